#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""machine_controller.py PORT COMPARED: a machine controller written by the manual, whose tool moves
on a line at 25 mm/s.

It writes its state 50 times a second, up to 20 ms late, and reads where the appliance saw the tool
at the exposures of COMPARED frame sets. Then it ends, and waits until the appliance notices. Prints
the errors in ms of motion, of 90 and of 99 in 100 sets."""

import random
import sys
import time

from modbus_client import Client, number_in, register_map, words_of

PERIOD, JITTER, SPEED = 0.02, 0.02, 25.0  # s, s, mm/s
UNKNOWN = 0x80000000
GOOD, PREDICTED, STALE = 1, 2, 4


class Map:
    def __init__(self):
        self.rows = {row["name"]: row for row in register_map() if row["address"] < 5000}
        self.state = [row for name, row in self.rows.items() if name.startswith("state_")]
        self.state.sort(key=lambda row: row["address"])

    def block(self, values):
        """Words of the state; what is not given is not known."""
        words = []
        for row in self.state:
            name = row["name"].removeprefix("state_")
            usual = UNKNOWN if row["type"] == "DINT" else 0
            value = values.get(name)
            code = usual if value is None else round(value / row["scale"])
            words += words_of(code & 0xFFFFFFFF) if row["count"] == 2 else [code]
        return words


class Controller:
    def __init__(self, port):
        self.map, self.client = Map(), Client(port)
        self.random = random.Random(5)
        self.begin = time.monotonic()
        self.sequence = 0

    def x(self, moment):
        return SPEED * (moment - self.begin)

    def send(self, moment):
        self.sequence += 1
        whole = int(moment)
        self.client.write(self.map.state[0]["address"], self.map.block({
            "part_0": 0x4142, "sequence": self.sequence, "clock_seconds": whole,
            "clock_microseconds": (moment - whole) * 1e6, "layer": 7, "x": self.x(moment),
            "y": 0, "z": 0, "laser_on": 1}))

    def read(self, first, last):
        """Values of the registers from one name to another, unscaled, of one request."""
        begin, end = self.map.rows[first], self.map.rows[last]
        words = self.client.read("input", begin["address"],
                                 end["address"] + end["count"] - begin["address"])
        place = lambda row: row["address"] - begin["address"]
        return {name: number_in(words[place(row):place(row) + row["count"]], row["type"])
                for name, row in self.map.rows.items()
                if row["table"] == "input" and 0 <= place(row)
                and place(row) + row["count"] <= len(words)}

    def seen(self):
        """A frame set with its exposure on our clock, and the machine at it; None: one came between."""
        before = self.read("utc_seconds", "system_frame_set")
        machine = self.read("machine_quality", "machine_vz")
        if self.read("system_frame_set", "system_frame_set") != {
                "system_frame_set": before["system_frame_set"]}:
            return None
        utc = before["utc_seconds"] + 1e-6 * before["utc_microseconds"]
        return before["system_frame_set"], utc - (time.time() - time.monotonic()), machine

    def run(self, wanted):
        """Errors of the tool's position, ms of motion, by frame set."""
        errors = {}
        due = time.monotonic()
        while len(errors) < wanted:
            time.sleep(max(0.0, due + self.random.uniform(0, JITTER) - time.monotonic()))
            self.send(due)
            due = max(due + PERIOD, time.monotonic() - PERIOD)
            seen = self.seen()
            if seen is None:
                continue
            number, exposure, machine = seen
            is_known = machine["machine_quality"] in (GOOD, PREDICTED)
            if self.sequence < 100 or not is_known or machine["machine_vx"] == -UNKNOWN:
                continue  # the clocks' offset is learnt, or the machine was busy for long
            assert machine["machine_layer"] == 7 and machine["machine_part_0"] == 0x4142, machine
            x = machine["machine_x"] * self.map.rows["machine_x"]["scale"]
            errors[number] = abs(x - self.x(exposure)) / SPEED * 1000
        return sorted(errors.values())

    def wait_until_stale(self):
        while self.read("machine_quality", "machine_quality")["machine_quality"] != STALE:
            pass
        machine = self.read("machine_quality", "machine_vz")
        for name in ("machine_x", "machine_layer", "machine_laser_on", "machine_vx"):
            assert machine[name] == -UNKNOWN, machine
        assert machine["machine_part_0"] == 0, machine


def main():
    controller = Controller(int(sys.argv[1]))
    errors = controller.run(int(sys.argv[2]))
    controller.wait_until_stale()
    share = lambda part: errors[int(part * (len(errors) - 1))]
    print(f"compared {len(errors)} p90 {share(0.9):.3f} p99 {share(0.99):.3f}")


main()
