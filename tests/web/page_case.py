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
