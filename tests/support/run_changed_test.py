# SPDX-License-Identifier: Apache-2.0
"""run_changed.py: the test programs that belong to a changed file."""
import sys
import unittest

sys.dont_write_bytecode = True
import run_changed  # noqa: E402


class Mirrored(unittest.TestCase):
    def setUp(self):
        self.programs = set(run_changed.folders_of_programs())

    def of(self, *changed):
        return run_changed.mirrored(changed, self.programs)

    def test_the_folder_of_tests_with_the_same_name(self):
        self.assertIn("remap_tests", self.of("proc/remap/kernel/scalar.cpp"))
        self.assertIn("web_tests", self.of("app/ports/web/http/server.cpp"))

    def test_without_such_a_folder_the_next_one_above(self):
        self.assertEqual(self.of("app/ports/web/http/not_there/x.cpp"), self.of("app/ports/web/http/server.cpp"))

    def test_a_changed_test_is_in_its_own_folder(self):
        self.assertEqual(self.of("tests/proc/optics/lens_test.cpp"), self.of("proc/optics/lens.cpp"))

    def test_only_what_is_compiled_counts(self):
        names = ["app/a.cpp", "tests/app/a_test.cpp", "app/README.md", "proc/a.h", "platform/demo"]
        self.assertEqual(run_changed.sources(names, "app"), ["app/a.cpp", "tests/app/a_test.cpp"])


if __name__ == "__main__":
    unittest.main()
