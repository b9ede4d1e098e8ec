# SPDX-License-Identifier: Apache-2.0
"""Titles, units and digits of figures on the page.

Folders: app/ports/web/page/files/elements app/ports/web/page/files/process proc/signals
"""

import re
import unittest

from selenium.webdriver.common.by import By

from appliance import eventually
from browser import module_address
from page_case import PageCase

# Digits and unit of a value in a table: three or four significant digits, or a whole number.
AMOUNT = re.compile(r"^(–|-?\d+|-?\d{2,3}\.\d|-?[1-9]\.\d{2}|-?0\.[1-9]\d{2}|-?0\.0\d{3})$")


class Figures(PageCase):
    def text_of(self, value, unit):
        return self.browser.execute_async_script("""
            const [module, value, unit, done] = arguments;
            import(module).then(({ amountText }) => done(amountText(value, unit)), (wrong) => done(String(wrong)));""",
            module_address("elements/amounts.js"), value, unit)

    def test_amounts_have_sensible_digits_and_symbols(self):
        self.browser.ignore_policy()
        self.browser.get(self.appliance.address)
        for value, unit, text in (
                (0.0003963, "deg", "0.0004°"), (8.4, "mm", "8.40 mm"), (26, "mm", "26 mm"),
                (110.249, "mm", "110.2 mm"), (1523.37, "degC", "1523 °C"), (-0.25, "deg", "-0.250°"),
                (12.345, "deg/s", "12.3°/s"), (812.34, "mm2", "812.3 mm²"), (3.21, "mm2/s", "3.21 mm²/s"),
                (4.5, "1/s/s", "4.50 1/s²"), (20.5, "degC/s", "20.5 °C/s"), (1e-9, "deg", "0°"),
                (999.96, "degC", "1000.0 °C"), (50, "", "50"), (None, "mm", "–")):
            with self.subTest(value=value, unit=unit):
                self.assertEqual(self.text_of(value, unit), text)

    def test_signals_have_titles_units_and_digits(self):
        self.browser.get(f"{self.appliance.address}#/process")
        # A press misses if what is above grows meanwhile.
        eventually("a region", lambda: self.browser.execute_script("""
            const all = document.querySelector('[data-region=pool] .all');
            if (all) all.open = true;
            return Boolean(all);"""))
        rows = eventually("the signals", lambda: self.browser.execute_script(
            "return [...document.querySelectorAll('[data-region=pool] tbody tr')]"
            ".map((row) => [...row.cells].map((cell) => cell.textContent))"))
        shown = {row[0]: row[1:] for row in rows}
        self.assertEqual(shown["Hot spot area hot_spot_area"][1], "mm²")
        self.assertEqual(shown["Hot spot peak temperature hot_spot_peak_temperature"][1], "°C")
        self.assertEqual(shown["Hot spot yaw hot_spot_yaw"][1], "°")
        self.assertEqual(shown["Spatter rate, trend spatter_rate_trend"][1], "1/s²")
        names = {name for name in self.appliance.status()["regions"][0]
                 if name not in ("name", "quality_text")}
        self.assertEqual({row[0].split(" ")[-1] for row in rows}, names)
        for name, (value, *_) in shown.items():
            if not name.endswith(" quality"):
                self.assertRegex(value, AMOUNT, name)
        options = self.browser.find_elements(By.CSS_SELECTOR, "[data-region=pool] [name=signal] option")
        self.assertIn("Hot spot width (hot_spot_width)", [one.get_attribute("textContent") for one in options])
        self.assertEqual(self.browser.complaints(), [])


if __name__ == "__main__":
    unittest.main()
