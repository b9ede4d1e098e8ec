# SPDX-License-Identifier: Apache-2.0
"""Folders that `cached` makes."""

import os
import pathlib
import subprocess
import tempfile
import unittest

CACHED = pathlib.Path(__file__).with_name("cached")


class Cached(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.made = pathlib.Path(folder.name) / "made"
        self.command = pathlib.Path(folder.name) / "command"

    def make(self, script, *arguments):
        """Returns whether a command of these lines made the folder."""
        self.command.write_text(f"#!/bin/sh\nset -e\nmkdir \"$1\"\n{script}\n", encoding="utf-8")
        self.command.chmod(0o755)
        return subprocess.run([CACHED, self.made, "--", self.command, *arguments], check=False,
                              stderr=subprocess.DEVNULL).returncode == 0

    def test_is_made_once_by_the_same_command(self):
        script = 'echo "$2" >"$1/text"; echo made >>"$1/../log"'
        for argument in ("a", "a", "b"):
            self.assertTrue(self.make(script, argument))
            self.assertEqual((self.made / "text").read_text(encoding="utf-8"), f"{argument}\n")
        self.assertEqual((self.made.parent / "log").read_text(encoding="utf-8"), "made\n" * 2)

    def test_one_that_failed_is_not_there(self):
        self.assertFalse(self.make("exit 1"))
        self.assertFalse(self.made.exists())
        self.assertTrue(self.make("true"))

    @unittest.skipUnless(os.geteuid() == 0, "mounts a file system")
    def test_what_a_killed_command_left_mounted_is_unmounted_and_kept(self):
        outside = self.made.parent / "outside"
        outside.mkdir()
        (outside / "file").touch()
        self.assertFalse(self.make(
            f'mkdir "$1/dev"; mount --bind "{outside}" "$1/dev"; mkdir "$1/dev/pts"; '
            'mount -t tmpfs none "$1/dev/pts"; kill -KILL $$'))
        self.assertTrue(self.make('touch "$1/whole"'))
        self.assertEqual([path.name for path in self.made.iterdir()], ["whole"])
        self.assertTrue((outside / "file").exists())


if __name__ == "__main__":
    unittest.main()
