# shellcheck shell=bash disable=SC2034,SC2154
# Sourced by the scripts that count instructions of aarch64 programs under qemu-user. $out: folder
# for their output.
# SPDX-License-Identifier: Apache-2.0

host=build/release/tests/bench
target=build/aarch64/tests/bench
library_folder=/usr/lib/aarch64-linux-gnu
sysroot=/usr/aarch64-linux-gnu

# quietly NAME COMMAND...: runs a command; prints its output only when it fails.
quietly() {
  local log=$out/$1.log
  shift
  "$@" >"$log" 2>&1 || { tail -n 40 "$log"; echo "$0: failed: $*"; exit 1; } >&2
}

# Debian 13's qemu-user is linked statically and does not support plugins: Debian 12's is used then.
find_qemu() {
  qemu=(qemu-aarch64)
  [[ $(qemu-aarch64 -help) == *$'\n-plugin '* ]] && return
  local root=$out/qemu libraries
  quietly qemu-packages tests/support/cached "$root" -- tests/support/debian_root \
    "$(dpkg --print-architecture)" bookworm qemu-user
  libraries=$(find "$root/lib" "$root/usr/lib" -name '*.so.*' -printf '%h\n' | sort -u | paste -sd :)
  qemu=("$(find -L "$root"/lib* -maxdepth 1 -name 'ld-linux*.so.*' | head -n 1)"
        --library-path "$libraries" "$root/usr/bin/qemu-aarch64")
}

# The same for programs of this computer.
find_native_qemu() {
  find_qemu
  qemu=("${qemu[@]/%qemu-aarch64/qemu-$(uname -m)}")
  sysroot=/ library_folder=/usr/lib/$(uname -m)-linux-gnu
}

# number_from PLUGIN PROGRAM ARGUMENT...: prints the plugin's numbers for the program, and in the same
# line the program's output.
number_from() {
  local file said
  file=$(mktemp "$out/number.XXXXXX")
  if ! said=$("${qemu[@]}" -L "$sysroot" \
      -E LD_LIBRARY_PATH="$library_folder:$library_folder/blas:$library_folder/lapack" \
      -plugin "$host/lib$1.so,out=$file" "${@:2}") ||
    ! grep -Exq '[0-9 ]+' "$file"; then
    echo "$0: no number from $1 for ${*:2}" >&2
    exit 1
  fi
  echo "$(<"$file") $said"
  rm "$file"
}

# instructions_of PROGRAM ARGUMENT...: prints the instructions of one repetition, the difference of two
# runs, and in the same line the program's output.
instructions_of() {
  local once twice said
  read -r once said < <(number_from count_instructions "$@" 1)
  read -r twice said < <(number_from count_instructions "$@" 2)
  echo "$((twice - once)) $said"
}

# side_by_side: runs the commands of stdin, one per line, several at a time. Each prints its whole line
# at once.
side_by_side() {
  local command running=0
  while read -r command; do
    if ((running == $(nproc))); then
      wait -n
      running=$((running - 1))
    fi
    $command &
    running=$((running + 1))
  done
  for (( ; running > 0; running--)); do wait -n; done
}
