# SPDX-License-Identifier: Apache-2.0
"""suite.sh: the programs that run under a sanitizer."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
FOLDER = pathlib.Path(__file__).resolve().parent
# Prints as many commands of a compiler as the names of the programs say, such as 40 for p1_40.
NINJA = r"""#!/bin/sh
shift 4
for name; do for n in $(seq "${name##*_}"); do echo "c++ -c $name"; done; done
"""
CORES = 2
MOST_OBJECTS = 90
SANITIZER_FACTOR = 2  # as in suite.sh


def executable(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    path.chmod(0o755)


class ChosenPrograms(unittest.TestCase):
    def choose(self, programs, *, whole=0, seconds_per_object=1, most=MOST_OBJECTS):
        """Names of the programs that are due; each is due or listed as not due. `programs`: lines of
        due_programs.py. The release build took `seconds_per_object`; the given time lets `most` objects of
        one second compile and run."""
        with tempfile.TemporaryDirectory() as folder:
            top = pathlib.Path(folder)
            executable(top / "tests/support/due_programs.py",
                       "#!/bin/sh\ncat <<'END'\n" + "".join(f"{line}\n" for line in programs) + "END\n")
            executable(top / "bin/ninja", NINJA)
            executable(top / "bin/nproc", f"#!/bin/sh\necho {CORES}\n")
            build = top / "build/tsan"
            build.mkdir(parents=True)
            if seconds_per_object:
                log = top / "build/release/.ninja_log"
                log.parent.mkdir()
                took_ms = 1000 * seconds_per_object
                log.write_text("# ninja log v5\n" f"0\t{9 * took_ms}\t1\ta.cpp.o\tabc\n" f"0\t{took_ms}\t1\ta.cpp.o\tabc\n"
                               f"{took_ms}\t{2 * took_ms}\t1\tb.cpp.o\tabc\n" "0\t900000\t1\tliba.a\tabc\n")
            subprocess.run(["git", "init", "--quiet"], cwd=top, check=True)
            subprocess.run(["git", "-c", "user.name=a", "-c", "user.email=a@example.org", "commit", "--quiet",
                            "--allow-empty", "--message", "a"], cwd=top, check=True)
            subprocess.run(["bash", "-c", f"set -uo pipefail; PATH={top}/bin:$PATH; . {FOLDER}/drawn.sh; . {FOLDER}/suite.sh; "
                            f"whole={whole} within={most * SANITIZER_FACTOR // CORES}; choose_programs tsan"],
                           cwd=top, check=True, capture_output=True)
            due = (build / "due").read_text().split()
            left = (build / "not_due").read_text().split()
            self.assertEqual(sorted(due + left), sorted(line.split()[1] for line in programs))
            return due

    def test_those_that_the_time_allows_run_and_the_own_ones_before_others(self):
        due = self.choose(["same a_10", "own b_40", "due c_30", "own d_30", "own e_30"])
        self.assertLessEqual(sum(int(name.split("_")[1]) for name in due), MOST_OBJECTS)
        self.assertEqual(len([name for name in due if name[0] in "bde"]), 2)

    def test_a_slow_machine_runs_fewer(self):
        programs = [f"own p{n}_20" for n in range(9)]
        self.assertEqual(len(self.choose(programs)), 4)
        self.assertEqual(len(self.choose(programs, seconds_per_object=2)), 2)

    def test_one_that_is_too_costly_is_left_to_whole_runs(self):
        self.assertEqual(self.choose(["same a_10", "own b_140"]), ["a_10"])

    def test_without_time_none_runs(self):
        for most in (0, -40):
            self.assertEqual(self.choose(["own a_1"], most=most), [])

    def test_without_a_release_build_it_fails(self):
        with self.assertRaises(subprocess.CalledProcessError):
            self.choose(["own a_1"], seconds_per_object=0)

    def test_a_whole_run_leaves_none_out(self):
        names = [f"p{n}_50" for n in range(20)]
        self.assertEqual(sorted(self.choose([f"same {name}" for name in names], whole=1, seconds_per_object=0)),
                         sorted(names))


if __name__ == "__main__":
    unittest.main()
