# Sourced by run: the scenarios, and the choice of those that run.
# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
here=tests/hil
scenarios=$here/scenarios
all=() rare=() chosen=() left_out=()

# header SCENARIO KEY: prints the words of KEY in the scenario's first lines.
header() { sed -n "1,6s/^# $2: //p" "$scenarios/$1" | xargs; }

# draw COUNT SEED: prints COUNT of the lines, the same ones for the same seed.
draw() {
  local line
  while read -r line; do
    echo "$(sha256sum <<<"$2 $line") $line"
  done | sort | head -n "$1" | cut -d ' ' -f 4-
}

# lines WORD...: prints one word per line, nothing for no words.
lines() { (($# == 0)) || printf '%s\n' "$@"; }

# Sets all to SCENARIO@MACHINE of each, and rare to those that run with --all-machines only.
find_all() {
  local file scenario folder machines
  for file in "$scenarios"/*; do
    scenario=${file##*/}
    read -ra machines <<<"$(header "$scenario" Machines)"
    all+=("${machines[@]/#/$scenario@}")
    if [[ $(header "$scenario" Only) == --all-machines ]]; then
      rare+=("${machines[@]/#/$scenario@}")
      continue
    fi
    [[ -n $(header "$scenario" Folders) ]] || { echo "run: $file names no Folders" >&2; return 1; }
    for folder in $(header "$scenario" Folders); do
      [[ -e $folder ]] || { echo "run: $file names $folder, which does not exist" >&2; return 1; }
    done
  done
}

# find_named NAME...: adds the named ones to chosen, each once.
find_named() {
  local name run found
  for name in "$@"; do
    found=0
    for run in "${all[@]}"; do
      if [[ $run == "$name" || ${run%@*} == "$name" ]]; then
        [[ " ${chosen[*]} " == *" $run "* ]] || chosen+=("$run")
        found=1
      fi
    done
    ((found)) || { echo "run: no scenario $name; see --list" >&2; return 2; }
  done
}

# find_part PART: adds the scenarios that have the part to chosen.
find_part() {
  local file
  for file in "$scenarios"/*; do
    ! grep -qx "part $1" "$file" || find_named "${file##*/}"
  done
  ((${#chosen[@]})) || { echo "run: no part \"$1\"; there are:" "$here"/parts/* >&2; return 2; }
}

# choose ordinary|drawn|every BASE SEED: sets chosen, and left_out to "SCENARIO@MACHINE without
# DRIVER" of those that must fail without their driver. Prints the scenarios that do not run.
choose() {
  local run driver ordinary passed_over
  mapfile -t ordinary < <(lines "${all[@]}" | grep -vxFf <(lines "${rare[@]}"))
  case $1 in
    every) chosen=("${all[@]}") ;;
    ordinary) chosen=("${ordinary[@]}") ;;
    drawn) choose_changed "$2" "$3" "${ordinary[@]}" ;;
  esac
  left_out=()
  for run in "${chosen[@]}"; do
    driver=$(header "${run%@*}" Driver)
    [[ -z $driver ]] || left_out+=("$run without $driver")
  done
  [[ $1 != every ]] || return 0
  mapfile -t left_out < <(lines "${left_out[@]}" | draw 1 "$3")
  mapfile -t passed_over < <(lines "${all[@]}" | grep -vxFf <(lines "${chosen[@]}"))
  echo "not run: ${passed_over[*]}; $here/run --all-machines runs all"
}

# Files that every scenario depends on.
everything=("$here" platform/build-deb platform/debian platform/install_packages tests/support/cached
            tests/support/checks.sh tests/support/debian_apt tests/support/debian_root tests/support/enter_root
            tests/support/modbus.sh tests/support/unpack_package)

# choose_changed BASE SEED RUN...: sets chosen to those with changes since BASE, and, when HEAD's hash draws
# machines at all, two of the others; with ORBWATCH_SINCE (tests/support/drawn.sh) to those with changes since
# then only.
choose_changed() {
  local base=${ORBWATCH_SINCE:-$1} seed=$2 run folders others=()
  shift 2
  if tests/support/changed "$base" "${everything[@]}"; then
    chosen=("$@")
    return
  fi
  for run in "$@"; do
    read -ra folders <<<"$(header "${run%@*}" Folders)"
    if tests/support/changed "$base" "${folders[@]}"; then chosen+=("$run"); else others+=("$run"); fi
  done
  echo "changed since $base: ${chosen[*]:-none}"
  draws machines || return 0
  mapfile -t others < <(lines "${others[@]}" | draw 2 "$seed")
  chosen+=("${others[@]}")
}

# Sorts vimc and vivid first, which take longest, so that neither runs alone at the end.
longest_first() {
  awk '/^(vimc|vivid)@[^ ]*$/ {print; next} {later[++n] = $0}
    END {for (i = 1; i <= n; ++i) print later[i]}'
}
