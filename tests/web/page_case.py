# SPDX-License-Identifier: Apache-2.0
"""A browser for each case, one running daemon for all cases of a class."""

import unittest

from selenium.webdriver.common.by import By

from appliance import Appliance, eventually
from browser import Browser


class PageCase(unittest.TestCase):
    ARGUMENTS = []  # arguments of the browser

    @classmethod
    def make_appliance(cls):
        return Appliance()

    @classmethod
    def setUpClass(cls):
        cls.appliance = cls.make_appliance()
        cls.addClassCleanup(cls.appliance.close)
        cls.appliance.start()

    def setUp(self):
        self.browser = Browser(self.ARGUMENTS)
        self.addCleanup(self.browser.close_all)

    def access_fields(self, name):
        return self.browser.find_elements(By.CSS_SELECTOR, f"#access [name={name}]")

    def fill_access(self, **values):
        """Sends the form for names, passwords and the first code, once it has these fields."""
        for name, value in values.items():
            field = eventually(name, lambda name=name: self.access_fields(name))[0]
            field.clear()
            field.send_keys(value)
        self.browser.find_element(By.CSS_SELECTOR, "#access form button").click()

    def expect_no_barriers(self, show):
        """Checks in light and in dark. `show` brings the page to the state to be checked."""
        self.browser.look_for_barriers()
        for scheme in ("light", "dark"):
            with self.subTest(scheme=scheme):
                self.browser.show_in(scheme)
                self.browser.get("about:blank")
                show()
                self.assertEqual(self.browser.barriers(), [])

    def expect_fits_its_width(self):
        widths = self.browser.execute_script(
            "return [document.documentElement.scrollWidth, document.documentElement.clientWidth]")
        self.assertLessEqual(widths[0], widths[1])
