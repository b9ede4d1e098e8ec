# Sourced by run: the installed package, its service, the effects of a second package, and their
# removal. Variables that seem unused are read by machine.sh.
# shellcheck shell=bash disable=SC2154,SC2034
# SPDX-License-Identifier: Apache-2.0

test_service() {
  check "a system boots" boot "$roots/ready-$suite-$architecture" || return
  files >"$work/before"
  check "the package has at most 5 MB: $(du -h --apparent-size "$package" | cut -f 1)" \
    test "$(stat -c %s "$package")" -le 5000000
  check "apt installs it without a network" inside sh -c "apt-get install -y /packages/orbwatch_*_$architecture.deb"
  check "the service is active then" has ActiveState active
  check "it measures the simulated machine, says mbpoll" wait_for "$patience" measures
  check "what is installed is as it was packed" inside sh -c 'test -z "$(dpkg --verify orbwatch)"'
  check "and no file that users edit is a conffile" test -z "$(inside dpkg-query -W -f '${Conffiles}' orbwatch)"
  test_programs
  test_start
  test_killed
  test_hung
  test_wrong_configuration
  test_configured
  later "second machine" test_second_machine
  later "packages of camera back-ends" test_others
  later removal test_removal
}

test_programs() {
  check "orbwatchd --check as the service's user" as_service orbwatchd --check
  check "the service may write its configuration" writes_configuration
  check "orbwatch doctor --json" doctor_speaks
  check "the manual pages" inside sh -c 'zcat /usr/share/man/man1/orbwatch.1.gz /usr/share/man/man8/orbwatchd.8.gz | grep -q "\.TH"'
  check "its exposure is at most 2.0 of 10" inside systemd-analyze security --threshold=20 --no-pager orbwatch.service
  check "its lines are in the journal, with a level" inside sh -c \
    'journalctl --no-pager SYSLOG_IDENTIFIER=orbwatchd PRIORITY=6 | grep "runs with"'
  check "systemd finds the modes of its folders that the unit states" has_stated_modes
  inside systemctl stop orbwatch.service
  check "orbwatch bench --simulated as the service's user" bench_speaks
  inside systemctl start orbwatch.service
}

has_stated_modes() {
  inside journalctl --no-pager >"$work/journal" && ! grep "orbwatch.*mode is different" "$work/journal"
}

# Writes in the service's view of the files.
writes_configuration() {
  inside nsenter --mount --target "$(property MainPID)" -- setpriv --reuid orbwatch --regid orbwatch --init-groups \
    sh -c 'cp /etc/orbwatch/site.toml /etc/orbwatch/tried && rm /etc/orbwatch/tried'
}

# The exit status depends on the board.
doctor_speaks() {
  inside orbwatch doctor --json >"$work/doctor.json" || (($? == 1))
  python3 -c 'import json, sys
report = json.load(open(sys.argv[1]))
assert len(report["checks"]) > 5 and report["worst"] in ("ok", "warning", "fault"), report' "$work/doctor.json"
}

# The exit status depends on the computer's other load.
bench_speaks() {
  as_service orbwatch bench --config /etc/orbwatch/site.toml --simulated --seconds 2 --json \
    >"$work/bench.json" || (($? == 1))
  python3 -c 'import json, sys
report = json.load(open(sys.argv[1]))
assert report["frame_sets"] > 0 and len(report["views"]) == 4, report' "$work/bench.json"
}

test_start() {
  local begin
  inside systemctl stop orbwatch.service
  begin=$(date +%s%N)
  inside systemctl start --no-block orbwatch.service
  check "it starts" wait_for "$patience" measures
  say "       from start to the first result by Modbus: $(seconds_since "$begin")"
  say "       resident: $(awk '/^VmRSS/ {printf "%.0f MB", $2 / 1000}' "/proc/$(process)/status")"
}

