# Commands for writing scenarios. Every check is a test of its own: passed or FAILED, one line of
# /results/checks each; its output is in the log.
# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0

# shellcheck source=../../support/checks.sh
. /orbwatch/tests/support/checks.sh

report() { echo "$1 $2" >>/results/checks; }

# load DRIVER [PARAMETER=VALUE...]: loads a driver and waits until udev has handled its devices.
loaded_drivers=/run/loaded_drivers
load() {
  modprobe "$@" || return
  echo "$1" >>"$loaded_drivers"
  ! command -v udevadm >/dev/null || udevadm settle --timeout=60
}

# video_device NAME: prints the first video node of the driver or card whose name contains NAME.
video_device() {
  local folder
  for folder in /sys/class/video4linux/video*; do
    [[ $(cat "$folder/name" 2>/dev/null) != *"$1"* ]] || { echo "/dev/${folder##*/}"; return; }
  done
  echo "no video device named $1" >&2
  return 1
}

# on_host PROGRAM [ARGUMENT...]: runs a program of the folder host on the computer that emulates
# this machine and is its only neighbour in the network; prints its output and returns its exit
# code.
on_host() {
  local channel line code=1
  exec {channel}<>/dev/virtio-ports/host || return
  echo "$*" >&"$channel"
  while read -r line <&"$channel"; do
    [[ $line != "exit "* ]] || { code=${line#exit }; break; }
    [[ -z $line ]] || echo "$line"
  done
  exec {channel}>&-
  return "$code"
}
