# SPDX-License-Identifier: Apache-2.0
"""A recorded event in the viewer of Recordings: its pictures, signals and regions, exports and replays.

Folders: app/ports/web/page/files/recordings app/ports/web/recordings app/ports/recorder
"""

import json
import pathlib
import re
import shutil
import tempfile
import unittest
import urllib.error
import urllib.request

from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import Select

from appliance import PATIENCE_S, eventually
from recordings_case import RecordingsCase


class EventViewer(RecordingsCase):
    def cursor(self):
        """Place of the chart's cursor, share of its width."""
        return self.browser.execute_script("""
            const line = document.querySelector('#viewer .cursor line');
            return Number(line.getAttribute('x1')) / document.querySelector('#viewer .plot').clientWidth;""")

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

    def test_another_event_shows_nothing_of_the_one_before(self):
        self.look_at_one()
        self.browser.find_element(By.CSS_SELECTOR, "#viewer .export summary").click()
        before = self.events()[0]["name"]
        self.record()
        newer = eventually("the newer one", lambda: next(
            (one["name"] for one in self.events() if one["name"] != before and one["is_finished"]), None))
        eventually("both can be looked at", lambda: len(self.browser.find_elements(
            By.XPATH, "//*[@id='events']//button[text()='Look at it' and not(@disabled)]")) == 2)
        self.browser.hold_answers("recordings/frames")
        self.press("Look at it")
        eventually("its pictures are asked for", lambda: self.browser.held_answers() == 1)
        for part in (".stage", ".export form"):
            self.assertFalse(self.browser.find_element(By.CSS_SELECTOR, f"#viewer {part}").is_displayed(), part)
        self.assertEqual(self.browser.text("#viewer output"), "")
        self.assertIsNone(self.browser.find_element(By.CSS_SELECTOR, "#viewer img").get_dom_attribute("src"))
        self.assertEqual(self.browser.find_elements(By.CSS_SELECTOR, "#viewer [name=camera] option"), [])
        self.browser.let_go()
        eventually("a picture", lambda: self.viewed()[2] > 100)
        source = self.browser.find_element(By.CSS_SELECTOR, "#viewer img").get_property("src")
        self.assertIn(newer, source)
        self.assertNotIn(before, source)
        self.assertEqual(self.browser.text("#viewer [role=alert]"), "")
        self.assertTrue(self.browser.find_element(By.CSS_SELECTOR, "#viewer .export form").is_displayed())
        self.assertEqual(self.browser.complaints(), [])

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


if __name__ == "__main__":
    unittest.main()
