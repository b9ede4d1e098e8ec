# Sourced by build-image and build-bundle: their options and the slot that both contain.
# shellcheck shell=bash disable=SC2034
# SPDX-License-Identifier: Apache-2.0
program=${0##*/}
refuse() { echo "$program: $*" >&2; exit 2; }

# value OPTION [VALUE]: prints the value of an option.
value() { [[ -n ${2:-} ]] || refuse "$1 needs a value"; echo "$2"; }

# read_options ARGUMENT...: sets suite, architecture, packages, key, certificate, configuration, more, added,
# version, consoles and output; files become absolute.
read_options() {
  suite="" architecture="" packages="" key="" version="" consoles="" output=""
  certificate=- configuration=- more=- added=()
  while (($#)); do
    case $1 in
      --help) usage; exit 0 ;;
      --suite) suite=$(value "$@") ;;
      --arch) architecture=$(value "$@") ;;
      --packages) packages=$(realpath -e "$(value "$@")") ;;
      --key) key=$(realpath -e "$(value "$@")") ;;
      --cert) certificate=$(realpath -e "$(value "$@")") ;;
      --configuration) configuration=$(realpath -e "$(value "$@")") ;;
      --files) more=$(realpath -e "$(value "$@")") ;;
      --add) added+=("$(value "$@")") ;;
      --version) version=$(value "$@") ;;
      --console) consoles=$(value "$@") ;;
      -o) output=$(realpath -m "$(value "$@")") ;;
      *) refuse "unknown option $1; see --help" ;;
    esac
    shift 2
  done
  [[ $suite == trixie ]] || refuse "--suite is \"$suite\"; it must be trixie"
  [[ $architecture =~ ^(amd64|arm64)$ ]] || refuse "--arch is \"$architecture\"; it must be amd64 or arm64"
  [[ -z $key || $certificate != - ]] || refuse "--key needs --cert"
  [[ $configuration == - || -e $configuration/site.toml ]] || refuse "$configuration has no site.toml"
  [[ -z $version || $version =~ ^[0-9]+(\.[0-9]+)*$ ]] ||
    refuse "--version is \"$version\"; it must be numbers, separated by dots"
  ((EUID == 0)) || refuse "needs root, to enter the system that it makes"
}

# Sets files to the packages of orbwatch that the image contains: all but manuals, types and the module for videos.
# Without --packages those of the present commit, which are built unless build-deb has left them.
find_packages() {
  local file name commit
  if [[ -z $packages ]]; then
    packages=$PWD/build/deb/$suite-$architecture
    commit=$(platform/build-deb --commit)
    # Changed files may have changed again since.
    if [[ $commit == *-changed || $(cat "$packages/commit" 2>/dev/null) != "$commit" ]]; then
      echo "$program: builds orbwatch's packages of $commit; --packages takes others" >&2
      platform/build-deb --suite "$suite" --arch "$architecture"
    fi
  fi
  files=()
  for name in orbwatch orbwatch-camera-genicam orbwatch-camera-libcamera; do
    for file in "$packages/$name"_*_"$architecture".deb; do [[ ! -e $file ]] || files+=("$file"); done
  done
  [[ ${files[0]:-} == */orbwatch_* ]] || refuse "$packages has no orbwatch_*_$architecture.deb"
}

# names_in FOLDER...: prints type, mode, name and target of all that the folders have.
names_in() {
  local folder
  for folder in "$@"; do find "$folder" -printf '%y %m %P %l\n' | LC_ALL=C sort; done
}

# Makes the contents of a slot; sets tools and slot to their folders.
make_signed_slot() {
  local base needed epoch system folders inputs=()
  epoch=$(git log -1 --format=%ct)
  export SOURCE_DATE_EPOCH=$epoch
  find_packages
  platform/install_packages package image
  [[ -n $version ]] || version=$(dpkg-deb --field "${files[0]}" Version | sed 's/~.*//')
  declare -A serial=([amd64]=ttyS0 [arm64]=ttyAMA0)
  [[ -n $consoles ]] || consoles=tty0,${serial[$architecture]}
  tools=build/chroots/image-tools-$suite base=build/chroots/image-$suite-$architecture
  tests/support/cached "$tools" -- platform/image/make_tools "$suite"
  mapfile -t needed < <(platform/debian/needed_by "${files[@]}")
  tests/support/cached "$base" -- platform/image/make_base "$suite" "$architecture" "${needed[@]}" "${added[@]}"
  mapfile -t system < <(find platform/image/system -type f | sort)
  # Systems of the same command may have other versions of Debian's packages.
  inputs=(platform/image/make_root "${system[@]}" "${files[@]}" "$tools.made-from" "$base.made-from"
    "$tools/var/lib/dpkg/status" "$base/var/lib/dpkg/status")
  [[ $certificate == - ]] || inputs+=("$certificate")
  [[ $configuration == - ]] || mapfile -t -O "${#inputs[@]}" inputs < <(find -L "$configuration" -type f | sort)
  [[ $more == - ]] || mapfile -t -O "${#inputs[@]}" inputs < <(find -L "$more" -type f | sort)
  slot=build/image/$suite-$architecture-$version
  mapfile -t folders < <(printf '%s\n' platform/image/system "$configuration" "$more" | grep -vx -e -)
  mkdir -p build/image
  names_in "${folders[@]}" >"$slot.names"
  inputs+=("$slot.names")
  tests/support/cached "$slot" "${inputs[@]}" -- platform/image/make_slot "$tools" "$architecture" "$consoles" \
    "$base" "$epoch" "$version" "$certificate" "$configuration" "$more" "${files[@]}"
  # shellcheck disable=SC2086
  platform/image/make_efi "$slot" "$tools" "$architecture" "$epoch" ${key:+"$key" "$certificate"}
}
