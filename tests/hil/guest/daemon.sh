# Functions of scenarios that run orbwatchd: it is configured by /tmp/site.toml and read by
# independent clients.
# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0

# Settings of one machine without a network: no multicast, all participants are local.
export CYCLONEDDS_URI='<General><Interfaces><NetworkInterface name="lo" multicast="false"/>
  </Interfaces></General><Discovery><ParticipantIndex>auto</ParticipantIndex>
  <Peers><Peer address="127.0.0.1"/></Peers></Discovery>'
# shellcheck disable=SC2034
modbus_port=1502 modbus_address=127.0.0.1
# shellcheck source=../../support/modbus.sh
. /orbwatch/tests/support/modbus.sh

answers_or_has_ended() { answers || ! kill -0 "$daemon" 2>/dev/null; }

# Starts orbwatchd; sets daemon to its process.
daemon_starts() {
  /build/app/orbwatchd --config /tmp/site.toml >/tmp/daemon.log 2>&1 &
  # shellcheck disable=SC2034
  daemon=$!
  wait_for 120 answers_or_has_ended
  answers || { cat /tmp/daemon.log; return 1; }
}
