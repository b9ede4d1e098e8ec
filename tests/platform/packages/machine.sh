# Sourced: functions to test a Debian system with systemd in a container.
# shellcheck shell=bash disable=SC2154
# SPDX-License-Identifier: Apache-2.0

# shellcheck source=../../support/checks.sh
. "$source/tests/support/checks.sh"
# Used by modbus.sh as words of a command.
# shellcheck disable=SC2034
modbus_port=1502 modbus_address=127.0.0.1
# shellcheck source=../../support/modbus.sh
. "$source/tests/support/modbus.sh"

# Limit of every wait, s. It measures nothing: durations are printed.
patience=180

# say TEXT: prints for the reader; all other output goes to the log.
say() { echo "$*" >&3; }

report() {
  say "$1 $2"
  [[ $1 == FAILED ]] || return 0
  { tac "$log" | sed '/^--- /q' | tac | tail -n 40
    if [[ -n ${leader:-} ]]; then inside journalctl --no-pager -n 25 -u 'orbwatch*' | sed 's,^,| ,'; fi
  } 2>&1 | sed 's/^/  /' >&3
}

# boot ROOT: starts the system of ROOT, without a network and with its writes kept apart, and sets
# leader to its first process. /packages in it is the folder $packages.
boot() {
  machine=$work/machine
  mkdir -p "$machine" "$work/root"
  mount -t tmpfs tmpfs "$machine" && mkdir "$machine/upper" "$machine/work" &&
    mount -t overlay overlay -o "lowerdir=$1,upperdir=$machine/upper,workdir=$machine/work" "$work/root" ||
    return
  systemd-nspawn --quiet --boot --directory="$work/root" --machine=orbwatch-packages --private-network \
    --register=no --keep-unit --link-journal=no --resolv-conf=off --timezone=off --console=pipe \
    --system-call-filter=@memlock \
    --bind-ro="$packages:/packages" </dev/null >"$work/console" 2>&1 &
  container=$!
  wait_for "$patience" has_a_first_process || { cat "$work/console"; return 1; }
  # shellcheck disable=SC2034
  modbus_from=(nsenter --target "$leader" --net --)
  wait_for "$patience" is_up || { cat "$work/console"; inside systemctl --no-pager --failed; return 1; }
}

# Checks for the first process in the system's own numbering, not for the one that starts it and
# ends.
has_a_first_process() {
  local process
  leader=""
  for process in $(pgrep --parent "$container"); do
    [[ $(awk '/^NSpid:/ {print $NF}' "/proc/$process/status") != 1 ]] || leader=$process
  done
  [[ -n $leader ]]
}

# Debian's own services that cannot start in a container do not matter here.
is_up() { [[ $(inside systemctl is-system-running 2>/dev/null) =~ ^(running|degraded)$ ]]; }

# halt: ends the system and drops its writes.
halt() {
  if [[ -n ${leader:-} ]]; then
    inside systemctl --no-block poweroff && wait_for "$patience" container_has_ended || kill -KILL "$leader"
    wait "$container"
    leader=""
  fi
  if mountpoint -q "$work/root"; then umount "$work/root"; fi
  if [[ -n ${machine:-} ]] && mountpoint -q "$machine"; then umount "$machine"; fi
}

container_has_ended() { ! kill -0 "$container" 2>/dev/null; }

# inside COMMAND...: runs a command as root in the system.
inside() {
  nsenter --target "$leader" --all --wdns=/ -- /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin \
    LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive "$@"
}

# as_service COMMAND...: runs a command in the system, as the service's user.
as_service() { inside setpriv --reuid orbwatch --regid orbwatch --init-groups "$@"; }

# property NAME [UNIT]: prints a property of the service from systemd.
property() { inside systemctl show --value --property="$1" "${2:-orbwatch.service}"; }

has() { [[ $(property "$1") == "$2" ]]; }

reads_another() { local value; value=$(register "$1"); [[ -n $value && $value != "$2" ]]; }

measures() { is_past system_frame_set 0; }

# says TEXT: succeeds if the service has written it to the journal.
says() { inside journalctl --no-pager --unit orbwatch.service | grep -F -- "$1"; }

# seconds_since NANOSECONDS
seconds_since() { awk -v a="$1" -v b="$(date +%s%N)" 'BEGIN {printf "%.1f s", (b - a) / 1e9}'; }

# files: lists all that a package may leave, without the changes of every package's installation.
files() {
  inside find / -xdev \( -path /proc -o -path /sys -o -path /dev -o -path /run -o -path /tmp \
    -o -path /packages -o -path /var/log -o -path /var/cache -o -path /var/lib/dpkg -o -path /var/lib/apt \
    -o -path /var/lib/systemd \) -prune -o -print | sort
  # The group gpio remains, since other programs may use it.
  inside sed '/^gpio:x:[0-9]*:$/d' /etc/passwd /etc/group
}
