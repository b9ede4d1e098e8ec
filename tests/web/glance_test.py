# SPDX-License-Identifier: Apache-2.0
"""The process at one glance: on a desktop, a tablet and a phone.

Folders: app/ports/web/page/files/process app/ports/web/page/files/elements
"""

import json
import re
import unittest
import urllib.request

from selenium.webdriver.common.by import By

from appliance import ALARM_S, PATIENCE_S, eventually
from browser import HOLD_DECODING, module_address
from page_case import ZONE, PageCase

# Levels of alarms that are not warnings, and states that need nobody, by proc/signals/alarm.h.
ALARM_LEVELS, WARNING_LEVELS, CALM_STATES = {1, 4, 5}, {2, 3}, {0, 6}


class Glance(PageCase):
    def show(self, width, height, page="process"):
        self.browser.show_on(width, height)
        self.browser.get(f"{self.appliance.address}#/{page}")
        eventually("the page shows the state", lambda: "running" in self.browser.text("#condition"))

    def show_process(self, width, height):
        self.show(width, height)
        eventually("view, key figures and charts", lambda: self.browser.execute_script("""
            return document.querySelector('#regions canvas').dataset.number
              && document.querySelector('#regions polyline') && document.querySelector('.key')
              && document.querySelectorAll('#charts .plot .grid text').length > 0;"""))

    def api(self, path):
        with urllib.request.urlopen(f"{self.appliance.address}api/v1/{path}", timeout=PATIENCE_S) as answer:
            return json.load(answer)

    def boxes(self, selector):
        """Left, top, right and bottom of the shown elements."""
        return self.browser.execute_script("""
            return [...document.querySelectorAll(arguments[0])].map((one) => one.getBoundingClientRect())
              .filter(({ width }) => width > 0)
              .map(({ left, top, right, bottom }) => [left, top, right, bottom]);""",
            selector)

    def expect_inside(self, width, height, *selectors):
        for selector in selectors:
            boxes = self.boxes(selector)
            self.assertTrue(boxes, selector)
            for box in boxes:
                self.assertGreaterEqual(min(box[:2]), 0, f"{selector} {box}")
                self.assertLessEqual(box[2], width, f"{selector} {box}")
                self.assertLessEqual(box[3], height, f"{selector} {box}")

    def test_view_key_figures_alarms_and_charts_need_no_scrolling(self):
        self.show_process(1440, 900)
        self.browser.keep_picture("glance")
        self.expect_fits_its_width()
        self.expect_inside(1440, 900, "#regions figure", ".key", "#alarms", "#charts .plot", "#charts .grid text")
        hidden = self.browser.execute_script("""
            const list = document.querySelector('#alarms ul');
            return list.scrollHeight - list.clientHeight;""")
        self.assertLessEqual(hidden, 0)
        [view], keys, charts = self.boxes("#regions figure"), self.boxes(".key"), self.boxes("#charts .plot")
        self.assertGreaterEqual(min(left for left, *_ in keys), view[2])
        self.assertGreaterEqual(min(top for _, top, *_ in charts), view[3])

    def test_a_tablet_shows_view_key_figures_and_alarms_at_once(self):
        self.show_process(1024, 768)
        self.browser.keep_picture("glance-tablet")
        self.expect_fits_its_width()
        self.expect_inside(1024, 768, "#regions figure", ".key", "#alarms")

    def cut(self):
        """Parts that are wider than they show, and values beyond the screen."""
        return self.browser.execute_script("""
            const width = document.documentElement.clientWidth;
            return [...document.querySelectorAll('.figures, .cards, .key, #alarms, #alarms ul, .chart, td.figure')]
              .filter((one) => one.checkVisibility())
              .filter((one) => one.scrollWidth > one.clientWidth || one.getBoundingClientRect().right > width)
              .map((one) => `${one.className} ${one.scrollWidth} ${one.clientWidth} ` +
                one.textContent.slice(0, 50));""")

    def open_all(self, page):
        self.browser.execute_script(
            "for (const one of document.querySelectorAll(`#${arguments[0]} details`)) one.open = true;", page)

    def test_a_phone_cuts_no_value_off(self):
        self.show_process(390, 844)
        eventually("an event of an alarm", lambda: self.browser.find_elements(
            By.CSS_SELECTOR, "#alarm-history tbody tr"), ALARM_S)
        self.browser.keep_picture("glance-phone")
        self.open_all("process")
        eventually("all signals", lambda: len(self.boxes("#charts .figures td.figure")) > 100)
        self.expect_fits_its_width()
        self.assertEqual(self.cut(), [])
        self.show(390, 844, "system")
        self.open_all("system")
        eventually("figures", lambda: len(self.boxes("#system .figures td.figure")) > 10)
        self.assertEqual(self.cut(), [])

    def test_key_figures_are_the_signals_with_limits(self):
        self.show_process(1440, 900)
        recipe = self.api("recipe")
        keys = {key.get_attribute("data-key"): key
                for key in self.browser.find_elements(By.CSS_SELECTOR, ".key")}
        self.assertEqual(set(keys), {f"{alarm['region']} {alarm['signal']}" for alarm in recipe["alarms"]})
        for alarm in recipe["alarms"]:
            name = f"{alarm['region']} {alarm['signal']}"
            self.assertIn(alarm["title"], keys[name].text)
            value = eventually("a value", lambda name=name: re.fullmatch(r"-?\d+(\.\d+)?", self.browser.text(
                f"[data-key='{name}'] .value")))[0]
            history = self.api(f"history?region={alarm['region']}&figure={alarm['signal']}")
            measured = [one for side in ("low", "high") for one in history[side] if one is not None]
            self.assertLessEqual(min(measured) - 1, float(value))
            self.assertGreaterEqual(max(measured) + 1, float(value))
            eventually("its spark line", lambda name=name: any(self.browser.execute_script("""
                const canvas = document.querySelector(arguments[0]);
                const copy = new OffscreenCanvas(canvas.width, canvas.height)
                  .getContext('2d', { willReadFrequently: true });
                copy.drawImage(canvas, 0, 0);
                return [...copy.getImageData(0, 0, canvas.width, canvas.height).data];""",
                f"[data-key='{name}'] canvas")))
            keys[name].click()
            self.assertEqual(self.browser.find_element(
                By.CSS_SELECTOR, f"[data-region={alarm['region']}] [name=signal]").get_property("value"),
                alarm["signal"])
        self.assertEqual(self.browser.text("[data-key='pool hot_spot_width'] small"), "mm")
        self.assertEqual(self.browser.text("[data-key='pool hot_spot_peak_temperature'] small"), "°C")
        self.assertEqual(self.browser.complaints(), [])

    def test_events_of_alarms_have_local_times(self):
        self.browser.live_in(ZONE)
        self.show_process(1440, 900)
        self.expect_local_times("history/alarms", "alarms", "#alarm-history")

    def test_a_late_answer_does_not_replace_newer_events(self):
        self.browser.ignore_policy()
        self.show(1440, 900, "system")
        names = self.browser.execute_async_script("""
            const [module, done] = arguments, fetched = window.fetch, answers = [];
            window.fetch = (address, ...more) => (address === 'api/v1/history/alarms'
              ? new Promise((answer) => answers.push(answer)) : fetched(address, ...more));
            const event = (name) => ({ name, time: '2026-01-01T00:00:00Z', event_text: '', level_text: '', value: 1,
              limit: 1, unit: 'mm' });
            const answer = (request, ...names) =>
              answers[request](new Response(JSON.stringify({ alarms: names.map(event) })));
            import(module).then(async ({ AlarmHistory }) => {
              const history = new AlarmHistory(), reads = [5, 6].map((count) => history.refresh(count));
              answer(1, 'first', 'second');
              await reads[1];
              answer(0, 'first');
              await reads[0];
              done([...history.body.rows].map(({ cells }) => cells[1].textContent));
            }).catch((wrong) => done(String(wrong)));""", module_address("process/alarm_history.js"))
        self.assertEqual(names, ["second", "first"])

    def test_events_are_read_again_after_a_lost_connection(self):
        self.show_process(1440, 900)
        self.browser.silence_pipeline()  # the number of events stays the same
        self.browser.hold_answers("nothing")
        self.browser.execute_script("""
            Object.defineProperty(document, 'hidden', { value: true, configurable: true });
            document.dispatchEvent(new Event('visibilitychange')); // closes the stream
            delete document.hidden;
            document.dispatchEvent(new Event('visibilitychange'));""")
        eventually("they are asked for", lambda: self.browser.asked("history/alarms"))

    def test_a_picture_that_is_decoded_after_another_view_was_chosen_is_not_drawn(self):
        self.browser.ignore_policy()
        self.show(1440, 900, "system")
        drawn = self.browser.execute_async_script(f"""{HOLD_DECODING}
            const [module, done] = arguments, drawn = [];
            const views = ['former', 'chosen'].map((name) => ({{ name, width: 8, height: 8 }}));
            const recipe = Object.assign(new EventTarget(),
              {{ stated: {{ number: 1, views }}, regions: [], removed: [] }});
            import(module).then(({{ RegionEditor }}) => {{
              const editor = new RegionEditor(recipe, {{ ofView: () => '' }}, false, () => {{}});
              const send = (name, number) => editor.picture({{ head: {{ name, number, age_ms: 0 }}, body: '' }});
              editor.freshness.drew = () => {{
                drawn.push(editor.canvas.dataset.number);
                if (drawn.at(-1) === '2') done(drawn);
              }};
              recipe.dispatchEvent(new Event('change'));
              send('former', 1);
              editor.view.value = 'chosen';
              editor.view.dispatchEvent(new Event('change'));
              send('chosen', 2);
              release();
            }}).catch((wrong) => done(String(wrong)));""", module_address("process/region_editor.js"))
        self.assertEqual(drawn, ["2"])

    def expected_mark(self, alarms):
        """Class of the worst alarm that is active or not acknowledged."""
        levels = {level for alarm in alarms if alarm["state"] not in CALM_STATES
                  for level in (alarm["level"], alarm["announced"])}
        return "alarm" if levels & ALARM_LEVELS else "warning" if levels & WARNING_LEVELS else ""

    def test_a_region_and_its_key_figure_have_the_colour_of_their_alarm(self):
        self.show_process(1440, 900)

        def marked():
            alarms = self.api("status")["alarms"]
            shown = self.browser.execute_script("""
                const texts = [...document.querySelectorAll('#regions svg text')];
                const of = (name) => texts.find(({ textContent }) => textContent === name).getAttribute('class');
                return [of('pool'), of('surroundings'),
                  ...[...document.querySelectorAll('.key')].map(({ className }) => className)];""")
            own = [self.expected_mark([alarm]) for alarm in alarms]
            return any(own) and shown == [self.expected_mark(alarms), "", *(f"key {mark}" for mark in own)]

        eventually("the colours of the alarms", marked, ALARM_S)
        self.browser.keep_picture("glance-alarm")
        colour = self.browser.execute_script("""
            const line = document.querySelector('#regions polyline.warning, #regions polyline.alarm');
            return line && getComputedStyle(line).stroke;""")
        red, _, blue = (int(part) for part in re.findall(r"\d+", colour))
        self.assertGreater(red, blue + 80)

    def test_a_silent_pipeline_draws_no_values(self):
        self.show_process(1440, 900)
        eventually("a value", lambda: re.search(r"\d", self.browser.text("[data-region=pool] .read .first")))
        self.browser.silence_pipeline()
        eventually("no values in key figures and charts", lambda: self.browser.execute_script("""
            const texts = (selector) => [...document.querySelectorAll(selector)].map(({ textContent }) => textContent);
            return texts('.key .value').every((text) => text === '–')
              && texts('#charts .read .first').every((text) => text.endsWith('–'))
              && document.querySelectorAll('#regions .warning, #regions .alarm').length === 0;"""))
        self.assertIn("stale", self.browser.find_element(By.TAG_NAME, "body").get_attribute("class"))
        self.browser.keep_picture("glance-silent")


class GlanceByRole(PageCase):
    def test_only_roles_that_may_acknowledge_are_offered_it(self):
        self.add_users("viewer", "operator")
        for role in ("viewer", "operator"):
            for path in ("#/process", "operator"):
                with self.subTest(role=role, path=path):
                    self.log_in_as(role, path)
                    eventually("alarms", lambda: self.browser.find_elements(By.CSS_SELECTOR, "#alarms li"))
                    buttons = self.browser.find_elements(By.CSS_SELECTOR, "#alarms button")
                    self.assertEqual(len(buttons), 0 if role == "viewer" else 1 + len(
                        self.browser.find_elements(By.CSS_SELECTOR, "#alarms li")))


if __name__ == "__main__":
    unittest.main()
