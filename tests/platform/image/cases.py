# SPDX-License-Identifier: Apache-2.0
"""cases.py ARCHITECTURE FOLDER CASE...: cases of emulated computers, with the images in FOLDER that `run` makes.
--list: prints the cases; --needed CASE...: the files that these take."""

import os
import random
import shutil
import socket
import subprocess
import sys
import traceback
from pathlib import Path

from tests.platform.image.disk import DataPartition, begin_of, overwrite, partitions
from tests.platform.image.machine import Machine
from tests.platform.image.page import Page

GIB = 1 << 30
PASSWORD = "a password of the test"
# The emulator has no KVM and shares its cores.
PATIENCE = 900
CODE = r"first password: not set; code for another computer (\S+)"


class Suite:
    def __init__(self, architecture, folder):
        self.architecture = architecture
        self.folder = Path(folder)
        self.failed = 0
        self.checks = 0

    def check(self, name, is_right, remark=""):
        self.checks += 1
        self.failed += not is_right
        print(f"{'passed' if is_right else 'FAILED'} {name}{': ' if remark else ''}{remark}", flush=True)

    def stick(self, name, *bundles):
        """Image of a USB stick with updates; returns options of the emulator."""
        file = self.folder / f"{name}.stick"
        file.unlink(missing_ok=True)
        kib = 2048 + sum((self.folder / bundle).stat().st_size >> 10 for bundle in bundles) * 21 // 20
        subprocess.run(["tests/support/enter_root", "build/chroots/image-tools-trixie",
                        f"{self.folder.resolve()}=/work", "--", "sh", "-euc",
                        f"cd /work; mkfs.vfat -C {file.name} {kib} >/dev/null; "
                        + "; ".join(f"mcopy -i {file.name} {bundle} ::orbwatch-{bundle}" for bundle in bundles)],
                       check=True)
        return ["-device", "qemu-xhci", "-drive", f"if=none,id=stick,format=raw,readonly=on,file={file}",
                "-device", "usb-storage,drive=stick"]

    def machine(self, name, image="first.img", size=4 * GIB):
        return Machine(self.folder / name, self.architecture, self.folder / image, size)


def free_port():
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        return listener.getsockname()[1]


def print_seconds(console, first_picture):
    """Seconds from power to the first picture, by part."""
    marks = [("firmware", r"EFI stub|Loading, please wait|Linux version"),
             ("kernel and initramfs, to the verified root", r"orbwatch: slot"),
             ("system and service, to its first frame set", CODE)]
    before = 0.0
    for name, pattern in marks:
        found = console.find(pattern)
        if found:
            print(f"  {found[1] - before:7.1f} s {name}")
            before = found[1]
    print(f"  {first_picture - before:7.1f} s password and picture over HTTPS")
    print(f"  {first_picture:7.1f} s from power to the first picture", flush=True)


def picture(suite):
    """The first boot shows the code on the console, which opens the page; data outlasts a power cut."""
    with suite.machine("picture", "demo.img") as machine:
        port = free_port()
        console = machine.switch_on(port)
        found = console.wait_for(CODE, PATIENCE)
        suite.check("console_shows_the_code", True, found[2][0])
        page = Page(port)
        suite.check("stranger_sees_nothing", page.request("GET", "/snapshot.jpg?view=door")[0] in (401, 403))
        suite.check("code_sets_the_first_password", page.set_first_password(found[2][1], PASSWORD)[0] == 200)
        size = len(page.picture("door"))
        suite.check("picture_arrives", size > 1000, f"{size} bytes")
        print_seconds(console, console.second())
        status = page.status()["system"]
        suite.check("frame_sets_are_counted", status["frame_set"] > 0, str(status["frame_set"]))
        suite.check("data_partition_has_no_fault", not console.find("fault of the data partition"))
        machine.cut_power()
        sectors = partitions(machine.disk)["data"]["size"]
        suite.check("data_partition_grows", sectors * 512 > GIB, f"{sectors * 512 >> 20} MiB")
        blocks = DataPartition(machine.disk).figure("Block count")
        suite.check("file_system_grows", blocks * 4096 > GIB)

        console = machine.switch_on(port)
        console.wait_for("first password: set", PATIENCE)
        page = Page(port)
        suite.check("password_outlasts_a_power_cut", page.log_in(PASSWORD)[0] == 200)


def missing_data(suite):
    """Without a data partition and with a damaged one the device starts with its defaults and shows the fault."""
    with suite.machine("missing_data") as machine:
        subprocess.run(["sfdisk", "--quiet", "--delete", machine.disk, "5"], check=True)
        console = machine.switch_on()
        console.wait_for(CODE, PATIENCE)
        suite.check("missing_data_is_a_fault",
                    console.wait_for("fault of the data partition: .* has none", 60) is not None)
    with suite.machine("damaged_data") as machine:
        overwrite(machine.disk, "data", 128 << 20)
        console = machine.switch_on()
        console.wait_for(CODE, PATIENCE)
        suite.check("damaged_data_is_a_fault",
                    console.wait_for("fault of the data partition: .* e2fsck ended", 60) is not None)
        machine.cut_power()
        suite.check("damaged_data_stays_as_it_is",
                    begin_of(machine.disk, "data", 128 << 20) == b"\xa5" * (128 << 20))


