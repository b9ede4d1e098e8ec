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
# Prints as many commands of a compiler as the names of the programs say, such as 40 for p1_40.
NINJA = r"""#!/bin/sh
shift 4
for name; do for n in $(seq "${name##*_}"); do echo "c++ -c $name"; done; done
"""
MOST_OBJECTS = 90


class ChosenPrograms(unittest.TestCase):
    def choose(self, programs, *, whole=0, since=""):
        """Names of the programs that are due by preset; each is in one of both lists. `programs`: lines of
        due_programs.py."""
        with tempfile.TemporaryDirectory() as top:
            (pathlib.Path(top) / "tests/support").mkdir(parents=True)
            listing = pathlib.Path(top) / "tests/support/due_programs.py"
            listing.write_text("#!/bin/sh\ncat <<'END'\n" + "".join(f"{line}\n" for line in programs) + "END\n")
            listing.chmod(0o755)
            ninja = pathlib.Path(top) / "bin/ninja"
            ninja.parent.mkdir()
            ninja.write_text(NINJA)
            ninja.chmod(0o755)
            subprocess.run(["git", "init", "--quiet"], cwd=top, check=True)
            subprocess.run(["git", "-c", "user.name=a", "-c", "user.email=a@example.org", "commit", "--quiet",
                            "--allow-empty", "--message", "a"], cwd=top, check=True)
            due = {}
            for preset in PRESETS:
                build = pathlib.Path(top) / "build" / preset
                build.mkdir(parents=True)
                subprocess.run(["bash", "-c", f"set -uo pipefail; PATH={ninja.parent}:$PATH; . {FOLDER}/drawn.sh; . {FOLDER}/suite.sh; "
                                f"whole={whole} ORBWATCH_SINCE={since}; choose_programs {preset}"],
                               cwd=top, check=True)
                due[preset] = (build / "due").read_text().split()
                left = (build / "not_due").read_text().split()
                self.assertEqual(sorted(due[preset] + left), sorted(line.split()[1] for line in programs))
            return due

    def test_one_sanitizer_runs_those_that_are_affordable_and_the_own_ones_before_others(self):
        none, due = sorted(self.choose(["same a_10", "own b_40", "due c_30", "own d_30", "own e_30"]).values(), key=len)
        self.assertEqual(none, [])
        self.assertLessEqual(sum(int(name.split("_")[1]) for name in due), MOST_OBJECTS)
        self.assertEqual(len([name for name in due if name[0] in "bde"]), 2)

    def test_one_that_is_too_costly_is_left_to_whole_runs(self):
        _, due = sorted(self.choose(["same a_10", "own b_140"]).values(), key=len)
        self.assertEqual(due, ["a_10"])

    def test_one_runs_when_nothing_has_changed(self):
        _, due = sorted(self.choose(["same a_50", "same b_50"]).values(), key=len)
        self.assertEqual(len(due), 1)

    def test_a_whole_run_leaves_none_out(self):
        names = [f"p{n}_50" for n in range(20)]
        for due in self.choose([f"same {name}" for name in names], whole=1).values():
            self.assertEqual(sorted(due), sorted(names))

    def test_one_since_a_commit_runs_all_that_changed_under_both(self):
        for due in self.choose(["own a_80", "due b_80", "same c_1"], since="HEAD").values():
            self.assertEqual(sorted(due), ["a_80", "b_80"])


if __name__ == "__main__":
    unittest.main()
