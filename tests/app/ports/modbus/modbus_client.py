# SPDX-License-Identifier: Apache-2.0
"""A Modbus TCP client by pymodbus, and the committed map. Runs with 3.0 (Debian 12) and 3.8 (13)."""

import csv
import inspect
import pathlib
import struct

from pymodbus.client import ModbusTcpClient

SOURCE = pathlib.Path(__file__).resolve().parents[4]
BITS = ("coil", "discrete")


class Refused(Exception):
    """The server answered with an exception; its code is `code`."""

    def __init__(self, code):
        super().__init__(f"exception {code}")
        self.code = code


def checked(answer):
    if answer.isError():
        raise Refused(getattr(answer, "exception_code", answer))
    return answer


class Client:
    """Reads return a list of words or bits. `unit` is the unit identifier of each request."""

    def __init__(self, port, unit=1):
        self.port, self.unit = port, unit
        self.connect()

    def connect(self):
        self.modbus = ModbusTcpClient("127.0.0.1", port=self.port, timeout=30)
        if not self.modbus.connect():
            raise ConnectionError(f"no answer on port {self.port}")

    def reconnect(self):
        self.modbus.close()
        self.connect()

    def read(self, table, address, count):
        functions = {
            "coil": self.modbus.read_coils,
            "discrete": self.modbus.read_discrete_inputs,
            "holding": self.modbus.read_holding_registers,
            "input": self.modbus.read_input_registers,
        }
        answer = checked(functions[table](address, count=count, slave=self.unit))
        if table in BITS:
            return [int(bit) for bit in answer.bits[:count]]
        return list(answer.registers)

    def write(self, address, words):
        checked(self.modbus.write_registers(address, words, slave=self.unit))

    def write_and_read(self, write_address, words, read_address, count):
        function = self.modbus.readwrite_registers
        name = "values" if "values" in inspect.signature(function).parameters else "write_registers"
        answer = function(
            read_address=read_address, read_count=count, write_address=write_address,
            slave=self.unit, **{name: words})
        return list(checked(answer).registers)

    def lose_answer(self, write_address, words, read_address, count):
        """Sends function code 23 and disconnects at once, like a PLC whose cable is pulled."""
        pdu = struct.pack(">BHHHHB", 23, read_address, count, write_address, len(words),
                          2 * len(words)) + struct.pack(f">{len(words)}H", *words)
        header = struct.pack(">HHHB", 1, 0, len(pdu) + 1, self.unit)
        self.modbus.socket.sendall(header + pdu)
        self.reconnect()


def words_of(number):
    """32-bit value, high word first."""
    return [number >> 16 & 0xFFFF, number & 0xFFFF]


def number_in(words, kind):
    """The value of a row's words, unscaled."""
    if kind == "UDINT":
        return words[0] << 16 | words[1]
    if kind == "DINT":
        return struct.unpack(">i", struct.pack(">HH", *words))[0]
    return words[0]


def register_map():
    """The rows of the committed table, with numbers converted."""
    with open(SOURCE / "app/ports/modbus/registers.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    for row in rows:
        for column in ("address", "count"):
            row[column] = int(row[column])
        for column in ("scale", "min", "max"):
            row[column] = float(row[column])
    return rows
