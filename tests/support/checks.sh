# Functions for checks in shell: for scenarios of tests/hil and for tests/platform/packages. The script
# that sources this file defines report VERDICT NAME, which receives the verdicts.
# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0

failed_checks=0

# check NAME COMMAND...: runs a test that passes when the command ends with 0; fails when the test does.
# The command's output is in the log, between two lines with the name.
check() {
  local name=$1 verdict=passed
  shift
  echo "--- $name ($(cut -d ' ' -f 1 /proc/uptime) s)"
  "$@" || { verdict=FAILED failed_checks=$((failed_checks + 1)); }
  echo "$verdict: $name"
  report "$verdict" "$name"
  [[ $verdict == passed ]]
}

# wait_for SECONDS COMMAND...: waits until the command succeeds; busy and emulated machines are slow.
wait_for() {
  local deadline=$((SECONDS + $1))
  shift
  until "$@"; do
    ((SECONDS < deadline)) || { echo "not within the time: $*"; return 1; }
    sleep 0.1
  done
}
