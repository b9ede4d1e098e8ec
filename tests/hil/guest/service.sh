# Functions of scenarios with the installed service.
# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0

export DEBIAN_FRONTEND=noninteractive
# shellcheck disable=SC2034
modbus_port=1502 modbus_address=127.0.0.1
machine_address=10.77.0.2
camera=/dev/video40 width=320 height=256 bytes=$((320 * 256 * 2))
# shellcheck source=../../support/modbus.sh
. /orbwatch/tests/support/modbus.sh

# property NAME: prints a property of the service from systemd.
property() { systemctl show --property "$1" --value orbwatch; }

# say_what_happened: prints the log for a check that fails; returns 1.
say_what_happened() {
  systemctl status --no-pager --lines 0 orbwatch
  journalctl --unit orbwatch --no-pager --lines 40
  return 1
}

# works: succeeds when the service is active and makes frame sets.
works() { systemctl --quiet is-active orbwatch && is_past system_frame_set 2; }

# comes_back COMMAND...: runs the command, which ends the service; it must be started again and
# work.
comes_back() {
  local restarts
  restarts=$(property NRestarts)
  "$@" || return
  wait_for 180 is_started_again "$restarts" && wait_for 180 works || say_what_happened
}

is_started_again() { (($(property NRestarts) > $1)); }

# install FOLDER [OPTION...]: installs the package in the folder with apt.
install() {
  local folder=$1
  shift
  apt-get install -y "$@" "$folder"/orbwatch_*_arm64.deb </dev/null
}

connect_network() { ip address add "$machine_address/24" dev eth0 && ip link set eth0 up; }

# host_reads NAME: prints the value of an input register, read over the network by the host.
host_reads() { on_host register "$machine_address" "$modbus_port" "$1"; }

# Starts a camera: a feeder writes a picture repeatedly; sets feeder to its process.
make_camera() {
  load v4l2loopback devices=1 video_nr=40 card_label=orbwatch exclusive_caps=0 || return
  head -c "$bytes" /dev/urandom >/tmp/picture
  {
    v4l2-ctl -d "$camera" --set-fmt-video-out="width=$width,height=$height,pixelformat=Y16 " ||
      exit
    while dd if=/tmp/picture bs="$bytes" status=none; do sleep 0.2; done
  } >"$camera" &
  feeder=$!
  wait_for 60 eval "v4l2-ctl -d $camera --get-fmt-video | grep -q 'Width/Height.*: $width/$height'"
}

# Removes the camera once no program uses it.
remove_camera() { kill "$feeder" && wait_for 60 modprobe -r v4l2loopback; }

# Writes the site of an installer: one camera.
make_site() {
  cat >/etc/orbwatch/rig.toml <<RIG
[[camera]]
name = "melt"
width = $width
height = $height
[camera.outline]
centre = [160, 128]
radius = 100
alpha = 340
RIG
  cat >/etc/orbwatch/recipes/melt.toml <<'RECIPE'
name = "melt"
[[view]]
name = "pool"
measured = "melt"
width = 160
height = 120
[[view.source]]
camera = "melt"
[[region]]
name = "pool"
view = "pool"
hot_spot_threshold = 95
RECIPE
  cat >/etc/orbwatch/site.toml <<SITE
rig = "rig.toml"
[[recipe]]
number = 1
file = "recipes/melt.toml"
[modbus]
port = $modbus_port
[[camera]]
name = "melt"
back_end = "v4l2"
width = $width
height = $height
frame_rate = 5
[camera.v4l2]
device = "$camera"
pixel_format = "y16"
[[view]]
name = "front"
width = 160
height = 120
[[view.source]]
camera = "melt"
SITE
}
