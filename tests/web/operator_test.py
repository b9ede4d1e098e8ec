# SPDX-License-Identifier: Apache-2.0
"""The screen of the machine's panel.

Folders: app/ports/web/page/files/process app/ports/web/page/files/elements
"""

import re
import unittest

from selenium.webdriver.common.by import By

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
        eventually("the state", lambda: "running" in self.browser.text("#condition"))

    def test_notices_are_texts_because_they_can_lead_nowhere(self):
        self.show()
        self.assertTrue(self.browser.find_elements(By.CSS_SELECTOR, "#notices span.wrong"))
        self.assertEqual(self.browser.find_elements(By.CSS_SELECTOR, "#notices a, #trial button"), [])

    def expect_no_figures(self, why):
        """Key figures and the title have this reason, and nothing has the colour of an alarm."""
        eventually(why, lambda: self.browser.execute_script("""
            const keys = [...document.querySelectorAll('#operator .key')], text = (key, part) =>
              key.querySelector(part).textContent;
            const quiet = getComputedStyle(document.querySelector('.key small')).color;
            const coloured = [...document.querySelectorAll('.key .value, #alarms .state, #notices .wrong')]
              .filter((one) => getComputedStyle(one).color !== quiet);
            return document.title.startsWith(arguments[0]) && coloured.length === 0 && keys.every((key) =>
              text(key, '.value') === '–' && text(key, '.state') === arguments[0]);""", why))

    def test_a_silent_pipeline_leaves_no_figures(self):
        self.show()
        self.browser.silence_pipeline()
        self.expect_no_figures("The pipeline does not report")
        self.browser.keep_picture("operator-silent")
        self.assertEqual(self.browser.text("#condition"), "The pipeline does not report")

    def test_a_lost_connection_leaves_no_figures(self):
        self.show()
        self.appliance.stop()
        self.addCleanup(lambda: self.appliance.daemon.poll() is None or self.appliance.start())
        self.expect_no_figures("No connection to the appliance: trying again")
        self.browser.keep_picture("operator-lost")
        self.appliance.start()
        eventually("figures again", lambda: re.search(r"\d", self.browser.text("#operator .key .value")))
        self.assertNotIn("No connection", self.browser.title)
        self.assertNotIn("stale", self.browser.find_element(By.TAG_NAME, "body").get_attribute("class"))

    def restart_with(self, file, text):
        if self.appliance.daemon.poll() is None:
            self.appliance.stop()
        file.write_text(text, encoding="utf-8")
        self.appliance.start()

    def test_a_view_that_a_restart_renames_is_shown_by_its_new_name(self):
        self.show()
        recipe = self.appliance.folder / "demo-recipe.toml"
        before = recipe.read_text(encoding="utf-8")
        self.addCleanup(self.restart_with, recipe, before)
        self.appliance.stop()
        number = "return document.querySelector('#operator #regions canvas').dataset.number"
        last = self.browser.execute_script(number)
        self.restart_with(recipe, before.replace('"process"', '"melt"'))
        eventually("its pictures", lambda: self.browser.execute_script(
            "return document.querySelector('#operator [name=view]').value") == "melt"
            and self.browser.execute_script(number) != last)
        eventually("the state", lambda: self.browser.text("#condition").startswith("running"))

    def test_it_keeps_nobody_out(self):
        self.expect_no_barriers(self.show)


if __name__ == "__main__":
    unittest.main()
