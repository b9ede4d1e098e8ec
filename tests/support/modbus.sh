# Reads orbwatchd's registers at $modbus_address:$modbus_port with a third-party client; the command
# prefix $modbus_from starts it elsewhere: in the network of a container.
# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0

registers=$(dirname "${BASH_SOURCE[0]}")/../../app/ports/modbus/registers.csv
modbus_from=()

# register NAME: prints the value of an input register; nothing if it cannot be read.
register() {
  local address kind type=(-t 3) value
  read -r address kind < <(awk -F, -v name="$1" '$1 == "input" && $6 == name {print $2, $4}' \
    "$registers")
  [[ $kind != UDINT ]] || type=(-t 3:int -B)
  value=$("${modbus_from[@]}" mbpoll -m tcp -p "${modbus_port:?}" -0 -r "$address" "${type[@]}" -c 1 -1 \
    -o 5 "${modbus_address:?}" | sed -n "s/^\[$address\]:[[:space:]]*\(-\{0,1\}[0-9]*\).*/\1/p")
  # mbpoll supports only signed 32 bit values.
  [[ $kind != UDINT || $value != -* ]] || value=$((value + (1 << 32)))
  echo "$value"
}

is() { [[ $(register "$1") == "$2" ]]; }

is_past() { (($(register "$1") > $2)); }

answers() { [[ -n $(register system_heartbeat 2>/dev/null) ]]; }