# process: prints its number outside of the system; of several machines all.
process() { pgrep --ns "$leader" --nslist pid --exact orbwatchd; }

# came_back BEFORE: succeeds when a new process measures, and the outputs were made safe in between.
came_back() { (($(property NRestarts) > $1)) && [[ $(property ActiveState) == active ]] && measures; }

outputs_were_made_safe() { property ExecStopPost | grep -F 'orbwatch lines --safe' | grep -F 'status=0/0'; }

test_killed() {
  local restarts begin
  restarts=$(property NRestarts) begin=$(date +%s%N)
  inside systemctl kill --signal=KILL --kill-whom=main orbwatch.service
  check "killed, it comes back" wait_for "$patience" came_back "$restarts"
  say "       from SIGKILL to the next result: $(seconds_since "$begin")"
  check "and its outputs were made safe" wait_for "$patience" outputs_were_made_safe
}

test_hung() {
  local restarts begin
  restarts=$(property NRestarts) begin=$(date +%s%N)
  "$here/hang_thread" "$(process)" pipeline &
  check "hung, the watchdog ends it" wait_for "$patience" says "Watchdog timeout"
  say "       from the hang to the watchdog: $(seconds_since "$begin")"
  check "and it comes back" wait_for "$patience" came_back "$restarts"
  say "       from the hang to the next result: $(seconds_since "$begin")"
  check "and its outputs were made safe" wait_for "$patience" outputs_were_made_safe
  wait $!
}

test_wrong_configuration() {
  check "nothing is refused yet" wait_for "$patience" is system_configuration_refused 0
  inside sed -i '1i nonsense = ' /etc/orbwatch/site.toml
  inside systemctl restart orbwatch.service
  check "with a wrong configuration the last good one runs" wait_for "$patience" measures
  check "and Modbus says so" wait_for "$patience" is system_configuration_refused 1
  check "and systemd and the journal say where" wait_for "$patience" says "site.toml:1"
  check "as its status" wait_for "$patience" status_says "site.toml:1"
  inside sed -i 1d /etc/orbwatch/site.toml
  inside systemctl restart orbwatch.service
  check "mended, it counts again" wait_for "$patience" is system_configuration_refused 0
}

status_says() { property StatusText | grep -F -- "$1"; }

# Configures as root, for the service's user.
test_configured() {
  local before
  before=$(register system_configuration_checksum)
  check "what runs is known by its checksum" test -n "$before" || return
  inside sh -c 'mkdir /root/new && cp -r /etc/orbwatch/* /root/new && sed -i "s/^name = \"door\"/name = \"gate\"/" /root/new/site.toml'
  check "orbwatch configure has a new configuration run" inside orbwatch configure /root/new/site.toml
  check "and it runs" wait_for "$patience" reads_another system_configuration_checksum "$before"
  check "the files are the old ones" inside grep -F 'name = "door"' /etc/orbwatch/site.toml
  check "orbwatch configure --cancel" inside orbwatch configure --cancel
  check "goes back" wait_for "$patience" is system_configuration_checksum "$before"
  inside orbwatch configure /root/new/site.toml
  check "again" wait_for "$patience" reads_another system_configuration_checksum "$before"
  check "orbwatch configure --confirm" inside orbwatch configure --confirm
  check "writes the files" inside grep -F 'name = "gate"' /etc/orbwatch/site.toml
  inside systemctl restart orbwatch.service
  check "which are read after a restart" wait_for "$patience" reads_another system_configuration_checksum "$before"
  check "and not refused" wait_for "$patience" is system_configuration_refused 0
  inside rm -r /root/new
}

test_second_machine() {
  check "a second machine on the board" begin_second_machine
  check "beside the first one" wait_for "$patience" measures
  check "with the modes of folders that its unit states" has_stated_modes
  test_second_configured
  end_second_machine
}

