# SPDX-License-Identifier: Apache-2.0
"""due_programs.py: the programs that a change affects, of a small project."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
import due_programs  # noqa: E402
import run_changed  # noqa: E402

# Two libraries; `upper` includes a header of `lower`. The daemon embeds a page and is started by its tests.
FILES = {
    "CMakeLists.txt": "", "README.md": "", "tests/CMakeLists.txt": "", "tests/data/a.toml": "",
    "lower/CMakeLists.txt": "", "lower/lower.h": "", "lower/lower.cpp": '#include "lower/lower.h"\n',
    "upper/CMakeLists.txt": "", "upper/upper.h": '#include "lower/lower.h"\n',
    "upper/upper.cpp": '#include "upper/upper.h"\n', "upper/page/main.js": "",
    "tests/web/page_test.py": "", "tests/lower_test.cpp": '#include "lower/lower.h"\n',
    "tests/upper_test.cpp": '#include "upper/upper.h"\n', "tests/daemon_test.cpp": "",
    "tests/fuzz/CMakeLists.txt": "", "tests/fuzz/lower_fuzz.cpp": "", "tests/fuzz/corpus/lower/1": "",
    "daemon.cpp": "",
}
TESTS = "".join(f'add_test({name}.0 "{name}")\n' for name in ("lower_tests", "upper_tests", "daemon_tests"))
NINJA = """
rule CXX_EXECUTABLE_LINKER__
  command = touch $out
build {top}/lower/CMakeFiles/lower.dir/Unity/unity_0_cxx.cxx: phony
build lower.a: CXX_EXECUTABLE_LINKER__ {build}/lower/CMakeFiles/lower.dir/Unity/unity_0_cxx.cxx
build lower_tests: CXX_EXECUTABLE_LINKER__ {top}/tests/lower_test.cpp lower.a
build upper_tests: CXX_EXECUTABLE_LINKER__ {top}/tests/upper_test.cpp {top}/upper/upper.cpp lower.a
build daemon: CXX_EXECUTABLE_LINKER__ {top}/daemon.cpp {top}/upper/upper.cpp
build daemon_tests: CXX_EXECUTABLE_LINKER__ {top}/tests/daemon_test.cpp || daemon
build fuzz_lower: CXX_EXECUTABLE_LINKER__ {top}/tests/fuzz/lower_fuzz.cpp lower.a
build bench: CXX_EXECUTABLE_LINKER__ lower.a
"""
ALL = {"lower_tests", "upper_tests", "daemon_tests", "fuzz_lower"}


class DuePrograms(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.top = pathlib.Path(folder.name).resolve()
        self.build = self.top / "build"
        for name, text in {**FILES, ".gitignore": "build\n"}.items():
            self.write(name, text)
        unity = "build/lower/CMakeFiles/lower.dir/Unity/unity_0_cxx.cxx"
        self.write(unity, f'#include "{self.top}/lower/lower.cpp"\n')
        self.write("build/build.ninja", NINJA.format(top=self.top, build=self.build))
        self.write("build/CTestTestfile.cmake", TESTS)
        self.git("init", "--quiet")
        self.commit()
        for module in (due_programs, run_changed):
            self.addCleanup(setattr, module, "ROOT", module.ROOT)
            module.ROOT = self.top

    def write(self, name, text):
        path = self.top / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def git(self, *words):
        subprocess.run(["git", "-c", "user.name=a", "-c", "user.email=a@example.org", *words], cwd=self.top,
                       check=True)

    def commit(self):
        self.git("add", "--all")
        self.git("commit", "--quiet", "--message", "a")

    def due_after(self, *changed):
        for name in changed:
            with (self.top / name).open("a") as file:
                file.write("\n")
        self.commit()
        return self.due("HEAD~1")

    def test_what_all_are_built_with_spares_no_sanitizer(self):
        self.due_after("CMakeLists.txt")
        for base in ("HEAD~1", ""):
            self.assertEqual(set(due_programs.fates(self.build, base).values()), {"own"})

    def due(self, base):
        fates = due_programs.fates(self.build, base)
        self.assertEqual(set(fates), ALL)
        return {name for name, fate in fates.items() if fate != "same"}

    def test_a_source_affects_what_is_linked_with_it(self):
        self.assertEqual(self.due_after("lower/lower.cpp"), {"lower_tests", "upper_tests", "fuzz_lower"})

    def test_a_program_of_the_changed_folder_is_told_from_others(self):
        self.write("tests/CMakeLists.txt", "orbwatch_tests(upper_tests SOURCES upper/upper_test.cpp LIBRARIES a)")
        self.commit()
        with (self.top / "upper/upper.cpp").open("a") as file:
            file.write("\n")
        self.commit()
        self.assertEqual(due_programs.fates(self.build, "HEAD~1"), {
            "upper_tests": "own", "daemon_tests": "due", "lower_tests": "same", "fuzz_lower": "same"})

    def test_a_program_affects_the_tests_that_start_it(self):
        self.assertEqual(self.due_after("daemon.cpp"), {"daemon_tests"})

    def test_a_header_affects_all_that_include_it_also_indirectly(self):
        self.assertEqual(self.due_after("upper/upper.h"), {"upper_tests", "daemon_tests"})
        self.assertEqual(self.due_after("lower/lower.h"), ALL)

    def test_another_file_affects_its_librarys_sources(self):
        self.assertEqual(self.due_after("upper/page/main.js"), {"upper_tests", "daemon_tests"})
        self.assertEqual(self.due_after("tests/fuzz/corpus/lower/1"), {"fuzz_lower"})

    def test_a_deleted_source_is_known_by_its_library(self):
        self.git("rm", "--quiet", "upper/upper.cpp")
        self.write("upper/CMakeLists.txt", "\n")
        self.write("upper/other.cpp", "")
        self.commit()
        self.assertEqual(self.due("HEAD~1"), {"upper_tests", "daemon_tests"})

    def test_documents_and_scripts_affect_none(self):
        self.assertEqual(self.due_after("README.md", "tests/web/page_test.py"), set())

    def test_what_all_are_built_with_affects_all(self):
        self.assertEqual(self.due_after("tests/data/a.toml"), ALL)
        self.assertEqual(self.due_after("CMakeLists.txt"), ALL)

    def test_all_are_due_without_a_known_commit(self):
        self.assertEqual(self.due(""), ALL)
        self.assertEqual(self.due("0" * 40), ALL)


if __name__ == "__main__":
    unittest.main()
