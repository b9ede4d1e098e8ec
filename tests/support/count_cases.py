#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""count_cases.py JUNIT: the cases that CTest's programs ran, from the file of its option --output-junit.

Prints `N passed, N failed, N skipped`, then a line per failed case (`FAILED PROGRAM NAME`) and per reason
of a skipped one. GoogleTest programs count by their printed cases, any other as one case; a program that
ended early has one more failure.
"""

import re
import sys
import xml.etree.ElementTree as ElementTree

COUNT = re.compile(r"^\[  (PASSED|SKIPPED|FAILED) +\] (\d+) tests?[,.]", re.MULTILINE)
FAILED = re.compile(r"^\[  FAILED  \] (\S+)(?:, where .*)?$", re.MULTILINE)
# Reason of a case that cannot run here. Cases that do not apply, like some of compliance/, have others.
REASON = re.compile(r"^skipped, missing.*$", re.MULTILINE)


def cases(program):
    """Numbers of passed, failed and skipped cases of one CTest test, and the failed ones' names."""
    output = program.findtext("system-out") or ""
    bad = program.get("status") == "fail"
    reason = program.find("skipped")
    if reason is not None and "SKIP_" not in reason.get("message", ""):
        return {"FAILED": 1}, ["not run"]
    counts = {}
    for kind, number in COUNT.findall(output):
        counts[kind] = counts.get(kind, 0) + int(number)
    if "SKIPPED" in counts:
        counts["SKIPPED"] = len(REASON.findall(output))
    names = list(dict.fromkeys(FAILED.findall(output)))
    if not counts:
        kind = "FAILED" if bad else "PASSED" if reason is None else "SKIPPED"
        return {kind: 1}, ["all of it"] if bad else []
    if bad and not counts.get("FAILED"):
        counts["FAILED"] = 1
        names = ["ended early"]
    return counts, names


def main():
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        print(__doc__)
        return 0 if sys.argv[1:] == ["--help"] else 2
    total = {"PASSED": 0, "FAILED": 0, "SKIPPED": 0}
    failures, reasons = [], set()
    for program in ElementTree.parse(sys.argv[1]).getroot().iter("testcase"):
        counts, names = cases(program)
        for kind, number in counts.items():
            total[kind] += number
        failures += [f"FAILED {program.get('name')} {name}" for name in names]
        reasons.update(REASON.findall(program.findtext("system-out") or ""))
    print(f"{total['PASSED']} passed, {total['FAILED']} failed, {total['SKIPPED']} skipped")
    for line in failures + sorted(reasons):
        print(line)
    return 0


if __name__ == "__main__":
    sys.exit(main())
