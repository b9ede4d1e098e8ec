#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""rtu_client.py LINE UNIT: reads and writes like a PLC program, with pymodbus.

Prints one line per request; server/rtu_server_test.cpp expects them.
"""

import sys

from pymodbus.client import ModbusSerialClient
from pymodbus.mei_message import ReadDeviceInformationRequest

from modbus_client import register_map

# Registers from the first argument to the sequence 41.
SELECT_VIEW_2 = [0, 2] + 9 * [0] + [1, 41]


def shown(answer):
    if answer.isError():
        return f"exception {getattr(answer, 'exception_code', answer)}"
    return str(getattr(answer, "registers", "written"))


def main(line, unit):
    address = {row["name"]: row["address"] for row in register_map() if row["address"] < 5000}
    client = ModbusSerialClient(line, baudrate=19200, parity="N", timeout=10)
    if not client.connect():
        sys.exit(f"cannot open {line}")
    first = address["argument_0"]
    acknowledged, heartbeat = address["acknowledged_sequence"], address["system_heartbeat"]
    print("read", shown(client.read_input_registers(address["map_version"], count=1, slave=unit)))
    print("heartbeat", shown(client.read_input_registers(heartbeat, count=2, slave=unit)))
    print("write", shown(client.write_registers(first, SELECT_VIEW_2, slave=unit)))
    while True:  # until it is carried out
        answer = client.read_holding_registers(acknowledged, count=3, slave=unit)
        if answer.isError() or answer.registers[0] == SELECT_VIEW_2[-1]:
            break
    print("acknowledged", shown(answer))
    print("half", shown(client.write_register(first, 5, slave=unit)))
    print("nowhere", shown(client.read_input_registers(65000, count=1, slave=unit)))
    identity = client.execute(ReadDeviceInformationRequest(1, 0, unit=unit))
    print("identity", identity.information[0].decode())
    client.close()


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(sys.argv[1], int(sys.argv[2]))
