# SPDX-License-Identifier: Apache-2.0
"""count_cases.py: the number of cases in a run of CTest."""
import sys
import unittest
from xml.etree import ElementTree

sys.dont_write_bytecode = True
import count_cases  # noqa: E402

PASSED = "[==========] 3 tests from 1 test suite ran.\n[  PASSED  ] {} tests.\n"


def program(output, status="run", skipped=None):
    element = ElementTree.Element("testcase", name="p", status=status)
    ElementTree.SubElement(element, "system-out").text = output
    if skipped is not None:
        ElementTree.SubElement(element, "skipped", message=skipped)
    return count_cases.cases(element)


class Cases(unittest.TestCase):
    def test_each_case_of_a_program_counts(self):
        self.assertEqual(program(PASSED.format(3)), ({"PASSED": 3}, []))

    def test_skipped_and_failed_cases_count_apart_and_failures_have_names(self):
        output = "a_test.cpp:3: Skipped\nskipped, missing: root\n" + PASSED.format(1)
        output += "[  SKIPPED ] 1 test, listed below:\n[  SKIPPED ] A.b\n"
        output += "[  FAILED  ] 2 tests, listed below:\n[  FAILED  ] A.c\n"
        output += "[  FAILED  ] A.d/1, where GetParam() = 4\n"
        self.assertEqual(program(output, "fail"), ({"PASSED": 1, "SKIPPED": 1, "FAILED": 2}, ["A.c", "A.d/1"]))

    def test_a_case_that_does_not_apply_is_not_skipped(self):
        output = "a_test.cpp:3: Skipped\none camera only\n" + PASSED.format(2)
        self.assertEqual(program(output + "[  SKIPPED ] 1 test, listed below:\n"), ({"PASSED": 2, "SKIPPED": 0}, []))

    def test_a_program_that_ends_early_has_failed(self):
        self.assertEqual(program("[ RUN      ] A.b\n", "fail"), ({"FAILED": 1}, ["all of it"]))
        self.assertEqual(program(PASSED.format(3), "fail"), ({"PASSED": 3, "FAILED": 1}, ["ended early"]))

    def test_what_prints_no_cases_is_one(self):
        self.assertEqual(program("fine\n"), ({"PASSED": 1}, []))

    def test_only_what_asks_for_it_is_skipped(self):
        self.assertEqual(program("", "notrun", "SKIP_RETURN_CODE=77"), ({"SKIPPED": 1}, []))
        self.assertEqual(program("", "notrun", "Unable to find executable"), ({"FAILED": 1}, ["not run"]))


if __name__ == "__main__":
    unittest.main()
