# SPDX-License-Identifier: Apache-2.0
"""Events that the recorder keeps, listed, shown, saved, exported, pinned and deleted on Recordings.

Folders: app/ports/web/page/files/recordings app/ports/web/recordings app/ports/recorder
"""

import json
import pathlib
import re
import shutil
import tempfile
import unittest
import urllib.error
import urllib.parse
import urllib.request

from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
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

    def filter_by_kind(self, text):
        """Chooses a cause as people do; the driver's own choice has no input event."""
        self.browser.execute_script(
            "const kind = document.querySelector('#recordings [name=kind]');"
            "kind.value = [...kind.options].find((option) => option.text === arguments[0]).value;"
            "kind.dispatchEvent(new Event('input', { bubbles: true }))", text)

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

    def cursor(self):
        """Place of the chart's cursor, share of its width."""
        return self.browser.execute_script("""
            const line = document.querySelector('#viewer .cursor line');
            return Number(line.getAttribute('x1')) / document.querySelector('#viewer .plot').clientWidth;""")

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

    def test_a_signal_has_the_cursor_of_the_pictures(self):
        event = self.look_at_one()
        chart = self.browser.find_element(By.CSS_SELECTOR, "#viewer .signals canvas")
        self.browser.execute_script("arguments[0].scrollIntoView({ block: 'center' })", chart)
        choice = Select(self.browser.find_element(By.CSS_SELECTOR, "#viewer [name=signal]"))
        signals = self.read("signals", event=event["name"])["signals"]
        self.assertEqual(len(choice.options), len(signals))
        layer = next(one for one in signals if one["figure"] == "x")
        choice.select_by_value(json.dumps([layer["region"], layer["figure"]], separators=(",", ":")))
        course = self.read("signal", event=event["name"], figure="x")
        at = max(n for n, time in enumerate(course["times"]) if time <= event["triggered"])
        shown = eventually("its value", lambda: re.fullmatch(
            r"Tool X (-?\d+\.\d+) mm", self.browser.text("#viewer .signals .read")))
        self.assertAlmostEqual(float(shown[1]), course["high"][at], delta=0.06)
        self.assertIn("0.00 s from the trigger", chart.get_attribute("aria-valuetext"))
        at, count, _ = self.viewed()
        begun = self.cursor()
        self.press("One after")
        eventually("the next one", lambda: self.viewed()[0] == at + 1)
        self.assertGreater(self.cursor(), begun)
        chart.send_keys(Keys.END)
        eventually("the last one", lambda: self.viewed()[0] == count)
        chart.send_keys(Keys.HOME)
        eventually("the first one", lambda: self.viewed()[0] == 1)
        self.assertLess(self.cursor(), begun)
        chart.send_keys(Keys.ARROW_RIGHT)
        eventually("the second one", lambda: self.viewed()[0] == 2 and self.viewed()[2] > 100)
        plot = self.browser.find_element(By.CSS_SELECTOR, "#viewer .plot")
        ActionChains(self.browser).move_to_element_with_offset(plot, int(0.4 * plot.size["width"]), 0).click().perform()
        eventually("one of the last", lambda: self.viewed()[0] > at)
        self.assertGreater(self.cursor(), begun)
        self.browser.keep_picture("recordings")
        self.assertEqual(self.browser.complaints(), [])

    def test_a_finger_moves_through_the_event_on_a_phone(self):
        self.browser.show_on(390, 844)
        self.look_at_one()
        self.expect_fits_its_width()
        plot = self.browser.find_element(By.CSS_SELECTOR, "#viewer .plot")
        self.browser.execute_script("arguments[0].scrollIntoView({ block: 'center' })", plot)
        at, begun = self.viewed()[0], self.cursor()
        x, y = self.browser.middle_of(plot)
        self.browser.touch("touchStart", [(x - 0.4 * plot.size["width"], y)])
        self.browser.touch("touchEnd", [])
        eventually("one before", lambda: self.viewed()[0] < at)
        self.assertLess(self.cursor(), begun)
        self.browser.keep_picture("recordings-phone")

    def test_the_measured_regions_are_over_the_pictures(self):
        event = self.look_at_one()
        recipes = self.read("regions", event=event["name"])["recipes"]
        regions = [one for one in recipes[0]["regions"] if one["camera"] == "thermal"]
        self.assertGreater(len(regions), 0)
        Select(self.browser.find_element(By.CSS_SELECTOR, "#viewer [name=camera]")).select_by_visible_text("thermal")
        def drawn():
            return self.browser.execute_script("""
                const svg = document.querySelector('#viewer .outlines');
                const seen = document.querySelector('#viewer img').getBoundingClientRect();
                return [...svg.querySelectorAll('polyline')].map((line) => {
                  const box = line.getBoundingClientRect();
                  return [box.left - seen.left, box.top - seen.top, seen.right - box.right, seen.bottom - box.bottom];
                });""")
        eventually("regions", lambda: len(drawn()) == sum(len(one["lines"]) for one in regions))
        eventually("the picture", lambda: self.viewed()[2] > 50)
        for box in drawn():
            self.assertGreater(min(box), 0, "within the picture of the ball")
        self.assertEqual({text.text for text in self.browser.find_elements(By.CSS_SELECTOR, "#viewer .outlines text")},
                         {one["name"] for one in regions})
        self.browser.keep_picture("recordings-regions")
        self.browser.find_element(By.XPATH, "//*[@id='viewer']//label[contains(., 'Regions')]/input").click()
        eventually("none", lambda: drawn() == [])
        self.assertEqual(self.browser.complaints(), [])

    def test_an_event_or_a_range_of_it_is_exported(self):
        saved = pathlib.Path(tempfile.mkdtemp(prefix="orbwatch-saved-"))
        self.addCleanup(shutil.rmtree, saved)
        self.browser.execute_cdp_cmd("Browser.setDownloadBehavior", {"behavior": "allow", "downloadPath": str(saved)})
        event = self.look_at_one()
        self.browser.find_element(By.CSS_SELECTOR, "#viewer .export summary").click()
        kind = Select(self.browser.find_element(By.NAME, "format"))

        def export(value):
            kind.select_by_value(value)
            self.press("Export as a file")
            return eventually(f"{value} is saved", lambda: list(saved.glob(f"*.{value}")))[0]

        table = export("csv").read_text(encoding="utf-8").splitlines()
        sets = len(self.read("signal", event=event["name"], figure="x")["times"])
        self.assertEqual(len(table), 1 + sets)
        eventually("it says so", lambda: "is being saved" in self.browser.text("#viewer .export [role=status]"))
        self.assertEqual(self.read("export")["state"], "none", "it is fetched once")
        for file in saved.iterdir():
            file.unlink()

        chart = self.browser.find_element(By.CSS_SELECTOR, "#viewer .signals canvas")
        self.press("From this picture")
        chart.send_keys(Keys.ARROW_RIGHT, Keys.ARROW_RIGHT)
        self.press("Up to this picture")
        self.assertEqual(self.browser.text("#viewer .export output").split(" s")[0], "from 0.00")
        self.assertEqual(len(self.browser.find_elements(By.CSS_SELECTOR, "#viewer .marks rect")), 1)
        self.browser.keep_picture("recordings-export")
        part = export("csv").read_text(encoding="utf-8").splitlines()
        self.assertGreaterEqual(len(part), 1 + 3)
        self.assertLess(len(part), 1 + 12)
        self.assertEqual(part[1].split(",")[0], event["triggered"])
        self.assertEqual(export("avi").read_bytes()[:4], b"RIFF")
        self.assertEqual(export("zip").read_bytes()[:2], b"PK")
        self.assertEqual(self.browser.complaints(), [])

    def cancel_while_it_lasts(self, work, label):
        """Presses the button `label` that begins an export or a replay, and its Cancel as soon as that is shown. Most
        work on a short event is done in less than a second: tries again when it was done before."""
        self.browser.execute_script("""
            const cancel = [...document.querySelectorAll(`#viewer .${arguments[0]} button`)]
              .find(({ textContent }) => textContent === 'Cancel');
            new MutationObserver(() => { if (!cancel.hidden) cancel.click(); }).observe(cancel, { attributes: true });
            """, work)
        for _ in range(20):
            before = self.read(work)["number"]
            self.press(label)
            eventually("it ends", lambda: [one for one in [self.read(work)] if one["number"] > before
                                           and one["state"] not in ("making", "measuring", "ready")])
            said = f"#viewer .{work} [role=status]"
            text = eventually("it says so", lambda: next((
                text for text in [self.browser.text(said)]
                if re.search("Cancelled|is being saved|were measured again", text)), None))
            if text.startswith("Cancelled"):
                return
        self.fail(f"{label} was never cancelled")

    def test_an_export_and_a_replay_are_cancelled_on_the_page(self):
        saved = pathlib.Path(tempfile.mkdtemp(prefix="orbwatch-saved-"))
        self.addCleanup(shutil.rmtree, saved)
        self.browser.execute_cdp_cmd("Browser.setDownloadBehavior", {"behavior": "allow", "downloadPath": str(saved)})
        self.look_at_one()
        self.browser.find_element(By.CSS_SELECTOR, "#viewer .export summary").click()
        Select(self.browser.find_element(By.NAME, "format")).select_by_value("avi")
        self.cancel_while_it_lasts("export", "Export as a file")
        self.assertEqual(self.read("export")["state"], "none")
        self.browser.find_element(By.CSS_SELECTOR, "#viewer .replay summary").click()
        self.cancel_while_it_lasts("replay", "Measure it again")
        self.assertEqual(self.read("replay")["state"], "none")

    def replay(self, recipe):
        """Tries a recipe on the shown event, and returns the row of the alarm of the pool's width."""
        Select(self.browser.find_element(By.CSS_SELECTOR, "#viewer [name=recipe]")).select_by_visible_text(recipe)
        self.press("Measure it again")
        eventually("a result", lambda: "were measured again" in self.browser.text("#viewer .replay [role=status]"))
        return self.browser.find_element(
            By.XPATH, "//*[@id='viewer']//tr[th[contains(., 'pool: hot_spot_width')]]")

    def test_a_recipe_is_tried_on_an_event(self):
        event = self.look_at_one()
        self.browser.find_element(By.CSS_SELECTOR, "#viewer .replay summary").click()
        choice = Select(self.browser.find_element(By.CSS_SELECTOR, "#viewer [name=recipe]"))
        self.assertEqual(choice.first_selected_option.text, "Recipe 1: cladding")

        width = self.replay("As recorded")
        self.assertEqual(width.get_attribute("class"), "")
        self.assertEqual([cell.text for cell in width.find_elements(By.TAG_NAME, "td")], ["not raised", "not raised"])
        self.assertIn("The event is short", self.browser.text("#viewer .replay [role=status]"))

        width = self.replay("Recipe 2: strict")
        self.assertEqual(width.get_attribute("class"), "differs")
        recorded, tried = width.find_elements(By.TAG_NAME, "td")
        self.assertEqual(recorded.text, "not raised")
        self.assertIn("high warning", tried.text)
        self.browser.keep_picture("recordings-replay")
        result = self.read("replayed", number=self.read("replay")["number"])
        [alarm] = [one for one in result["alarms"] if one["differs"] and "hot_spot_width" in one["name"]]
        self.assertEqual(alarm["computed"][0]["level_text"], "high warning")
        self.assertEqual(result["event"], event["name"])
        tried.find_element(By.TAG_NAME, "button").click()
        eventually("its first picture", lambda: self.viewed()[0] <= 2)
        signal = Select(self.browser.find_element(By.CSS_SELECTOR, "#viewer [name=signal]"))
        signal.select_by_value('["pool","hot_spot_width"]')
        eventually("the other curve", lambda: "with the recipe" in self.browser.text("#viewer .signals .second"))
        self.assertEqual(self.browser.complaints(), [])

    def test_a_replay_is_cancelled_or_refused(self):
        event = self.look_at_one()

        def post(path, body):
            asked = urllib.request.Request(f"{self.appliance.address}api/v1/{path}", json.dumps(body).encode(),
                                           {"Content-Type": "application/json"})
            with urllib.request.urlopen(asked, timeout=PATIENCE_S) as answer:
                return json.load(answer)

        number = post("replay_recording", {"event": event["name"], "recipe": 2})["number"]
        post("cancel_replay", {"number": number})
        eventually("it ends", lambda: self.read("replay")["state"] == "none")
        for body in ({"event": "../../etc", "recipe": 2}, {"event": event["name"], "recipe": 9}):
            with self.assertRaises(urllib.error.HTTPError) as refused:
                post("replay_recording", body)
            self.assertEqual(refused.exception.code, 409)
            self.assertIn("error", json.load(refused.exception))
            refused.exception.close()

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

    def test_nothing_bars_people_from_events_and_their_pictures(self):
        self.addCleanup(self.remove_all)
        def show():
            self.browser.get(f"{self.appliance.address}#/recordings")
            if not self.events():
                self.record()
            eventually("an event", self.shown)
            self.press("Look at it")
            eventually("a picture", lambda: self.viewed()[2] > 100)
            eventually("a chart", lambda: self.browser.text("#viewer .signals .read"))
            self.browser.find_element(By.CSS_SELECTOR, "#viewer .export summary").click()
            self.browser.find_element(By.CSS_SELECTOR, "#viewer .replay summary").click()
            self.replay("Recipe 2: strict")
        for width in (1440, 390):
            with self.subTest(width=width):
                self.browser.set_window_size(width, 850)
                self.expect_no_barriers(show)
                self.expect_fits_its_width()

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
        self.assertGreater(event["pictures"], 10)
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
