#!/usr/bin/env python3
"""rtu_client.py LINE UNIT: reads and writes as a PLC program would, with pymodbus.

Prints one line per request; what they must say stands in rtu_server_test.cpp.
"""

import sys

from pymodbus.client import ModbusSerialClient
from pymodbus.mei_message import ReadDeviceInformationRequest


# From the first argument to the sequence, 41.
SELECT_VIEW_2 = [0, 2] + 9 * [0] + [1, 41]


def shown(answer):
    if answer.isError():
        return f"exception {getattr(answer, 'exception_code', answer)}"
    return str(getattr(answer, "registers", "written"))


def main(line, unit):
    client = ModbusSerialClient(line, baudrate=19200, parity="N", timeout=10)
    if not client.connect():
        sys.exit(f"cannot open {line}")
    print("read", shown(client.read_input_registers(0, count=2, slave=unit)))
    print("write", shown(client.write_registers(0, SELECT_VIEW_2, slave=unit)))
    print("acknowledged", shown(client.read_holding_registers(13, count=3, slave=unit)))
    print("half", shown(client.write_register(0, 5, slave=unit)))
    print("nowhere", shown(client.read_input_registers(65000, count=1, slave=unit)))
    identity = client.execute(ReadDeviceInformationRequest(1, 0, unit=unit))
    print("identity", identity.information[0].decode())
    client.close()


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(sys.argv[1], int(sys.argv[2]))
