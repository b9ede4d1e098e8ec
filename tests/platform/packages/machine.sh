# Sourced: a Debian system with systemd in a container, and the words to test it with.
# shellcheck shell=bash disable=SC2154

failed_checks=0
modbus_port=1502

# check NAME COMMAND...: a test that passes when the command ends with 0; what it printed is in the log.
check() {
  local name=$1
  shift
  if "$@" >"$work/check.log" 2>&1; then
    echo "passed $name"
  else
    failed_checks=$((failed_checks + 1))
    echo "FAILED $name"
    tail -n 40 "$work/check.log" | sed 's/^/  /'
    if [[ -n ${leader:-} ]]; then
      inside journalctl --no-pager -n 25 -u 'orbwatch*' 2>&1 | sed 's,^,  | ,' || echo '  | no journal'
    fi
  fi
}

# wait_for SECONDS COMMAND...: until the command succeeds.
wait_for() {
  local deadline=$((SECONDS + $1))
  shift
  until "$@"; do
    ((SECONDS < deadline)) || { echo "not within the time: $*"; return 1; }
    sleep 0.05
  done
}

# boot ROOT: starts the system of ROOT, without a network and with what it writes kept apart, and sets
# leader to its first process. /packages in it is the folder $packages.
boot() {
  machine=$work/machine
  mkdir -p "$machine" "$work/root"
  mount -t tmpfs tmpfs "$machine"
  mkdir "$machine/upper" "$machine/work"
  mount -t overlay overlay -o "lowerdir=$1,upperdir=$machine/upper,workdir=$machine/work" "$work/root"
  systemd-nspawn --quiet --boot --directory="$work/root" --machine=orbwatch-packages --private-network \
    --register=no --keep-unit --link-journal=no --resolv-conf=off --timezone=off --console=pipe \
    --system-call-filter=@memlock \
    --bind-ro="$packages:/packages" </dev/null >"$work/console" 2>&1 &
  container=$!
  wait_for 30 has_a_first_process || { cat "$work/console"; return 1; }
  wait_for 60 is_up || { cat "$work/console"; inside systemctl --no-pager --failed; return 1; }
}

has_a_first_process() {
  leader=$(pgrep --parent "$container" | head -n 1)
  [[ -n $leader ]]
}

is_up() { [[ $(inside systemctl is-system-running 2>/dev/null) == running ]]; }

# halt: ends the system and forgets what it wrote.
halt() {
  if [[ -n ${leader:-} ]]; then
    inside systemctl --no-block poweroff >"$work/console" 2>&1 || kill -KILL "$leader"
    wait "$container"
    leader=""
  fi
  if mountpoint -q "$work/root"; then umount "$work/root"; fi
  if [[ -n ${machine:-} ]] && mountpoint -q "$machine"; then umount "$machine"; fi
}

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

# register NAME: the value of an input register, by a client of other people.
register() {
  local address kind type=(-t 3)
  read -r address kind < <(awk -F, -v name="$1" '$1 == "input" && $6 == name {print $2, $4}' \
    "$source/app/ports/modbus/registers.csv")
  [[ $kind != UDINT ]] || type=(-t 3:int -B)
  nsenter --target "$leader" --net -- mbpoll -m tcp -p "$modbus_port" -0 -r "$address" "${type[@]}" \
    -c 1 -1 -o 1 127.0.0.1 2>/dev/null | sed -n "s/^\[$address\]:[[:space:]]*\([0-9]*\).*/\1/p"
}

reads() { [[ $(register "$1") == "$2" ]]; }

reads_another() { local value; value=$(register "$1"); [[ -n $value && $value != "$2" ]]; }

measures() { (($(register system_frame_set) > 0)); }

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
