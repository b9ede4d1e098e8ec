# SPDX-License-Identifier: Apache-2.0
"""Events that the recorder keeps, listed, saved, pinned and deleted on Recordings.

Folders: app/ports/web/page/files/recordings app/ports/web/recordings app/ports/recorder
"""

import json
import shutil
import unittest
import urllib.request

from selenium.webdriver.common.by import By
from selenium.webdriver.support.ui import Select

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
"""


class RecordingAppliance(Appliance):
    def __init__(self):
        super().__init__()
        file = self.folder / "demo.toml"
        file.write_text(file.read_text(encoding="utf-8") + EVENTS, encoding="utf-8")


class Recordings(PageCase):
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

    def step_through_its_pictures(self, event):
        self.press("Look at it")
        eventually("a picture", lambda: self.viewed()[2] > 100)
        at, count, _ = self.viewed()
        self.assertIn("0.00 s from the trigger", self.browser.text("#viewer output"), "it begins with the trigger")
        self.assertGreater(at, 3)
        self.assertLess(at, count)
        self.browser.keep_picture("recordings-viewer")
        self.press("One after")
        eventually("the next one", lambda: self.viewed()[0] == at + 1 and self.viewed()[2] > 100)
        self.press("One before")
        eventually("the one before", lambda: self.viewed()[0] == at and self.viewed()[2] > 100)
        colour = self.viewed()[2]
        camera = Select(self.browser.find_element(By.CSS_SELECTOR, "#viewer select"))
        counts = {}
        for name in [one.text for one in camera.options]:
            camera.select_by_visible_text(name)
            eventually(f"pictures of {name}", lambda: self.viewed()[2] > 50)
            counts[name] = self.viewed()[1]
        self.assertGreater(len(counts), 1)
        self.assertEqual(sum(counts.values()), event["pictures"])
        self.assertNotEqual(self.viewed()[2], colour, "another camera has another size")
        self.press("Close")
        self.assertFalse(self.browser.find_element(By.ID, "viewer").is_displayed())

    def test_an_event_that_is_being_recorded_says_so(self):
        unfinished = self.appliance.folder / "recordings/events/20200101T000000.000Z-command.unfinished"
        unfinished.mkdir(parents=True)
        self.addCleanup(unfinished.rmdir)
        self.browser.get(f"{self.appliance.address}#/recordings")
        eventually("it is shown", lambda: "It is being recorded." in self.browser.text("#events"))
        self.assertFalse(self.browser.find_element(By.XPATH, "//button[text()='Look at it']").is_enabled())
        self.assertEqual(self.browser.complaints(), [])

    def test_nothing_bars_people_from_events_and_their_pictures(self):
        def show():
            self.browser.get(f"{self.appliance.address}#/recordings")
            if not self.events():
                self.record()
            eventually("an event", self.shown)
            self.press("Look at it")
            eventually("a picture", lambda: self.viewed()[2] > 100)
        for width in (1440, 390):
            with self.subTest(width=width):
                self.browser.set_window_size(width, 850)
                self.expect_no_barriers(show)
                self.expect_fits_its_width()
        self.press("Remove")
        self.browser.switch_to.alert.accept()
        eventually("it is deleted", lambda: self.events() == [])

    def test_an_event_without_a_summary_is_listed_beside_others(self):
        events = self.appliance.folder / "recordings" / "events"
        self.addCleanup(lambda: eventually("none is left", lambda: self.events() == []))
        self.addCleanup(shutil.rmtree, events)
        (events / "20260101T000000.000Z-alarm").mkdir(parents=True)
        self.browser.get(f"{self.appliance.address}#/recordings")
        eventually("it is listed", lambda: len(self.shown()) == 1)
        self.record()
        eventually("the other one is listed, too", lambda: len(self.shown()) == 2)
        self.assertEqual(self.shown()[0], "By command")

    def test_an_event_is_recorded_shown_saved_pinned_and_deleted(self):
        self.browser.get(f"{self.appliance.address}#/recordings")
        eventually("the list", lambda: "0 events" in self.browser.text("#recordings [role=status]"))
        event = self.record()
        self.assertEqual(event["trigger"], "command")
        self.assertGreater(event["pictures"], 10)
        self.assertEqual(event["lost"], 0)
        eventually("it is shown", lambda: self.shown() == ["By command"])
        eventually("with the picture of its trigger", lambda: self.browser.execute_script(
            "return document.querySelector('#events img').naturalWidth > 100"))
        self.browser.keep_picture("recordings")

        self.step_through_its_pictures(event)

        link = self.browser.find_element(By.CSS_SELECTOR, "#events a[download]").get_property("href")
        with urllib.request.urlopen(link, timeout=PATIENCE_S) as answer:
            saved = answer.read()
        self.assertEqual(saved[:8], b"\x89MCAP0\r\n")
        self.assertEqual(saved[-8:], saved[:8], "it is whole")

        self.press("Keep")
        eventually("it is pinned", lambda: self.events()[0]["is_pinned"])
        eventually("and says so", lambda: "Do not keep" in self.browser.text("#events"))

        self.browser.find_element(By.NAME, "part").send_keys("no such part")
        self.assertEqual(self.shown(), [])
        self.assertIn("0 of 1 events", self.browser.text("#recordings [role=status]"))
        self.browser.find_element(By.NAME, "part").clear()
        self.browser.find_element(By.NAME, "part").send_keys(" ")
        self.assertEqual(self.shown(), ["By command"])

        self.press("Remove")
        self.browser.switch_to.alert.accept()
        eventually("it is deleted", lambda: self.events() == [])
        eventually("and no longer shown", lambda: self.shown() == [])
        self.assertEqual(self.browser.complaints(), [])


if __name__ == "__main__":
    unittest.main()
