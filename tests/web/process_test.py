# SPDX-License-Identifier: Apache-2.0
"""Limits and regions of the recipe, changed on the page of a running daemon.

Folders: app/ports/web/process app/ports/web/page/files/process app/files
"""

import difflib
import tomllib
import unittest

from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.select import Select

from appliance import eventually
from process_case import ProcessCase


class RecipeOnThePage(ProcessCase):
    def region(self, name):
        return next(one for one in self.recipe()["regions"] if one["name"] == name)

    def drag_a_limit(self):
        """Drags the high warning of the width upwards; returns its new value on the page."""
        self.choose_signal("pool", "hot_spot_width")
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
        self.choose_signal("pool", "hot_spot_width")
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

    def move_a_corner(self):
        """Moves the pool's first corner by keys."""
        Select(self.find("#regions [name=region]")).select_by_value("pool")
        corner = self.find("#regions [data-corner='0']")
        corner.send_keys(Keys.SHIFT + Keys.ARROW_LEFT)
        eventually("it is settled", self.has_unsent)

    def name_a_region(self, name):
        """Adds a region in the middle of the view."""
        for field, value in (("name", name), ("threshold", "900")):
            self.find(f"#regions form [name={field}]").send_keys(value)
        self.find("#regions form button").click()

    def draw_a_region(self):
        self.name_a_region("seam")
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
        self.choose_signal("surroundings", "spatter_rate")
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
        eventually("the page can end it", lambda: "is reverted in" in self.browser.text("#recipe [role=timer]"))
        self.press("Revert now")
        eventually("the old recipe runs", lambda: self.appliance.says(lambda: self.appliance.checksum() == checksum))
        self.assertEqual(self.appliance.recipe.read_bytes(), self.before)

    def try_out(self):
        """Begins a trial that the page can end."""
        checksum = self.appliance.checksum()
        self.press("Try out")
        self.expect_trial(checksum)

    def expect_trial(self, checksum):
        """Waits for a trial that the page can end, of another configuration than that of the checksum."""
        eventually("it runs", lambda: self.appliance.says(
            lambda: self.appliance.checksum() != checksum and self.appliance.configuration()["trial"]))
        eventually("the page can end it", lambda: "is reverted in" in self.browser.text("#recipe [role=timer]"))

    def test_changes_come_back_after_a_trial_that_is_not_kept(self):
        checksum = self.appliance.checksum()
        self.choose_signal("pool", "hot_spot_width")
        self.type_limit("high_warning", 27.5)
        self.draw_a_region()
        self.try_out()
        eventually("the new region is measured", lambda: self.browser.find_elements(
            By.CSS_SELECTOR, "[data-region=seam]"))
        self.assertFalse(self.has_unsent(), "they are on trial")
        self.press("Revert now")
        eventually("the old recipe runs", lambda: self.appliance.says(lambda: self.appliance.checksum() == checksum))
        eventually("the changes are back", self.has_unsent)
        self.assertEqual(self.region_names(), ["pool", "surroundings", "seam"])
        eventually("charts of the old recipe", lambda: not self.browser.find_elements(
            By.CSS_SELECTOR, "[data-region=seam]"))
        self.choose_signal("pool", "hot_spot_width")
        self.assertEqual(self.shown("high_warning"), 27.5)
        self.press("Check and show the difference")
        eventually("they can be sent again", lambda: all(
            line in self.browser.text("#recipe pre") for line in ('+name = "seam"', "+high_warning = 27.5")))
        self.press("Discard the changes")
        self.assertFalse(self.has_unsent())
        self.assertEqual(self.region_names(), ["pool", "surroundings"])
        self.assertEqual(self.appliance.recipe.read_bytes(), self.before)

    def test_a_limit_that_is_changed_while_another_one_is_sent_is_not_on_trial(self):
        checksum = self.appliance.checksum()
        self.choose_signal("pool", "hot_spot_width")
        self.type_limit("high_warning", 27.5)
        self.browser.execute_script("""
            [...document.querySelectorAll('#recipe button')].find((one) => one.textContent === 'Try out').click();
            const field = document.querySelector('[data-region=pool] .limits [name=low_warning]');
            field.value = 8;
            field.dispatchEvent(new Event('change'));""")
        self.expect_trial(checksum)
        self.assertTrue(self.has_unsent())
        self.press("Revert now")
        eventually("the old recipe runs", lambda: self.appliance.says(lambda: self.appliance.checksum() == checksum))
        eventually("both limits", lambda: self.browser.execute_script("""
            return ['low_warning', 'high_warning'].map((limit) =>
              document.querySelector(`[data-region=pool] .limits [name=${limit}]`)?.value);""") == ["8", "27.5"])
        self.assertTrue(self.has_unsent())

    def move_without_an_answer(self, requests):
        """Moves the first corner by keys; returns when the page has asked for so many coordinates, which are held."""
        self.find("#regions [data-corner='0']").send_keys(Keys.SHIFT + Keys.ARROW_LEFT)
        eventually("it is asked for", lambda: self.browser.held_answers() == requests)

    def let_all_go(self):
        """Passes on what is held; returns when the page has read it."""
        self.browser.let_go()
        self.browser.execute_async_script("fetch('api/v1/recipe').then((answer) => answer.text()).then(arguments[0])")

    def test_the_newest_corners_count_in_whichever_order_their_coordinates_come(self):
        before = self.corners()
        self.browser.hold_answers("recipe/polygon")
        self.move_without_an_answer(1)
        self.move_without_an_answer(2)
        self.browser.execute_script("window.answers.held.reverse()")
        self.let_all_go()
        eventually("they are there", self.has_unsent)
        moved = self.corners()
        self.assertAlmostEqual(moved[0][0], before[0][0] - 20)
        self.assertEqual(moved[1:], before[1:])

    def test_coordinates_that_come_after_the_changes_were_discarded_change_nothing(self):
        before = self.corners()
        self.choose_signal("pool", "hot_spot_width")
        self.type_limit("high_warning", 27.5)
        self.browser.hold_answers("recipe/polygon")
        self.move_without_an_answer(1)
        self.press("Discard the changes")
        self.let_all_go()
        eventually("the shape is the recipe's again", lambda: self.corners() == before)
        self.assertFalse(self.has_unsent())

    def test_a_region_that_is_pressed_does_not_get_the_corners_of_another_one(self):
        pool = self.corners()
        self.name_a_region("seam")
        choice = Select(self.find("#regions [name=region]"))
        eventually("it is there", lambda: self.find("#regions [name=region]").get_property("value") == "seam")
        seam = self.corners()
        choice.select_by_value("pool")
        self.browser.hold_answers("recipe/polygon")
        self.move_without_an_answer(1)
        choice.select_by_value("seam")
        self.find("#regions [data-corner='0']").click()
        self.let_all_go()
        self.assertEqual(self.corners(), seam)
        choice.select_by_value("pool")
        self.assertEqual(self.corners(), [[pool[0][0] - 10, pool[0][1]], *pool[1:]])

    def test_a_deleted_region_is_not_added_again_by_its_name(self):
        self.delete_a_region()
        self.name_a_region("surroundings")
        eventually("it is refused", lambda: self.browser.text("#regions [role=alert]") ==
                   "Refused: region surroundings is being deleted; keep that change first, or choose another name")
        self.assertEqual(self.region_names(), ["pool"])
        self.press("Discard the changes")
        self.assertEqual(self.region_names(), ["pool", "surroundings"])

    def configured(self):
        """The site file, and its recipes by number."""
        site = (self.appliance.folder / "demo.toml").read_text(encoding="utf-8")
        return site, {one["number"]: one["file"] for one in tomllib.loads(site)["recipe"]}

    def test_a_copy_becomes_a_recipe_of_its_own(self):
        site, recipes = self.configured()
        self.assertEqual(list(recipes), [1])
        for name, number, why in (("../evil", 2, "must be 1 to 40 letters"), ("demo-rig", 2, "exists already"),
                                  ("thin", 1, "recipe 1 exists already")):
            self.type_copy(name, number)
            self.press("Check and show the difference")
            eventually(why, lambda why=why: why in self.said())
        self.choose_signal("surroundings", "spatter_rate")
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
        eventually("the page says so, too", lambda: "files" in self.said())
        self.assertFalse(self.has_unsent())
        self.assertEqual(self.region_names(), ["pool", "seam"])

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
