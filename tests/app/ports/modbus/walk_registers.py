#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""walk_registers.py PORT: reads every row of the committed map from a running server, and writes
every writable row. Prints each fault on one line; exit code 1 if there is any."""

import sys

from modbus_client import BITS, Client, Refused, number_in, register_map, words_of

MIRRORS = {"coil": "discrete", "holding": "input"}
NOT_VALID = -0x80000000
MIRROR_OFFSET = 5000
ONE_REQUEST = {"coil": 2000, "discrete": 2000, "holding": 125, "input": 125}


def read(client, row):
    """The words or bits of a row, read by several requests if it is longer than one."""
    values, step = [], ONE_REQUEST[row["table"]]
    for place in range(0, row["count"], step):
        values += client.read(row["table"], row["address"] + place, min(step, row["count"] - place))
    return values


def wrong_value(row, values):
    if row["name"].startswith("reserved_"):
        return any(values) and "is reserved and not 0"
    if row["table"] in BITS:
        return None
    number = number_in(values, row["type"])
    if row["type"] == "DINT" and number == NOT_VALID:
        return None
    # A register has a coarser resolution than a double.
    low, high = (row[end] / row["scale"] for end in ("min", "max"))
    if not low - 0.5 <= number <= high + 0.5:
        return f"reads {number}, which is not in {low} to {high}"
    return None


def mirror_is_between(client, row, original):
    """Compares reads of a running machine: constants are equal, counters lie in between."""
    for _ in range(50):
        before, mirror, after = read(client, original), read(client, row), read(client, original)
        if before == after:
            return mirror == before
        if original["table"] == "input" and original["type"] != "DINT":
            if before <= mirror <= after:
                return True
    return False


def write_all(client, rows):
    """Writes each writable row with its present value; the sequence stays, so no command is given."""
    for row in rows:
        if row["access"] != "rw":
            continue
        if row["name"].startswith("state_"):
            yield from write_part_of_state(client, row)
            continue
        client.write(row["address"], read(client, row))
        if row["count"] == 2:
            try:
                client.write(row["address"], [0])
                yield f"{row['name']}: half of it could be written"
            except Refused as refused:
                if refused.code != 2:
                    yield f"{row['name']}: half of it is refused with {refused}"


def write_part_of_state(client, row):
    """The state of the machine is written whole or not at all."""
    try:
        client.write(row["address"], read(client, row))
        yield f"{row['name']}: could be written without the rest of the state"
    except Refused as refused:
        if refused.code != 2:
            yield f"{row['name']}: alone it is refused with {refused}"


def walk(client, rows):
    by_place = {(row["table"], row["address"]): row for row in rows}
    for row in rows:
        where = f"{row['table']} {row['address']} {row['name']}"
        try:
            values = read(client, row)
        except Refused as refused:
            yield f"{where}: {refused}"
            continue
        wrong = wrong_value(row, values)
        if wrong:
            yield f"{where}: {wrong}"
        if row["table"] not in MIRRORS or row["address"] < MIRROR_OFFSET:
            continue
        original = by_place[MIRRORS[row["table"]], row["address"] - MIRROR_OFFSET]
        if not mirror_is_between(client, row, original):
            yield f"{where}: is not what it mirrors"
    yield from write_all(client, rows)


def main():
    client, rows = Client(int(sys.argv[1])), register_map()
    wrong = list(walk(client, rows))
    print("\n".join(wrong))
    print(f"{len(rows)} rows, {len(wrong)} wrong")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
