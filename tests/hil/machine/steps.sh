# Sourced by prepare and build: steps that make missing parts of the machines "$@" in the folder
# $cache. Logs are in $results, times in $stages. Another run waits for the end of this one.
# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
: "${cache:?}" "${results:?}" "${stages:?}"
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
project=$(cd "$here/../../.." && pwd)
support=$project/tests/support
# shellcheck source=../../support/stages.sh
. "$support/stages.sh"
# Scripts that unpack packages: their results are made again when they change.
# shellcheck disable=SC2034
unpacking=("$support/debian_apt" "$support/unpack_package")

# step NAME COMMAND...: runs a command and prints its output only if it fails.
step() {
  local name=$1
  shift
  if ! timed "$results/$name.log" "$@"; then
    echo "run: $name failed, the end of $results/$name.log:" >&2
    tail -n 40 "$results/$name.log" >&2
    exit 1
  fi
  stage_row "$name" passed
  echo "$name (${wall:?} s)"
}

# for_machine NAME...: succeeds if one of these machines is requested.
for_machine() {
  local name
  for name in "$@"; do [[ " ${machines[*]} " != *" $name "* ]] || return 0; done
  return 1
}

machines=("$@")
mkdir -p "$cache"
exec 9>"$cache/lock"
if ! flock --nonblock 9; then
  echo "waiting for another run, which makes the machines"
  flock 9
fi
