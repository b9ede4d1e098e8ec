#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""unsteady.py [--folder FOLDER] record SUITE [FILE...]: keeps the results of tests, from FILEs or
standard input.
unsteady.py [--folder FOLDER] report: writes unsteady.md and prints it: the tests that both failed and
passed on the same commit.

A FILE holds the output of CTest, its JUnit file, the output of GoogleTest or of unittest (verbose), or
lines "passed NAME" and "failed NAME". FOLDER is build/logs if not given; results.tsv in it has a line
for each result: commit, UTC, suite, test, passed or failed. The newest 50,000 to 60,000 lines are kept.
With uncommitted changes the commit is followed by a hash of them.
"""

import argparse
import collections
import contextlib
import dataclasses
import datetime
import fcntl
import pathlib
import sys

from results import results
from revision import ROOT, revision

MOST_LINES = 60000
KEPT_LINES = 50000
LONGEST_NAME = 300
NONE = "No test both failed and passed on the same commit."


@dataclasses.dataclass
class Count:
    passed: int = 0
    failed: int = 0
    newest: str = ""


@contextlib.contextmanager
def locked(folder):
    """Admits one process at a time; suites may run in parallel."""
    folder.mkdir(parents=True, exist_ok=True)
    with (folder / "results.lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield


def replace(file, text):
    """Leaves the old file or the new one, never a part."""
    unfinished = file.with_suffix(".unfinished")
    unfinished.write_text(text)
    unfinished.replace(file)


def record(folder, suite, found, commit, now):
    """Appends results to results.tsv and drops the oldest when there are too many."""
    lines = [f"{commit}\t{now:%Y-%m-%dT%H:%M:%SZ}\t{suite}\t{' '.join(name.split())[:LONGEST_NAME]}"
             f"\t{'passed' if passed else 'failed'}\n" for name, passed in found]
    file = folder / "results.tsv"
    with locked(folder):
        with file.open("a+") as out:
            out.writelines(lines)
            out.seek(0)
            kept = out.readlines()
        if len(kept) > MOST_LINES:
            replace(file, "".join(kept[-KEPT_LINES:]))


def counts(text):
    """Numbers of passes and failures by commit, suite and test."""
    found = collections.defaultdict(Count)
    for line in text.splitlines():
        fields = line.split("\t")
        if len(fields) != 5 or fields[4] not in ("passed", "failed"):
            continue
        commit, utc, suite, name, result = fields
        count = found[commit, suite, name]
        count.newest = max(count.newest, utc)
        if result == "passed":
            count.passed += 1
        else:
            count.failed += 1
    return dict(found)


def unsteady(found):
    """The counts of tests that both passed and failed. If CTest runs a program as a whole, only a
    failed one's cases are known: a case passes with its program, and represents it."""
    chosen, represented = {}, set()
    for (commit, suite, name), count in found.items():
        program = commit, suite, name.partition("/")[0]
        passed = count.passed
        if program[2] != name and program in found:
            passed += found[program].passed
        if count.failed and passed:
            chosen[commit, suite, name] = dataclasses.replace(count, passed=passed)
            if program[2] != name:
                represented.add(program)
    return {key: count for key, count in chosen.items() if key not in represented}


def page(chosen):
    """The content of unsteady.md, the newest first."""
    if not chosen:
        return NONE + "\n"
    lines = ["Tests that both failed and passed on the same commit:", "",
             "| test | suite | commit | failed | passed | newest result |", "|---|---|---|---|---|---|"]
    rows = sorted(chosen.items(), key=lambda row: row[0])
    rows.sort(key=lambda row: row[1].newest, reverse=True)
    lines += [f"| {name.replace('|', '/')} | {suite} | {commit} | {count.failed} | {count.passed} "
              f"| {count.newest} |" for (commit, suite, name), count in rows]
    return "\n".join(lines) + "\n"


def report(folder):
    """Writes unsteady.md and returns its text."""
    with locked(folder):
        file = folder / "results.tsv"
        text = page(unsteady(counts(file.read_text() if file.exists() else "")))
        replace(folder / "unsteady.md", text)
    return text


def read(files):
    contents = [file.read_bytes() for file in files] or [sys.stdin.buffer.read()]
    texts = [content.decode(errors="replace") for content in contents]
    return [result for text in texts for result in results(text)]


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "build/logs")
    commands = parser.add_subparsers(dest="command", required=True)
    recording = commands.add_parser("record")
    recording.add_argument("suite", metavar="SUITE")
    recording.add_argument("files", metavar="FILE", nargs="*", type=pathlib.Path)
    commands.add_parser("report")
    asked = parser.parse_args()
    if asked.command == "report":
        print(report(asked.folder), end="")
        return
    try:
        found = read(asked.files)
    except (OSError, ValueError) as error:
        sys.exit(f"unsteady: {error}")
    if not found:
        sys.exit(f"unsteady: no result of a test in what {asked.suite} printed")
    record(asked.folder, asked.suite, found, revision(), datetime.datetime.now(datetime.timezone.utc))


if __name__ == "__main__":
    main()
