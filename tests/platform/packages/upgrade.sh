# Sourced by run: state kept by an upgrade, and the refusal of a downgrade.
# shellcheck shell=bash disable=SC2154
# SPDX-License-Identifier: Apache-2.0

test_upgrade() {
  check "a system boots" boot "$roots/ready-$suite-$architecture" || return
  check "version $older is installed" inside sh -c 'apt-get install -y /packages/older/orbwatch_*.deb'
  check "it measures" wait_for "$patience" measures
  an_installer_was_here
  check "it measures what the installer wrote" wait_for "$patience" measures
  check "and a second machine" begin_second_machine
  files_of_state before
  inside sh -c 'cd /etc && find orbwatch -type f -exec sha256sum {} + | sort' >"$work/configuration-before"
  # Runs like unattended-upgrades: no answer, no option of dpkg.
  check "apt upgrades to $version, and asks nothing" inside sh -c \
    "apt-get install -y /packages/orbwatch_*_$architecture.deb </dev/null"
  check "it is configured" test "$(inside dpkg-query -W -f '${db:Status-Abbrev}${Version}' orbwatch)" = "ii $version"
  check "it measures on" wait_for "$patience" measures
  check "and the second machine" wait_for "$patience" second_measures
  check "both by the new program" programs_are_there
  inside sh -c 'cd /etc && find orbwatch -type f -exec sha256sum {} + | sort' >"$work/configuration-after"
  check "the configuration is what it was, and nothing is beside it" \
    diff "$work/configuration-before" "$work/configuration-after"
  end_second_machine
  files_of_state after
  check "commands and calibration are kept" diff "$work/state-before" "$work/state-after"
  check "the calibration is read" inside sh -c 'orbwatch calibration history | grep -F "for another rig file"'
  test_older_files
  check "a downgrade is refused with a sentence" downgrade_is_refused
  check "version $version runs on" wait_for "$patience" measures
  check "and is installed" test "$(inside dpkg-query -W -f '${db:Status-Abbrev}${Version}' orbwatch)" = "ii $version"
  check "nor is it installed where $version was removed" removed_is_not_replaced
}

# The executable of a process is deleted once its program was replaced.
programs_are_there() {
  local each programs=0
  for each in $(process); do
    programs=$((programs + 1))
    ! readlink "/proc/$each/exe" | grep deleted || return
  done
  ((programs == 2))
}

an_installer_was_here() {
  inside sed -i 's/^name = "door"/name = "gate"/' /etc/orbwatch/site.toml
  inside sed -i '1i # Measured on site.' /etc/orbwatch/rig.toml
  inside systemctl stop orbwatch.service
  as_service sh -c 'cat >/var/lib/orbwatch/calibration.toml' <<CALIBRATION
[[entry]]
number = 1
time = "2026-01-01T00:00:00Z"
camera = "colour"
method = "detect_ball"
quality = "0.1 mm"
rig = 1
[entry.ball]
centre = [120, 60, 430]
CALIBRATION
  inside systemctl start orbwatch.service
}

files_of_state() { inside sh -c 'cd /var/lib/orbwatch && sha256sum calibration.toml commands' >"$work/state-$1"; }

# Files of an older version, which this one does not read.
test_older_files() {
  inside systemctl stop orbwatch.service
  # The version follows the eight letters of each slot of 8 KiB.
  inside sh -c 'for slot in 0 1; do
    printf "\\0" | dd of=/var/lib/orbwatch/commands bs=1 seek=$((slot * 8192 + 8)) conv=notrunc status=none
  done'
  inside systemctl start orbwatch.service
  check "older commands are refused with a sentence" wait_for "$patience" says "commands: is of version 0; this orbwatchd reads version 1"
  check "and it measures" wait_for "$patience" measures
  inside sed -i '/^method/d' /var/lib/orbwatch/calibration.toml
  inside systemctl --no-block restart orbwatch.service
  check "an older calibration is refused with a sentence" wait_for "$patience" says "calibration.toml:"
  inside rm /var/lib/orbwatch/calibration.toml
  check "and without it, it measures" wait_for "$patience" measures
}

# Configuration and state are still there.
removed_is_not_replaced() { inside apt-get remove -y orbwatch && downgrade_is_refused; }

downgrade_is_refused() {
  ! inside sh -c 'apt-get install -y --allow-downgrades /packages/older/orbwatch_*.deb' >"$work/downgrade" 2>&1 &&
    grep -F "the older $older may not read" "$work/downgrade"
}
