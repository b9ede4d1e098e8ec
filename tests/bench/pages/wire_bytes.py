# SPDX-License-Identifier: Apache-2.0
"""Measures what the page's pictures cost on the wire, on several screens: see README.md of tests/bench."""

import argparse
import collections
import concurrent.futures
import datetime
import json
import pathlib
import statistics
import sys
import time
import urllib.parse
import urllib.request

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "web"))
from appliance import Appliance, eventually  # noqa: E402
from browser import Browser  # noqa: E402
from slow_link import SlowLink  # noqa: E402

FRAME_RATE = 15  # pictures per second of the cameras in demo.toml
SLOW_BYTES = 1.5e6 / 8  # per second: a phone with a slow link
WARM_UP_S = 2  # until the buffers of a slow link are full
# Screen, CSS px; device pixels per CSS pixel; layout; page.
SCREENS = (
    ("four tiles on 1440x900", 1440, 900, 1, "4", "live"),
    ("one large and three small", 1440, 900, 1, "large", "live"),
    ("nine places", 1440, 900, 1, "9", "live"),
    ("phone of 390x844", 390, 844, 1, None, "live"),
    ("the same, 3 device pixels", 390, 844, 3, None, "live"),
    ("its *Process*", 390, 844, 1, None, "process"),
)
NOTE_STREAMS = """{
  const { fetch } = window;
  window.streams = [];
  window.fetch = (...request) => {
    const address = String(request[0]);
    if (address.startsWith('api/v1/live?')) window.streams.push({ address, opened: performance.now() });
    return fetch(...request);
  };
}"""


LAYOUTS = ["1", "2", "4", "6", "9", "large"]
CHOOSE = """
const button = document.querySelectorAll('.layouts button')[arguments[0]];
button?.click();
return Boolean(button);"""
# Address of a stream of views that has been open for two seconds; null: none.
SETTLED = """
const last = window.streams.at(-1);
return last?.address.includes('view=') && performance.now() - last.opened > 2000 ? last.address : null;"""


def quantile(values, part):
    ordered = sorted(values)
    return ordered[round(part * (len(ordered) - 1))]


def stream_of(machine, width, height, scale, layout, page):
    """Address of the live stream that the page opens on this screen, once it does not change any more."""
    browser = Browser()
    try:
        browser.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": NOTE_STREAMS})
        browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
            "width": width, "height": height, "deviceScaleFactor": scale, "mobile": width < 600})
        browser.get(f"{machine.address}#/{page}")
        if layout:
            eventually("layouts", lambda: browser.execute_script(CHOOSE, LAYOUTS.index(layout)))
        return eventually("a stream that stays", lambda: browser.execute_script(SETTLED))
    finally:
        browser.close_all()


def in_full(stream):
    """The same stream without widths, which are those that every client received before."""
    query = urllib.parse.parse_qsl(urllib.parse.urlsplit(stream).query)
    return "api/v1/live?" + urllib.parse.urlencode([(name, value) for name, value in query if name == "view"])


def received(port, stream, seconds):
    """Bytes of each message with a picture, by view, and ages (ms) of the pictures that a client receives in this
    time."""
    taken, ages = collections.defaultdict(list), []
    begin = time.monotonic() + WARM_UP_S
    with urllib.request.urlopen(f"http://127.0.0.1:{port}/{stream}", timeout=60) as answer:
        while (now := time.monotonic()) < begin + seconds:
            line = answer.readline()
            head = json.loads(line)
            body = answer.read(head["bytes"])
            if now < begin or head["kind"] != "view":
                continue
            taken[head["name"]].append(len(line) + len(body))
            stamp = datetime.datetime.fromisoformat(f"{head['stamp'][:26]}+00:00").timestamp()
            ages.append(1000 * (time.time() - stamp))
    return taken, ages


def bandwidth(machine, stream, seconds):
    """Kilobytes per second of all views at the cameras' rate, which a busy computer does not reach."""
    taken, _ = received(machine.port, stream, seconds)
    return sum(statistics.mean(sizes) for sizes in taken.values()) * FRAME_RATE / 1000


def over_slow_link(machine, stream, seconds):
    """Pictures per second over a slow link, and the p95 of their age in ms."""
    link = SlowLink(machine.port, SLOW_BYTES)
    try:
        _, ages = received(link.port, stream, seconds)
    finally:
        link.close()
    return len(ages) / seconds, quantile(ages, 0.95)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("seconds", type=int, nargs="?", default=20, help="of each figure")
    seconds = parser.parse_args().seconds
    machine = Appliance()
    machine.start()
    grown = []
    try:
        print("| screen | views | kB/s in full | kB/s by tile | pictures/s over 1.5 Mbit/s in full | by tile "
              "| age p95 there in full, ms | by tile |\n|---|---:|---:|---:|---:|---:|---:|---:|")
        for name, *screen in SCREENS:
            stream = stream_of(machine, *screen)
            # At the same time, so that both show the same scenes.
            with concurrent.futures.ThreadPoolExecutor() as clients:
                full, tiled = clients.map(lambda one: bandwidth(machine, one, seconds), (in_full(stream), stream))
            slow = [over_slow_link(machine, one, seconds) for one in (in_full(stream), stream)]
            print(f"| {name} | {stream.count('view=')} | {full:.0f} | {tiled:.0f} "
                  f"| {slow[0][0]:.1f} | {slow[1][0]:.1f} | {slow[0][1]:.0f} | {slow[1][1]:.0f} |", flush=True)
            if tiled > 1.1 * full:
                grown.append(name)
    finally:
        machine.close()
    for name in grown:
        print(f"wire_bytes: {name}: more bytes than in full", file=sys.stderr)
    return 1 if grown else 0


if __name__ == "__main__":
    sys.exit(main())
