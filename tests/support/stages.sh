# shellcheck shell=bash disable=SC2154
# Sourced by the scripts that run tests: timed stages, a table of them, and counts of results.
# $stages is the table's Markdown file, created by stages_begin; $logs the folder of their output.
# SPDX-License-Identifier: Apache-2.0

stages_begin() {
  passed=0 failed=0 skipped=0
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

# stage_row NAME RESULT: adds a row to the table for the command that timed has run.
stage_row() { echo "| $1 | $wall | $cpu | $2 |" >>"$stages"; }

# stage NAME COMMAND...: runs one step that passes or fails as a whole; its output is kept.
stage() {
  timed "$logs/$1.log" "${@:2}"
  stage_ended "$1" $?
}

# stage_ended NAME CODE [HOW]: counts the step that timed has run, and prints its log's end after a failure.
stage_ended() {
  if (($2 == 0)); then
    passed=$((passed + 1))
    stage_row "$1" "passed${3:+, $3}"
    echo "passed   $1 ($wall s)"
  else
    failed=$((failed + 1))
    stage_row "$1" "FAILED${3:+, $3}"
    echo "FAILED   $1 ($wall s), the end of $logs/$1.log:"
    tail -n 60 "$logs/$1.log"
    return 1
  fi
}

# beside NAME COMMAND...: starts a stage that leaves a core to those after it; await NAME ends it.
# end_begun ends the started stages that are no longer awaited.
declare -A begun
beside() {
  local name=$1
  shift
  set -m  # a process group of its own
  {
    timed "$logs/$name.log" "$@"
    echo "$? $wall $cpu" >"$logs/$name.ended"
  } &
  begun[$name]=$!
  set +m
}
end_begun() {
  local group
  for group in "${begun[@]}"; do kill -- "-$group" 2>/dev/null; done
}
await() {
  local code
  wait "${begun[$1]}"
  read -r code wall cpu <"$logs/$1.ended"
  stage_ended "$1" "$code" beside
}

# stages_end: completes the table with the sums and prints it. Parallel stages add no time.
stages_end() {
  awk -F'|' 'NR > 2 {cpu += $4} NR > 2 && !/, beside \|$/ {wall += $3} END {print "| **together** | " wall " | " cpu " | |"}' \
    "$stages" >"$stages.sum"
  cat "$stages.sum" >>"$stages"
  rm "$stages.sum"
  cat "$stages"
}

# stages_verdict: prints the counts; fails when a test failed or, in acceptance mode, was skipped.
stages_verdict() {
  echo
  echo "$passed passed, $failed failed, $skipped skipped"
  ((failed == 0)) && { [[ -z ${ORBWATCH_ACCEPTANCE:-} ]] || ((skipped == 0)); }
}
