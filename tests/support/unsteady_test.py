# SPDX-License-Identifier: Apache-2.0
"""unsteady.py: the results it keeps and the tests it reports as unsteady."""
import datetime
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
import unsteady  # noqa: E402

DAY = datetime.datetime(2026, 1, 1, tzinfo=datetime.timezone.utc)


class Unsteady(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name) / "logs"

    def record(self, *found, commit="c1", suite="release", hour=0):
        unsteady.record(self.folder, suite, found, commit, DAY + datetime.timedelta(hours=hour))

    def rows(self):
        return [line for line in unsteady.report(self.folder).splitlines() if line.startswith("| ")][1:]

    def test_a_test_that_failed_and_passed(self):
        self.record(("a", True), ("b", True), ("c", False))
        self.record(("a", False), ("b", True), ("c", False), hour=1)
        self.record(("a", True), hour=2)
        self.assertEqual(self.rows(), ["| a | release | c1 | 1 | 2 | 2026-01-01T02:00:00Z |"])
        self.assertEqual((self.folder / "unsteady.md").read_text(), unsteady.report(self.folder))

    def test_other_commits_and_suites_are_something_else(self):
        self.record(("a", True))
        self.record(("a", False), commit="c2")
        self.record(("a", False), suite="tsan")
        self.assertEqual(self.rows(), [])
        self.assertEqual(unsteady.report(self.folder), unsteady.NONE + "\n")

    def test_a_case_passes_with_its_program_and_stands_for_it(self):
        self.record(("x.1", False), ("x.1/A.b", False), ("x.1/A.c", True), ("y.0", False))
        self.record(("x.1", True), ("y.0", True), hour=1)
        self.assertEqual(self.rows(), ["| y.0 | release | c1 | 1 | 1 | 2026-01-01T01:00:00Z |",
                                       "| x.1/A.b | release | c1 | 1 | 1 | 2026-01-01T00:00:00Z |"])

    def test_names_are_one_field(self):
        self.record(("a\tb\nc|d", True), ("a b c|d", False), ("x" * 999, True))
        self.assertEqual(len(self.rows()), 1)
        self.assertIn("| a b c/d |", self.rows()[0])
        longest = (self.folder / "results.tsv").read_text().splitlines()[-1]
        self.assertLess(len(longest), unsteady.LONGEST_NAME + 100)

    def test_broken_lines_are_skipped(self):
        self.record(("a", True))
        with (self.folder / "results.tsv").open("a") as out:
            out.write("\nc1\tnow\trelease\ta\nc1\tnow\trelease\ta\tmaybe\n\0\n")
        self.record(("a", False))
        self.assertEqual(len(self.rows()), 1)

    def test_the_file_stays_small(self):
        self.record(("first", True))
        for _ in range(7):
            self.record(*[("a", True)] * 10000)
            lines = (self.folder / "results.tsv").read_text().splitlines()
            self.assertLessEqual(len(lines), unsteady.MOST_LINES)
        self.assertNotIn("first", {line.split("\t")[3] for line in lines})
        self.assertEqual(sorted(file.name for file in self.folder.iterdir()),
                         ["results.lock", "results.tsv"])

    def test_nothing_was_recorded_yet(self):
        self.assertEqual(unsteady.report(self.folder), unsteady.NONE + "\n")
