"""A browser for each case, one running daemon for all cases of a class."""

import unittest

from appliance import Appliance
from browser import Browser


class PageCase(unittest.TestCase):
    ARGUMENTS = []  # of the browser

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

    def expect_no_barriers(self, show):
        """In light and in dark. `show` brings the page to what is judged."""
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
