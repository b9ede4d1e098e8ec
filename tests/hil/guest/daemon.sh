# What scenarios that run orbwatchd have in common: it is configured by /tmp/site.toml and read by
# clients of other people.
# shellcheck shell=bash

# One machine without a network: no multicast, everybody is found at home.
export CYCLONEDDS_URI='<General><Interfaces><NetworkInterface name="lo" multicast="false"/>
  </Interfaces></General><Discovery><ParticipantIndex>auto</ParticipantIndex>
  <Peers><Peer address="127.0.0.1"/></Peers></Discovery>'
modbus_port=1502

# register NAME: the value of an input register.
register() {
  local address kind type=(-t 3)
  read -r address kind < <(awk -F, -v name="$1" '$1 == "input" && $6 == name {print $2, $4}' \
    /orbwatch/app/ports/modbus/registers.csv)
  [[ $kind != UDINT ]] || type=(-t 3:int -B)
  mbpoll -m tcp -p "$modbus_port" -0 -r "$address" "${type[@]}" -c 1 -1 -o 5 127.0.0.1 |
    sed -n "s/^\[$address\]:[[:space:]]*\([0-9]*\).*/\1/p"
}

is() { [[ $(register "$1") == "$2" ]]; }

is_past() { (($(register "$1") > $2)); }

answers() { [[ -n $(register system_heartbeat 2>/dev/null) ]]; }

# Sets daemon to its process.
daemon_starts() {
  /build/app/orbwatchd --config /tmp/site.toml >/tmp/daemon.log 2>&1 &
  # shellcheck disable=SC2034
  daemon=$!
  wait_for 120 answers || { cat /tmp/daemon.log; return 1; }
}
