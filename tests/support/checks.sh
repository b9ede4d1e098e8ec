# The words that checks in shell are written in: for scenarios of tests/hil and for
# tests/platform/packages. Whoever sources this defines report VERDICT NAME, which is where a verdict
# goes.
# shellcheck shell=bash

failed_checks=0

# check NAME COMMAND...: a test that passes when the command ends with 0; fails when the test does. What
# the command prints is in the log, between two lines with the name.
check() {
  local name=$1 verdict=passed
  shift
  echo "--- $name ($(cut -d ' ' -f 1 /proc/uptime) s)"
  "$@" || { verdict=FAILED failed_checks=$((failed_checks + 1)); }
  echo "$verdict: $name"
  report "$verdict" "$name"
  [[ $verdict == passed ]]
}

# wait_for SECONDS COMMAND...: until the command succeeds; busy and emulated machines take their time.
wait_for() {
  local deadline=$((SECONDS + $1))
  shift
  until "$@"; do
    ((SECONDS < deadline)) || { echo "not within the time: $*"; return 1; }
    sleep 0.1
  done
}
