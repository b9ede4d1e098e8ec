# SPDX-License-Identifier: Apache-2.0
"""Logging in, against a running daemon.

Folders: app/ports/web/access app/ports/web/http app/ports/web/page/files/system
"""

import json
import re
import subprocess
import unittest
import urllib.error
import urllib.request

from selenium.webdriver.common.by import By

from appliance import ROOT, eventually
from page_case import ZONE, PageCase

PASSWORD = "correct horse battery"
NEXT_PASSWORD = "a forgotten one replaced"
OWN_PASSWORD = "chosen by its own user"
# The first request for the session fails.
FAIL_ONCE = """{
  const { fetch } = window;
  let fails = true;
  window.fetch = (address, ...more) => {
    if (!fails || address !== 'api/v1/session') return fetch(address, ...more);
    fails = false;
    return Promise.reject(new Error('no connection'));
  };
}"""


class Access(PageCase):
    """Cases in order: each one uses the users of the previous one."""

    def expect_live(self):
        eventually("pictures", lambda: any(self.browser.picture_numbers().values()))

    def session(self):
        """The interface's report of the browser's own session."""
        return self.browser.execute_async_script(
            "fetch('/api/v1/session').then((a) => a.json()).then(arguments[0])")

    def open_people(self):
        eventually("the part for administrators",
                   lambda: self.browser.find_elements(By.CSS_SELECTOR, "#people summary"))[0].click()
        eventually("who may log in", lambda: "admin" in self.browser.text("#people tbody"))

    def submit(self, form, **values):
        for name, value in values.items():
            control = form.find_element(By.NAME, name)
            if control.tag_name != "select":
                control.clear()
            control.send_keys(value)
        form.find_element(By.TAG_NAME, "button").click()

    def press(self, label):
        self.browser.execute_script(
            "document.querySelector(`[aria-label='${arguments[0]}']`).click()", label)

    def status_of(self, path, headers=None):
        """Status of a request without any session."""
        request = urllib.request.Request(self.appliance.address + path, headers=headers or {})
        try:
            with urllib.request.urlopen(request, timeout=60) as answer:
                return answer.status
        except urllib.error.HTTPError as error:
            error.close()
            return error.code

    def users(self):
        file = self.appliance.folder / "state/users.json"
        self.assertEqual(file.stat().st_mode & 0o777, 0o600)
        return {user["name"]: user["role"] for user in json.loads(file.read_text())["users"]}

    def test_1_the_first_password_is_set(self):
        self.browser.get(self.appliance.address)
        self.expect_live()
        self.assertEqual(self.status_of("api/v1/status"), 200)
        self.browser.find_element(By.CSS_SELECTOR, "#account button").click()
        self.fill_access(password=PASSWORD, again=PASSWORD + "x")
        eventually("the page says that they differ",
                   lambda: "differ" in self.browser.text("#access [role=alert]"))
        self.browser.keep_picture("first-password")
        self.fill_access(password=PASSWORD, again=PASSWORD)
        eventually("the page says who it is",
                   lambda: "admin" in self.browser.text("#account"))
        self.expect_live()
        self.assertLessEqual({"user": "admin", "role": "administrator", "has_users": True}.items(),
                             self.session().items())
        self.assertEqual(self.users(), {"admin": "administrator"})
        self.assertEqual(self.status_of("api/v1/status"), 401)
        # A stream from before the log-in was required may be refused before the log-in page is
        # shown.
        self.assertEqual([entry for entry in self.browser.complaints()
                          if "api/v1/live" not in entry["message"]], [])

    def test_2_a_connection_that_is_there_is_not_called_missing(self):
        self.browser.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": FAIL_ONCE})
        self.browser.get(self.appliance.address)
        eventually("the form", lambda: self.access_fields("password"))
        self.assertEqual(self.browser.text("#condition"), "")

    def test_2_nobody_gets_in_without_it(self):
        self.browser.get(self.appliance.address)
        eventually("the form", lambda: self.access_fields("password"))
        self.assertEqual(self.browser.find_elements(By.TAG_NAME, "canvas"), [])
        self.browser.keep_picture("login")
        self.browser.hold_answers("api/v1/login")
        self.fill_access(user="admin", password="not the right one")
        self.browser.find_element(By.CSS_SELECTOR, "#access form button").click()
        self.assertEqual(len(self.browser.asked("api/v1/login")), 1, "a second press logs nobody in twice")
        self.browser.let_go()
        eventually("the page says so",
                   lambda: "password is wrong" in self.browser.text("#access [role=alert]"))
        self.assertEqual(self.session()["user"], "")
        self.fill_access(user="admin", password=PASSWORD)
        self.expect_live()
        self.assertEqual(self.session()["user"], "admin")

    def test_3_logging_out_ends_session_and_stream(self):
        self.browser.get(self.appliance.address)
        self.fill_access(user="admin", password=PASSWORD)
        self.expect_live()
        self.browser.find_element(By.CSS_SELECTOR, "#account button").click()
        eventually("the form", lambda: self.access_fields("password"))
        self.assertEqual(self.session()["user"], "")

    def test_4_a_restart_of_the_daemon_logs_nobody_out(self):
        self.browser.get(self.appliance.address)
        self.fill_access(user="admin", password=PASSWORD)
        self.expect_live()
        self.appliance.stop()
        eventually("the page says so", lambda: "No connection" in self.browser.text("#condition"))
        self.appliance.start(self.appliance.is_healthy)
        eventually("the page shows the state again",
                   lambda: "running" in self.browser.text("#condition"))
        self.assertEqual(self.session()["user"], "admin")

    def test_5_a_forgotten_password_is_replaced_on_the_board(self):
        self.browser.get(self.appliance.address)
        self.fill_access(user="admin", password=PASSWORD)
        self.expect_live()
        self.browser.hold_answers("api/v1/session")
        subprocess.run(
            [ROOT / "build/release/app/orbwatch", "password",
             "--config", self.appliance.folder / "demo.toml"],
            input=NEXT_PASSWORD + "\n", encoding="utf-8", check=True, capture_output=True)
        # The session with the old password ends, and its stream with it; the page remains.
        self.browser.execute_script("window.isTheSamePage = true")
        # Slow answers do not add up: each would make the form anew while somebody types.
        eventually("the stream is asked for again and again", lambda: len(self.browser.asked("api/v1/live")) > 2)
        self.assertEqual(len(self.browser.asked("api/v1/session")), 1)
        self.browser.let_go()
        eventually("the form", lambda: self.access_fields("password"))
        self.fill_access(user="admin", password=PASSWORD)
        eventually("the old one is refused",
                   lambda: "password is wrong" in self.browser.text("#access [role=alert]"))
        self.browser.hold_answers("api/v1/session", "busy")
        self.fill_access(user="admin", password=NEXT_PASSWORD)
        eventually("the session is asked for", self.browser.held_answers)
        self.browser.let_go()
        eventually("the form is gone", lambda: self.browser.execute_script(
            "return document.getElementById('access').hidden"))
        self.expect_live()
        self.assertTrue(self.browser.execute_script("return window.isTheSamePage"))
        self.assertEqual(self.users(), {"admin": "administrator"})

    def test_6_nothing_keeps_anybody_out(self):
        def show():
            self.browser.get(self.appliance.address)
            eventually("the form", lambda: self.access_fields("password"))

        self.expect_no_barriers(show)

    def test_7_the_administrator_lets_others_in(self):
        self.browser.live_in(ZONE)
        self.browser.get(f"{self.appliance.address}#/system")
        self.fill_access(user="admin", password=NEXT_PASSWORD)
        self.open_people()
        people, programs = self.browser.find_elements(By.CSS_SELECTOR, "#people form")
        self.submit(people, user="kim", role="operator", password="too short")
        self.assertEqual(self.users(), {"admin": "administrator"})
        self.submit(people, password=PASSWORD)
        eventually("kim is a user", lambda: self.users().get("kim") == "operator")
        self.submit(programs, name="recorder", role="viewer")
        token = eventually("a token", lambda: re.search(
            r"once: (\S+)", self.browser.text("#people [role=status]")))[1]
        authorization = {"Authorization": f"Bearer {token}"}
        self.assertEqual(self.status_of("api/v1/status", authorization), 200)
        self.assertEqual(self.status_of("api/v1/audit", authorization), 403)
        eventually("the audit", lambda: "create_token" in self.browser.text("#people"))
        self.expect_local_times("audit", "entries", "#people > :last-child")
        self.browser.keep_picture("people")
        self.press("Remove kim")
        eventually("kim is none", lambda: "kim" not in self.users())
        self.press("Revoke recorder")
        eventually("the token is of no use",
                   lambda: self.status_of("api/v1/status", authorization) == 401)
        eventually("the token is shown no more",
                   lambda: token not in self.browser.text("#people"))
        self.assertEqual(self.browser.complaints(), [])

    def test_7_the_token_stays_when_the_lists_cannot_be_read(self):
        self.browser.get(f"{self.appliance.address}#/system")
        self.fill_access(user="admin", password=NEXT_PASSWORD)
        self.open_people()
        self.browser.hold_answers("api/v1/audit", "the disk is full")
        self.submit(self.browser.find_elements(By.CSS_SELECTOR, "#people form")[1], name="dashboard", role="viewer")
        eventually("the lists are read", self.browser.held_answers)
        self.browser.let_go()
        eventually("the reason", lambda: "the disk is full" in self.browser.text("#people [role=alert]"))
        token = re.search(r"once: (\S+)", self.browser.text("#people [role=status]"))[1]
        self.assertEqual(self.status_of("api/v1/status", {"Authorization": f"Bearer {token}"}), 200)
        for _ in range(2):  # closes and opens the card
            self.browser.find_element(By.CSS_SELECTOR, "#people > summary").click()
        eventually("the lists are read again", lambda: self.browser.find_elements(
            By.CSS_SELECTOR, "[aria-label='Revoke dashboard']"))
        self.assertEqual(self.browser.text("#people [role=alert]"), "")
        self.press("Revoke dashboard")
        eventually("the token is of no use", lambda: self.status_of(
            "api/v1/status", {"Authorization": f"Bearer {token}"}) == 401)

    def test_7_a_second_press_does_not_replace_the_token(self):
        self.browser.get(f"{self.appliance.address}#/system")
        self.fill_access(user="admin", password=NEXT_PASSWORD)
        self.open_people()
        self.browser.hold_answers("api/v1/create_token")
        form = self.browser.find_elements(By.CSS_SELECTOR, "#people form")[1]
        self.submit(form, name="twice", role="viewer")
        form.find_element(By.TAG_NAME, "button").click()
        self.assertEqual(len(self.browser.asked("api/v1/create_token")), 1)
        self.browser.let_go()
        eventually("the token", lambda: re.search(r"once: \S+", self.browser.text("#people [role=status]")))
        eventually("the lists are read again", lambda: self.browser.find_elements(
            By.CSS_SELECTOR, "[aria-label='Revoke twice']"))
        self.browser.execute_script(
            "const button = document.querySelector(`[aria-label='Revoke twice']`); button.click(); button.click()")
        eventually("it is revoked", lambda: not self.browser.find_elements(
            By.CSS_SELECTOR, "[aria-label='Revoke twice']"))
        self.assertEqual(len(self.browser.asked("api/v1/revoke_token")), 1)

    def test_8_nor_from_that_part(self):
        self.browser.look_for_barriers()
        self.browser.get(f"{self.appliance.address}#/system")
        self.fill_access(user="admin", password=NEXT_PASSWORD)
        self.open_people()
        self.assertEqual(self.browser.barriers(), [])

    def log_in_elsewhere(self, password):
        """Cookie of a session without the page; None: refused."""
        request = urllib.request.Request(
            f"{self.appliance.address}api/v1/login", json.dumps({"user": "admin", "password": password}).encode(),
            {"Content-Type": "application/json"})
        try:
            with urllib.request.urlopen(request, timeout=60) as answer:
                return answer.headers["Set-Cookie"].split(";")[0]
        except urllib.error.HTTPError as error:
            error.close()
            self.assertEqual(error.code, 401)
            return None

    def test_9_a_user_changes_the_own_password(self):
        elsewhere = {"Cookie": self.log_in_elsewhere(NEXT_PASSWORD)}
        self.assertEqual(self.status_of("api/v1/status", elsewhere), 200)
        self.browser.get(f"{self.appliance.address}#/system")
        self.fill_access(user="admin", password=NEXT_PASSWORD)
        eventually("the card", lambda: self.browser.find_elements(By.CSS_SELECTOR, "#password > summary"))[0].click()
        self.assertIn("admin, administrator", self.browser.text("#password .state"))
        form = self.browser.find_element(By.CSS_SELECTOR, "#password form")

        def said(what):
            eventually(what, lambda: what in self.browser.text("#password [role=status]"))

        self.submit(form, old=NEXT_PASSWORD, password=OWN_PASSWORD, again=OWN_PASSWORD + "x")
        said("the two passwords differ")
        self.submit(form, old=PASSWORD, password=OWN_PASSWORD, again=OWN_PASSWORD)
        said("password is wrong")
        self.assertEqual(self.status_of("api/v1/status", elsewhere), 200)
        self.browser.hold_answers("api/v1/set_password")
        self.submit(form, old=NEXT_PASSWORD, password=OWN_PASSWORD, again=OWN_PASSWORD)
        form.find_element(By.TAG_NAME, "button").click()  # would be refused: the old one is another now
        self.assertEqual(len(self.browser.asked("api/v1/set_password")), 1)
        self.browser.let_go()
        said("Changed")
        self.browser.keep_picture("own-password")
        self.assertEqual([one.get_property("value") for one in form.find_elements(By.TAG_NAME, "input")],
                         ["admin", "", "", ""])
        self.assertEqual(self.status_of("api/v1/status", elsewhere), 401)
        self.assertEqual(self.session()["user"], "admin")
        self.assertIsNone(self.log_in_elsewhere(NEXT_PASSWORD))
        self.assertIsNotNone(self.log_in_elsewhere(OWN_PASSWORD))
        # The page continues with its new session.
        self.browser.execute_script("location.hash = '#/live'")
        self.expect_live()
        self.assertFalse(self.browser.find_element(By.ID, "access").is_displayed())


if __name__ == "__main__":
    unittest.main()
