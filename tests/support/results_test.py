# SPDX-License-Identifier: Apache-2.0
"""results.py: every kind of output that it reads, complete and broken."""
import sys
import unittest

sys.dont_write_bytecode = True
from results import results  # noqa: E402

CTEST = """Test project /b
      Start  1: x_tests.0
 1/9 Test  #1: x_tests.0 ........................   Passed    0.02 sec
      Start  2: x_tests.1
 2/9 Test  #2: x_tests.1 ........................***Failed    0.01 sec
[ RUN      ] A.good
[       OK ] A.good (3 ms)
[  FAILED  ] A.bad/0, where GetParam() = 3, (x) (4 ms)
passed by accident
[  FAILED  ] A.bad/0, where GetParam() = 3

 3/9 Test  #5: Q.crash ..........................***Exception: SegFault  0.02 sec
 4/9 Test  #4: slow .............................***Timeout   0.99 sec
 5/9 Test  #3: skip .............................***Skipped   0.02 sec
 6/9 Test  #7: off ..............................***Not Run (Disabled)   0.00 sec
 7/9 Test  #6: absent ...........................***Not Run   0.00 sec
 8/9 Test  #9: Single.case ......................***Failed    0.01 sec
[  FAILED  ] Single.case (4 ms)
 9/9 Test  #8: with space .......................   Passed    0.01 sec
 9/9 Test #10: P/Q.r/one  # GetParam() = 8-byte object <60-D3 68-A2> ...   Passed    0.01 sec
75% tests passed, 2 tests failed out of 8
"""

JUNIT = """<?xml version="1.0" encoding="UTF-8"?>
<testsuite name="(empty)" tests="5">
  <testcase name="ok" status="run"><system-out>[       OK ] A.b (3 ms)
</system-out></testcase>
  <testcase name="bad.0" status="fail"><failure message=""/><system-out>[  FAILED  ] A.c (4 ms)
</system-out></testcase>
  <testcase name="skip" status="notrun"><skipped message="SKIP_RETURN_CODE=77"/></testcase>
  <testcase name="absent" status="notrun"><skipped message="Unable to find executable"/></testcase>
  <testcase name="off" status="disabled"/>
</testsuite>
"""

UNITTEST = """test_bad (page_test.Page.test_bad) ... FAIL
test_doc (page_test.Page.test_doc)
Some words ... here. ... noise
ok
test_err (page_test.Page.test_err) ... ERROR
test_plain (page_test.Page.test_plain) ... ok
test_skip (page_test.Page.test_skip) ... skipped 'no browser'
setUpClass (page_test.Other) ... ERROR
test_sub (page_test.Page.test_sub) ...
  test_sub (page_test.Page.test_sub) (a=1) ... FAIL

======================================================================
ERROR: test_err (page_test.Page.test_err)
ok
Ran 6 tests in 0.001s

FAILED (failures=2, errors=1, skipped=1)
"""

WORDS = """passed   shell (3 s)
passed vivid@arm64: pictures arrive (12 s)
FAILED vimc@arm64: a line (12.5 s), the end of x.log:
FAILED: the daemon starts
failed other
skipped  packages, which need root
12 passed, 3 failed, 0 skipped
all checks passed
"""


class Results(unittest.TestCase):
    def test_ctest(self):
        self.assertEqual(results(CTEST), [
            ("x_tests.0", True), ("x_tests.1", False), ("x_tests.1/A.good", True),
            ("x_tests.1/A.bad/0", False), ("Q.crash", False), ("slow", False), ("absent", False),
            ("Single.case", False), ("with space", True), ("P/Q.r/one", True)])

    def test_junit(self):
        self.assertEqual(results(JUNIT), [("ok", True), ("ok/A.b", True), ("bad.0", False),
                                          ("bad.0/A.c", False), ("absent", False)])

    def test_googletest(self):
        text = "[       OK ] A.b (3 ms)\n[  FAILED  ] A.c (1 ms)\n[  FAILED  ] A.c\n[  PASSED  ] 1 test.\n"
        self.assertEqual(results(text), [("A.b", True), ("A.c", False)])

    def test_unittest(self):
        self.assertEqual(results(UNITTEST), [
            ("page_test.Page.test_bad", False), ("page_test.Page.test_doc", True),
            ("page_test.Page.test_err", False), ("page_test.Page.test_plain", True),
            ("page_test.Other", False), ("page_test.Page.test_sub", False)])

    def test_words(self):
        self.assertEqual(results(WORDS), [
            ("shell", True), ("vivid@arm64: pictures arrive", True), ("vimc@arm64: a line", False),
            ("the daemon starts", False), ("other", False)])

    def test_a_broken_junit_file_is_an_error(self):
        with self.assertRaises(ValueError):
            results(JUNIT[:200])

    def test_text_without_results(self):
        for text in ("", "\0\n\n", "[       OK ] A.b", "passed\n", "No tests were found!!!\n"):
            self.assertEqual(results(text), [], text)
