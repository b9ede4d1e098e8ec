#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Records of a version that was tried, in a folder in place of the device's root, with programs in place of the
firmware's and the system's. tests/platform/image/run broken_update has the real ones."""
import os
import pathlib
import subprocess
import tempfile
import unittest

SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "platform/image/system/usr/lib/orbwatch-image"
ORDER = "BootCurrent: 0001\\nBootOrder: {order}\\nBoot0001* system0\\nBoot0002* system1\\n"
# The data partition is there as soon as its service is awaited.
SYSTEMCTL = """#!/bin/sh
case "$*" in
  "start orbwatch-data") mv {root}/partition {root}/data ;;
  show*) printf "ActiveState=active\\nStatusText=running: 1\\nInvocationID=1\\n" ;;
esac
"""


class TrialRecords(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="orbwatch-trial-")
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        for name in ("bin", "data/update", "run/orbwatch-image", "etc"):
            (self.root / name).mkdir(parents=True)
        (self.root / "etc/os-release").write_text("IMAGE_ID=orbwatch\nIMAGE_VERSION=2.0\n", encoding="utf-8")
        (self.root / "run/orbwatch-image/slot").write_text("a\n", encoding="utf-8")
        self.record = self.root / "data/update/tried"
        self.returned = self.root / "data/returned"
        self.program("systemctl", SYSTEMCTL.format(root=self.root))
        for name in ("ip", "orbwatch", "timedatectl", "rauc", "sleep"):
            self.program(name, "#!/bin/sh\n")
        self.program("on_consoles", "#!/bin/sh\ncat\n")

    def program(self, name, text):
        (self.root / "bin" / name).write_text(text, encoding="utf-8")
        (self.root / "bin" / name).chmod(0o755)

    def run_script(self, name):
        script = (SCRIPTS / name).read_text(encoding="utf-8").replace("proof=120", "proof=0")
        for there, here in (("/usr/lib/orbwatch-image/", f"{self.root}/bin/"), ("=/run/", f"={self.root}/run/"),
                            ("/data/", f"{self.root}/data/"), ("/etc/", f"{self.root}/etc/"),
                            ("/usr/lib/systemd/systemd-networkd-wait-online", "true")):
            script = script.replace(there, here)
        done = subprocess.run(["bash", "-c", script], capture_output=True, text=True, check=False,
                              env={**os.environ, "SLOT": "system0", "PATH": f"{self.root}/bin:{os.environ['PATH']}"})
        self.assertEqual(done.stderr, "")
        return done.stdout

    def lines(self):
        shown = self.run_script("show_access").splitlines()
        return [line for line in shown if line and not line.startswith("clock")]

    def confirm(self, order):
        """Starts the confirmation before the data partition is mounted."""
        partition, data = self.root / "partition", self.root / "data"
        data.rename(partition)
        self.program("efibootmgr", "#!/bin/sh\nprintf '" + ORDER.format(order=order) + "'\n")
        said = self.run_script("confirm_version")
        if partition.exists():
            partition.rename(data)
        return said

    def test_record_is_kept_when_the_program_that_prepared_it_has_ended(self):
        self.run_script("keep_record")
        self.assertFalse(self.record.exists(), "nothing was prepared")
        prepared = self.record.with_suffix(".new")
        prepared.write_text("3\n", encoding="utf-8")
        self.run_script("keep_record")
        self.assertEqual(self.record.read_text(encoding="utf-8"), "3\n")
        self.assertFalse(prepared.exists())

    def test_console_names_a_version_that_was_not_kept(self):
        self.record.write_text("3\nf2c4e1f0-0000-4000-8000-000000000000\n", encoding="utf-8")
        self.assertEqual(self.lines(), ["orbwatch 2.0, slot a", "version 3 was tried and not kept"])

    def test_console_does_not_name_the_running_version(self):
        self.assertEqual(self.lines(), ["orbwatch 2.0, slot a"])
        self.record.write_text("2.0\nf2c4e1f0-0000-4000-8000-000000000000\n", encoding="utf-8")
        self.assertEqual(self.lines(), ["orbwatch 2.0, slot a"])
        self.record.write_text("3\n", encoding="utf-8")
        (self.root / "run/orbwatch-image/trial").touch()
        self.assertEqual(self.lines(), ["orbwatch 2.0, slot a, on trial"])

    def test_kept_version_removes_its_record_that_a_power_cut_has_left(self):
        self.record.write_text("2.0\nf2c4e1f0-0000-4000-8000-000000000000\n", encoding="utf-8")
        self.returned.write_text("1.5\nreason\n", encoding="utf-8")
        self.assertEqual(self.confirm("0001,0002"), "")
        self.assertFalse(self.record.exists() or self.returned.exists())

    def test_kept_version_keeps_the_record_of_another_one(self):
        self.record.write_text("2.0.1\n", encoding="utf-8")
        self.returned.write_text("2.0.1\nreason\n", encoding="utf-8")
        self.assertEqual(self.confirm("0001"), "")
        self.assertTrue(self.record.exists() and self.returned.exists())

    def test_kept_version_without_a_record_is_silent(self):
        self.assertEqual(self.confirm("0001"), "")

    def test_version_on_trial_that_works_is_kept(self):
        self.record.write_text("2.0\n", encoding="utf-8")
        self.program("efibootmgr", "#!/bin/sh\nprintf '" + ORDER.format(order="0002") + "'\n")
        self.assertEqual(self.run_script("confirm_version"), "version 2.0 is on trial\nversion 2.0 works and is kept\n")
        self.assertFalse(self.record.exists())
        self.assertFalse((self.root / "run/orbwatch-image/trial").exists())


if __name__ == "__main__":
    unittest.main()
