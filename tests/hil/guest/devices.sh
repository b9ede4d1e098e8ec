# Devices that scenarios and parts make from the kernel's drivers: a chip of lines, a camera that is fed.
# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0

chip_config=/sys/kernel/config/gpio-sim/orbwatch
# make_chip NAME...: makes the chip "orbwatch" of 8 lines, named from offset 2 on. Sets chip to its device, and
# lines to the folder of their wires, sim_gpioOFFSET.
make_chip() {
  local offset=2 name
  load gpio-sim || return
  mountpoint --quiet /sys/kernel/config || mount -t configfs none /sys/kernel/config || return
  mkdir -p $chip_config/bank || return
  echo 8 >$chip_config/bank/num_lines
  echo orbwatch >$chip_config/bank/label
  for name in "$@"; do
    mkdir $chip_config/bank/line$offset || return
    echo "$name" >$chip_config/bank/line$offset/name
    offset=$((offset + 1))
  done
  echo 1 >$chip_config/live || return
  chip=$(cat $chip_config/bank/chip_name)
  # shellcheck disable=SC2034
  lines=/sys/devices/platform/$(cat $chip_config/dev_name)/$chip
  wait_for 20 test -e "/dev/$chip"
}

# make_camera PICTURE FOURCC WIDTH HEIGHT: makes a camera that a process feeds with the file PICTURE, five times
# per second. Sets camera and feeder.
make_camera() {
  local picture=$1 fourcc=$2 width=$3 height=$4
  load v4l2loopback devices=1 card_label=orbwatch exclusive_caps=0 || return
  camera=$(video_device orbwatch) || return
  {
    v4l2-ctl -d "$camera" --set-fmt-video-out="width=$width,height=$height,pixelformat=$fourcc" ||
      exit
    while dd if="$picture" bs="$(stat -c %s "$picture")" status=none; do sleep 0.2; done
  } >"$camera" &
  # shellcheck disable=SC2034
  feeder=$!
  wait_for 60 eval "v4l2-ctl -d $camera --get-fmt-video | grep -q 'Width/Height.*: $width/$height'"
}
