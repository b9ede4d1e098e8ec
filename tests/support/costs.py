#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""costs.py BUILD_FOLDER --since-file FILE [--build-cpu SECONDS] [--tests-cpu SECONDS] [--name NAME]:
Markdown tables of the CPU seconds per target and per test program in a build folder.

FILE is touched before the build; jobs whose outputs are older do not count. The job durations in
.ninja_log and the test durations in LastTest.log are elapsed seconds on a busy machine. Each table is
therefore scaled: its sum is the CPU seconds that were measured for the whole stage. A table is
printed for each of --build-cpu and --tests-cpu. NAME begins the headings; default: the folder's name.
"""

import argparse
import collections
import dataclasses
import os
import pathlib
import re
import sys

VERSIONS = ("5", "6", "7")  # versions of .ninja_log; they differ in the hash of the command
SMALL = 0.01  # share of the sum below which rows are merged
EMULATORS = re.compile(r"(.*/)?qemu-[a-z0-9_]+$")


@dataclasses.dataclass(frozen=True)
class Entry:
    """A line of .ninja_log."""
    begin_ms: int
    end_ms: int
    written_ns: int  # 0: the output is not a file
    output: str
    command: str


@dataclasses.dataclass(frozen=True)
class Cost:
    """A job of the build or a test: the row that it belongs to, its own name, elapsed seconds."""
    row: str
    name: str
    seconds: float


def entries(text):
    """The lines of a .ninja_log. Skips incomplete ones, which an interrupted build leaves."""
    lines = text.split("\n")
    version = re.fullmatch(r"# ninja log v(\d+)", lines[0])
    if not version or version[1] not in VERSIONS:
        raise ValueError(f"unknown version of the ninja log: {lines[0]!r}")
    found = []
    for line in lines[1:-1]:  # the last one has no end of line
        fields = line.split("\t")
        if len(fields) == 5 and all(field.isdecimal() for field in fields[:3]):
            found.append(Entry(int(fields[0]), int(fields[1]), int(fields[2]), *fields[3:]))
    return found


def since(log, mark_ns):
    """The newest entry of each output, of those written since the mark. An entry without a time
    belongs to the same build as the one before it."""
    newest, counts = {}, False
    for entry in log:
        if entry.written_ns:
            counts = entry.written_ns >= mark_ns
        newest.pop(entry.output, None)
        if counts:
            newest[entry.output] = entry
    return list(newest.values())


def target_of_object(output):
    found = re.search(r"(?:^|/)CMakeFiles/([^/]+)\.dir/", output)
    return found[1] if found else None


def product_name(output):
    """What CMake calls a linked file's target: libfoo.so.1 is foo."""
    return re.sub(r"^lib(.*)\.(a|so[.\d]*)$", r"\1", output.rpartition("/")[2])


def row_of(outputs, targets):
    """The target that a job's outputs belong to; for other commands the first output."""
    for output in outputs:
        if target := target_of_object(output):
            return target
    for output in outputs:
        if product_name(output) in targets:
            return product_name(output)
    return outputs[0]


def build_costs(log, build):
    """The jobs of the entries. A job has a line for each of its outputs."""
    jobs = collections.defaultdict(list)
    for entry in log:
        output = entry.output.removeprefix(f"{build}/")
        jobs[entry.begin_ms, entry.end_ms, entry.command].append(output)
    targets = {target_of_object(output) for outputs in jobs.values() for output in outputs}
    return [Cost(row_of(outputs, targets), outputs[0], max(0, end - begin) / 1000)
            for (begin, end, _), outputs in jobs.items()]


def program_of(test, command, build):
    """The name of the program in the build folder that a test runs; for other tests the test's own."""
    words = re.findall(r'"([^"]*)"', command)
    if len(words) > 1 and EMULATORS.match(words[0]):
        words = [word for word in words[1:] if word.startswith(f"{build}/")]
    if words and words[0].startswith(f"{build}/"):
        return words[0].rpartition("/")[2]
    return re.sub(r"\.\d+$", "", test)


