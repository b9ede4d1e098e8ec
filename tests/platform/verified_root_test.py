#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The initramfs finds the slot that the firmware has started, with a folder in place of the devices. The real one boots
in tests/platform/image/run."""
import os
import pathlib
import subprocess
import tempfile
import unittest

SCRIPT = (pathlib.Path(__file__).resolve().parents[2] /
          "platform/image/system/etc/initramfs-tools/scripts/local-top/verified_root")
PROGRAMS = {
    "busybox": 'exec "$@"',
    "modprobe": "",
    "mount": "",
    "umount": "",
    "udevadm": """for device; do :; done
[ "$1" = info ] || exec test -e "$device"
cat "{root}/guids/${{device##*/}}" """,
    "veritysetup": 'echo "opened $2"',
}
FUNCTIONS = 'panic() { echo "panic: $*"; exit 1; }\n'


class VerifiedRoot(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="orbwatch-root-")
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        for name in ("bin", "efivars", "guids", "dev/disk/by-partuuid", "sys/class/block", "sys/block"):
            (self.root / name).mkdir(parents=True)
        for name, text in PROGRAMS.items():
            (self.root / "bin" / name).write_text(f"#!/bin/sh\n{text.format(root=self.root)}\n", encoding="utf-8")
            (self.root / "bin" / name).chmod(0o755)
        (self.root / "functions").write_text(FUNCTIONS, encoding="utf-8")
        (self.root / "cmdline").write_text("orbwatch.root_hash=12 orbwatch.hash_offset=4096\n", encoding="utf-8")

    def add_disk(self, disk, prefix, guids):
        """Partitions of a disk, by name; the last disk owns the links of udev."""
        for number, (name, guid) in enumerate(guids.items(), 1):
            part = f"{prefix}{number}"
            where = self.root / "sys/block" / disk / part
            where.mkdir(parents=True)
            (where / "partition").write_text(f"{number}\n", encoding="utf-8")
            (where / "uevent").write_text(f"PARTNAME={name}\n", encoding="utf-8")
            (self.root / "sys/class/block" / part).symlink_to(where)
            (self.root / "guids" / part).write_text(f"{guid}\n", encoding="utf-8")
            (self.root / "dev" / part).touch()
            link = self.root / "dev/disk/by-partuuid" / guid
            link.unlink(missing_ok=True)
            link.symlink_to(f"../../{part}")
        (self.root / "sys/class/block" / disk).symlink_to(self.root / "sys/block" / disk)

    def image(self, first):
        return {name: f"{first}0000000-0000-4000-8000-00000000000{number}"
                for number, name in enumerate(("esp_a", "esp_b", "root_a", "root_b", "data"))}

    def start(self, guid):
        variable = self.root / "efivars/LoaderDevicePartUUID-4a67b082"
        variable.write_bytes(b"\6\0\0\0" + (guid.upper() + "\0").encode("utf-16-le"))
        text = SCRIPT.read_text(encoding="utf-8")
        for there in ("/efivars", "/dev/", "/sys/", "/run/"):
            text = text.replace(there, f"{self.root}{there}")
        text = text.replace("/proc/cmdline", f"{self.root}/cmdline").replace(". /scripts/", f". {self.root}/")
        done = subprocess.run(["sh", "-c", text, "verified_root"], capture_output=True, text=True, check=False,
                              env={**os.environ, "PATH": f"{self.root}/bin:{os.environ['PATH']}"})
        self.assertEqual(done.stderr, "")
        return done.stdout

    def test_slot_is_that_of_the_partition_that_was_loaded(self):
        self.add_disk("sda", "sda", {"other": "20000000-0000-4000-8000-000000000000"})
        self.add_disk("nvme0n1", "nvme0n1p", self.image(1))
        self.add_disk("sdb", "sdb", self.image(3))
        self.assertIn("orbwatch: slot b\nopened ", self.start(self.image(1)["esp_b"]))
        run = self.root / "run/orbwatch-image"
        self.assertEqual((run / "slot").read_text(encoding="utf-8"), "b\n")
        self.assertEqual((run / "rauc.env").read_text(encoding="utf-8"), "SLOT=system1\n")
        self.assertEqual((run / "slots/root_b").readlink(), self.root / "dev/nvme0n1p4")

    def test_two_disks_with_one_image_are_refused(self):
        self.add_disk("sda", "sda", self.image(1))
        self.add_disk("sdb", "sdb", self.image(1))
        self.assertEqual(self.start(self.image(1)["esp_a"]),
                         "panic: orbwatch: two disks have this image, sdb1 and sda1 are the same partition of it: "
                         "remove one disk\n")


if __name__ == "__main__":
    unittest.main()
