# SPDX-License-Identifier: Apache-2.0
"""The screen of the machine's panel.

Folders: app/ports/web/page/files/process app/ports/web/page/files/elements
"""

import unittest

from appliance import eventually
from page_case import PageCase

MOST_KEYS = 5
# Least height of digits for 3 m, by the rule of a 200th of the distance: 15 mm, on a panel of 0.27 mm per pixel. Digits
# have about 0.7 of the size of their font.
LEAST_FONT_PX = 15 / 0.27 / 0.7


class OperatorScreen(PageCase):
    def show(self, width=1920, height=1080):
        self.browser.show_on(width, height)
        self.browser.get(f"{self.appliance.address}operator")
        eventually("view, key figures and alarms", lambda: self.browser.execute_script("""
            return document.querySelector('#operator #regions canvas')?.dataset.number
              && document.querySelector('#operator .key .value')?.textContent
              && document.querySelector('#operator #alarms li');"""))

    def shown(self, selector):
        return self.browser.execute_script(
            "return [...document.querySelectorAll(arguments[0])].filter((one) => one.checkVisibility()).length", selector)

    def test_it_is_read_from_afar_without_scrolling(self):
        self.show()
        self.assertIn(self.shown("#operator .key"), range(1, MOST_KEYS + 1))
        size = self.browser.execute_script(
            "return parseFloat(getComputedStyle(document.querySelector('.key .value')).fontSize)")
        self.assertGreaterEqual(size, LEAST_FONT_PX)
        self.assertTrue(self.browser.execute_script(
            "const { scrollHeight, clientHeight } = document.documentElement; return scrollHeight <= clientHeight;"))
        self.expect_fits_its_width()
        self.browser.keep_picture("operator")
        self.assertEqual(self.browser.complaints(), [])

    def test_it_has_no_menus(self):
        self.show()
        self.assertEqual(self.shown("nav, select, #account"), 0)
        self.assertIn("running", self.browser.text("#condition"))

    def test_it_keeps_nobody_out(self):
        self.expect_no_barriers(self.show)


if __name__ == "__main__":
    unittest.main()
