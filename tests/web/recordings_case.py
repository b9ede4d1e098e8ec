# SPDX-License-Identifier: Apache-2.0
"""Common parts of the cases of recorded events: an appliance that records, and what a user does on Recordings."""

import json
import urllib.parse
import urllib.request

from selenium.webdriver.common.by import By

from appliance import PATIENCE_S, Appliance, eventually
from page_case import PageCase

EVENTS = """
[recorder]
folder = "recordings"
reserve_mib = 16
[recorder.events]
ring_mib = 64
before_s = 0.5
after_s = 0.5
longest_s = 2
on_alarm = false
on_lines = ["button"]

[[line]]  # its pulses are shorter than the time between frame sets
name = "pusher"
use = "trigger_out"
back_end = "simulated"
line_name = "wire"
width_us = 500

[[line]]
name = "button"
use = "process_input"
back_end = "simulated"
line_name = "wire"
"""

STRICT_RECIPE = """
[[recipe]]
number = 2
file = "strict-recipe.toml"
"""
# Limits of the pool's width that it always exceeds, at once.
STRICT = (("low_warning = 9 ", "low_warning = 0.1 "), ("high_warning = 26", "high_warning = 2"),
          ("on_delay = 0.5", "on_delay = 0"))


class RecordingAppliance(Appliance):
    def __init__(self):
        super().__init__()
        file = self.folder / "demo.toml"
        file.write_text(file.read_text(encoding="utf-8") + EVENTS + STRICT_RECIPE, encoding="utf-8")
        recipe = (self.folder / "demo-recipe.toml").read_text(encoding="utf-8")
        for before, after in (*STRICT, ('name = "cladding"', 'name = "strict"')):
            assert before in recipe, "the demo's recipe has changed"
            recipe = recipe.replace(before, after, 1)
        (self.folder / "strict-recipe.toml").write_text(recipe, encoding="utf-8")


class RecordingsCase(PageCase):
    @classmethod
    def make_appliance(cls):
        return RecordingAppliance()

    def events(self):
        with urllib.request.urlopen(f"{self.appliance.address}api/v1/recordings", timeout=PATIENCE_S) as answer:
            return json.load(answer)["events"]

    def shown(self):
        """Causes of the events that are listed."""
        return self.browser.execute_script(
            "return [...document.querySelectorAll('#events h3')].map(({ textContent }) => textContent)")

    def press(self, label):
        """Presses a button once the page enables it."""
        path = f"//*[@id='recordings']//button[text()='{label}' and not(@disabled)]"
        eventually(f"{label} can be pressed", lambda: self.browser.find_elements(By.XPATH, path))[0].click()

    def record(self):
        before = len(self.events())
        self.press("Record what happens now")
        return eventually("it is recorded", lambda: [
            one for one in self.events() if len(self.events()) > before and one["is_finished"]])[0]

    def viewed(self):
        """Number of the picture that is shown, number of all, and its width."""
        text = self.browser.text("#viewer output").split(",")[0]
        number, count = text.split(" of ") if " of " in text else (0, 0)
        return int(number), int(count), self.browser.execute_script(
            "const seen = document.querySelector('#viewer img');"
            "return seen.complete && seen.src.endsWith(`frame=${arguments[0]}`) ? seen.naturalWidth : 0",
            int(number) - 1)

    def look_at_one(self):
        """Shows an event of a list that has one."""
        self.addCleanup(self.remove_all)
        self.browser.get(f"{self.appliance.address}#/recordings")
        if not self.events():
            self.record()
        eventually("an event", self.shown)
        self.press("Look at it")
        eventually("a picture", lambda: self.viewed()[2] > 100)
        eventually("a chart", lambda: self.browser.text("#viewer .signals .read"))
        return self.events()[0]

    def remove_all(self):
        for event in eventually("all are finished", lambda: [
                self.events() for _ in [0] if all(one["is_finished"] for one in self.events())])[0]:
            asked = urllib.request.Request(
                f"{self.appliance.address}api/v1/remove_recording", json.dumps({"event": event["name"]}).encode(),
                {"Content-Type": "application/json"})
            urllib.request.urlopen(asked, timeout=PATIENCE_S).close()

    def read(self, path, **query):
        address = f"{self.appliance.address}api/v1/recordings/{path}?{urllib.parse.urlencode(query)}"
        with urllib.request.urlopen(address, timeout=PATIENCE_S) as answer:
            return json.load(answer)
