#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Access to the configuration on the data partition, in a folder in place of the device's root, with programs in place
of the system's. tests/platform/image/run has the real ones."""
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "platform/image/system/usr/lib/orbwatch-image/mount_data"
ABSOLUTE = re.compile(r"(?<![\w/.$}])/(?=(?:data|dev|etc|run|sys|usr|var)\b)")
# A folder that is mounted is a copy of the kept one.
MOUNT = """#!/bin/sh
[ "$1" = --bind ] || exit 0
rm -r "$3" && cp -a "$2" "$3"
"""
CHGRP = """#!/bin/sh
echo "$@" >>{root}/given
exit {status}
"""


class MountData(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="orbwatch-data-")
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        self.configuration = self.root / "etc/orbwatch"
        self.kept = self.root / f"data/system{self.configuration}"
        for name in ("bin", "data", "run/orbwatch-image", "sys/block/sda/sda1", "usr/lib/systemd"):
            (self.root / name).mkdir(parents=True)
        self.make_folders(self.configuration, 0o2775)
        (self.root / "etc/machine-id").write_text("1\n", encoding="utf-8")
        (self.root / "run/orbwatch-image/disk").write_text(f"{self.root}/dev/sda\n", encoding="utf-8")
        (self.root / "sys/block/sda/sda1/uevent").write_text("PARTNAME=data\n", encoding="utf-8")
        for name in ("e2fsck", "install", "systemd-repart", "udevadm"):
            self.program(f"bin/{name}", "#!/bin/sh\n")
        self.program("usr/lib/systemd/systemd-growfs", "#!/bin/sh\n")
        self.program("bin/stat", "#!/bin/sh\necho '1000000 * 4096'\n")
        self.program("bin/mount", MOUNT)
        self.program("bin/chgrp", CHGRP.format(root=self.root, status=0))

    def program(self, name, text):
        (self.root / name).write_text(text, encoding="utf-8")
        (self.root / name).chmod(0o755)

    def make_folders(self, top, mode):
        """Makes a configuration whose folders, except the two that every image gave to the service, have a mode."""
        (top / "recipes/parts").mkdir(parents=True)
        (top / "tls").mkdir()
        for folder in (top, top / "recipes"):
            folder.chmod(0o2775)
        for folder in (top / "recipes/parts", top / "tls"):
            folder.chmod(mode)

    def run_script(self):
        script = ABSOLUTE.sub(f"{self.root}/", SCRIPT.read_text(encoding="utf-8"))
        subprocess.run(["bash", "-c", script], capture_output=True, text=True, check=False,
                       env={**os.environ, "PATH": f"{self.root}/bin:{os.environ['PATH']}"})
        fault = self.root / "run/orbwatch-image/data-fault"
        return fault.read_text(encoding="utf-8") if fault.exists() else ""

    def given(self):
        """Folders that were given to a group, after its name."""
        record = self.root / "given"
        return sorted(record.read_text(encoding="utf-8").split()) if record.exists() else []

    def modes(self):
        folders = [self.configuration, *(path for path in self.configuration.rglob("*") if path.is_dir())]
        return {oct(folder.stat().st_mode & 0o7777) for folder in folders}

    def test_service_may_write_every_folder_that_an_older_image_left(self):
        self.make_folders(self.kept, 0o755)
        self.assertEqual(self.run_script(), "")
        self.assertEqual(self.given(), sorted([f"{self.configuration}/recipes/parts", f"{self.configuration}/tls",
                                               "orbwatch"]))
        self.assertEqual(self.modes(), {"0o2775"})

    def test_folders_of_the_first_boot_stay_as_they_are(self):
        self.assertEqual(self.run_script(), "")
        self.assertEqual(self.given(), [])
        self.assertEqual(self.modes(), {"0o2775"})

    def test_folders_that_stay_closed_are_reported(self):
        self.make_folders(self.kept, 0o755)
        self.program("bin/chgrp", CHGRP.format(root=self.root, status=1))
        self.assertIn("stay closed to the service", self.run_script())


if __name__ == "__main__":
    unittest.main()
