# SPDX-License-Identifier: Apache-2.0
"""Common parts of the cases of the recipe's limits and regions, which a user changes on Process."""

import json
import urllib.request

from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.select import Select

from appliance import PATIENCE_S, eventually
from configuration_test import Configured
from page_case import PageCase


class ProcessCase(PageCase):
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

    def find(self, selector):
        element = self.browser.find_element(By.CSS_SELECTOR, selector)
        self.browser.execute_script("arguments[0].scrollIntoView({block: 'center'})", element)
        return element

    def press(self, label, part="recipe"):
        self.find(f"#{part}").find_element(By.XPATH, f".//button[text()='{label}']").click()

    def said(self):
        return self.browser.text("#recipe [role=status]")

    def choose_signal(self, region, signal):
        option = f"[data-region={region}] [name=signal] option[value={signal}]"
        eventually(signal, lambda: self.browser.find_elements(By.CSS_SELECTOR, option))
        Select(self.find(f"[data-region={region}] [name=signal]")).select_by_value(signal)

    def type_copy(self, name, number):
        for field, value in (("copy", name), ("number", str(number))):
            shown = self.find(f"#recipe-copy [name={field}]")
            shown.clear()
            shown.send_keys(value)

    def shown(self, limit):
        return float(self.find(f"[data-region=pool] .limits [name={limit}]").get_property("value"))

    def type_limit(self, limit, value):
        """Types a limit of the pool as people do, and leaves its field for the next one."""
        if not self.browser.execute_script("return document.querySelector('[data-region=pool] details').open"):
            self.find("[data-region=pool] details > summary").click()
        field = self.find(f"[data-region=pool] .limits [name={limit}]")
        field.send_keys(Keys.CONTROL, "a")
        field.send_keys(str(value), Keys.TAB)

    def has_unsent(self):
        """True: the shown recipe has changes that can be sent."""
        return not self.browser.execute_script("return document.querySelector('#recipe > button').disabled")

    def region_names(self):
        """Names of the regions that can be changed."""
        return self.browser.execute_script(
            "return [...document.querySelectorAll('#regions [name=region] option')].map(({ value }) => value)")
