# SPDX-License-Identifier: Apache-2.0
"""Recipes that change, as by a PLC, while the page has unsent changes of one.

Folders: app/ports/web/process app/ports/web/page/files/process
"""

import json
import unittest
import urllib.request

from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.select import Select

from appliance import PATIENCE_S, eventually
from configuration_test import Configured
from process_case import ProcessCase

# The second recipe has another limit of the pool's width and another second region.
OTHER = ((b'name = "cladding"', b'name = "narrow"'), (b"high_warning = 26", b"high_warning = 22"),
         (b'name = "surroundings"', b'name = "room"'))
REGIONS = {1: "surroundings", 2: "room"}
UNSENT = "Unsent changes of recipe 1 (cladding)."


class TwoRecipes(Configured):
    def __init__(self):
        super().__init__()
        other = self.recipe.read_bytes()
        for before, after in OTHER:
            assert before in other, "the demo's recipe has changed"
            other = other.replace(before, after)
        (self.folder / "narrow.toml").write_bytes(other)
        with open(self.folder / "demo.toml", "a", encoding="utf-8") as site:
            site.write('\n[[recipe]]\nnumber = 2\nfile = "narrow.toml"\n')

    def select(self, recipe):
        request = urllib.request.Request(
            f"{self.address}api/v1/command/select_recipe", json.dumps({"recipe": recipe}).encode(),
            {"Content-Type": "application/json"})
        with urllib.request.urlopen(request, timeout=PATIENCE_S):
            pass
        eventually("it is measured by", lambda: self.status()["system"]["recipe"] == recipe)


class RecipeSwitch(ProcessCase):
    @classmethod
    def make_appliance(cls):
        return TwoRecipes()

    def setUp(self):
        super().setUp()
        self.addCleanup(self.appliance.select, 1)
        self.choose_signal("pool", "hot_spot_width")

    def switch(self, recipe):
        """Selects a recipe as a PLC does, and waits until the page shows it."""
        self.appliance.select(recipe)
        eventually("its regions", lambda: REGIONS[recipe] in self.region_names())
        eventually("its charts", lambda: self.browser.execute_script(
            "return [...document.querySelectorAll('#charts [data-region]')].map(({ dataset }) => dataset.region)")
            == ["pool", REGIONS[recipe]])

    def unsent(self):
        return self.browser.text("#unsent")

    def copy(self):
        """Name of the recipe that gets the changes."""
        return self.find("#recipe-copy [name=copy]").get_property("value")

    def move_a_corner(self):
        """Moves the pool's first corner by keys, and waits until the appliance has its coordinates."""
        Select(self.find("#regions [name=region]")).select_by_value("pool")
        before = self.corner()
        self.find("#regions [data-corner='0']").send_keys(Keys.SHIFT + Keys.ARROW_LEFT)
        eventually("it is settled", self.has_unsent)
        moved = self.corner()
        self.assertEqual(moved, before - 10)
        return moved

    def corner(self):
        return float(self.find("#regions [data-corner='0']").get_attribute("cx"))

    def test_unsent_changes_stay_with_their_recipe(self):
        stated = self.corner()
        moved = self.move_a_corner()
        self.type_copy("wide", 9)
        # Last, so that the next field has the focus when the recipe changes.
        self.type_limit("high_warning", 27.5)
        self.switch(2)
        self.assertEqual(self.shown("high_warning"), 22)
        self.assertEqual(self.corner(), stated)
        self.assertEqual(self.copy(), "")
        self.assertFalse(self.has_unsent())
        self.assertIn(UNSENT, self.unsent())
        self.browser.keep_picture("process-unsent")
        self.press("Check and show the difference")
        eventually("nothing is sent", lambda: self.said() == "Nothing was changed.")

        self.type_limit("high_warning", 21)
        self.press("Check and show the difference")
        eventually("only its own", lambda: self.said() == "Valid. Changed: narrow.toml.")
        self.assertNotIn("27.5", self.browser.text("#recipe pre"))

        self.switch(1)
        self.assertEqual(self.shown("high_warning"), 27.5)
        self.assertEqual(self.corner(), moved)
        self.assertEqual(self.copy(), "wide")
        self.assertIn("Unsent changes of recipe 2 (narrow).", self.unsent())
        self.assertNotIn(UNSENT, self.unsent())
        self.press("Check and show the difference")
        eventually("a copy of the first recipe", lambda: self.said() == "Valid. Changed: demo.toml, wide.toml.")
        self.assertIn("high_warning = 27.5", self.browser.text("#recipe pre"))

    def test_a_corner_that_is_moved_during_the_switch_is_not_the_other_recipes(self):
        stated = self.corner()
        Select(self.find("#regions [name=region]")).select_by_value("pool")
        corner = self.find("#regions [data-corner='0']")
        self.browser.execute_script("""
            const corner = arguments[0], box = corner.getBoundingClientRect();
            const send = (kind, right) => corner.dispatchEvent(new PointerEvent(kind, { bubbles: true, button: 0,
              pointerId: 1, clientX: box.x + box.width / 2 + right, clientY: box.y + box.height / 2 }));
            corner.setPointerCapture = () => {};  // of a pointer that is there
            send('pointerdown', 0);
            send('pointermove', -20);
            window.endDrag = () => ['pointermove', 'pointerup'].forEach((kind) => send(kind, -20));""", corner)
        self.assertLess(self.corner(), stated)
        self.switch(2)
        self.assertEqual(self.corner(), stated)
        self.browser.execute_script("endDrag()")
        eventually("it is the first one's", lambda: UNSENT in self.unsent())
        self.assertFalse(self.has_unsent())
        self.assertEqual(self.corner(), stated)
        self.switch(1)
        self.assertLess(self.corner(), stated)

    def test_unsent_changes_of_another_recipe_are_discarded(self):
        self.type_limit("high_warning", 27.5)
        self.assertTrue(self.has_unsent())
        self.assertEqual(self.unsent(), "")
        self.switch(2)
        self.assertIn(UNSENT, self.unsent())
        self.press("Discard", "unsent")
        self.assertEqual(self.unsent(), "")
        self.switch(1)
        self.assertFalse(self.has_unsent())
        self.assertEqual(self.shown("high_warning"), 26)

    def nodes(self):
        """Number of the page's nodes, with those that it has removed and still holds."""
        self.browser.execute_cdp_cmd("HeapProfiler.collectGarbage", {})
        return self.browser.execute_cdp_cmd("Memory.getDOMCounters", {})["nodes"]

    def test_removed_charts_are_not_held(self):
        own = self.browser.execute_script(
            "return document.querySelector('[data-region=surroundings]').getElementsByTagName('*').length")
        self.assertGreater(own, 100, "a chart has many nodes")
        self.switch(2)
        self.switch(1)
        before = self.nodes()
        for _ in range(5):
            self.switch(2)
            self.switch(1)
        # Ten charts were removed; ticks and texts differ by less than one has.
        eventually("no more nodes than before", lambda: self.nodes() < before + 2 * own)


if __name__ == "__main__":
    unittest.main()
