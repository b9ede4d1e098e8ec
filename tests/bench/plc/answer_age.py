# SPDX-License-Identifier: Apache-2.0
"""Measures the age of a frame set when a PLC first reads it, and the time until there is one: see README.md of
tests/bench."""

import argparse
import contextlib
import csv
import os
import pathlib
import socket
import struct
import sys
import threading
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "web"))
from appliance import PATIENCE_S, ROOT, Appliance, free_port  # noqa: E402

TURNS = 4
STARTS = 11
POLL_S = 0.002
LEAST_PICTURES = 100_000  # bytes
P50_LIMIT, P99_LIMIT = 1.1, 1.3  # of the p50 without viewers


class Demo(Appliance):
    """The demo with Modbus and the page."""

    def __init__(self):
        super().__init__()
        self.modbus_port = free_port()
        site = self.folder / "demo.toml"
        site.write_text(f"{site.read_text(encoding='utf-8')}\n[modbus]\nport = {self.modbus_port}\n",
                        encoding="utf-8")


def address_of(register):
    """Address of an input register of the program's list."""
    with open(ROOT / "app/ports/modbus/registers.csv", encoding="utf-8") as listing:
        return next(int(row[1]) for row in csv.reader(listing) if row[0] == "input" and register in row)


class Plc:
    FIRST = address_of("system_frame_set")
    COUNT = address_of("system_stamp_age") + 2 - FIRST  # both of two registers, high word first

    def __init__(self, port):
        self.connection = socket.create_connection(("127.0.0.1", port))
        self.connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.answers = self.connection.makefile("rb")

    def read(self):
        """Number of the newest frame set, and its age in ms."""
        self.connection.sendall(struct.pack(">HHHBBHH", 1, 0, 6, 1, 4, self.FIRST, self.COUNT))
        registers = self.answers.read(9 + 2 * self.COUNT)[9:]
        return struct.unpack(">I", registers[:4])[0], struct.unpack(">I", registers[-4:])[0]

    def ages(self, seconds):
        """Ages of the frame sets of that time, each when it is read first."""
        ages, (last, _) = [], self.read()
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            number, age = self.read()
            if number != last:
                ages.append(age)
                last = number
        return ages


@contextlib.contextmanager
def viewer(machine):
    """Receives every view of the machine, like the page."""
    views = "&".join(f"view={view['name']}" for view in machine.status()["views"])
    received = 0
    with socket.create_connection(("127.0.0.1", machine.port)) as connection:
        connection.sendall(f"GET /api/v1/live?{views} HTTP/1.1\r\nHost: localhost\r\n\r\n".encode())

        def receive():
            nonlocal received
            while part := connection.recv(1 << 20):
                received += len(part)

        thread = threading.Thread(target=receive)
        thread.start()
        try:
            yield
        finally:
            connection.shutdown(socket.SHUT_RDWR)
            thread.join()
    if received < LEAST_PICTURES:
        raise SystemExit(f"answer_age: the page sent {received} bytes, no pictures")


def quantile(values, part):
    ordered = sorted(values)
    return ordered[round(part * (len(ordered) - 1))]


def seconds_to_first_set():
    """From the daemon's exec until a PLC reads the number of a frame set; waits at most PATIENCE_S."""
    machine = Demo()
    begin = time.monotonic()
    machine.start(is_up=lambda: True)
    try:
        plc = None
        while time.monotonic() < begin + PATIENCE_S:
            with contextlib.suppress(ConnectionRefusedError):
                plc = plc or Plc(machine.modbus_port)
                if plc.read()[0] > 0:
                    return time.monotonic() - begin
            time.sleep(POLL_S)
        raise SystemExit("answer_age: no frame set")
    finally:
        machine.close()


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("seconds", type=float)
    seconds = parser.parse_args().seconds
    machine = Demo()
    alone, watched = [], []
    machine.start()
    try:
        plc = Plc(machine.modbus_port)
        for _ in range(TURNS):
            alone += plc.ages(seconds / TURNS)
            with viewer(machine):
                watched += plc.ages(seconds / TURNS)
    finally:
        machine.close()
    base = quantile(alone, 0.5)
    print("| age of a frame set when a PLC first reads it | sets | p50, ms | p99, ms | "
          "p50 and p99 of the p50 without viewers |\n|---|---|---|---|---|")
    for name, ages in (("no viewer", alone), ("web viewer of every view", watched)):
        p50, p99 = quantile(ages, 0.5), quantile(ages, 0.99)
        print(f"| {name} | {len(ages)} | {p50} | {p99} | {p50 / base:.2f}, {p99 / base:.2f} |")
    starts = [seconds_to_first_set() for _ in range(STARTS)]
    print("\n| the daemon's exec to the first frame set that a PLC reads | p50, s | longest, s |\n|---|---|---|")
    print(f"| {STARTS} starts | {quantile(starts, 0.5):.2f} | {max(starts):.2f} |")
    late = [limit for part, limit in ((0.5, P50_LIMIT), (0.99, P99_LIMIT))
            if quantile(watched, part) > limit * base]
    if late and "CI" not in os.environ:
        raise SystemExit(f"answer_age: the viewer makes the PLC wait more than {late} times as long")


if __name__ == "__main__":
    main()
