# SPDX-License-Identifier: Apache-2.0
"""Limits and regions of the recipe, changed on the page of a running daemon.

Folders: app/ports/web/process app/ports/web/page/files/process app/files
"""

import difflib
import json
import tomllib
import unittest
import urllib.request

from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.select import Select

from appliance import PATIENCE_S, eventually
from configuration_test import Configured
from page_case import PageCase


class RecipeOnThePage(PageCase):
    @classmethod
    def make_appliance(cls):
        return Configured()

    def setUp(self):
        super().setUp()
        self.before = self.appliance.recipe.read_bytes()
        self.browser.get(f"{self.appliance.address}#/process")
        eventually("regions over a picture", lambda: self.browser.execute_script(
            "return document.querySelectorAll('#regions polyline').length > 1"
            " && document.querySelector('#regions canvas').dataset.number"))
        self.find("#regions summary").click()
        eventually("handles", lambda: self.browser.find_elements(By.CSS_SELECTOR, "#regions [data-corner]"))

    def recipe(self):
        """Recipe in force, from the interface."""
        with urllib.request.urlopen(self.appliance.address + "api/v1/recipe",
                                    timeout=PATIENCE_S) as answer:
            return json.load(answer)

    def region(self, name):
        return next(one for one in self.recipe()["regions"] if one["name"] == name)

    def find(self, selector):
        element = self.browser.find_element(By.CSS_SELECTOR, selector)
        self.browser.execute_script("arguments[0].scrollIntoView({block: 'center'})", element)
        return element

    def press(self, label, part="recipe"):
        self.find(f"#{part}").find_element(By.XPATH, f".//button[text()='{label}']").click()

    def said(self):
        return self.browser.text("#recipe [role=status]")

    def drag_a_limit(self):
        """Drags the high warning of the width upwards; returns its new value on the page."""
        Select(self.find("[data-region=pool] [name=signal]")).select_by_value("hot_spot_width")
        eventually("its lines", lambda: self.browser.find_elements(
            By.CSS_SELECTOR, "[data-limit='1 high_warning'] .grip[y1]"))
        self.find("[data-region=pool] .plot")
        # A chart that takes another scale moves its lines: whoever misses one pulls again.
        dragged = eventually("it is dragged", lambda: self.drag_up(
            "[data-limit='1 high_warning'] .grip", "high_warning", 26))
        line = self.browser.find_element(By.CSS_SELECTOR, "[data-limit='1 high_warning']")
        line.send_keys(Keys.ARROW_UP)
        pressed = self.shown("high_warning")
        self.assertGreater(pressed, dragged)
        return pressed

    def drag_up(self, grip, limit, above):
        """Pulls a line upwards; returns its value when that is above the given one."""
        ActionChains(self.browser).move_to_element(
            self.browser.find_element(By.CSS_SELECTOR, grip)).click_and_hold().move_by_offset(
                0, -7).release().perform()
        value = self.shown(limit)
        return value if value > above else None

    def test_a_limit_grips_on_its_whole_length(self):
        Select(self.find("[data-region=pool] [name=signal]")).select_by_value("hot_spot_width")
        eventually("its lines", lambda: self.browser.find_elements(
            By.CSS_SELECTOR, "[data-limit='1 high_warning'] .grip[y1]"))
        self.find("[data-region=pool] .plot")
        shares = self.browser.execute_script("""
            const shares = {};
            for (const grip of document.querySelectorAll('[data-region=pool] .limit .grip')) {
              const limit = grip.parentElement, box = grip.ownerSVGElement.getBoundingClientRect();
              if (limit.getAttribute('visibility') === 'hidden') continue;
              const y = box.top + Number(grip.getAttribute('y1'));
              let gripped = 0;
              for (let x = 1; x < box.width - 1; ++x) {
                const pressed = document.elementFromPoint(box.left + x, y);
                if (pressed?.classList.contains('grip')) ++gripped;
              }
              shares[limit.dataset.limit] = gripped / Math.ceil(box.width - 2);
            }
            return shares;""")
        self.assertIn("1 high_warning", shares)
        self.assertGreater(min(shares.values()), 0.99, shares)

    def shown(self, limit):
        return float(self.find(f"[data-region=pool] .limits [name={limit}]").get_property("value"))

    def move_a_corner(self):
        """Moves the pool's first corner by keys."""
        Select(self.find("#regions [name=region]")).select_by_value("pool")
        corner = self.find("#regions [data-corner='0']")
        corner.send_keys(Keys.SHIFT + Keys.ARROW_LEFT)
        eventually("it is settled", lambda: self.browser.execute_script(
            "return !document.querySelector('#recipe > button').disabled"))

    def draw_a_region(self):
        for name, value in (("name", "seam"), ("threshold", "900")):
            self.find(f"#regions form [name={name}]").send_keys(value)
        self.find("#regions form button").click()
        eventually("it is there", lambda: self.find(
            "#regions [name=region]").get_property("value") == "seam")
        picture = self.find("#regions svg")
        ActionChains(self.browser).move_to_element_with_offset(picture, -200, -150).click_and_hold(
            ).move_by_offset(80, 60).release().perform()
        eventually("it has an outline there", lambda: self.browser.execute_script(
            "return document.querySelector(\"#regions [data-corner='0']\").getAttribute('cx') < 200"))

    def corners(self):
        """Corners of the region that is being changed, in pixels of its view."""
        return self.browser.execute_script("""
            return [...document.querySelectorAll('#regions [data-corner]')]
              .map((corner) => ['cx', 'cy'].map((name) => Number(corner.getAttribute(name))));""")

    def shape_the_region(self):
        """Adds a corner by a finger, which pulls it out of the upper edge; adds one by keys and
        removes it."""
        before = self.corners()
        self.browser.drag_by_finger(self.find("#regions [data-edge='0']"), 0, -20)
        eventually("a corner more", lambda: len(self.corners()) == len(before) + 1)
        shaped = self.corners()
        self.assertEqual([shaped[0], *shaped[2:]], before)
        self.assertAlmostEqual(shaped[1][0], (before[0][0] + before[1][0]) / 2, delta=1)
        self.assertLess(shaped[1][1], before[0][1] - 5)
        self.find("#regions [data-edge='3']").send_keys(Keys.ENTER)
        eventually("and another one", lambda: len(self.corners()) == len(shaped) + 1)
        self.assertEqual(self.browser.switch_to.active_element.get_attribute("data-corner"), "4")
        self.browser.switch_to.active_element.send_keys(Keys.DELETE)
        eventually("it is gone again", lambda: self.corners() == shaped)
        self.press("Remove corner 5", "regions")
        eventually("the button removes one, too", lambda: self.corners() == shaped[:4])

    def delete_a_region(self):
        Select(self.find("#regions [name=region]")).select_by_value("surroundings")
        self.press("Delete the region", "regions")
        self.assertIn("Region surroundings is deleted", self.browser.text("#regions [role=status]"))

    def difference(self):
        """Removed and added lines of the file."""
        lines = [text.decode().splitlines(keepends=True)
                 for text in (self.before, self.appliance.recipe.read_bytes())]
        changes = list(difflib.ndiff(*lines))
        return [[line[2:] for line in changes if line[0] == sign] for sign in "-+"]

    def test_a_signal_without_an_alarm_gets_limits(self):
        checksum, before = self.appliance.checksum(), self.recipe()["alarms"]
        Select(self.find("[data-region=surroundings] [name=signal]")).select_by_value("spatter_rate")
        self.find("[data-region=surroundings]").find_element(By.XPATH, ".//button[text()='+ limit']").click()
        for name, value in (("high_warning", "500"), ("high_alarm", "900")):
            self.find(f"[data-region=surroundings] .limits [name={name}]").send_keys(value, Keys.TAB)
        eventually("its line", lambda: self.browser.find_elements(
            By.CSS_SELECTOR, "[data-region=surroundings] [data-limit='0 high_warning'][aria-valuenow='500']"))
        self.browser.keep_picture("new-limit")
        self.press("Check and show the difference")
        eventually("the difference", lambda: '+signal = "spatter_rate"' in self.browser.text("#recipe pre"))
        self.press("Try out")
        eventually("it runs", lambda: self.appliance.says(
            lambda: self.appliance.checksum() != checksum and self.appliance.configuration()["trial"]))
        *others, added = self.recipe()["alarms"]
        self.assertEqual(others, before)
        self.assertLessEqual({"region": "surroundings", "signal": "spatter_rate", "high_warning": 500,
                              "high_alarm": 900, "low_warning": None}.items(), added.items())
        eventually("its key figure", lambda: self.browser.find_elements(
            By.CSS_SELECTOR, "[data-key='surroundings spatter_rate']"))
        self.press("Revert now")
        eventually("the old recipe runs", lambda: self.appliance.says(lambda: self.appliance.checksum() == checksum))
        self.assertEqual(self.appliance.recipe.read_bytes(), self.before)

    def configured(self):
        """The site file, and its recipes by number."""
        site = (self.appliance.folder / "demo.toml").read_text(encoding="utf-8")
        return site, {one["number"]: one["file"] for one in tomllib.loads(site)["recipe"]}

    def type_copy(self, name, number):
        for field, value in (("copy", name), ("number", str(number))):
            shown = self.find(f"#recipe-copy [name={field}]")
            shown.clear()
            shown.send_keys(value)

    def test_a_copy_becomes_a_recipe_of_its_own(self):
        site, recipes = self.configured()
        self.assertEqual(list(recipes), [1])
        for name, number, why in (("../evil", 2, "must be 1 to 40 letters"), ("demo-rig", 2, "exists already"),
                                  ("thin", 1, "recipe 1 exists already")):
            self.type_copy(name, number)
            self.press("Check and show the difference")
            eventually(why, lambda why=why: why in self.said())
        Select(self.find("[data-region=surroundings] [name=signal]")).select_by_value("spatter_rate")
        self.find("[data-region=surroundings]").find_element(By.XPATH, ".//button[text()='+ limit']").click()
        self.find("[data-region=surroundings] .limits [name=high_alarm]").send_keys("900", Keys.TAB)
        self.type_copy("thin", 2)
        checksum = self.appliance.checksum()
        self.press("Try out")
        eventually("it runs", lambda: self.appliance.says(
            lambda: self.appliance.checksum() != checksum and self.appliance.configuration()["trial"]))
        self.assertIn({"number": 2, "name": "thin"}, self.recipe()["recipes"])
        self.assertFalse((self.appliance.folder / "thin.toml").exists())
        eventually("the page can keep it", lambda: "is reverted in" in self.browser.text("#recipe [role=timer]"))
        self.browser.keep_picture("process-copy")
        self.press("Keep it")
        eventually("the files are written", lambda: self.configured()[1] == {**recipes, 2: "thin.toml"})
        self.assertTrue(self.configured()[0].startswith(site[:site.index("[[recipe]]")]))
        copy = (self.appliance.folder / "thin.toml").read_bytes()
        self.assertIn(b'name = "thin"\r\n', copy)
        self.assertIn(b"high_alarm = 900", copy)
        self.assertEqual(self.appliance.recipe.read_bytes(), self.before)
        self.browser.execute_script("location.hash = '#/system'")
        self.find("#control > summary").click()
        eventually("it is in the list", lambda: "2 thin" in self.browser.text("#control [name=recipe]"))
        Select(self.find("#control [name=recipe]")).select_by_value("2")
        self.press("Measure by it", "control")
        eventually("it is measured by", lambda: self.appliance.status()["system"]["recipe"] == 2)
        self.assertEqual(self.recipe()["name"], "thin")
        Select(self.find("#control [name=recipe]")).select_by_value("1")
        self.press("Measure by it", "control")
        eventually("the old one again", lambda: self.appliance.status()["system"]["recipe"] == 1)

    def test_limits_and_regions_are_kept_in_the_recipe(self):
        checksum, pool = self.appliance.checksum(), self.region("pool")
        limit = self.drag_a_limit()
        self.move_a_corner()
        self.draw_a_region()
        self.shape_the_region()
        self.delete_a_region()
        self.browser.keep_picture("process-recipe")
        self.press("Check and show the difference")
        eventually("the difference",
                   lambda: '+name = "seam"' in self.browser.text("#recipe pre"))
        self.assertEqual(self.appliance.recipe.read_bytes(), self.before)
        self.press("Try out")
        eventually("it runs", lambda: self.appliance.says(
            lambda: self.appliance.checksum() != checksum
            and self.appliance.configuration()["trial"]))
        self.assertEqual(self.recipe()["alarms"][0]["high_warning"], limit)
        eventually("the page says so",
                   lambda: "is reverted in" in self.browser.text("#recipe [role=timer]"))
        eventually("the new region is measured", lambda: self.browser.find_elements(
            By.CSS_SELECTOR, "[data-region=seam]"))
        self.assertEqual(self.appliance.recipe.read_bytes(), self.before)
        self.press("Keep it")
        eventually("the file is written",
                   lambda: self.appliance.recipe.read_bytes() != self.before)

        gone, new = self.difference()
        self.assertEqual([line.split(" ")[0] for line in gone[:2]], ["points", "high_warning"])
        self.assertIn(f"high_warning = {limit:g}\r\n", new)
        self.assertTrue(any(line.endswith(
            "[-30, -130, 178], [-30, 30, 178], [-190, 30, 178]]  # the workpiece\r\n") for line in new))
        kept = tomllib.loads(self.appliance.recipe.read_text(encoding="utf-8"))
        self.assertEqual([region["name"] for region in kept["region"]], ["pool", "seam"])
        self.assertEqual(len(kept["region"][0]["alarm"]), 2)
        self.assertEqual(sorted(kept["region"][1]), ["hot_spot_threshold", "name", "points", "view"])
        self.assertEqual(len(kept["region"][1]["points"]), 4)
        # Ten pixels to the left, where the view shows the workpiece's top or the room beside it.
        moved = self.region("pool")["corners"]
        self.assertAlmostEqual(moved[0]["pixel"][0], pool["corners"][0]["pixel"][0] - 10, delta=0.01)
        self.assertAlmostEqual(moved[0]["pixel"][1], pool["corners"][0]["pixel"][1], delta=0.01)
        self.assertEqual(moved[1:], pool["corners"][1:])
        # The browser complains about the restart of the appliance, which answers 503 while it ends.
        self.assertEqual([one for one in self.browser.complaints()
                          if "ERR_" not in one["message"] and "503" not in one["message"]], [])


if __name__ == "__main__":
    unittest.main()
