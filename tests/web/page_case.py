# SPDX-License-Identifier: Apache-2.0
"""A browser for each case, one running daemon for all cases of a class."""

import datetime
import sys
import unittest
import zoneinfo

from selenium.webdriver.common.by import By

from appliance import ALARM_S, Appliance, eventually
from browser import Browser

ZONE = "Australia/Eucla"  # 8:45 h ahead of UTC
PASSWORD = "correct horse battery"  # of the users that add_users() creates

# Creates an administrator, then a user of each of these roles, who is named like it.
ADD_USERS = """
    const [password, roles, done] = arguments;
    const post = (path, body) => fetch(`/api/v1/${path}`, { method: 'POST', body: JSON.stringify(body),
      headers: { 'Content-Type': 'application/json', 'X-Orbwatch': 'test' } });
    (async () => {
      await post('set_user', { user: 'admin', role: 'administrator', password });
      await post('login', { user: 'admin', password });
      for (const role of roles) await post('set_user', { user: role, role, password });
      await post('logout', {});
    })().then(done);"""


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

    def run(self, result=None):
        """Prints the appliance's diagnosis after a case that failed."""
        result = result or self.defaultTestResult()
        before = len(result.failures) + len(result.errors)
        super().run(result)
        if len(result.failures) + len(result.errors) > before:
            print(self.appliance.diagnosis(), file=sys.stderr)
        return result

    def setUp(self):
        self.browser = Browser(self.ARGUMENTS)
        self.addCleanup(self.browser.close_all)

    def access_fields(self, name):
        return self.browser.find_elements(By.CSS_SELECTOR, f"#access [name={name}]")

    def fill_access(self, **values):
        """Sends the form for names, passwords and the first code, once it has these fields."""
        for name, value in values.items():
            field = eventually(lambda name=name: f"the field {name}; instead {self.browser.state()}",
                               lambda name=name: self.access_fields(name))[0]
            field.clear()
            field.send_keys(value)
        self.browser.find_element(By.CSS_SELECTOR, "#access form button").click()

    def add_users(self, *roles):
        """Users named like their roles, and an administrator, of an appliance without users."""
        self.browser.get(self.appliance.address)
        self.browser.execute_async_script(ADD_USERS, PASSWORD, roles)

    def log_in_as(self, role, path):
        """Opens a page as a user of add_users()."""
        self.browser.delete_all_cookies()
        self.browser.get("about:blank")
        self.browser.get(f"{self.appliance.address}{path}")
        self.fill_access(user=role, password=PASSWORD)
        eventually("the page says who it is", lambda: role in self.browser.text("#account"))

    def hide_for_a_while(self, meanwhile=lambda: None):
        """Shows another tab until the page has closed its stream and `meanwhile` has returned."""
        [page] = self.browser.window_handles
        self.browser.switch_to.new_window("tab")
        eventually("no stream is open", lambda: self.appliance.status()["web"]["streams"] == 0)
        meanwhile()
        self.browser.close()
        self.browser.switch_to.window(page)

    def expect_no_barriers(self, show):
        """Checks in light and in dark. `show` brings the page to the state to be checked."""
        self.browser.look_for_barriers()
        for scheme in ("light", "dark"):
            with self.subTest(scheme=scheme):
                self.browser.show_in(scheme)
                self.browser.get("about:blank")
                show()
                self.assertEqual(self.browser.barriers(), [])

    def expect_local_times(self, path, name, table):
        """Checks a table's first column, in the browser's zone ZONE, against the times that the interface has."""
        def local(time):
            utc = datetime.datetime.fromisoformat(f"{time[:19]}+00:00")
            return utc.astimezone(zoneinfo.ZoneInfo(ZONE)).strftime("%Y-%m-%d %H:%M:%S")

        def agree():
            shown, stated = self.browser.execute_async_script("""
                const [path, name, table, done] = arguments;
                const shown = [...document.querySelectorAll(`${table} tbody tr`)]
                  .map(({ cells }) => cells[0].textContent);
                fetch(`/api/v1/${path}`).then((answer) => answer.json())
                  .then((all) => done([shown, all[name].map(({ time }) => time)]));""", path, name, table)
            return shown and set(shown) <= {local(time) for time in stated}

        eventually(f"local times of {path}", agree, ALARM_S)
        self.assertIn(ZONE, self.browser.text(f"{table} thead"))

    def expect_fits_its_width(self):
        widths = self.browser.execute_script(
            "return [document.documentElement.scrollWidth, document.documentElement.clientWidth]")
        self.assertLessEqual(widths[0], widths[1])
