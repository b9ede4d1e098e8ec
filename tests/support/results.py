# SPDX-License-Identifier: Apache-2.0
"""Reads passed and failed tests from the output of the programs that run tests."""

import re
import xml.etree.ElementTree as xml

# CTest: " 3/12 Test  #4: optics_tests.1 ......***Failed    0.02 sec"
CTEST = re.compile(r" *\d+/\d+ Test +#\d+: (.+?) \.{2,} *(Passed|\*\*\*.*?) +[\d.]+ sec$")
# GoogleTest repeats the names of failed tests at its end, there without a time.
GTEST = re.compile(r"\[ +(OK|FAILED) +\] ([^\s,]+)(?:, where .*)? \(\d+ ms\)$")
# unittest: "test_x (page_test.PageTest.test_x) ... ok"; a description or output may come between.
UNITTEST = re.compile(r"(?:test_\w+|setUpClass|setUpModule|tearDownClass|tearDownModule) \(([\w.]+)\)")
VERDICT = re.compile(r"(?:^|.* \.\.\. )(ok|FAIL|ERROR|skipped .*|expected failure)$")
# Our scripts: "passed NAME" or "FAILED   NAME (3 s), see ...".
WORDS = re.compile(r"(passed|failed|FAILED):? +([^\s(].*?)(?: \([\d.]+ s\).*)?$")
NOT_RUN = ("***Skipped", "***Not Run (Disabled)")


class _Reader:
    def __init__(self):
        self.found = []
        self.by_ctest = False
        self.test = None  # CTest's test whose output follows
        self.case = None  # unittest's case whose verdict follows

    def line(self, line):
        if ctest := CTEST.match(line):
            self.ctest(*ctest.groups())
        elif gtest := GTEST.match(line):
            self.gtest(gtest[2], gtest[1] == "OK")
        elif not self.by_ctest:
            self.other(line)

    def ctest(self, name, verdict):
        name = name.partition("  # ")[0]  # a parameter follows, which may contain addresses
        self.by_ctest, self.test = True, name
        if not verdict.startswith(NOT_RUN):
            self.found.append((name, verdict == "Passed"))

    def gtest(self, name, passed):
        """A case's own name is within its program's, unless CTest runs it alone."""
        if name != self.test:
            self.found.append((f"{self.test}/{name}" if self.test else name, passed))

    def other(self, line):
        if begun := UNITTEST.match(line):
            self.case = begun[1]
        if self.case and (verdict := VERDICT.match(line)):
            if verdict[1] in ("ok", "FAIL", "ERROR"):
                self.found.append((self.case, verdict[1] == "ok"))
            self.case = None
        elif words := WORDS.match(line):
            self.found.append((words[2], words[1] == "passed"))


def _junit(text):
    reader = _Reader()
    for case in xml.fromstring(text).iter("testcase"):
        name, status = case.get("name", ""), case.get("status", "run")
        if status == "disabled" or (status == "notrun" and not _absent(case)):
            continue
        reader.ctest(name, "Passed" if status == "run" and case.find("failure") is None else "***Failed")
        for line in case.findtext("system-out", "").splitlines():
            reader.line(line)
    return reader.found


def _absent(case):
    """True if a test did not run because its program is missing, which CTest counts as failed."""
    skipped = case.find("skipped")
    return skipped is not None and skipped.get("message", "").startswith("Unable to find")


def results(text):
    """Pairs of a test's name and whether it passed, in the order of the text: the output of CTest, its
    JUnit file, the output of GoogleTest or unittest (verbose), or lines "passed NAME" and
    "failed NAME". Tests that were skipped are left out."""
    if re.match(r"\s*<(\?xml|testsuite)", text):
        try:
            return _junit(text)
        except xml.ParseError as error:
            raise ValueError(f"not a JUnit file: {error}") from error
    reader = _Reader()
    for line in text.splitlines():
        reader.line(line)
    return reader.found