def test_costs(text, build):
    """The tests of a LastTest.log."""
    found, test, command, printed = [], None, "", False
    for line in text.splitlines():
        if begun := re.match(r"\d+/\d+ Test: (.*?)(  # .*)?$", line):
            test, command, printed = begun[1], "", False
        elif test and not command and line.startswith("Command: "):
            command = line
        elif test and line.endswith("<end of output>"):
            printed = True
        elif test and printed and (took := re.match(r"Test time = +([\d.]+) sec", line)):
            found.append(Cost(program_of(test, command, build), test, float(took[1])))
            test = None
    return found


def grouped(costs):
    """Rows: name, seconds, number, the longest; the most expensive first, the small ones as one."""
    groups = collections.defaultdict(list)
    for cost in costs:
        groups[cost.row].append(cost.seconds)
    rows = sorted(((name, sum(times), len(times), max(times)) for name, times in groups.items()),
                  key=lambda row: (-row[1], row[0]))
    limit = SMALL * sum(row[1] for row in rows)
    large, small = [r for r in rows if r[1] >= limit], [r for r in rows if r[1] < limit]
    if len(small) < 2:
        return rows
    return large + [(f"{len(small)} others, below 1 % each", sum(r[1] for r in small),
                     sum(r[2] for r in small), max(r[3] for r in small))]


def table(title, costs, cpu, kind, plural):
    """Markdown: a heading, the method, a table."""
    elapsed = sum(cost.seconds for cost in costs)
    lines = [f"### {title}", ""]
    if not costs:
        return lines + [f"No {kind} was run.", ""]
    longest = max(costs, key=lambda cost: cost.seconds)
    scale = cpu / elapsed if elapsed else 0
    lines += [f"{cpu:.0f} CPU s were measured; the {elapsed:.0f} s elapsed in {len(costs)} {plural} are "
              f"scaled to them. The longest {kind} is `{longest.name}`, {longest.seconds:.1f} s elapsed.",
              "", f"| {title.rpartition(' ')[2]} | CPU s | {plural} | longest, CPU s |",
              "|---|---|---|---|"]
    lines += [f"| {name} | {seconds * scale:.1f} | {count} | {most * scale:.1f} |"
              for name, seconds, count, most in grouped(costs)]
    return lines + [""]


def read(path, mark_ns=0):
    if not path.exists():
        sys.exit(f"costs: {path} is missing")
    if path.stat().st_mtime_ns < mark_ns:
        sys.exit(f"costs: {path} is older than the mark")
    return path.read_text(errors="replace")


def build_table(asked, build, mark_ns):
    log = read(build / ".ninja_log")
    try:
        costs = build_costs(since(entries(log), mark_ns), build)
    except ValueError as error:
        sys.exit(f"costs: {build}/.ninja_log: {error}")
    return table(f"{asked.name}: CPU seconds per target", costs, asked.build_cpu, "job", "jobs")


def tests_table(asked, build, mark_ns):
    costs = test_costs(read(build / "Testing/Temporary/LastTest.log", mark_ns), build)
    return table(f"{asked.name}: CPU seconds per program", costs, asked.tests_cpu, "test", "tests")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", metavar="BUILD_FOLDER", type=pathlib.Path)
    parser.add_argument("--since-file", metavar="FILE", type=pathlib.Path, required=True)
    parser.add_argument("--build-cpu", metavar="SECONDS", type=float)
    parser.add_argument("--tests-cpu", metavar="SECONDS", type=float)
    parser.add_argument("--name", metavar="NAME")
    asked = parser.parse_args()
    build = pathlib.Path(os.path.abspath(asked.build))
    asked.name = asked.name or build.name
    if not asked.since_file.exists():
        sys.exit(f"costs: the mark {asked.since_file} is missing")
    mark_ns = asked.since_file.stat().st_mtime_ns
    lines = []
    if asked.build_cpu is not None:
        lines += build_table(asked, build, mark_ns)
    if asked.tests_cpu is not None:
        lines += tests_table(asked, build, mark_ns)
    print("\n".join(lines))


if __name__ == "__main__":
    main()
