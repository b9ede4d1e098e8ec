#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""model_cycles.py BUILD_FOLDER: models the cycles of the NEON kernels' inner loops with llvm-mca.

Compiles kernel/neon.cpp to assembler like BUILD_FOLDER for aarch64, finds the innermost loops
with table look-ups and prints a JSON list of cycles per iteration on Cortex-A72 and A76. The model
assumes that every load hits the first cache. LLVM describes the A76 only as Neoverse N1, the same
core for servers.
"""

import json
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

LLVM_MCA = "llvm-mca-19"
PROCESSORS = {"Cortex-A72": "cortex-a72", "Cortex-A76": "neoverse-n1"}
BLOCK_PIXELS = 16


def output_of(command, text=None):
    return subprocess.run(command, input=text, stdout=subprocess.PIPE, text=True, check=True).stdout


def assembler(build):
    entries = json.loads((build / "compile_commands.json").read_text())
    entry = next(e for e in entries if e["file"].endswith("proc/remap/kernel/neon.cpp"))
    command = shlex.split(entry["command"])
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "neon.s"
        command[command.index("-o") + 1] = str(out)
        command[command.index("-c")] = "-S"
        subprocess.run(command, cwd=entry["directory"], check=True)
        return out.read_text().splitlines()


def functions(lines):
    """Yields each function's name and lines."""
    name, body = None, []
    for line in lines:
        start = re.match(r"(\w+):", line)
        if start and not line.startswith(".L"):
            name, body = start[1], []
        elif re.match(r"\s*\.size\s", line):
            if name:
                yield name, body
            name = None
        elif name:
            body.append(line)


def inner_loops(body):
    """The shortest loops, from a label to a branch back to it, that look up in tables."""
    labels, loops = {}, []
    for index, line in enumerate(body):
        if label := re.match(r"(\.L\w+):", line):
            labels[label[1]] = index
        elif branch := re.match(r"\s+(?:b\.?\w*|cbn?z|tbn?z)\s.*?(\.L\w+)$", line):
            start = labels.get(branch[1])
            if start is not None:
                loops.append((start, index))
    with_tables = [(start, end) for start, end in loops
                   if any(re.match(r"\s+tb[lx]\s", line) for line in body[start:end])]
    return [body[start:end + 1] for start, end in with_tables
            if not any(start <= a and b <= end and (a, b) != (start, end)
                       for a, b in with_tables)]


def modelled(loop, processor, turns=200):
    """Cycles and instructions per iteration."""
    # GCC writes bytes of movi with their sign, which LLVM does not parse.
    instructions = [re.sub(r"0xf{14}(\w\w)$", r"0x\1", line) for line in loop
                    if re.match(r"\s+[a-z]", line)]
    report = json.loads(output_of(
        [LLVM_MCA, "--json", "-mtriple=aarch64", f"-mcpu={processor}", f"-iterations={turns}"],
        "\n".join(instructions) + "\n"))
    return (report["CodeRegions"][0]["SummaryView"]["TotalCycles"] / turns, len(instructions))


def layouts():
    """The names of remap::Layout."""
    header = pathlib.Path("proc/remap/kernel/layout.h").read_text()
    members = re.search(r"enum class Layout\b.*?\{(.*?)\};", header, re.DOTALL)[1]
    return re.findall(r"^\s*(\w+),", members, re.MULTILINE)


def readable(name):
    """The function's last name and template arguments."""
    name = output_of(["c++filt", name]).strip().split("(orbwatch::remap::TileJob")[0]
    name = re.sub(r"orbwatch::remap::(\(anonymous namespace\)::)?", "", name)
    name = re.sub(r"\(Layout\)(\d)", lambda number: layouts()[int(number[1])], name)
    return name.removeprefix("void ")


def blocks_per_turn(name):
    """The kernels process a row of blocks per iteration; their last template argument is its length.
    None for another function that looks up in tables."""
    count = re.search(r", (\d+)>$", name)
    return int(count[1]) if count else None


def main(build):
    found = []
    for name, body in functions(assembler(build)):
        for loop in inner_loops(body):
            shown = readable(name)
            blocks = blocks_per_turn(shown)
            if blocks is None:
                continue
            pixels = BLOCK_PIXELS * blocks
            for label, processor in PROCESSORS.items():
                cycles, instructions = modelled(loop, processor)
                found.append({"loop": shown, "cpu": label, "cycles": cycles,
                              "instructions": instructions, "per_pixel": cycles / pixels})
    if not found:
        sys.exit("model_cycles: no loop through blocks in kernel/neon.cpp")
    print(json.dumps(sorted(found, key=lambda entry: (entry["loop"], entry["cpu"])), indent=1))


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]))
