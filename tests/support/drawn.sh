# shellcheck shell=bash
# Sourced by the scripts that run tests: selects the stages that most changes do not affect.
# ORBWATCH_SINCE: the commit to compare with instead of the last whole run's; nothing is drawn then.
# ORBWATCH_UNTIL: seconds since 1970 from which on no such stage begins, so that a slow machine comes to an end.
# SPDX-License-Identifier: Apache-2.0

# Folders and files whose changes require the long gates of alignment.
# shellcheck disable=SC2034
alignment=(app/simulation proc/align proc/optics tests/proc/align tests/support/*.cpp tests/support/*.h)

# passed_at PART: prints the commit at which a part of tests/whole passed last; empty: never.
passed_at() { awk -F' \\| ' -v part="| $1" '$1 == part && $5 ~ /^passed/ {print $3}' tests/REPORT.md 2>/dev/null || true; }

# last_whole PART: prints the newest commit at which all of PART passed, alone or within `run`.
last_whole() {
  local own run
  own=$(passed_at "$1")
  run=$(passed_at run)
  if [[ $1 == machines || -z $run ]] || git merge-base --is-ancestor "$run" "${own:-none}" 2>/dev/null; then
    echo "$own"
  else
    echo "$run"
  fi
}

# draws NAME: ends with 0 when HEAD's hash draws NAME, one of four.
draws() {
  local hash
  [[ -z ${ORBWATCH_SINCE:-} ]] || return
  hash=$(printf '%s %s' "$(git rev-parse HEAD)" "$1" | sha256sum)
  ((16#${hash:0:4} % 4 == 0))
}

# drawn_of NAME...: prints one of the names, which HEAD's hash draws.
drawn_of() {
  local names=("$@") hash
  hash=$(git rev-parse HEAD)
  echo "${names[16#${hash:0:4} % $#]}"
}

# by_turns: names in an order that HEAD's hash draws.
by_turns() {
  local name head
  head=$(git rev-parse HEAD)
  while read -r name; do echo "$(sha256sum <<<"$head $name") $name"; done | sort | sed 's/.* //'
}

# due NAME FOLDER...: ends with 0 when NAME is to run: in a whole run (whole=1), and else, while there is
# time, when something below a folder changed since the last whole run of $part, or when it is drawn.
due() {
  local code=0
  ((${whole:-0})) && return
  [[ -z ${ORBWATCH_UNTIL:-} ]] || (($(date +%s) < ORBWATCH_UNTIL)) || return
  tests/support/changed "${ORBWATCH_SINCE:-$(last_whole "$part")}" "${@:2}" || code=$?
  ((code != 1)) || draws "$1"
}
