# shellcheck shell=bash
# Sourced by the scripts that run tests: selects the stages that most changes do not affect.
# ORBWATCH_SINCE: the commit to compare with instead of the last whole run's; nothing is drawn then.
# SPDX-License-Identifier: Apache-2.0

# Folders whose changes require the long gates of alignment.
# shellcheck disable=SC2034
alignment=(app/simulation proc/align proc/optics tests/proc/align tests/support)

# The commit of the last whole run; empty when there was none.
last_whole() { sed -n 's/^Commit: *//p' tests/REPORT.md 2>/dev/null || true; }

# draws NAME: ends with 0 when HEAD's hash draws NAME, one of four.
draws() {
  local hash
  [[ -z ${ORBWATCH_SINCE:-} ]] || return
  hash=$(printf '%s %s' "$(git rev-parse HEAD)" "$1" | sha256sum)
  ((16#${hash:0:4} % 4 == 0))
}

# due NAME FOLDER...: ends with 0 when NAME is to run: in a whole run (whole=1), when something below a
# folder changed since the last whole run, or when it is drawn.
due() {
  local code=0
  ((${whole:-0})) && return
  tests/support/changed "${ORBWATCH_SINCE:-$(last_whole)}" "${@:2}" || code=$?
  ((code != 1)) || draws "$1"
}
