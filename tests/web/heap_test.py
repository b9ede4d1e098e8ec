# SPDX-License-Identifier: Apache-2.0
"""Twelve views in one page for long, nine of them in sight: as many connections as for one, and no growth.

Folders: app/ports/web/streams app/ports/web/page/files/appliance app/ports/web/page/files/live
"""

import os
import pathlib
import time
import unittest

from appliance import Appliance, eventually
from page_case import PageCase

VIEWS, IN_SIGHT = 12, 9
# An hour with ORBWATCH_SHARE=1, like the long gates of the other tests; else two minutes.
SECONDS = 3600 if os.environ.get("ORBWATCH_SHARE") == "1" else 120
PAUSE_S = 10  # between two readings of the memory
SHARE = 0.25  # share of the time until caches are full
BROWSER_MAY_GROW = 1_000_000  # bytes, the page has some 3 MB
DAEMON_MAY_GROW = 4_000_000  # bytes, the daemon has some 150 MB


class TwelveViews(Appliance):
    def __init__(self):
        super().__init__()
        file = self.folder / "demo.toml"
        views = "".join(f'[[view]]\nname = "view_{n}"\nyaw = {30 * n}\nh_fov = 60\nwidth = 320\n'
                        'height = 240\n[[view.source]]\ncamera = "colour"\n'
                        for n in range(VIEWS - 4))
        file.write_text(file.read_text(encoding="utf-8") + views, encoding="utf-8")

    def resident(self):
        """Bytes of the daemon."""
        fields = pathlib.Path(f"/proc/{self.daemon.pid}/statm").read_text(encoding="ascii").split()
        return int(fields[1]) * os.sysconf("SC_PAGESIZE")


class Heap(PageCase):
    @classmethod
    def make_appliance(cls):
        return TwelveViews()

    def used(self):
        """Bytes that the page holds, without garbage."""
        self.browser.execute_cdp_cmd("HeapProfiler.collectGarbage", {})
        return self.browser.execute_cdp_cmd("Runtime.getHeapUsage", {})["usedSize"]

    def pictures(self):
        """Numbers of the pictures of views that have one."""
        numbers = self.browser.picture_numbers()
        self.assertIn(len(numbers), (0, VIEWS))
        return {view: number for view, number in numbers.items() if number}

    def test_twelve_views_take_two_connections_and_no_more_memory(self):
        self.browser.get(self.appliance.address)
        eventually("views are seen", lambda: len(self.pictures()) == IN_SIGHT)
        eventually("the page's connection and the one that asks are left",
                   lambda: self.appliance.status()["web"]["connections"] <= 2)
        self.assertEqual(self.appliance.status()["web"]["streams"], 1)
        page, daemon = [], []
        end = time.monotonic() + SECONDS
        while time.monotonic() < end:
            time.sleep(PAUSE_S)  # the test measures over time
            page.append(self.used())
            daemon.append(self.appliance.resident())
        first = max(1, round(SHARE * len(page)))
        self.assertLess(min(page[-first:]) - min(page[:first]), BROWSER_MAY_GROW, page)
        self.assertLess(daemon[-1] - daemon[first], DAEMON_MAY_GROW, daemon)
        before = self.pictures()
        eventually("pictures still come", lambda: all(
            number > before[view] for view, number in self.pictures().items()))
        self.assertEqual(self.browser.complaints(), [])


if __name__ == "__main__":
    unittest.main()
