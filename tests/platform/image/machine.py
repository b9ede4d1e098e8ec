# SPDX-License-Identifier: Apache-2.0
"""Emulated computer with UEFI firmware that boots the image of a disk."""

import functools
import os
import platform
import re
import shutil
import subprocess
import tempfile
import threading
import time
from pathlib import Path

EMULATORS = {
    "amd64": (["qemu-system-x86_64", "-M", "q35", "-cpu", "Nehalem"],
              "/usr/share/OVMF/OVMF_CODE_4M.fd", "/usr/share/OVMF/OVMF_VARS_4M.fd"),
    "arm64": (["qemu-system-aarch64", "-M", "virt", "-cpu", "cortex-a72"],
              "/usr/share/AAVMF/AAVMF_CODE.fd", "/usr/share/AAVMF/AAVMF_VARS.fd"),
}
TCG = "tcg,thread=multi"
ESCAPES = re.compile(r"\x1b\[[0-9;?]*[A-Za-z]|\x1b[()][A-Z0-9]|[\r\x00]")


class Console:
    """Lines of the serial console with the seconds since the power was switched on, also in a log."""

    def __init__(self, log):
        self.log = log
        self.lines = []
        self.changed = threading.Condition()
        self.begin = time.monotonic()
        self.is_open = True

    def second(self):
        return time.monotonic() - self.begin

    def read(self, stream):
        with open(self.log, "a", encoding="utf-8") as log:
            for raw in stream:
                text = ESCAPES.sub("", raw.decode("utf-8", "replace")).rstrip("\n")
                second = self.second()
                log.write(f"{second:7.1f} {text}\n")
                log.flush()
                with self.changed:
                    self.lines.append((second, text))
                    self.changed.notify_all()
        with self.changed:
            self.is_open = False
            self.changed.notify_all()

    def find(self, pattern, since=0):
        """Returns number, second and match of the first such line from line `since` on, or None."""
        for number, (second, text) in enumerate(self.lines[since:], since):
            match = re.search(pattern, text)
            if match:
                return number, second, match
        return None

    def wait_for(self, pattern, deadline, since=0):
        """Waits for such a line. TimeoutError: none within `deadline` seconds, or the computer is off."""
        with self.changed:
            self.changed.wait_for(lambda: self.find(pattern, since) or not self.is_open, deadline)
            found = self.find(pattern, since)
        if not found:
            raise TimeoutError(f"no line \"{pattern}\" on the console, {self.log}")
        return found


@functools.cache
def accelerator(architecture):
    """KVM if this computer's KVM runs the firmware, which is not so in every virtual machine, else TCG."""
    command, firmware, _ = EMULATORS[architecture]
    if not command[0].endswith(platform.machine()) or not os.access("/dev/kvm", os.R_OK | os.W_OK):
        return TCG
    with tempfile.TemporaryDirectory() as folder:
        console = Console(Path(folder) / "console")
        process = subprocess.Popen(
            [*command, "-accel", "kvm", "-m", "256", "-nodefaults", "-display", "none", "-serial", "stdio",
             "-drive", f"if=pflash,format=raw,readonly=on,file={firmware}"],
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        threading.Thread(target=console.read, args=(process.stdout,), daemon=True).start()
        try:
            found = console.wait_for(r"BdsDxe|UEFI|KVM internal error", 60)[2][0]
        except TimeoutError:
            found = ""
        process.kill()
        process.wait()
    return "kvm" if found in ("BdsDxe", "UEFI") else TCG


class Machine:
    """Computer with a disk of its own, made from an image, in a folder; it has power within `with`."""

    def __init__(self, folder, architecture, image, disk_bytes):
        self.folder = Path(folder)
        self.folder.mkdir(parents=True, exist_ok=True)
        self.architecture = architecture
        self.command, self.firmware, self.no_variables = EMULATORS[architecture]
        self.disk = self.folder / "disk"
        self.variables = self.folder / "variables"
        subprocess.run(["cp", "--sparse=always", "--reflink=auto", image, self.disk], check=True)
        with open(self.disk, "r+b") as disk:
            disk.truncate(disk_bytes)
        self.erase_variables()
        (self.folder / "console").unlink(missing_ok=True)
        self.process = None
        self.console = None

    def erase_variables(self):
        """Leaves the firmware without boot entries, like a new one."""
        shutil.copy(self.no_variables, self.variables)

    def has_variable_text(self, text):
        """True: a variable of the firmware, such as a boot entry, contains the text."""
        return text.encode("utf-16-le") in self.variables.read_bytes()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.cut_power()

    def switch_on(self, port=None, more=()):
        """Port: TCP port of this computer that leads to the page's HTTPS."""
        network = "user,id=network,restrict=on"
        if port:
            network += f",hostfwd=tcp:127.0.0.1:{port}-:8443"
        self.console = Console(self.folder / "console")
        self.process = subprocess.Popen(
            [*self.command, "-accel", accelerator(self.architecture), "-smp", "2", "-m", "1024",
             "-nodefaults", "-display", "none", "-serial", "stdio", "-device", "virtio-rng-pci",
             "-drive", f"if=pflash,format=raw,readonly=on,file={self.firmware}",
             "-drive", f"if=pflash,format=raw,file={self.variables}",
             "-drive", f"if=none,id=disk,format=raw,file={self.disk}",
             "-device", "virtio-blk-pci,drive=disk",
             "-netdev", network, "-device", "virtio-net-pci,netdev=network",
             *more],
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        threading.Thread(target=self.console.read, args=(self.process.stdout,), daemon=True).start()
        return self.console

    def run_for(self, seconds):
        """Lets it run, until a moment that depends on nothing that happens in it."""
        try:
            self.process.wait(seconds)
        except subprocess.TimeoutExpired:
            pass

    def cut_power(self):
        if self.process:
            self.process.kill()
            self.process.wait()
            self.process = None
