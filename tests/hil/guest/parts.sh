# Functions of scenarios with several parts: each part has the machine to itself, even after a
# failed part.
# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0

# part NAME: runs the checks of parts/NAME as a process of its own, then ends its remaining
# processes, unloads the drivers that it loaded and empties /tmp. /results/parts gets a line:
# "passed" or "FAILED", and the name.
part() {
  local group verdict=passed
  [[ -z ${only_part:-} || $only_part == "$1" ]] || return 0
  echo "=== part $1"
  : >"${loaded_drivers:?}"
  setsid /orbwatch/tests/hil/guest/run_checks "parts/$1" &
  group=$!
  wait "$group" || verdict=FAILED
  if ! clean_up "$group"; then
    verdict=FAILED
    report FAILED "$1_is_cleaned_up"
  fi
  [[ $verdict == passed ]] || failed_checks=$((failed_checks + 1))
  echo "$verdict $1" >>/results/parts
}

clean_up() {
  local driver drivers
  end_processes "$1" || return
  mapfile -t drivers < <(sort -u "$loaded_drivers")
  for driver in "${drivers[@]}"; do unload "$driver" || return; done
  find /tmp -mindepth 1 -delete
}

# end_processes GROUP: ends a process group; a stopped process is continued, so that it can end.
end_processes() {
  has_ended "$1" && return
  kill -TERM -- "-$1" && kill -CONT -- "-$1"
  wait_for 60 has_ended "$1" || { kill -KILL -- "-$1"; wait_for 60 has_ended "$1"; }
}

has_ended() { ! kill -0 -- "-$1" 2>/dev/null; }

# unload DRIVER: unloads it once no program, such as udev, has its device open.
unload() {
  [[ $1 != gpio-sim ]] || remove_chips || return
  wait_for 60 modprobe -r "$1"
}

remove_chips() {
  local chip
  for chip in /sys/kernel/config/gpio-sim/*; do
    [[ -d $chip ]] || continue
    echo 0 >"$chip/live" && find "$chip" -mindepth 2 -type d -delete && rmdir "$chip"/bank* "$chip" ||
      return
  done
}