def full_data(suite):
    """With a full data partition the device starts with what it has, shows the fault, and keeps recordings."""
    image = suite.folder / "first.img"
    recorded = suite.folder / "recording"
    recorded.write_bytes(random.Random(1).randbytes(1 << 20))
    recording = "/system/var/lib/orbwatch/recordings/kept"
    copy = suite.folder / "full_data" / "copy"
    # The partition has no room to grow.
    with suite.machine("full_data", size=image.stat().st_size) as machine:
        data = DataPartition(machine.disk)
        data.add("/recording", recorded)
        data.fill("/filler")
        console = machine.switch_on()
        console.wait_for(CODE, PATIENCE)
        suite.check("full_data_at_the_first_start_is_a_fault",
                    console.wait_for("fault of the data partition: no room for /etc/orbwatch", 60) is not None)
        machine.cut_power()
        suite.check("recording_stays", data.content("/recording", copy) == recorded.read_bytes())

        data.change("rm /filler")
        port = free_port()
        console = machine.switch_on(port)
        code = console.wait_for(CODE, PATIENCE)[2][1]
        suite.check("device_with_room_again_has_no_fault", not console.find("fault of the data partition"))
        suite.check("password_is_set", Page(port).set_first_password(code, PASSWORD)[0] == 200)
        machine.cut_power()

        data.add(recording, recorded)
        data.fill("/filler")
        console = machine.switch_on(port)
        console.wait_for("first password: set", PATIENCE)
        fault = console.wait_for("fault of the data partition: (.* is full, 0 MiB are free.*)", 60)
        suite.check("full_data_later_is_a_fault", True, fault[2][1])
        page = Page(port)
        suite.check("user_of_a_full_device_logs_in", page.log_in(PASSWORD)[0] == 200)
        suite.check("picture_of_a_full_device_arrives", len(page.picture("heat")) > 1000)
        machine.cut_power()
        suite.check("recordings_stay", data.content(recording, copy) == recorded.read_bytes())


def clock_1970(suite):
    """With a clock that begins in 1970 the device boots to a picture and reports that nothing has set its clock."""
    with suite.machine("clock_1970") as machine:
        port = free_port()
        console = machine.switch_on(port, more=["-rtc", "base=1970-01-01T00:00:00"])
        code = console.wait_for(CODE, PATIENCE)[2][1]
        clock = console.find("clock: (.*) UTC, not set by a time server yet")
        suite.check("console_says_that_the_clock_is_not_set", bool(clock), clock and clock[2][1])
        page = Page(port)
        suite.check("password_is_set", page.set_first_password(code, PASSWORD)[0] == 200)
        suite.check("picture_arrives", len(page.picture("heat")) > 1000)
        suite.check("status_says_that_the_clock_is_not_set",
                    page.status()["health"]["clock_synchronised"] == 0)


def erased_entries(suite):
    """A firmware that has lost its boot entries still boots, and gets them again."""
    with suite.machine("erased_entries") as machine:
        for start in ("first", "erased"):
            machine.erase_variables()
            console = machine.switch_on()
            console.wait_for(r"orbwatch 1\.0, slot a$", PATIENCE)
            suite.check(f"{start}_start", True)
            machine.cut_power()
            suite.check(f"{start}_start_makes_entries",
                        machine.has_variable_text("system0") and machine.has_variable_text("system1"))
        console = machine.switch_on()
        entry = console.wait_for(r'starting Boot[0-9A-F]{4} "(.*)" from', PATIENCE)
        console.wait_for(r"orbwatch 1\.0, slot a$", PATIENCE, entry[0])
        suite.check("entry_is_used", entry[2][1] == "system0", entry[2][1])


def damaged_slot(suite):
    """A new version whose root or kernel is damaged before its trial never runs: the version before boots."""
    stick = suite.stick("good", "good.raucb")
    with suite.machine("damaged_slot") as machine:
        console = machine.switch_on(more=stick)
        console.wait_for("version 2 is installed", PATIENCE)
        machine.cut_power()
        variables = shutil.copy(machine.variables, machine.folder / "variables-before-the-trial")
        for partition in ("root_b", "esp_b"):
            shutil.copy(variables, machine.variables)
            overwrite(machine.disk, partition, 8 << 20)
            console = machine.switch_on()
            found = console.wait_for(r"orbwatch (1\.0|2), slot [ab]", PATIENCE)
            suite.check(f"damaged_{partition}_never_runs", found[2][0] == "orbwatch 1.0, slot a", found[2].string)
            console.wait_for("version 2 was tried and not kept", 60, found[0])
            suite.check(f"damaged_{partition}_is_shown", True)
            machine.cut_power()


