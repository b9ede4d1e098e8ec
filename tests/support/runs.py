#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""runs.py [--folder FOLDER] keep [FILE]: stores a finished table of stages as COMMIT-UTC.md.
runs.py [--folder FOLDER] compare A B: prints the rows that cost more in run B than in run A.
runs.py [--folder FOLDER] list: prints the names of the runs, the oldest first.

FILE is build/logs/stages.md and FOLDER build/logs/runs if not given. The newest 20 runs are kept. A
and B are files or prefixes of names in FOLDER; the newest such run is chosen. The columns "CPU s" of
tables with the same heading are compared: rows that are new, or higher by more than 10 % and by 1 s.
"""

import argparse
import datetime
import pathlib
import re
import sys

from revision import ROOT, revision

KEPT = 20
DEARER = 1.10
NOTICED_S = 1.0
COLUMN = "CPU s"


def runs(folder):
    """The kept runs, the oldest first."""
    named = [(found[1], file) for file in folder.glob("*.md")
             if (found := re.search(r"-(\d{8}T\d{6}Z)(?:-\d+)?\.md$", file.name))]
    return [file for _, file in sorted(named)]


def keep(source, folder, commit, now):
    """Copies a finished table; returns its new place."""
    folder.mkdir(parents=True, exist_ok=True)
    place = folder / f"{commit}-{now:%Y%m%dT%H%M%SZ}.md"
    place.write_text(source.read_text())
    for old in runs(folder)[:-KEPT]:
        old.unlink()
    return place


def cells(line):
    return [cell.strip().strip("*`") for cell in line.strip().strip("|").split("|")]


def seconds_of(text):
    """CPU seconds by the heading above a table and the row's name."""
    found, heading, column = {}, "", None
    for line in text.splitlines():
        if line.startswith("#"):
            heading = line.strip("# ")
        if not line.startswith("|"):
            column = None
            continue
        row = cells(line)
        if column is None:
            column = row.index(COLUMN) if COLUMN in row else -1
        elif 0 < column < len(row) and re.fullmatch(r"\d+(\.\d+)?", row[column]):
            key = heading, re.sub(r"^\d+ others", "others", row[0])
            found[key] = found.get(key, 0) + float(row[column])
    return found


def dearer(before, after):
    """Rows: heading, name, seconds before (None: new), seconds after; the largest rise first."""
    rows = [(*key, before.get(key), after[key]) for key in after
            if after[key] - before.get(key, 0) >= NOTICED_S
            and after[key] > DEARER * before.get(key, 0)]
    return sorted(rows, key=lambda row: (row[2] or 0) - row[3])


def comparison(before, after):
    rows = dearer(before, after)
    if not rows:
        return ["Nothing costs more than 10 % more."]
    lines = ["| table | row | CPU s before | CPU s now | change |", "|---|---|---|---|---|"]
    for heading, name, old, new in rows:
        change = f"+{100 * (new / old - 1):.0f} %" if old else "new"
        lines.append(f"| {heading} | {name} | {'' if old is None else f'{old:.1f}'} | {new:.1f} | {change} |")
    return lines


def chosen(name, folder):
    if pathlib.Path(name).is_file():
        return pathlib.Path(name)
    named = [run for run in runs(folder) if run.name.startswith(name)]
    return named[-1] if named else sys.exit(f"runs: no run {name} in {folder}; see runs.py list")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "build/logs/runs")
    commands = parser.add_subparsers(dest="command", required=True)
    commands.add_parser("keep").add_argument("file", metavar="FILE", nargs="?", type=pathlib.Path,
                                             default=ROOT / "build/logs/stages.md")
    compare = commands.add_parser("compare")
    compare.add_argument("before", metavar="A")
    compare.add_argument("after", metavar="B")
    commands.add_parser("list")
    asked = parser.parse_args()
    if asked.command == "keep":
        if not asked.file.is_file():
            sys.exit(f"runs: {asked.file} is missing")
        print(keep(asked.file, asked.folder, revision(), datetime.datetime.now(datetime.timezone.utc)))
    elif asked.command == "list":
        print("\n".join(run.name for run in runs(asked.folder)))
    else:
        texts = [chosen(name, asked.folder).read_text() for name in (asked.before, asked.after)]
        print("\n".join(comparison(*map(seconds_of, texts))))


if __name__ == "__main__":
    main()
