# SPDX-License-Identifier: Apache-2.0
"""drawn.sh: the commit from which on a part counts as changed."""
import pathlib
import subprocess
import sys
import tempfile
import time
import unittest

sys.dont_write_bytecode = True
SCRIPT = pathlib.Path(__file__).resolve().parent / "drawn.sh"


class Repository(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.top = pathlib.Path(folder.name)
        self.git("init", "--quiet")
        self.commits = [self.commit() for _ in range(3)]

    def git(self, *words):
        return subprocess.run(["git", "-c", "user.name=a", "-c", "user.email=a@example.org", *words],
                              cwd=self.top, check=True, capture_output=True, text=True).stdout.strip()

    def commit(self):
        self.git("commit", "--quiet", "--allow-empty", "--message", "a")
        return self.git("rev-parse", "HEAD")


class LastWhole(Repository):
    def report(self, **rows):
        """Rows by part: number of the commit, and the result."""
        (self.top / "tests").mkdir(exist_ok=True)
        lines = [f"| {part} | `a command` | {self.commits[number]} | 9 | {result} |"
                 for part, (number, result) in rows.items()]
        stages = ["", "| stage | s | CPU s | result |", "| page | 81 | 155 | passed |"]
        (self.top / "tests/REPORT.md").write_text("\n".join(lines + stages) + "\n")

    def last(self, part):
        ran = subprocess.run(["bash", "-c", f'set -euo pipefail; . {SCRIPT}; last_whole "$1"', "last", part],
                             cwd=self.top, check=True, capture_output=True, text=True)
        return ran.stdout.strip()

    def test_without_a_report_there_is_none(self):
        self.assertEqual(self.last("page"), "")

    def test_it_is_the_newer_one_of_the_part_alone_and_the_run_with_it(self):
        self.report(run=(0, "passed: 9 passed"))
        self.assertEqual(self.last("page"), self.commits[0])
        self.report(run=(0, "passed"), page=(1, "passed: 9 passed"))
        self.assertEqual(self.last("page"), self.commits[1])
        self.report(run=(2, "passed"), page=(1, "passed"))
        self.assertEqual(self.last("page"), self.commits[2])

    def test_what_failed_does_not_count(self):
        self.report(run=(0, "passed"), page=(1, "FAILED: 8 passed, 1 failed"))
        self.assertEqual(self.last("page"), self.commits[0])
        self.report(run=(0, "FAILED"), page=(1, "FAILED"))
        self.assertEqual(self.last("page"), "")

    def test_a_run_does_not_contain_the_machines(self):
        self.report(run=(2, "passed"), machines=(1, "passed"))
        self.assertEqual(self.last("machines"), self.commits[1])
        self.report(run=(2, "passed"))
        self.assertEqual(self.last("machines"), "")

class Due(Repository):
    """Whether a stage is to run of whose folder everything has changed."""

    def is_due(self, **variables):
        settings = "".join(f"{name}={value}; " for name, value in variables.items())
        (self.top / "tests/support").mkdir(parents=True, exist_ok=True)
        changed = self.top / "tests/support/changed"
        changed.write_text("#!/bin/sh\nexit 0\n")
        changed.chmod(0o755)
        ran = subprocess.run(["bash", "-c", f"set -uo pipefail; . {SCRIPT}; part=page; {settings}due name folder"],
                             cwd=self.top, check=False, capture_output=True, text=True)
        self.assertEqual(ran.stderr, "")
        return ran.returncode == 0

    def test_a_changed_one_is_due_until_the_time_is_over(self):
        self.assertTrue(self.is_due())
        self.assertTrue(self.is_due(ORBWATCH_UNTIL=int(time.time()) + 3600))
        self.assertFalse(self.is_due(ORBWATCH_UNTIL=int(time.time()) - 1))

    def test_a_whole_run_has_no_end(self):
        self.assertTrue(self.is_due(whole=1, ORBWATCH_UNTIL=1))


if __name__ == "__main__":
    unittest.main()
