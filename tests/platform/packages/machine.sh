# Sourced: a Debian system with systemd in a container, and the words to test it with.
# shellcheck shell=bash disable=SC2154

# shellcheck source=../../support/checks.sh
. "$source/tests/support/checks.sh"
# Read by modbus.sh, where they are words of a command.
# shellcheck disable=SC2034
modbus_port=1502 modbus_address=127.0.0.1
# shellcheck source=../../support/modbus.sh
. "$source/tests/support/modbus.sh"

# Seconds that are waited for anything. Nothing is measured by it: what took how long is printed.
patience=180

# say TEXT: for the reader; what else is printed is for the log.
say() { echo "$*" >&3; }

report() {
  say "$1 $2"
  [[ $1 == FAILED ]] || return 0
  { tac "$log" | sed '/^--- /q' | tac | tail -n 40
    if [[ -n ${leader:-} ]]; then inside journalctl --no-pager -n 25 -u 'orbwatch*' | sed 's,^,| ,'; fi
  } 2>&1 | sed 's/^/  /' >&3
}

# boot ROOT: starts the system of ROOT, without a network and with what it writes kept apart, and sets
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

# The first process of the system's own numbering, not the one that starts it and ends.
has_a_first_process() {
  local process
  leader=""
  for process in $(pgrep --parent "$container"); do
    [[ $(awk '/^NSpid:/ {print $NF}' "/proc/$process/status") != 1 ]] || leader=$process
  done
  [[ -n $leader ]]
}

# What of Debian's own cannot start in a container is not what is tested.
is_up() { [[ $(inside systemctl is-system-running 2>/dev/null) =~ ^(running|degraded)$ ]]; }

# halt: ends the system and forgets what it wrote.
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

# inside COMMAND...: as root in the system.
inside() {
  nsenter --target "$leader" --all --wdns=/ -- /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin \
    LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive "$@"
}

# as_service COMMAND...: in the system, as the service's user.
as_service() { inside setpriv --reuid orbwatch --regid orbwatch --init-groups "$@"; }

# property NAME [UNIT]: what systemd says of the service.
property() { inside systemctl show --value --property="$1" "${2:-orbwatch.service}"; }

has() { [[ $(property "$1") == "$2" ]]; }

reads_another() { local value; value=$(register "$1"); [[ -n $value && $value != "$2" ]]; }

measures() { is_past system_frame_set 0; }

# says TEXT: whether the service has written it to the journal.
says() { inside journalctl --no-pager --unit orbwatch.service | grep -F -- "$1"; }

# seconds_since NANOSECONDS
seconds_since() { awk -v a="$1" -v b="$(date +%s%N)" 'BEGIN {printf "%.1f s", (b - a) / 1e9}'; }

# files: all that a package may leave, without what every package's installation changes.
files() {
  inside find / -xdev \( -path /proc -o -path /sys -o -path /dev -o -path /run -o -path /tmp \
    -o -path /packages -o -path /var/log -o -path /var/cache -o -path /var/lib/dpkg -o -path /var/lib/apt \
    -o -path /var/lib/systemd \) -prune -o -print | sort
  # The group gpio stays: others may use it.
  inside sed '/^gpio:x:[0-9]*:$/d' /etc/passwd /etc/group
}
