# SPDX-License-Identifier: Apache-2.0
"""Measures the latency from exposure to canvas, in headless Chromium: see README.md of tests/bench."""

import argparse
import os
import pathlib
import sys
import urllib.request

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "web"))
from browser import Browser  # noqa: E402
from numbered_machine import NumberedMachine  # noqa: E402
from slow_link import SlowLink  # noqa: E402

LATENCY_AIM_MS, SLOW_AGE_AIM_MS = 150, 300
SQUARES = 16  # hal/test_pattern/painted_number.h

# Reads the canvas each time before the browser shows it. `seen` and `ages` are milliseconds of the
# system's clock, which daemon and browser share.
WATCH = """
const [seconds, squares, done] = arguments;
const canvas = document.querySelector('#tiles canvas');
const side = Math.max(1, Math.floor(2 * Math.min(canvas.width, canvas.height) / (5 * squares)));
const left = Math.floor((canvas.width - 2 * squares * side) / 2);
const top_ = Math.floor(canvas.height / 2) + Math.floor(canvas.height / 20);
const row = new OffscreenCanvas(2 * squares * side, side).getContext('2d', { willReadFrequently: true });
const number = () => {
  row.drawImage(canvas, left, top_, 2 * squares * side, side, 0, 0, 2 * squares * side, side);
  const pixels = row.getImageData(0, side >> 1, 2 * squares * side, 1).data;
  const green = [];
  for (let k = 0; k < 2 * squares; ++k) green.push(pixels[4 * (k * side + (side >> 1)) + 1]);
  const between = (Math.min(...green) + Math.max(...green)) / 2;
  const bits = green.map((value) => value > between ? 1 : 0);
  const value = (from) => bits.slice(from, from + squares).reduce((sum, bit) => 2 * sum + bit, 0);
  return (value(0) ^ value(squares)) === 2 ** squares - 1 ? value(0) : null;
};
const frames = [], ages = [];
const end = performance.now() + 1000 * seconds;
let shown = '';
const look = () => {
  const now = performance.timeOrigin + performance.now(), { stamp } = canvas.dataset;
  ages.push(now - Date.parse(stamp));
  if (stamp !== shown) frames.push({ number: number(), stamp: Date.parse(stamp), seen: now });
  shown = stamp;
  if (performance.now() < end) requestAnimationFrame(look); else done({ frames, ages });
};
requestAnimationFrame(look);
"""


def quantile(values, part):
    ordered = sorted(values)
    return ordered[round(part * (len(ordered) - 1))]


def watched(port, seconds):
    """Frames shown on the canvas of the page at that port."""
    browser = Browser()
    try:
        browser.set_script_timeout(seconds + 60)
        browser.get(f"http://127.0.0.1:{port}/")
        browser.execute_async_script("""
            const look = () => document.querySelector('#tiles canvas')?.dataset.stamp
              ? arguments[0]() : requestAnimationFrame(look);
            look();""")
        return browser.execute_async_script(WATCH, seconds, SQUARES)
    finally:
        browser.close_all()


def check(frames, frame_rate):
    """The numbers in the pixels identify the exposures; the stamps must match them."""
    torn = [frame for frame in frames if frame["number"] is None]
    if torn or len(frames) < 2:
        raise SystemExit(f"page_latency: {len(torn)} of {len(frames)} pictures show no number")
    first = frames[0]
    for frame in frames:
        expected = (frame["number"] - first["number"]) % 2**SQUARES / frame_rate * 1000
        if abs(frame["stamp"] - first["stamp"] - expected) > 2:
            raise SystemExit(f"page_latency: {frame} is not the exposure that its stamp says")


def bandwidth(machine):
    """Bytes per second of the view's stream."""
    address = machine.address + "snapshot.jpg?view=ball"
    with urllib.request.urlopen(address, timeout=60) as answer:
        return len(answer.read()) * machine.frame_rate


def row(name, machine, port, seconds):
    """Prints a row; returns the p95 of the latency and of the age."""
    seen = watched(port, seconds)
    frames = seen["frames"]
    check(frames, machine.frame_rate)
    latencies = [frame["seen"] - frame["stamp"] for frame in frames]
    latency, age = quantile(latencies, 0.95), quantile(seen["ages"], 0.95)
    print(f"| {name} | {len(frames) / seconds:.1f} | {quantile(latencies, 0.5):.0f} | {latency:.0f} "
          f"| {age:.0f} | {max(seen['ages']):.0f} |", flush=True)
    return latency, age


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("seconds", type=int, nargs="?", default=20, help="of each row")
    seconds = parser.parse_args().seconds
    print("| case | pictures/s | exposure to canvas p50, ms | p95 | age of what is seen p95 | longest |\n"
          "|---|---:|---:|---:|---:|---:|")
    missed = []
    for width, height, aim in ((1280, 720, LATENCY_AIM_MS), (1920, 1080, None)):
        machine = NumberedMachine(width, height, 30)
        machine.start()
        try:
            latency, _ = row(f"{height}p30", machine, machine.port, seconds)
            if aim and latency > aim:
                missed.append(f"{height}p30: p95 {latency:.0f} ms, the aim is {aim} ms")
            link = SlowLink(machine.port, bandwidth(machine) / 3)
            _, age = row(f"{height}p30, a third of the bandwidth", machine, link.port, seconds)
            link.close()
            if aim and age > SLOW_AGE_AIM_MS:
                missed.append(f"{height}p30, slow: age {age:.0f} ms, the aim is {SLOW_AGE_AIM_MS} ms")
        finally:
            machine.close()
    for line in missed:
        print(f"page_latency: {line}", file=sys.stderr)
    return 1 if missed and "CI" not in os.environ else 0  # times are not evaluated there


if __name__ == "__main__":
    sys.exit(main())