begin_second_machine() {
  inside sh -c 'mkdir /etc/orbwatch/second && cd /etc/orbwatch && cp -r rig.toml recipes second &&
    sed "s/^port = 1502/port = 1503/; s/^domain = 0/domain = 1/; s/^\[web\]/&\nport = 8081/" site.toml >second/site.toml' &&
    inside systemctl enable --now orbwatch@second.service && wait_for "$patience" second_measures
}

# of_second COMMAND...: reads the registers of the second machine.
of_second() { modbus_port=1503 "$@"; }
second_measures() { of_second measures; }

end_second_machine() {
  inside systemctl disable --now orbwatch@second.service
  inside rm -r /etc/orbwatch/second /var/lib/orbwatch-second
}

# Reports for the second machine in root's shell, which has no state folder.
test_second_configured() {
  local first second site=/etc/orbwatch/second/site.toml
  first=$(register system_configuration_checksum) second=$(of_second register system_configuration_checksum)
  inside sh -c 'cp -r /etc/orbwatch/second /root/new && sed -i "s/^name = \"[a-z]*\"/&  # tried/" /root/new/site.toml'
  check "orbwatch configure --config SECOND" inside orbwatch configure /root/new/site.toml --config $site
  check "has the second machine run it" \
    wait_for "$patience" of_second reads_another system_configuration_checksum "$second"
  check "and the first one as before" is system_configuration_checksum "$first"
  check "--confirm, too" inside orbwatch configure --confirm --config $site
  check "writes its files" inside grep -F '# tried' $site
  check "orbwatch password --config SECOND" inside sh -c "echo correct horse battery | orbwatch password --config $site"
  check "sets that of the second machine only" \
    inside sh -c 'test -e /var/lib/orbwatch-second/users.json && ! test -e /var/lib/orbwatch/users.json'
  inside rm -r /root/new
}

test_others() {
  check "a second machine is there" begin_second_machine
  local before
  before=$(property InvocationID orbwatch@second.service)
  check "the module for libcamera is missed" inside sh -c 'orbwatch --version | grep -x "libcamera not installed"'
  check "and that for videos" inside sh -c 'orbwatch --version | grep -x "video not installed"'
  check "the other packages" inside sh -c 'apt-get install -y /packages/*.deb'
  check "the service runs on" wait_for "$patience" measures
  check "the second machine was restarted, too" wait_for "$patience" invoked_again "$before"
  end_second_machine
  check "the module for libcamera is loaded" inside sh -c 'orbwatch --version | grep -E "^libcamera v?[0-9]"'
  check "and that for GenICam" inside sh -c 'orbwatch --version | grep -E "^genicam 0\.8\."'
  check "and that for videos, with its libraries" inside sh -c \
    'orbwatch --version | grep -x "video installed" && ! ldd /usr/lib/*/orbwatch/modules/camera-video.so | grep "not found"'
  check "manuals and message types" inside test -e /usr/share/doc/orbwatch-doc/html/index.html \
    -a -e /usr/share/doc/orbwatch-doc/html/installation.de.html \
    -a -e /usr/share/doc/orbwatch-doc/html/installation.ja.html \
    -a -e /usr/share/orbwatch-msgs/modbus/registers.csv
}

invoked_again() {
  local now
  now=$(property InvocationID orbwatch@second.service)
  [[ -n $now && $now != "$1" ]]
}

# The system has no pgrep of its own.
nothing_runs() { ! has ActiveState active && [[ -z $(process) ]]; }

test_removal() {
  check "a second machine is there" begin_second_machine
  check "apt removes it" inside sh -c 'apt-get remove -y "orbwatch*"'
  check "nothing runs" nothing_runs
  check "configuration and state are kept" inside test -e /etc/orbwatch/site.toml -a -e /var/lib/orbwatch/last-good.json
  check "apt purges it" inside sh -c 'apt-get purge -y "orbwatch*"'
  files >"$work/after"
  check "nothing is left" diff "$work/before" "$work/after"
}