def refused(suite):
    """Updates that are truncated, older or signed by another key are refused in a sentence."""
    stick = suite.stick("refused", "truncated.raucb", "older.raucb", "other_key.raucb")
    with suite.machine("refused") as machine:
        console = machine.switch_on(more=stick)
        for name, reason in [("older", "its version, 0.9, is older than the running one, 1.0"),
                             ("other_key", "it is not signed by the key of this device"),
                             ("truncated", "it is incomplete or not an update")]:
            found = console.wait_for(rf"orbwatch-{name}\.raucb is refused: {reason}", PATIENCE)
            suite.check(f"{name}_is_refused", True, found[2].string)


def good_update(suite):
    """A good update is tried, kept after frame sets and interfaces have worked, and stays after a power cut."""
    stick = suite.stick("good", "good.raucb")
    with suite.machine("good_update") as machine:
        port = free_port()
        console = machine.switch_on(port, more=stick)
        code = console.wait_for(CODE, PATIENCE)[2][1]
        console.wait_for("version 2 is installed", PATIENCE)
        number = console.wait_for(r"orbwatch 2, slot b, on trial", PATIENCE)[0]
        suite.check("update_is_tried", True)
        console.wait_for("version 2 works and is kept", PATIENCE, number)
        suite.check("update_is_kept", True)
        suite.check("code_of_the_older_version_is_valid",
                    Page(port).set_first_password(code, PASSWORD)[0] == 200)
        machine.cut_power()
        console = machine.switch_on(port)
        console.wait_for(r"orbwatch 2, slot b$", PATIENCE)
        suite.check("update_stays_after_a_power_cut", True)
        console.wait_for("first password: set", PATIENCE)
        suite.check("password_stays", Page(port).log_in(PASSWORD)[0] == 200)


def broken_update(suite):
    """An update whose service never works returns to the version before, and is not tried again."""
    stick = suite.stick("broken", "broken.raucb")
    with suite.machine("broken_update") as machine:
        console = machine.switch_on(more=stick)
        number = console.wait_for("version 3 is installed", PATIENCE)[0]
        number = console.wait_for("orbwatch: slot b", PATIENCE, number)[0]
        suite.check("broken_update_is_tried", True)
        number = console.wait_for("version 3 does not work: restart", PATIENCE, number)[0]
        number = console.wait_for(r"orbwatch 1\.0, slot a$", PATIENCE, number)[0]
        suite.check("device_returns", True)
        console.wait_for("version 3 was tried and not kept", 60, number)
        console.wait_for("is refused: this device has tried version 3", PATIENCE, number)
        suite.check("broken_update_is_not_tried_again", True)


def power_cuts(suite):
    """Power cuts at random moments of the installation and the next start: the old or the good version boots."""
    stick = suite.stick("good", "good.raucb")
    cuts = int(os.environ.get("ORBWATCH_CUTS", "10"))
    for cut in range(cuts):
        moments = random.Random(cut)
        with suite.machine("power_cuts") as machine:
            console = machine.switch_on(more=stick)
            number = console.wait_for("USB stick: checks", PATIENCE)[0]
            if cut % 2:
                number = console.wait_for("version 2 is installed", PATIENCE, number)[0]
            seconds = moments.uniform(0, 60)
            machine.run_for(seconds)
            last = console.lines[-1][1]
            machine.cut_power()
            console = machine.switch_on()
            found = console.wait_for(r"orbwatch (1\.0|2), slot [ab]", PATIENCE)
            suite.check(f"boots_after_cut_{cut}", True,
                        f"{seconds:.1f} s after \"{'installed' if cut % 2 else 'begin'}\" ({last}): {found[2][0]}")


# The cases and the files that they take.
CASES = {
    picture: ["demo.img"],
    missing_data: ["first.img"],
    full_data: ["first.img"],
    clock_1970: ["first.img"],
    erased_entries: ["first.img"],
    refused: ["first.img", "truncated.raucb", "older.raucb", "other_key.raucb"],
    good_update: ["first.img", "good.raucb"],
    broken_update: ["first.img", "broken.raucb"],
    damaged_slot: ["first.img", "good.raucb"],
    power_cuts: ["first.img", "good.raucb"],
}


def chosen(names):
    """The named cases, or all. SystemExit: there is no such case."""
    by_name = {case.__name__: case for case in CASES}
    for name in names:
        if name not in by_name:
            print(f"run: no case {name}; see --list", file=sys.stderr)
            sys.exit(2)
    return [by_name[name] for name in names] or list(CASES)


def run(suite, case):
    print(f"--- {case.__name__}", flush=True)
    try:
        case(suite)
    except Exception:  # a case that cannot continue has failed
        suite.check(case.__name__, False, "\n" + traceback.format_exc())


def main(arguments):
    if arguments == ["--list"]:
        print(*[f"{case.__name__}: {case.__doc__}" for case in CASES], sep="\n")
        return 0
    if arguments[:1] == ["--needed"]:
        print(*sorted({file for case in chosen(arguments[1:]) for file in CASES[case]}), sep="\n")
        return 0
    architecture, folder, *names = arguments
    suite = Suite(architecture, folder)
    for case in chosen(names):
        run(suite, case)
    print(f"{suite.checks - suite.failed} passed, {suite.failed} failed")
    return 1 if suite.failed or not suite.checks else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
