#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""report.py FOLDER: makes remap.md and remap.json from the measurements of tests/bench/run.

Reads instructions.txt (instruction_gates.py), peer.txt (lines: view/format instructions), bytes.txt
(lines: program view/format bytes), times.json (Google Benchmark's) and cycles.json
(model_cycles.py's) in FOLDER. Fails when a required figure is missed.
"""

import datetime
import json
import operator
import os
import pathlib
import platform
import statistics
import subprocess
import sys

import instruction_gates
from instruction_gates import FLAT

FLAT_PIXELS = 1920 * 1080
# Clocks of the processors for which a frame set is modelled, GHz, and the kernel's layouts whose loops
# have the modelled instructions per cycle: those that sample NV12 and 16 bit pictures.
CLOCKS = {"Cortex-A72": 1.8, "Cortex-A76": 2.4}
LAYOUTS = ("One8", "Two8", "One16")
# Merged views that OpenCV makes, too, and the least ratio of its time to ours, which the fastest kernel
# of a machine must reach, and the aim; those for AVX2 apply where it is the fastest one.
MERGED_WITH_PEER = ("nv12_y16", "rgb_y16", "grey_y16")
MERGED_LIMITS = (4, 5.5)
MERGED_LIMITS_AVX2 = (3.5, 4)
KERNELS = ("scalar", "neon", "avx2", "avx512")


class Measured:
    """Output of the programs, by name; a missing figure is None."""

    def __init__(self, folder):
        self.ours = instruction_gates.read(folder)
        self.instructions = {("count_ours", *case.split("/")): count
                             for (group, case), count in self.ours.items() if group == "remap"}
        self.peer_merged = {}
        for line in (folder / "peer.txt").read_text().splitlines():
            case, instructions = line.split()
            view, layout = case.split("/")
            if view == "merged":
                self.peer_merged[layout] = int(instructions) / FLAT_PIXELS
            else:
                self.instructions["count_opencv", view, layout] = int(instructions) / FLAT_PIXELS
        self.bytes = {}
        for line in (folder / "bytes.txt").read_text().splitlines():
            program, case, touched = line.split()
            self.bytes[program, *case.split("/")] = int(touched) / FLAT_PIXELS
        times = json.loads((folder / "times.json").read_text())
        self.runs = {run.get("label", run["name"]): run
                     for run in times["benchmarks"]}
        failed = [f"{name}: {run['error_message']}" for name, run in self.runs.items()
                  if run.get("error_occurred")]
        if failed:
            sys.exit("report: " + "; ".join(failed))
        self.kernels = [kernel for kernel in KERNELS
                        if any(f"{kernel}_ms" in run for run in self.runs.values())]
        self.cycles = json.loads((folder / "cycles.json").read_text())

    def mean_instructions(self, program, layout):
        counts = [self.instructions.get((program, view, layout)) for view in FLAT]
        return None if None in counts else statistics.mean(counts)

    def most_bytes(self, program, layout=None):
        """Most bytes per pixel, beyond source and view, of any flat view; by default of any format."""
        return max((touched for (who, _, what), touched in self.bytes.items()
                    if who == program and layout in (None, what)), default=None)

    def fewer_instructions(self, layout):
        ours = self.mean_instructions("count_ours", layout)
        peer = self.mean_instructions("count_opencv", layout)
        return peer / ours if ours and peer else None

    def fewer_merging(self, view):
        """The same for a merged view."""
        ours, peer = self.ours.get(("merged", view)), self.peer_merged.get(view)
        return peer / ours if ours and peer else None

    def two_byte_instructions(self, program):
        """Instructions per pixel of the U V plane, which has one for four luminance pixels of NV12."""
        both, one = (self.mean_instructions(program, layout) for layout in ("nv12", "grey"))
        return 4 * (both - one) if both and one else None

    def counter(self, run, name):
        return self.runs.get(run, {}).get(name)

    def worst(self, run, what):
        """The largest of all kernels' errors in that run."""
        errors = [self.counter(run, f"{kernel}_{what}") for kernel in self.kernels]
        return None if None in errors or not errors else max(errors)

    def worst_ratio(self, layout, name):
        values = [self.counter(f"{view}/{layout}/3000", name) for view in FLAT]
        return None if None in values else min(values)

    def worst_ratio_of_all(self, name):
        return min((run[name] for run in self.runs.values() if name in run), default=None)

    def instructions_per_cycle(self, processor):
        """Mean over the modelled loops of LAYOUTS together."""
        loops = [entry for entry in self.cycles if entry["cpu"] == processor
                 and any(f"<{layout}," in entry["loop"] for layout in LAYOUTS)]
        return (sum(entry["instructions"] for entry in loops)
                / sum(entry["cycles"] for entry in loops))

    def repointing(self, name):
        runs = [run for key, run in self.runs.items() if key.startswith("build_grid/far_away/")]
        return max(run[name] for run in runs) if runs else None

    def largest_change_with_source(self):
        """Largest change of a ratio, in per cent, from the 3000x3000 source to the larger one."""
        changes = []
        for key, large in self.runs.items():
            if not key.endswith("/4096"):
                continue
            small = self.runs[key.removesuffix("4096") + "3000"]
            changes += [abs(large[name] / small[name] - 1) * 100 for name in small
                        if "_vs_" in name and name.split("_")[0] != "scalar"]
        return max(changes) if changes else None


def gates(measured):
    """(figure, value, comparison, at least, aim, depends on this machine's speed). Without figures
    for kernels that this machine cannot run."""
    at_most, at_least = operator.le, operator.ge
    rows = []
    for figure, value, most, aim in instruction_gates.rows(measured.ours):
        rows.append((figure, value, at_most, most, aim, False))
    for layout, aim in (("grey", 6.5), ("nv12", 6.4), ("bgr", 6.1), ("y16", 5.8)):
        rows.append((f"aarch64 instructions, OpenCV / ours, {layout}", measured.fewer_instructions(layout),
                     at_least, None, aim, False))
    for view in MERGED_WITH_PEER:
        rows.append((f"aarch64 instructions, OpenCV / ours, merged view {view}",
                     measured.fewer_merging(view), at_least, *MERGED_LIMITS, False))
        for kernel, label, (least, aim) in (("avx512", "AVX-512", MERGED_LIMITS),
                                            ("avx2", "AVX2", MERGED_LIMITS_AVX2)):
            if kernel in measured.kernels:
                rows.append((f"OpenCV / ours, merged view {view}, {label}",
                             measured.counter(f"merged/{view}", f"{kernel}_vs_opencv_merge"),
                             at_least, least if kernel == measured.kernels[-1] else None, aim,
                             True))
    for label, run, kernel, limits in (
            ("flat grey, AVX-512", "grey", "avx512", (3.5, 6, 2.3, 3.5)),
            ("flat grey, AVX2", "grey", "avx2", (3.4, 4.5, 1.8, 2.5)),
            ("flat NV12, AVX-512", "nv12", "avx512", (3.4, 5, 2.6, 3))):
        if kernel not in measured.kernels:
            continue
        rows.append((f"cv::remap / ours, {label}, worst",
                     measured.worst_ratio(run, f"{kernel}_vs_opencv"), at_least, *limits[:2],
                     True))
        rows.append((f"v360 / ours, {label}, worst",
                     measured.worst_ratio(run, f"{kernel}_vs_v360"), at_least, *limits[2:],
                     True))
    if "avx512" in measured.kernels:
        for peer, name, least, aim in (("cv::remap", "opencv", 3, 4), ("v360", "v360", 1.7, 2.5)):
            rows.append((f"{peer} / ours, equirect 3840x1920 grey, AVX-512",
                         measured.counter("equirect/grey/3000", f"avx512_vs_{name}"), at_least,
                         least, aim, True))
    for kernel, label, least, aim in (("avx512", "AVX-512", None, 3), ("avx2", "AVX2", 2.5, 3)):
        if kernel in measured.kernels:
            rows.append((f"cv::remap / ours, {label}, worst of all views, formats and sources",
                         measured.worst_ratio_of_all(f"{kernel}_vs_opencv"), at_least,
                         least if kernel == measured.kernels[-1] else None, aim,
                         True))
    rows.append(("re-pointing a 1080p view, ms, worst", measured.repointing("cpu_time"), at_most,
                 0.5, 0.25, True))
    grid = measured.repointing("bytes")
    rows.append(("grid of a 1080p view, KB, worst", grid and grid / 1000, at_most, 100, 80, False))
    rows.append(("ratios with a source of 4096x4096, change in per cent, worst",
                 measured.largest_change_with_source(), at_most, None, 15, True))
    rows.append(("bytes touched per pixel beyond source and view, any format, worst",
                 measured.most_bytes("count_ours"), at_most, 0.1, None, False))
    for what, least, aim in (("rms", 1.1, 1.0), ("max", 6, 5)):
        errors = [measured.worst(f"{view}/grey/3000", what) for view in FLAT]
        rows.append((f"error on white noise, {what} of 255, flat grey, worst",
                     None if None in errors else max(errors), at_most, least, aim, False))
    return rows


def verdict(value, comparison, least, aim, is_judged):
    if value is None:
        return "-" if least is None else "NOT MEASURED"
    if aim is not None and comparison(value, aim):
        return "aim reached"
    if least is None:
        return "short of the aim" if aim is not None else ""
    if comparison(value, least):
        return "reached"
    return "MISSED" if is_judged else "missed, not judged here"


def text(value):
    if value is None:
        return "-"
    return f"{value:.3g}" if abs(value) < 100 else f"{value:.0f}"


def table(head, rows):
    lines = [head, ["---"] + ["---:"] * (len(head) - 1), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines) + "\n"


def instruction_table(measured):
    rows = []
    for layout in ("grey", "nv12", "bgr", "y16", "yuyv"):
        for program in ("count_ours", "count_opencv"):
            values = [measured.instructions.get((program, view, layout)) for view in FLAT]
            if values[0] is not None:
                rows.append([layout, program.removeprefix("count_"), *map(text, values),
                             text(measured.mean_instructions(program, layout)),
                             text(measured.most_bytes(program, layout))])
    for program in ("count_ours", "count_opencv"):
        rows.append(["2 x 8 bit, from nv12 - grey", program.removeprefix("count_"), "", "", "",
                     text(measured.two_byte_instructions(program)), ""])
    return table(["format", "", "o0", "o1", "o2", "mean", "bytes touched"], rows)


def time_table(measured):
    rows = []
    for key, run in measured.runs.items():
        if "opencv_ms" not in run:
            continue
        row = [key, text(run["opencv_ms"]), text(run["v360_ms"])]
        for kernel in measured.kernels:
            row.append("{} ({}, {})".format(*(text(run[f"{kernel}_{what}"]) for what in
                                              ("ms", "vs_opencv", "vs_v360"))))
        rows.append([*row, *(f"{text(run['opencv_' + what])}, {text(measured.worst(key, what))}"
                             for what in ("rms", "max"))])
    return table(["view/format/source", "cv::remap", "v360", *measured.kernels, "rms: cv, ours",
                  "max: cv, ours"], rows)


def merged_table(measured):
    rows = []
    for view in MERGED_WITH_PEER:
        run = measured.runs.get(f"merged/{view}")
        if not run:
            continue
        rows.append([view, text(measured.ours.get(("merged", view))),
                     text(measured.peer_merged.get(view)), text(run["opencv_merge_ms"]),
                     *("{} ({})".format(text(run[f"{kernel}_ms"]),
                                        text(run[f"{kernel}_vs_opencv_merge"]))
                       for kernel in measured.kernels), text(run["difference_rms"])])
    return table(["view", "instructions: ours", "OpenCV", "ms: OpenCV", *measured.kernels,
                  "difference, rms"], rows)


def repointing_table(measured):
    return table(["", "ms", "KB"],
                 [[key, text(run["cpu_time"]), text(run["bytes"] / 1000)]
                  for key, run in measured.runs.items() if "bytes" in run])


def stage_table(measured):
    """The reference machine's stages, and their times if every cycle has the modelled number of
    instructions."""
    rates = [1e9 * CLOCKS[processor] * measured.instructions_per_cycle(processor)
             for processor in CLOCKS]
    def stages(readers):
        return [*instruction_gates.stages(measured.ours, readers),
                ("until_the_status", instruction_gates.answer(measured.ours, readers)),
                ("frame_set", measured.ours.get((f"reference_{readers}", "frame_set")))]
    as_jpeg = dict(stages("jpeg"))
    return table(["stage", "million instructions, read as RGB", "as JPEG",
                  *(f"modelled ms as RGB, {processor}" for processor in CLOCKS)],
                 [[stage.replace("_", " "), text(count), text(as_jpeg.get(stage)),
                   *(text(count * 1e6 / rate * 1e3) for rate in rates)]
                  for stage, count in stages("rgb") if count is not None])


def clocks(measured):
    """Text such as "Cortex-A72 at 1.8 GHz with 2.0 instructions per cycle"."""
    return ", ".join(f"{processor} at {clock} GHz with "
                     f"{measured.instructions_per_cycle(processor):.2f} instructions per cycle"
                     for processor, clock in CLOCKS.items())


def cycle_table(measured):
    rows = [[entry["loop"], entry["cpu"], text(entry["cycles"]), text(entry["per_pixel"])]
            for entry in measured.cycles]
    return table(["loop", "processor", "cycles per turn", "per pixel"], rows)


def machine():
    compiler = subprocess.run(["g++", "--version"], capture_output=True, text=True, check=True)
    model = platform.machine()
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            model = line.split(":", 1)[1].strip()
            break
    return {"date": datetime.date.today().isoformat(), "machine": model,
            "compiler": compiler.stdout.splitlines()[0]}


def main(folder):
    measured = Measured(folder)
    where = machine()
    judged = []
    for figure, value, comparison, least, aim, is_speed in gates(measured):
        is_judged = not (is_speed and os.environ.get("CI"))
        judged.append({"figure": figure, "value": value, "at_least": least, "aim": aim,
                       "verdict": verdict(value, comparison, least, aim, is_judged)})
    markdown = f"""# The remap core beside its peers

{where['date']}, {where['machine']}, {where['compiler']}. Written by tests/bench/run.

{table(['figure', 'measured', 'at least', 'aim', ''],
       [[row['figure'], text(row['value']), text(row['at_least']), text(row['aim']),
         row['verdict']] for row in judged])}
## Instructions per output pixel, aarch64, flat 1080p

And the bytes per pixel that a remap touches beyond source and view, worst of the three views.

{instruction_table(measured)}
## A frame set of the reference machine, aarch64

Counted; milliseconds are modelled, not measured: {clocks(measured)}, those of the
inner loops {', '.join(LAYOUTS)} below. Other code may have fewer, and misses of the caches add to it.

{stage_table(measured)}
## Thread CPU time in ms, one thread, medians of paired repetitions

In brackets how many times slower cv::remap and v360 are. Where a view is smaller than its source
they alias and ours do not. Errors are those of the first plane elsewhere, in 255ths, against double.

{time_table(measured)}
## Merged views of 1920x1080, two cameras mixed, the thermal one measured

aarch64 instructions per pixel; thread CPU time, and in brackets how many times slower OpenCV is.
The difference is that of the pictures, in 255ths.

{merged_table(measured)}
## Re-pointing a 1080p view

{repointing_table(measured)}
## Modelled cycles

By llvm-mca, not measured: the kernels' inner loops without cache misses and without what is done
once per tile. fill_rows<Layout, blocks in a row>; the A76 as Neoverse N1, the same core.

{cycle_table(measured)}"""
    (folder / "remap.md").write_text(markdown)
    result = {**where, "gates": judged, "cycles": measured.cycles,
              "reference_machine": dict(instruction_gates.stages(measured.ours)),
              "counts": [{"program": program, "view": view, "format": layout, "per_pixel": count,
                                "bytes_touched": measured.bytes[program, view, layout]}
                               for (program, view, layout), count in measured.instructions.items()],
              "runs": list(measured.runs.values())}
    (folder / "remap.json").write_text(json.dumps(result, indent=1) + "\n")
    print(markdown)
    missed = [row for row in judged if row["verdict"] in ("MISSED", "NOT MEASURED")]
    for row in missed:
        print(f"report: {row['verdict']}: {row['figure']}", file=sys.stderr)
    return 1 if missed else 0


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(main(pathlib.Path(sys.argv[1])))
