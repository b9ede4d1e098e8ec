# shellcheck shell=bash disable=SC2154
# Sourced by the scripts that run tests: stages that are timed, and a table of them.
# $stages is the table's file, Markdown, which stages_begin makes.

stages_begin() {
  mkdir -p "$(dirname "$stages")"
  printf '| stage | s | CPU s | result |\n|---|---|---|---|\n' >"$stages"
}

# timed LOG COMMAND...: runs a command with its output in LOG and sets $wall and $cpu, in seconds.
# CPU seconds are comparable on a busy machine, too.
timed() {
  local log=$1 times code TIMEFORMAT='%R %U %S'
  shift
  times=$(mktemp)
  { time "$@" >"$log" 2>&1; } 2>"$times"
  code=$?
  read -r wall cpu < <(awk 'END {printf "%.0f %.0f\n", $1, $2 + $3}' "$times")
  rm "$times"
  return "$code"
}

# stage_row NAME RESULT: a line of the table for what timed has run.
stage_row() { echo "| $1 | $wall | $cpu | $2 |" >>"$stages"; }

# stages_end: completes the table with the sums and prints it.
stages_end() {
  awk -F'|' 'NR > 2 {wall += $3; cpu += $4} END {print "| **together** | " wall " | " cpu " | |"}' \
    "$stages" >"$stages.sum"
  cat "$stages.sum" >>"$stages"
  rm "$stages.sum"
  cat "$stages"
}
