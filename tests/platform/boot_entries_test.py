#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The firmware's entries of an image's slots, with programs in place of efibootmgr and udevadm that keep them in a
file. The real ones are used by tests/platform/image/run erased_entries."""
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

SCRIPT = (pathlib.Path(__file__).resolve().parents[2] /
          "platform/image/system/usr/lib/orbwatch-image/make_boot_entries")
PATH = r"\EFI\BOOT\BOOTX64.EFI"
EFIBOOTMGR = r"""#!/usr/bin/env python3
import pathlib, sys
entries = pathlib.Path(__file__).with_name("entries")
order = pathlib.Path(__file__).with_name("order")
words = sys.argv[1:]
value = lambda option: words[words.index(option) + 1]
lines = entries.read_text().splitlines()
if "--verbose" in words:
    print("BootCurrent: 0000", "BootOrder: " + order.read_text() if order.exists() else "No BootOrder is set", *lines,
          sep="\n")
elif "--bootorder" in words:
    order.write_text(value("--bootorder"))
elif "--delete-bootnum" in words:
    entries.write_text("".join(f"{line}\n" for line in lines if not line.startswith("Boot" + value("--bootnum"))))
else:
    guid = f"new-guid-{value('--part')}".upper()
    if "--create" in words:
        order.write_text(",".join([f"{len(lines) + 10:04X}", *order.read_text().split(",")]))
    entries.write_text("".join(f"{line}\n" for line in [*lines,
        f"Boot{len(lines) + 10:04X}* {value('--label')}\tHD({value('--part')},GPT,{guid},0x800,0x1000)/{value('--loader')}"]))
"""
UDEVADM = """#!/bin/sh
for device; do :; done
echo "new-guid-${device##*esp_}" | tr ab 23
"""


class BootEntries(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="orbwatch-entries-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.entries = self.folder / "entries"
        for name, text in (("efibootmgr", EFIBOOTMGR), ("udevadm", UDEVADM)):
            (self.folder / name).write_text(text, encoding="utf-8")
            (self.folder / name).chmod(0o755)
        (self.folder / "slot").write_text("a\n", encoding="utf-8")
        (self.folder / "disk").write_text("/dev/vda\n", encoding="utf-8")
        (self.folder / "slots").mkdir()
        for number, slot in ((2, "esp_a"), (3, "esp_b")):
            (self.folder / "block" / slot).mkdir(parents=True)
            (self.folder / "block" / slot / "partition").write_text(f"{number}\n", encoding="utf-8")
            (self.folder / "slots" / slot).touch()
        script = SCRIPT.read_text(encoding="utf-8").replace("run=/run/orbwatch-image", f"run={self.folder}")
        script = script.replace("/sys/class/block/${device#/dev/}", f"{self.folder}/block/${{device##*/}}")
        (self.folder / "make").write_text(script.replace("$(uname -m)", "x86_64"), encoding="utf-8")

    def make(self, *entries, order="0000"):
        self.write_order(order)
        self.entries.write_text("".join(f"{one}\n" for one in entries), encoding="utf-8")
        done = subprocess.run(["bash", self.folder / "make"], capture_output=True, text=True, check=False,
                              env={**os.environ, "PATH": f"{self.folder}:{os.environ['PATH']}"})
        self.assertEqual(done.returncode, 0, done.stderr)
        found = re.findall(r"\* (\S+)\tHD\(\d,GPT,([^,]+),", self.entries.read_text(encoding="utf-8"))
        return sorted(found), done.stdout

    def write_order(self, order):
        """`None`: the firmware has no order."""
        file = self.folder / "order"
        file.unlink(missing_ok=True)
        if order is not None:
            file.write_text(order, encoding="utf-8")

    def order(self):
        return (self.folder / "order").read_text(encoding="utf-8")

    right = [("system0", "NEW-GUID-2"), ("system1", "NEW-GUID-3")]

    def entry(self, number, name, guid):
        return f"Boot{number:04X}* {name}\tHD(2,GPT,{guid},0x800,0x1000)/{PATH}"

    def test_missing_ones_are_made_and_right_ones_stay(self):
        found, said = self.make(self.entry(0, "UEFI Misc Device", "x"))
        self.assertEqual(sorted(found)[-2:], self.right)
        self.assertEqual(said.count("made the entry"), 2)
        self.assertEqual(self.order(), "000B,0000")
        found, said = self.make(self.entry(1, "system0", "new-guid-2"), self.entry(2, "system1", "new-guid-3"),
                                order="0000,0001")
        self.assertEqual(said, "")
        self.assertEqual(len(found), 2)

    def test_those_of_another_disk_are_replaced(self):
        found, said = self.make(self.entry(1, "system0", "old"), self.entry(2, "system0", "older"),
                                self.entry(3, "system1", "old"), self.entry(4, "system10", "another"))
        self.assertEqual(found, [self.right[0], self.right[1], ("system10", "another")])
        self.assertEqual(said.count("removed the entry"), 3)

    def test_booted_slot_becomes_the_first_when_the_order_has_neither(self):
        entries = self.entry(0x1A, "system0", "NEW-GUID-2"), self.entry(2, "system1", "NEW-GUID-3")
        for booted, order, expected in (("a", "0000,0003", "001A,0000,0003"), ("b", "0000,0003", "0002,0000,0003"),
                                        ("b", None, "0002"), ("a", "0000,0002", "0000,0002"),
                                        ("b", "0000,001A,0003", "0000,001A,0003")):
            with self.subTest(booted=booted, order=order):
                (self.folder / "slot").write_text(f"{booted}\n", encoding="utf-8")
                found, said = self.make(*entries, order=order)
                self.assertEqual((self.order(), found), (expected, self.right))
                self.assertEqual(said.count("put the entry"), int(order != expected))


if __name__ == "__main__":
    unittest.main()
