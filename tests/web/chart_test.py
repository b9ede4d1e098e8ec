# SPDX-License-Identifier: Apache-2.0
"""The charts of the process page, compared with the history that the interface has.

Folders: app/ports/web/page/files/process app/ports/web/page/files/elements
"""

import datetime
import json
import re
import time
import unittest
import urllib.request
import zoneinfo

from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.select import Select

from appliance import PATIENCE_S, eventually
from page_case import ZONE, PageCase

CHART = "[data-region=pool] .chart"
STEP_S = 0.5  # of the history


class Charts(PageCase):
    def setUp(self):
        super().setUp()
        self.browser.live_in(ZONE)
        self.browser.get(f"{self.appliance.address}#/process")
        eventually("a chart with limits", lambda: self.browser.find_elements(
            By.CSS_SELECTOR, f"{CHART} [data-limit] .grip[y1]"))
        self.plot = self.browser.find_element(By.CSS_SELECTOR, f"{CHART} .plot")
        self.browser.execute_script("arguments[0].scrollIntoView({block: 'center'})", self.plot)

    def choose(self, signal, part="signal"):
        Select(self.browser.find_element(
            By.CSS_SELECTOR, f"[data-region=pool] [name={part}]")).select_by_value(signal)

    def labels(self, selector):
        """Text, x and y of labels beside the plot."""
        return self.browser.execute_script("""
            return [...document.querySelectorAll(arguments[0])].map((text) =>
              [text.textContent, ...['x', 'y'].map((name) => Number(text.getAttribute(name)))]);""",
            f"{CHART} .grid text{selector}")

    def local_now(self):
        return datetime.datetime.now(zoneinfo.ZoneInfo(ZONE))

    def seconds_ago(self, text):
        """Seconds since a time of the day in the browser's zone."""
        now = self.local_now()
        of_day = datetime.datetime.strptime(text, "%H:%M:%S" if text.count(":") == 2 else "%H:%M")
        then = now.replace(hour=of_day.hour, minute=of_day.minute, second=of_day.second,
                           microsecond=0)
        return (now - then).total_seconds() % 86400

    def widths(self):
        """Lowest width of the pool in each step, oldest first; None where it was not measured."""
        return self.history("hot_spot_width")["low"]

    def test_a_restart_is_a_gap_in_the_history(self):
        eventually("some steps", lambda: sum(width is not None for width in self.widths()) > 8)
        before = self.widths()
        self.appliance.stop()
        stopped = time.monotonic()
        eventually("two steps pass without it", lambda: time.monotonic() > stopped + 2 * STEP_S)
        self.appliance.start()
        after = eventually("it is measured again", lambda: next((
            widths for widths in [self.widths()] if len(widths) > len(before) and widths[-1] is not None), None))
        self.assertEqual(after[:len(before)], before)
        self.assertIn(None, after[len(before):])
        file = self.appliance.folder / "state/figure-history"
        self.assertEqual(file.stat().st_mode & 0o777, 0o600)

    def test_ticks_are_round_local_times_and_equidistant_round_values(self):
        labels = eventually("labels of the time axis", lambda: self.labels(":not(.first)"))
        times = [text for text, _, _ in labels if text != "now"]
        self.assertEqual(len(times), len(labels) - 1)
        self.assertGreaterEqual(len(times), 3)
        for time in times:
            self.assertLess(self.seconds_ago(time), 605, time)
        minutes = [int(time[3:]) for time in times]
        step = (minutes[1] - minutes[0]) % 60
        self.assertIn(step, (1, 2, 5, 10))
        self.assertEqual({minute % step for minute in minutes}, {0})
        width = self.plot.size["width"]
        for text, x, _ in labels:
            expected = width if text == "now" else width * (1 - self.seconds_ago(text) / 600)
            self.assertAlmostEqual(x, expected, delta=0.01 * width, msg=text)

        values = [(float(text), y) for text, _, y in self.labels(".first") if re.match(r"^[-0-9]", text)]
        self.assertGreaterEqual(len(values), 3)
        (first, y0), (second, y1) = values[:2]
        for n, (value, y) in enumerate(values):
            self.assertAlmostEqual(value, first + n * (second - first), delta=1e-6)
            self.assertAlmostEqual(y, y0 + n * (y1 - y0), delta=0.01)
        self.assertLess(y1, y0)

    def test_no_label_lies_on_the_plot(self):
        self.choose("hot_spot_width", "compared")
        eventually("a second axis", lambda: self.labels(".second"))
        over = self.browser.execute_script("""
            const plot = arguments[0].querySelector('canvas').getBoundingClientRect(), over = [];
            for (const text of arguments[0].querySelectorAll('text')) {
              const box = text.getBoundingClientRect();
              const isBeside = box.right <= plot.left || box.left >= plot.right || box.bottom <= plot.top ||
                box.top >= plot.bottom;
              if (!isBeside && text.checkVisibility({ visibilityProperty: true })) over.push(text.textContent);
            }
            return over;""", self.plot)
        self.assertEqual(over, [])
        widths = self.browser.execute_script(
            "return [document.documentElement.scrollWidth, document.documentElement.clientWidth]")
        self.assertLessEqual(*widths)

    def history(self, figure):
        with urllib.request.urlopen(
                f"{self.appliance.address}api/v1/history?region=pool&figure={figure}",
                timeout=PATIENCE_S) as answer:
            return json.load(answer)

    def read(self):
        """What is stated above the plot: signal with value, and the moment."""
        return self.browser.text(f"{CHART} .read .first"), self.browser.text(f"{CHART} .read > :last-child")

    def expect_reading(self, ago):
        """Checks the reading of a moment so many seconds ago."""
        text, when = self.read()
        self.assertAlmostEqual(self.seconds_ago(when), ago, delta=5)
        history = self.history("hot_spot_peak_temperature")
        measured = [value for side in ("low", "high") for value in history[side] if value is not None]
        values = [float(number) for number in re.findall(r"-?\d+(?:\.\d+)?", text)]
        self.assertIn(len(values), (1, 2), text)
        for value in values:
            self.assertGreaterEqual(value, min(measured) - 1)
            self.assertLessEqual(value, max(measured) + 1)

    def test_values_at_the_pointer_are_those_of_the_history(self):
        eventually("20 s of measurements", lambda: len(
            [low for low in self.history("hot_spot_peak_temperature")["low"] if low is not None]) > 20)
        self.assertEqual(self.read()[1], "now")
        width = self.plot.size["width"]
        at = round(width / 2 - 10 * width / 600)  # 10 s before the right end
        ActionChains(self.browser).move_to_element_with_offset(self.plot, at, 0).perform()
        eventually("the measurement there", lambda: ":" in self.read()[1] and "–" not in self.read()[0])
        self.expect_reading(10)
        self.assertEqual(len(self.browser.find_elements(By.CSS_SELECTOR, f"{CHART} .cursor circle")), 1)
        self.browser.keep_picture("chart")
        ActionChains(self.browser).move_to_element(
            self.browser.find_element(By.TAG_NAME, "h1")).perform()
        eventually("the newest values again", lambda: self.read()[1] == "now")

        box = self.plot.rect
        left, top = self.browser.execute_script(
            "const box = arguments[0].getBoundingClientRect(); return [box.left, box.top];", self.plot)
        self.browser.touch("touchStart", [(left + box["width"] / 2 + at, top + box["height"] / 2)])
        self.browser.touch("touchEnd", [])
        eventually("a finger does the same", lambda: ":" in self.read()[1])
        self.expect_reading(10)
        elsewhere = self.browser.find_element(By.CSS_SELECTOR, "[data-region=pool] h3")
        self.browser.execute_script("arguments[0].scrollIntoView({ block: 'center' });", elsewhere)
        self.browser.tap(elsewhere)
        eventually("a finger elsewhere ends it", lambda: self.read()[1] == "now")

    def test_keys_move_along_the_chart(self):
        canvas = self.plot.find_element(By.TAG_NAME, "canvas")
        canvas.send_keys(Keys.ARROW_LEFT)
        self.assertEqual(canvas.get_attribute("aria-valuenow"), "-1")
        canvas.send_keys(Keys.SHIFT + Keys.ARROW_LEFT)
        self.assertEqual(canvas.get_attribute("aria-valuenow"), "-11")
        when = re.match(r"(\d\d:\d\d:\d\d): ", canvas.get_attribute("aria-valuetext"))[1]
        self.assertAlmostEqual(self.seconds_ago(when), 11, delta=5)
        canvas.send_keys(Keys.HOME)
        self.assertEqual(canvas.get_attribute("aria-valuenow"), "-600")
        canvas.send_keys(Keys.ARROW_LEFT)
        self.assertEqual(canvas.get_attribute("aria-valuenow"), "-600")
        canvas.send_keys(Keys.ESCAPE)
        self.assertEqual(self.read()[1], "now")

    def bands(self):
        """Top, bottom and colour of each range beyond a limit, and the height of its line."""
        return self.browser.execute_script("""
            const bands = {};
            for (const limit of arguments[0].querySelectorAll('.limit')) {
              if (limit.getAttribute('visibility') === 'hidden') continue;
              const [, name] = limit.dataset.limit.split(' '), band = limit.querySelector('.band');
              const top = Number(band.getAttribute('y'));
              bands[name] = { top, bottom: top + Number(band.getAttribute('height')),
                line: Number(limit.querySelector('line').getAttribute('y1')),
                colour: getComputedStyle(band).fill };
            }
            return bands;""", self.plot)

    def test_ranges_beyond_limits_are_shaded_amber_and_red(self):
        bands = self.bands()
        self.assertEqual(set(bands), {"high_warning", "high_alarm"})
        warning, alarm = bands["high_warning"], bands["high_alarm"]
        self.assertAlmostEqual(warning["bottom"], warning["line"], delta=0.01)
        self.assertAlmostEqual(warning["top"], alarm["line"], delta=0.01)
        self.assertAlmostEqual(alarm["bottom"], alarm["line"], delta=0.01)
        self.assertEqual(alarm["top"], 0)
        self.assertGreater(alarm["bottom"], 5)
        for band, is_amber in ((warning, True), (alarm, False)):
            red, green, blue = (int(part) for part in re.findall(r"\d+", band["colour"]))
            self.assertGreater(red, blue + 80)
            self.assertEqual(green > 0.4 * red, is_amber, band["colour"])
        self.choose("hot_spot_width")
        eventually("its limits", lambda: set(self.bands()) == {"low_warning", "high_warning"})
        bands = self.bands()
        self.assertEqual(bands["high_warning"]["top"], 0)
        self.assertAlmostEqual(bands["low_warning"]["top"], bands["low_warning"]["line"], delta=0.01)
        self.assertAlmostEqual(bands["low_warning"]["bottom"], self.plot.size["height"], delta=2.5)

    def drawn_colours(self):
        """Whether pixels of the plot have the colour of each stated signal."""
        return self.browser.execute_script("""
            const canvas = arguments[0].querySelector('canvas');
            const copy = new OffscreenCanvas(canvas.width, canvas.height)
              .getContext('2d', { willReadFrequently: true });
            copy.drawImage(canvas, 0, 0);
            const { data } = copy.getImageData(0, 0, canvas.width, canvas.height);
            const found = new Set();
            for (let k = 0; k < data.length; k += 4) {
              if (data[k + 3] === 255) found.add(`rgb(${data[k]}, ${data[k + 1]}, ${data[k + 2]})`);
            }
            return [...arguments[0].parentElement.querySelectorAll('.read .first, .read .second')]
              .map((signal) => found.has(getComputedStyle(signal).color));""", self.plot)

    def test_two_signals_are_compared(self):
        eventually("one curve", lambda: self.drawn_colours() == [True, False])
        self.choose("hot_spot_mean_temperature", "compared")
        eventually("two curves", lambda: self.drawn_colours() == [True, True])
        self.assertEqual(self.labels(".second"), [])  # one axis for one unit
        self.assertIn("Hot spot mean temperature", self.browser.text(f"{CHART} .read .second"))
        self.choose("hot_spot_width", "compared")
        eventually("an axis of its own", lambda: len(self.labels(".second")) >= 3)
        self.browser.keep_picture("chart-compared")
        self.choose("", "compared")
        eventually("one curve again", lambda: self.drawn_colours() == [True, False])
        self.assertEqual(self.browser.complaints(), [])


if __name__ == "__main__":
    unittest.main()
