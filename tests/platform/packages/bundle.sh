# Sourced by run: one file contains everything that a minimal system needs.
# shellcheck shell=bash disable=SC2154
# SPDX-License-Identifier: Apache-2.0

test_bundle() {
  local bundle=$folder/orbwatch-$suite-$architecture.tar
  check "there is a bundle, by build-deb --bundle" test -e "$bundle"
  [[ -e $bundle ]] || return 0
  tar -xf "$bundle" -C "$packages"
  check "it has each package that one of it needs in exactly one version" \
    has_exact_dependencies "$packages/orbwatch-$suite-$architecture/packages"
  check "a system boots" boot "$roots/minimal-$suite-$architecture" || return
  check "the minimal system has none of what it needs" inside sh -c '! test -e /usr/lib/*-linux-gnu/libmodbus.so.5'
  check "the bundle installs without a network" inside "/packages/orbwatch-$suite-$architecture/install"
  check "and the service is active" has ActiveState active
  check "and measures" wait_for "$patience" measures
  check "it adds the module for libcamera" inside "/packages/orbwatch-$suite-$architecture/install" orbwatch-camera-libcamera
  check "which is loaded" inside sh -c 'orbwatch --version | grep -E "^libcamera v?[0-9]"'
  check "and the service runs on" wait_for "$patience" measures
}

# has_exact_dependencies FOLDER: succeeds if the packages in the folder include each `X (= V)` that one of them depends
# on; prints those that are missing. Of alternatives one is enough, which apt has chosen.
has_exact_dependencies() {
  local file
  for file in "$1"/*.deb; do dpkg-deb --show --showformat='${Package} (= ${Version})\n' "$file"; done |
    LC_ALL=C sort >"$work/bundled"
  for file in "$1"/*.deb; do dpkg-deb --show --showformat='${Pre-Depends}, ${Depends}\n' "$file"; done |
    tr ',' '\n' | grep -v '|' | sed -n 's/^ *\([^ :]*\)\(:[a-z0-9]*\)\? *\((= .*)\).*/\1 \3/p' | LC_ALL=C sort -u >"$work/needed"
  [[ -s $work/needed ]] && ! LC_ALL=C comm -13 "$work/bundled" "$work/needed" | grep .
}
