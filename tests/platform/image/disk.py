# SPDX-License-Identifier: Apache-2.0
"""Contents of an emulated computer's disk, read and damaged while it is off, without mounts."""

import json
import subprocess


def partitions(disk):
    """Partitions of a disk by name: first sector and number of sectors."""
    table = json.loads(subprocess.run(["sfdisk", "--json", disk], check=True, capture_output=True).stdout)
    return {part["name"]: part for part in table["partitiontable"]["partitions"]}


def overwrite(disk, partition, size):
    """Overwrites the first bytes of a partition with a pattern."""
    with open(disk, "r+b") as file:
        file.seek(partitions(disk)[partition]["start"] * 512)
        file.write(b"\xa5" * size)


def begin_of(disk, partition, size):
    """The first bytes of a partition."""
    with open(disk, "rb") as file:
        file.seek(partitions(disk)[partition]["start"] * 512)
        return file.read(size)


class DataPartition:
    """File system of the data partition."""

    def __init__(self, disk):
        self.place = f"{disk}?offset={partitions(disk)['data']['start'] * 512}"

    def figure(self, name):
        """A number of the file system's head, such as "Block count"."""
        text = subprocess.run(["dumpe2fs", "-h", self.place], check=True, capture_output=True, text=True).stdout
        return int(next(line.split()[-1] for line in text.splitlines() if line.startswith(f"{name}:")))

    def repair(self):
        """Replays its journal, which a power cut leaves behind."""
        subprocess.run(["e2fsck", "-p", self.place], check=False, capture_output=True)

    def change(self, *commands):
        """Runs commands of debugfs and returns their output."""
        self.repair()
        return subprocess.run(["debugfs", "-w", "-f", "-", self.place], check=True, capture_output=True, text=True,
                              input="\n".join(commands) + "\n").stdout

    def add(self, path, source):
        """Adds a file; its folders are made."""
        folders = path.split("/")[1:-1]
        self.change(*[f"mkdir /{'/'.join(folders[:depth + 1])}" for depth in range(len(folders))],
                    f"write {source} {path}")

    def content(self, path, target):
        """Bytes of a file, which is copied to `target` for that."""
        self.change(f"dump {path} {target}")
        return target.read_bytes()

    def fill(self, path):
        """Gives all free blocks to a new file, also those that only root may use."""
        self.change(f"write /dev/null {path}")
        end = 0
        # One call for all of them fails when they are not contiguous.
        for blocks in (256, 1):
            pieces = self.figure("Free blocks") // blocks
            self.change(*[f"fallocate {path} {begin} {begin + blocks - 1}"
                          for begin in range(end, end + pieces * blocks, blocks)])
            end += pieces * blocks
        free = self.figure("Free blocks")
        if free:
            raise ValueError(f"{free} blocks of {self.place} remain free")
