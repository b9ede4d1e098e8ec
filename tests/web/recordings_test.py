# SPDX-License-Identifier: Apache-2.0
"""Events that the recorder keeps, listed, searched, shown, saved, pinned and deleted on Recordings.

Folders: app/ports/web/page/files/recordings app/ports/web/recordings app/ports/recorder
"""

import json
import shutil
import unittest
import urllib.request

from selenium.webdriver.common.by import By
from selenium.webdriver.support.ui import Select

from appliance import PATIENCE_S, eventually
from recordings_case import RecordingsCase

# Parts of the summary of an event with an alarm; the rest does not matter.
SUMMARY = {"trigger": "alarm", "text": "pool: hot_spot_width raised, high alarm, 27.25 mm",
           "first": "2026-01-01T00:00:00Z", "triggered": "2026-01-01T00:00:01Z", "last": "2026-01-01T00:00:02Z",
           "frame_set": 1, "recipe": 1, "part": None, "layer": None, "pictures": {}, "lost": 0, "has_beginning": True,
           "is_interrupted": False, "versions": {}}
ALARM = {"region": "pool", "signal": "hot_spot_width", "level": 4, "value": 27.25, "unit": "mm"}


class Recordings(RecordingsCase):
    def filter_by_kind(self, text):
        """Chooses a cause as people do; the driver's own choice has no input event."""
        self.browser.execute_script(
            "const kind = document.querySelector('#recordings [name=kind]');"
            "kind.value = [...kind.options].find((option) => option.text === arguments[0]).value;"
            "kind.dispatchEvent(new Event('input', { bubbles: true }))", text)

    def step_through_its_pictures(self, event):
        self.press("Look at it")
        eventually("a picture", lambda: self.viewed()[2] > 100)
        at, count, _ = self.viewed()
        self.assertIn("0.00 s from the trigger", self.browser.text("#viewer output"), "it begins with the trigger")
        self.assertGreater(at, 1)
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

    def test_the_cause_of_an_event_is_in_the_pages_language(self):
        events = self.appliance.folder / "recordings" / "events"
        self.addCleanup(lambda: eventually("none is left", lambda: self.events() == []))
        self.addCleanup(shutil.rmtree, events)
        for second, cause in ((1, {"alarm": ALARM}), (2, {}), (3, {"trigger": "line", "line": "button"})):
            event = events / f"20260101T00000{second}.000Z-alarm"
            event.mkdir(parents=True)
            (event / "summary.json").write_text(json.dumps({**SUMMARY, **cause}), encoding="utf-8")
        for language, line, alarm in (
                ("en", "line button became active", "pool: Hot spot width, high alarm, 27.3 mm"),
                ("de", "Leitung button wurde aktiv", "pool: Breite des heißen Flecks, oberer Alarm, 27,3 mm"),
                ("ja", "デジタル入力 button が有効になった", "pool: 高温部の幅、上限アラーム、27.3 mm")):
            with self.subTest(language=language):
                self.browser.get(f"{self.appliance.address}#/recordings")
                self.browser.execute_script("localStorage.setItem('language', arguments[0])", language)
                self.browser.refresh()
                # That of an earlier version, in the middle, has no parts.
                eventually("causes", lambda: self.shown() == [line, SUMMARY["text"], alarm])

    def test_an_event_that_is_being_recorded_says_so(self):
        unfinished = self.appliance.folder / "recordings/events/20200101T000000.000Z-command.unfinished"
        unfinished.mkdir(parents=True)
        self.addCleanup(unfinished.rmdir)
        self.browser.get(f"{self.appliance.address}#/recordings")
        eventually("it is shown", lambda: "It is being recorded." in self.browser.text("#events"))
        self.assertFalse(self.browser.find_element(By.XPATH, "//button[text()='Look at it']").is_enabled())
        self.assertEqual(self.browser.complaints(), [])

    def test_many_events_are_shown_by_pages_and_searched(self):
        events = self.appliance.folder / "recordings" / "events"
        self.addCleanup(lambda: eventually("none is left", lambda: self.events() == []))
        self.addCleanup(shutil.rmtree, events)
        for number in range(120):
            (events / f"20260101T00{number // 60:02}{number % 60:02}.000Z-alarm").mkdir(parents=True)
        self.browser.get(f"{self.appliance.address}#/recordings")
        eventually("the newest ones", lambda: len(self.shown()) == 100)
        self.assertIn("120 events", self.browser.text("#recordings > [role=status]"))
        self.press("Show more")
        eventually("all", lambda: len(self.shown()) == 120)
        eventually("no more", lambda: not self.browser.find_element(
            By.XPATH, "//*[@id='recordings']//button[text()='Show more']").is_displayed())
        self.browser.execute_script(
            "const until = document.querySelector('#recordings [name=until]'); until.value = '2001-01-01T00:00';"
            "until.dispatchEvent(new Event('input', { bubbles: true }))")
        eventually("none of that time", lambda: self.shown() == [])
        self.assertIn("0 of 120 events", self.browser.text("#recordings > [role=status]"))
        # These events have no picture.
        self.assertEqual([one for one in self.browser.complaints() if "trigger.jpg" not in one["message"]], [])

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

    def test_a_pulse_of_a_digital_line_records_an_event(self):
        self.browser.get(f"{self.appliance.address}#/recordings")
        eventually("the list", lambda: "0 events" in self.browser.text("#recordings > [role=status]"))
        request = urllib.request.Request(f"{self.appliance.address}api/v1/command/pulse", data=b'{"line": 0}',
                                         headers={"Content-Type": "application/json"})
        with urllib.request.urlopen(request, timeout=PATIENCE_S) as answer:
            self.assertEqual(json.load(answer)["result_text"], "done")
        event = eventually("it is recorded", lambda: [one for one in self.events() if one["is_finished"]])[0]
        self.assertEqual(event["trigger"], "line")
        eventually("it is shown", lambda: self.shown() == ["line button became active"])
        self.filter_by_kind("Alarm")
        eventually("no alarm", lambda: self.shown() == [])
        self.filter_by_kind("A digital line")
        eventually("the pulse", lambda: self.shown() == ["line button became active"])
        self.press("Remove")
        self.browser.switch_to.alert.accept()
        eventually("it is deleted", lambda: self.events() == [])
        self.assertEqual(self.browser.complaints(), [])

    def test_an_event_is_recorded_shown_saved_pinned_and_deleted(self):
        self.browser.get(f"{self.appliance.address}#/recordings")
        eventually("the list", lambda: "0 events" in self.browser.text("#recordings > [role=status]"))
        event = self.record()
        self.assertEqual(event["trigger"], "command")
        self.assertGreater(event["pictures"], 4)
        self.assertEqual(event["lost"], 0)
        eventually("it is shown", lambda: self.shown() == ["By command"])
        eventually("with the picture of its trigger", lambda: self.browser.execute_script(
            "return document.querySelector('#events img').naturalWidth > 100"))
        self.browser.keep_picture("recordings-list")

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
        eventually("none", lambda: self.shown() == [])
        self.assertIn("0 of 1 events", self.browser.text("#recordings > [role=status]"))
        self.browser.find_element(By.NAME, "part").clear()
        self.browser.find_element(By.NAME, "part").send_keys(" ")
        eventually("the event again", lambda: self.shown() == ["By command"])

        self.press("Remove")
        self.browser.switch_to.alert.accept()
        eventually("it is deleted", lambda: self.events() == [])
        eventually("and no longer shown", lambda: self.shown() == [])
        self.assertEqual(self.browser.complaints(), [])


if __name__ == "__main__":
    unittest.main()
