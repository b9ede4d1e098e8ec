# SPDX-License-Identifier: Apache-2.0
"""suite.sh: the programs that run under a sanitizer."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
FOLDER = pathlib.Path(__file__).resolve().parent
PRESETS = ("asan-ubsan", "tsan")
MOST_OWN = 6


class ChosenPrograms(unittest.TestCase):
    def choose(self, programs, *, whole=0, since=""):
        """Names of the programs that are due by preset; each is in one of both lists. `programs`: lines of
        due_programs.py."""
        with tempfile.TemporaryDirectory() as top:
            (pathlib.Path(top) / "tests/support").mkdir(parents=True)
            listing = pathlib.Path(top) / "tests/support/due_programs.py"
            listing.write_text("#!/bin/sh\ncat <<'END'\n" + "".join(f"{line}\n" for line in programs) + "END\n")
            listing.chmod(0o755)
            subprocess.run(["git", "init", "--quiet"], cwd=top, check=True)
            subprocess.run(["git", "-c", "user.name=a", "-c", "user.email=a@example.org", "commit", "--quiet",
                            "--allow-empty", "--message", "a"], cwd=top, check=True)
            due = {}
            for preset in PRESETS:
                build = pathlib.Path(top) / "build" / preset
                build.mkdir(parents=True)
                subprocess.run(["bash", "-c", f"set -uo pipefail; . {FOLDER}/drawn.sh; . {FOLDER}/suite.sh; "
                                f"whole={whole} ORBWATCH_SINCE={since}; choose_programs {preset}"],
                               cwd=top, check=True)
                due[preset] = (build / "due").read_text().split()
                left = (build / "not_due").read_text().split()
                self.assertEqual(sorted(due[preset] + left), sorted(line.split()[1] for line in programs))
            return due

    def test_changed_ones_run_under_both_and_affected_ones_under_one(self):
        due = self.choose(["own a", "due b", "own c"])
        self.assertEqual(sorted(map(sorted, due.values())), [["a", "b", "c"], ["a", "c"]])

    def test_of_many_changed_ones_some_run_under_one(self):
        due = self.choose([f"own p{n}" for n in range(20)] + ["due b", "same c"])
        few, many = sorted(due.values(), key=len)
        self.assertEqual(few, [])
        self.assertEqual(len(many), MOST_OWN)
        self.assertTrue(all(name.startswith("p") for name in many))

    def test_a_whole_run_and_one_since_a_commit_leave_none_of_them_out(self):
        names = [f"p{n}" for n in range(20)]
        for options in ({"whole": 1}, {"since": "HEAD"}):
            for due in self.choose([f"own {name}" for name in names], **options).values():
                self.assertEqual(sorted(due), sorted(names))


if __name__ == "__main__":
    unittest.main()
