# SPDX-License-Identifier: Apache-2.0
"""tests/stress: the commands it runs, its failures, and the end of all its processes."""
import importlib.machinery
import importlib.util
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
STRESS = Path(__file__).resolve().parent.parent / "stress"
loader = importlib.machinery.SourceFileLoader("stress", str(STRESS))
stress = importlib.util.module_from_spec(importlib.util.spec_from_loader("stress", loader))
loader.exec_module(stress)

ENTER = f"""
import importlib.machinery, importlib.util, signal, sys
sys.dont_write_bytecode = True
loader = importlib.machinery.SourceFileLoader("stress", {str(STRESS)!r})
stress = importlib.util.module_from_spec(importlib.util.spec_from_loader("stress", loader))
loader.exec_module(stress)
for number in (signal.SIGINT, signal.SIGTERM):
    signal.signal(number, stress.interrupted)
with stress.busy_loops(2) as loops:
    print(*(loop.pid for loop in loops), flush=True)
    signal.pause()
"""


def runs(pid):
    """A process that ended and was not waited for by its parent does not run."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except (FileNotFoundError, ProcessLookupError):
        return False


def ended(pids):
    until = time.monotonic() + 60
    while any(map(runs, pids)):
        if time.monotonic() > until:
            return False
        time.sleep(0.01)
    return True


class Commands(unittest.TestCase):
    def command(self, test):
        words, _, _ = stress.command_of(test, "release")
        return " ".join(map(str, words)).replace(f"{stress.ROOT}/", "")

    def test_scripts(self):
        self.assertEqual(self.command("web"), "tests/web/run")
        self.assertEqual(self.command("web:an_alarm"), "tests/web/run an_alarm")
        self.assertEqual(self.command("packages"), "tests/platform/packages/run")
        self.assertEqual(self.command("hil:vivid@arm64"), "tests/hil/run vivid@arm64")

    def test_regular_expressions_go_to_ctest(self):
        self.assertRegex(self.command("^Daemon|web"),
                         r"^setarch -R ctest --preset release -j \d+ --no-tests=error -R \^Daemon\|web$")

    def test_a_program_runs_as_in_ctest_but_whole(self):
        listing = {"tests": [
            {"name": "absent_NOT_BUILT"},
            {"name": "x.0", "command": ["/usr/bin/env", "/bin/sh", "--gtest_filter=-"],
             "properties": [{"name": "ENVIRONMENT", "value": ["A=b=c", "GTEST_TOTAL_SHARDS=4"]},
                            {"name": "WORKING_DIRECTORY", "value": "/tmp"}]}]}
        self.assertEqual(stress.test_of_program(listing, "sh"),
                         (["/usr/bin/env", "/bin/sh"], {"A": "b=c"}, "/tmp"))
        with self.assertRaises(stress.Unusable):
            stress.test_of_program(listing, "absent")


class Reason(unittest.TestCase):
    def test_a_run_passes_with_a_passed_test_only(self):
        self.assertEqual(stress.reason(0, [("a", True)]), "")
        self.assertEqual(stress.reason(0, []), "no test was run")
        self.assertEqual(stress.reason(8, []), "ended with 8")
        self.assertEqual(stress.reason(1, [("a", True), ("b", False)]), "b")
        self.assertIn("b failed", stress.reason(0, [("b", False)]))
        self.assertIn("not ended", stress.reason(None, [("a", True)]))


class Processes(unittest.TestCase):
    def test_a_run_leaves_no_process(self):
        with tempfile.TemporaryDirectory() as folder:
            log = Path(folder) / "log"
            code = stress.run(["sh", "-c", "sleep 1000 & echo $!; exit 3"], None, folder, log)
            self.assertEqual(code, 3)
            self.assertTrue(ended([int(log.read_text())]))

    def test_loops_end_with_the_block(self):
        with stress.busy_loops(3) as loops:
            self.assertTrue(all(runs(loop.pid) for loop in loops))
            self.assertEqual({os.getpgid(loop.pid) for loop in loops}, {loops[0].pid})
        self.assertTrue(ended([loop.pid for loop in loops]))

    def test_loops_end_with_a_signal(self):
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGKILL):
            with subprocess.Popen([sys.executable, "-c", ENTER], stdout=subprocess.PIPE,
                                  text=True) as process:
                loops = list(map(int, process.stdout.readline().split()))
                self.assertEqual(len(loops), 2)
                process.send_signal(number)
                process.wait()
            self.assertTrue(ended(loops), number)


if __name__ == "__main__":
    unittest.main()
