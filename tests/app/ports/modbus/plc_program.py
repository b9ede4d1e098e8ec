#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""plc_program.py PORT PARTS SEED [--slow | --overrun | --any]: a PLC program written by the manual.

It triggers, reads the result, uses it once and acknowledges it, while connections are lost and
writes come twice. Every register of a result must belong to the same part. --slow: up to 8 results
come between two scans; --overrun: up to 20, and refused ones must be counted; --any: of a running
machine, whose figures are not known beforehand. Prints its counts."""

import random
import sys

from modbus_client import Client, number_in, register_map, words_of

TRIGGER = 8
REGIONS = 4


class Map:
    """Addresses by name, and the structure of a region."""

    def __init__(self):
        rows = [row for row in register_map() if row["address"] < 5000]
        self.address = {row["name"]: row["address"] for row in rows}
        self.window = []
        for region in range(REGIONS):
            prefix = f"result_{region}_"
            own = [row for row in rows if row["name"].startswith(prefix)]
            base = own[0]["address"]
            self.window.append(
                [(row["name"][len(prefix):], row["address"] - base, row) for row in own])


class Plc:
    def __init__(self, port, seed, option):
        self.map = Map()
        self.client = Client(port)
        self.random = random.Random(seed)
        self.bursts = {"--slow": 8, "--overrun": 20}.get(option, 1)
        self.is_any = option == "--any"
        self.sequence = 0
        self.acknowledged = 0  # written with the next request
        self.last = (0, 0, 0)  # number and stamp of the result used last
        self.parts, self.lost, self.again, self.triggered = 0, 0, 0, 0

    def trigger(self):
        """Gives a command by the handshake: a repeated write is one command."""
        self.sequence = (self.sequence + 1) & 0xFFFF
        words = [TRIGGER, self.sequence]
        address = self.map.address["command"]
        for _ in range(self.random.choice((1, 1, 1, 2))):
            self.client.write(address, words)
        acknowledged = None
        while acknowledged != self.sequence:
            acknowledged, result = self.client.read(
                "holding", self.map.address["acknowledged_sequence"], 2)
        if result != 0:
            raise AssertionError(f"trigger {self.sequence}: result {result}")
        self.triggered += 1

    def wait_for(self, number):
        """Waits until this is the newest result."""
        address = self.map.address["system_result"]
        while number_in(self.client.read("input", address, 2), "UDINT") != number:
            pass

    def window(self, words, region):
        return {name: number_in(words[place:place + row["count"]], row["type"])
                for name, place, row in self.map.window[region]
                if place + row["count"] <= len(words)}

    def scan(self):
        """One request acknowledges the result used before and reads the next; true if one waited."""
        address = self.map.address["result_acknowledged"]
        window = self.map.address["result_0_result"] + 5000  # the mirror
        chance = self.random.random()
        if chance < 0.02:  # the write arrives or not, its answer does not
            self.client.lose_answer(address, words_of(self.acknowledged), window, 124)
            self.acknowledged = 0
            return True
        if chance < 0.04:
            self.client.reconnect()
            self.acknowledged = 0
        words = self.client.write_and_read(address, words_of(self.acknowledged), window, 124)
        result = self.window(words, 0)
        if result["result"] == 0:
            return False
        self.use(result)
        self.acknowledged = result["result"]
        return True

    def use(self, result):
        identity = (result["result"], result["utc_seconds"], result["utc_microseconds"])
        if identity == self.last:
            self.again += 1  # its acknowledgement was lost
            return
        if result["result"] <= self.last[0]:
            raise AssertionError(f"result {result['result']} after {self.last[0]}")
        self.lost += result["result"] - self.last[0] - 1
        self.check(result, 0)
        others = self.random.randrange(1, REGIONS)  # a region each, to save time
        words = self.client.read("input", self.map.address[f"result_{others}_result"], 124)
        self.check(self.window(words, others), others, result["result"])
        self.last = identity
        self.parts += 1

    def check(self, result, region, number=None):
        """Expects the code that the simulated pipeline computes from n and the region."""
        n = result["result"]
        if number is not None and n != number:
            raise AssertionError(f"region {region} shows result {n} beside {number}")
        if self.is_any:
            return
        expected = {"frame_set": 10 * n, "trigger": n, "configuration_checksum": 7 * n,
                    "recipe": n % 1000, "quality": 1, "process_active": n % 2,
                    "valid_0": 0xFFFF, "valid_16": 0xFFFF, "valid_32": 0xFFFF}
        for name, _, row in self.map.window[region]:
            if name in expected:
                wrong = result[name] != expected[name]
            elif row["type"] == "DINT":
                span = int(row["max"] / row["scale"])
                wrong = result[name] != (n + region) % span
            else:
                continue
            if wrong:
                raise AssertionError(f"result {n}, region {region}: {name} reads {result[name]}")

    def run(self, parts):
        while self.triggered < parts:
            burst = min(self.random.randint(1, self.bursts), parts - self.triggered)
            for _ in range(burst):
                self.trigger()
            self.wait_for(self.triggered)
            while self.scan():
                pass
        self.lost += self.triggered - self.last[0]  # nothing came after these
        overruns = number_in(self.client.read("input", self.map.address["result_overruns"], 2), "UDINT")
        if overruns != self.lost:
            raise AssertionError(f"{self.lost} numbers are missing, {overruns} results were refused")
        print(f"triggered {self.triggered} parts {self.parts} lost {self.lost} again {self.again}")


def main():
    port, parts, seed = (int(word) for word in sys.argv[1:4])
    Plc(port, seed, " ".join(sys.argv[4:])).run(parts)


if __name__ == "__main__":
    main()
