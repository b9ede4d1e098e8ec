#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""instruction_gates.py FOLDER: checks the instruction counts of tests/bench/instructions.

Reads instructions.txt in FOLDER (lines: group, case, instructions, and pixels that share them; the
same on every machine). Prints a table and fails when a required figure is missed.
"""

import pathlib
import statistics
import sys

FLAT = ("flat_o0", "flat_o1", "flat_o2")

# Limit and aim for the three flat views together, by format.
REMAP = {"grey": (5.8, 5.0), "nv12": (8.5, 7.5), "bgr": (14.5, 13), "y16": (10.7, 10)}
MERGED = {"nv12": (13, 11.5), "yuyv": (15, 14), "rgb": (12.5, 11.3), "nv12_y16": (29, 28),
          "rgb_y16": (29, 28), "grey_y16": (25, 24), "panorama": (46, 44),
          "panorama_grey": (37, 35), "nv12_measured": (20.5, 18.5), "rgb_measured": (29, 26)}
# Millions in a frame set of the reference machine by what its views are read as, without JPEG's
# compression and network.
FRAME_SET = {"rgb": (109, 105), "jpeg": (105.5, 100)}
# Of these, from the last frame to registers, alarms and lines out, while all views are read.
ANSWER = (30, 25)
ANSWER_STAGES = ("commands", "measured_halving", "measured_plane", "measurement", "status")
# Per pixel of the reference machine's panorama of 1024x512, read as RGB.
SMALL_PANORAMA = (70, 55)
SMALL_PANORAMA_PIXELS = 1024 * 512
# Limit and aim per sample of the plane that is sharpened.
SHARPENING = {"nv12": (3, 2.6), "yuyv": (3, 2.6), "rgb": (3, 2.6)}
# Limit and aim per pixel of the region.
SIGNALS = {"cold_8": (4, 0.6), "cold_16": (4, 0.8), "noisy_8": (12, 10.5), "noisy_16": (12, 11)}


def read(folder):
    """Instructions per pixel, for the reference machine in millions, by group and case."""
    counts = {}
    for line in (folder / "instructions.txt").read_text().splitlines():
        group, case, instructions, pixels = line.split()
        counts[group, case] = int(instructions) / int(pixels)
    return counts


def mean_remap(counts, layout):
    """Mean of the flat views; None when one is missing."""
    values = [counts.get(("remap", f"{view}/{layout}")) for view in FLAT]
    return None if None in values else statistics.mean(values)


def answer(counts, readers="rgb"):
    """Millions until the status is out; None when a stage is missing."""
    of_stages = [counts.get((f"reference_{readers}", stage)) for stage in ANSWER_STAGES]
    return None if None in of_stages else sum(of_stages)


def rows(counts):
    """Rows of the table: (figure, instructions, at most, aim)."""
    found = [(f"aarch64 instructions per pixel, {layout}", mean_remap(counts, layout), *limits)
             for layout, limits in REMAP.items()]
    found += [(f"aarch64 instructions per pixel, merged view {view}", counts.get(("merged", view)),
               *limits) for view, limits in MERGED.items()]
    found += [(f"aarch64 instructions per pixel, region {case}", counts.get(("signals", case)),
               *limits) for case, limits in SIGNALS.items()]
    found += [(f"aarch64 instructions per sample that is sharpened, {layout}",
               counts.get(("sharpening", layout)), *limits)
              for layout, limits in SHARPENING.items()]
    found += [(f"aarch64 million instructions per frame set, reference machine read as {readers}",
               counts.get((f"reference_{readers}", "frame_set")), *limits)
              for readers, limits in FRAME_SET.items()]
    found.append(("aarch64 million instructions from the last frame to the status, reference machine",
                  answer(counts), *ANSWER))
    panorama = counts.get(("reference_rgb", "panorama"))
    found.append(("aarch64 instructions per pixel, panorama of the reference machine",
                  panorama and panorama * 1e6 / SMALL_PANORAMA_PIXELS, *SMALL_PANORAMA))
    return found


def stages(counts, readers="rgb"):
    """Pairs (stage, million instructions) of the reference machine's frame set that is read as RGB
    or as JPEG, the largest first."""
    found = [(case, count) for (group, case), count in counts.items()
             if group == f"reference_{readers}" and case != "frame_set"]
    return sorted(found, key=lambda stage: -stage[1])


def main(folder):
    missed = []
    counts = read(folder)
    for figure, value, most, aim in rows(counts):
        shown = "NOT MEASURED" if value is None else f"{value:.2f}"
        print(f"{figure}: {shown}, at most {most}, aim {aim}")
        if value is None or value > most:
            missed.append(figure)
    for stage, count in stages(counts):
        print(f"of the frame set, {stage.replace('_', ' ')}: {count:.2f} million")
    for figure in missed:
        print(f"instruction_gates: MISSED: {figure}", file=sys.stderr)
    return 1 if missed else 0


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(main(pathlib.Path(sys.argv[1])))
