# shellcheck shell=bash disable=SC2154
# Sourced by tests/run, after stages.sh and drawn.sh: builds a preset and runs its tests, case by case.
# SPDX-License-Identifier: Apache-2.0

# CTest's slots, three per core; tests/CMakeLists.txt sets the number that a test uses.
places=$((3 * $(nproc)))

# Prefix of the compile commands, such as nice.
gently=()

# build PRESET [TARGET...]: configures and compiles it.
build() {
  stage "$1-configure" cmake --preset "$1" && compile "$@"
}

# compile PRESET [TARGET...]: compiles a configured preset, all without targets.
compile() {
  local preset=$1 begin=$logs/$1-build.begin
  shift
  touch "$begin"
  stage "$preset-build" "${gently[@]}" cmake --build --preset "$preset" ${1:+--target "$@"} || return
  tests/support/costs.py "build/$preset" --since-file "$begin" --build-cpu "$cpu" >>"$logs/costs.md"
}

# An object takes a sanitizer this many times as long as the release build, including its part of the tests.
sanitizer_factor=2

# pace: prints the mean seconds that one core compiled an object of the release build.
pace() {
  awk -F'\t' '$4 ~ /\.o$/ {took[$4] = $2 - $1}
    END {for (name in took) {sum += took[name]; ++count}; if (count) print sum / count / 1000}' build/release/.ninja_log
}

# objects_within SECONDS: prints the number of objects that a sanitizer compiles and runs in this time.
objects_within() {
  awk -v within="$1" -v cores="$(nproc)" -v pace="$(pace)" -v factor="$sanitizer_factor" \
    'BEGIN {if (pace <= 0) exit 1; fit = int(within * cores / (factor * pace)); print (fit > 0 ? fit : 0)}'
}

# objects_of FOLDER NAME...: prints the number of objects that the programs consist of.
objects_of() { ninja -C "$1" -t commands "${@:2}" | grep -c -- ' -c '; }

# affordable FOLDER MOST: of names in order of their importance, those that together have at most MOST objects.
affordable() {
  local name taken=()
  while read -r name; do
    (($(objects_of "$1" "${taken[@]}" "$name") <= $2)) || continue
    taken+=("$name")
    echo "$name"
  done
}

# choose_programs PRESET: writes the test programs and fuzz targets of a configured preset that are to run, and
# the others, to files `due` and `not_due` in its folder.
choose_programs() {
  local folder=build/$1 fate most
  tests/support/due_programs.py "$folder" "${ORBWATCH_SINCE:-$(last_whole sanitizers)}" >"$folder/programs" ||
    return
  if ((whole)); then
    sed 's/.* //' "$folder/programs"
  else
    most=$(objects_within "$within") || { echo "no release build, whose pace is needed" >&2; return 1; }
    for fate in own due same; do sed -n "s/^$fate //p" "$folder/programs" | by_turns; done | affordable "$folder" "$most"
  fi >"$folder/due"
  sed 's/.* //' "$folder/programs" | { grep -vxFf "$folder/due" || true; } >"$folder/not_due"
}

# build_due PRESET: configures it and compiles the programs that are due.
build_due() {
  local preset=$1 targets=()
  stage "$preset-configure" cmake --preset "$preset" && stage "$preset-due" choose_programs "$preset" || return
  if [[ -s build/$preset/not_due ]]; then
    mapfile -t targets <"build/$preset/due"
    left_out "$(wc -l <"build/$preset/not_due") programs under $preset" "tests/run --whole"
    ((${#targets[@]})) || return 0
  fi
  compile "$preset" "${targets[@]}"
}

# Options that keep the complete output of programs, for count_cases.py.
junit=(--test-output-size-passed 10000000 --test-output-size-failed 10000000 --output-junit)

# run_cases NAME FOLDER COMMAND...: runs CTest for the build in FOLDER with a command that writes cases.xml
# there, and counts every case.
run_cases() {
  local name=$1 folder=$2 xml=$2/cases.xml log=$logs/$1.log begin=$logs/$1.begin told numbers code
  shift 2
  rm -f "$xml"
  touch "$begin"
  timed "$log" "$@"
  code=$?
  told=$(tests/support/count_cases.py "$xml")
  read -ra numbers <<<"${told%%$'\n'*}"
  if ((${numbers[0]:-0} + ${numbers[2]:-0} == 0)); then
    failed=$((failed + 1))
    stage_row "$name" FAILED
    echo "FAILED   $name: no test was run, see $log"
    tail -n 20 "$log"
    return 1
  fi
  # CTest itself may report a failure that no case reports.
  ((code == 0 || numbers[2] > 0)) || numbers[2]=1
  passed=$((passed + numbers[0])) failed=$((failed + numbers[2])) skipped=$((skipped + numbers[4]))
  stage_row "$name" "${numbers[0]} passed, ${numbers[2]} failed, ${numbers[4]} skipped"
  echo "$name: ${numbers[0]} passed, ${numbers[2]} failed, ${numbers[4]} skipped ($wall s)"
  sed 1d <<<"$told"
  tests/support/unsteady.py record "$name" "$log"
  tests/support/costs.py "$folder" --since-file "$begin" --tests-cpu "$cpu" --name "$name" >>"$logs/costs.md"
  ((code == 0)) && return
  grep -B 5 -A 25 -E 'Failure|ERROR: |WARNING: ThreadSanitizer|runtime error' "$log" | head -n 200
  return 1
}

# cases PRESET [OPTION...]: runs the tests of a preset that is built; options are CTest's.
cases() {
  local preset=$1 folder=$PWD/build/$1
  shift
  # Sanitizers need a fixed address layout.
  run_cases "$preset-tests" "$folder" setarch -R ctest --preset "$preset" -j "$places" "$@" \
    "${junit[@]}" "$folder/cases.xml"
}

# cases_due PRESET: runs the tests of the programs that build_due has built.
cases_due() {
  local due
  if [[ ! -s build/$1/not_due ]]; then
    cases "$1"
  elif due=$(grep -v '^fuzz_' "build/$1/due"); then
    cases "$1" --tests-regex "^(${due//$'\n'/|})\\."
  fi
}
