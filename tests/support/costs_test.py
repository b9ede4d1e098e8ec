# SPDX-License-Identifier: Apache-2.0
"""costs.py: its counts, and its results for incomplete logs."""
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
import costs  # noqa: E402

HEADER = "# ninja log v5\n"
MARK = 1000


def line(begin, end, output, written=MARK, command="c"):
    return f"{begin}\t{end}\t{written}\t{output}\t{command}\n"


def seconds(text, build="/b", mark=MARK):
    """Seconds by row."""
    found = {}
    for cost in costs.build_costs(costs.since(costs.entries(text), mark), build):
        found[cost.row] = found.get(cost.row, 0) + cost.seconds
    return found


class NinjaLog(unittest.TestCase):
    def test_objects_and_the_link_belong_to_the_target(self):
        text = HEADER + line(0, 1000, "proc/CMakeFiles/optics.dir/a/b.cpp.o", command="1")
        text += line(0, 500, "proc/CMakeFiles/optics.dir/Unity/unity_0_cxx.cxx.o", command="2")
        text += line(1000, 1250, "proc/liboptics.a", command="3")
        self.assertEqual(seconds(text), {"optics": 1.75})

    def test_other_commands_are_named_by_their_output(self):
        text = HEADER + line(0, 2000, "app/page.cpp")
        self.assertEqual(seconds(text), {"app/page.cpp": 2})

    def test_a_job_with_many_outputs_counts_once(self):
        text = HEADER + line(0, 1000, "app/a.h") + line(0, 1000, "app/a.cpp")
        text += line(0, 1000, "/b/app/a.h")
        self.assertEqual(seconds(text), {"app/a.h": 1})

    def test_a_link_that_lists_its_tests_belongs_to_the_target(self):
        text = HEADER + line(0, 1000, "t/CMakeFiles/x_tests.dir/a.cpp.o", command="1")
        text += line(1000, 3000, "t/x_tests[1]_tests.cmake") + line(1000, 3000, "t/x_tests")
        self.assertEqual(seconds(text), {"x_tests": 3})

    def test_the_newest_entry_of_an_output_counts(self):
        text = HEADER + line(0, 9000, "a.o") + line(0, 1000, "a.o", command="d")
        self.assertEqual(seconds(text), {"a.o": 1})

    def test_earlier_builds_do_not_count(self):
        text = HEADER + line(0, 9000, "a.o", written=MARK - 1) + line(0, 1000, "b.o")
        self.assertEqual(seconds(text), {"b.o": 1})

    def test_an_entry_without_a_time_belongs_to_the_build_before_it(self):
        text = HEADER + line(0, 1000, "old.o", written=1) + line(1, 2000, "old", written=0)
        text += line(0, 1000, "new.o") + line(1, 2000, "new", written=0)
        self.assertEqual(seconds(text), {"new.o": 1, "new": 1.999})

    def test_incomplete_lines_are_skipped(self):
        text = HEADER + "\n" + "1\t2\n" + "x\t2\t3\ta\tb\n" + line(0, 1000, "a.o") + "0\t5000\t2000\tb"
        self.assertEqual(seconds(text), {"a.o": 1})

    def test_versions(self):
        for version in ("5", "6", "7"):
            self.assertEqual(seconds(f"# ninja log v{version}\n" + line(0, 1000, "a.o")), {"a.o": 1})
        for wrong in ("", "# ninja log v4\n", "# ninja log v99\n", "something\n"):
            with self.assertRaises(ValueError):
                costs.entries(wrong)


def test_log(name, command, output, took):
    return (f"3/9 Testing: {name}\n3/9 Test: {name}\nCommand: {command}\nDirectory: /b\nOutput:\n---\n"
            f"{output}<end of output>\nTest time =   {took} sec\n---\nTest Passed.\n")


class TestLog(unittest.TestCase):
    def costs(self, text):
        return [(cost.row, cost.name, cost.seconds) for cost in costs.test_costs(text, "/b")]

    def test_rows_are_programs_of_the_build_folder(self):
        text = test_log("A.b", '"/b/t/x_tests" "--gtest_filter=A.b"', "", "0.50")
        text += test_log("y.3", '"/usr/bin/qemu-aarch64" "-L" "/usr" "/b/t/y_tests"', "", "1.25")
        text += test_log("units", '"/source/units" "/b/platform/service"', "", "2.00")
        text += test_log("z.0  # GetParam() = 3", "", "", "0.00")
        self.assertEqual(self.costs(text), [("x_tests", "A.b", 0.5), ("y_tests", "y.3", 1.25),
                                            ("units", "units", 2), ("z", "z.0", 0)])

    def test_output_of_a_test_does_not_matter(self):
        text = test_log("A.b", '"/b/x"', "Test time =   9.00 sec\nCommand: z\nno end of line", "0.50")
        self.assertEqual(self.costs(text), [("x", "A.b", 0.5)])

    def test_a_test_that_did_not_end_is_left_out(self):
        self.assertEqual(self.costs("1/2 Test: a\nCommand: \"/b/x\"\nOutput:\n"), [])


class Table(unittest.TestCase):
    def test_is_scaled_and_sorted_and_joins_what_is_small(self):
        rows = [costs.Cost("big", "b.o", 90), costs.Cost("middle", "m.o", 109.2),
                costs.Cost("s", "s.o", 0.5), costs.Cost("t", "t.o", 0.3)]
        lines = costs.table("x: CPU seconds per target", rows, 100, "job", "jobs")
        self.assertEqual(lines[0], "### x: CPU seconds per target")
        self.assertIn("100 CPU s were measured; the 200 s elapsed in 4 jobs", lines[2])
        self.assertIn("`m.o`, 109.2 s", lines[2])
        self.assertEqual(lines[6:], ["| middle | 54.6 | 1 | 54.6 |", "| big | 45.0 | 1 | 45.0 |",
                                     "| 2 others, below 1 % each | 0.4 | 2 | 0.2 |", ""])

    def test_without_jobs_and_without_time(self):
        self.assertIn("No job was run.", costs.table("x", [], 5, "job", "jobs"))
        self.assertIn("| a | 0.0 | 1 | 0.0 |",
                      costs.table("x", [costs.Cost("a", "a", 0)], 5, "job", "jobs"))

    def test_a_log_older_than_the_mark_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            log = Path(folder) / "LastTest.log"
            with self.assertRaises(SystemExit):
                costs.read(log)
            log.write_text("text")
            self.assertEqual(costs.read(log, log.stat().st_mtime_ns), "text")
            with self.assertRaises(SystemExit):
                costs.read(log, log.stat().st_mtime_ns + 1)
