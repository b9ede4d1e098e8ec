# SPDX-License-Identifier: Apache-2.0
"""What the machine says, on Process and System, and in the header when it stops.

Folders: app/ports/web/page/files/process app/ports/web/page/files/system app/machine app/ports/web/machine
"""

import json
import threading
import time
import unittest
import urllib.request

from appliance import PATIENCE_S, Appliance, eventually
from page_case import PageCase

PERIOD_S = 0.02


class MachineAppliance(Appliance):
    """A script sends the states of its machine."""

    def __init__(self):
        super().__init__()
        file = self.folder / "demo.toml"
        site = file.read_text(encoding="utf-8")
        assert 'source = "simulation"' in site, "the demo's site file has changed"
        file.write_text(site.replace('source = "simulation"', 'source = "http"'), encoding="utf-8")

    def send(self, **state):
        request = urllib.request.Request(
            f"{self.address}api/v1/machine_state", json.dumps(state).encode(),
            {"Content-Type": "application/json"})
        with urllib.request.urlopen(request, timeout=PATIENCE_S):
            pass


class Script:
    """Sends the state 50 times a second while it is entered."""

    def __init__(self, appliance, **state):
        self.ends = threading.Event()
        self.failure = None

        def run():
            try:
                while not self.ends.wait(PERIOD_S):
                    appliance.send(x=time.monotonic() % 100, y=0, z=0, **state)
            except OSError as failure:
                self.failure = failure

        self.thread = threading.Thread(target=run)

    def __enter__(self):
        self.thread.start()

    def __exit__(self, *_):
        self.ends.set()
        self.thread.join()
        assert self.failure is None, self.failure


class MachineState(PageCase):
    @classmethod
    def make_appliance(cls):
        return MachineAppliance()

    def text(self, selector):
        return self.browser.execute_script("return document.querySelector(arguments[0])?.innerText ?? ''", selector)

    def test_process_names_part_and_layer_and_the_header_a_machine_that_stopped(self):
        with Script(self.appliance, part="Flügel 7", layer=12):
            self.browser.get(f"{self.appliance.address}#/process")
            eventually("part and layer", lambda: self.text("#process .machine") == "Part Flügel 7 · Layer 12")
            self.assertNotIn("machine's state", self.text("header"))
        eventually("nothing is known", lambda: self.text("#process .machine") == "")
        self.assertIn("The machine's state is not known", self.text("header"))
        with Script(self.appliance, part="Flügel 8", layer=1, track=4):
            eventually("the next part", lambda: self.text("#process .machine") == "Part Flügel 8 · Layer 1 · Track 4")
            eventually("no notice", lambda: "machine's state" not in self.text("header"))
        self.assertEqual(self.browser.complaints(), [])

    def test_system_has_its_figures_in_a_card(self):
        with Script(self.appliance, part="P-7", laser_power=1800, laser_on=1):
            self.browser.get(f"{self.appliance.address}#/system")
            card = "#machine.card"
            eventually("the card", lambda: "good" in self.text(card))
            self.browser.execute_script("document.querySelector(arguments[0]).open = true", card)
            eventually("its figures", lambda: "P-7" in self.text(card) and "1800" in self.text(card))
        eventually("stale", lambda: "stale" in self.text(card))


if __name__ == "__main__":
    unittest.main()
