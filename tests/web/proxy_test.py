# SPDX-License-Identifier: Apache-2.0
"""A browser and a player behind nginx, which ends TLS and shows the page below a path.

Folders: app/ports/web/PROXIES.md app/ports/web/access app/ports/web/http app/ports/web/page/files
"""

import base64
import json
import subprocess
import unittest

from selenium.webdriver.common.by import By

from appliance import ROOT, eventually
from page_case import PageCase
from proxy import CLIENT, PATH, Proxied

PASSWORD = "correct horse battery"
STREAM = "stream.mjpg?view=heat"
JPEG_BEGINS = b"\xff\xd8\xff"


class Proxy(PageCase):
    """Cases in order: each one continues after the previous one."""

    # Replaces a certificate signed by the plant's own authority.
    ARGUMENTS = ["--ignore-certificate-errors", "--host-resolver-rules=MAP plant.example 127.0.0.1"]

    @classmethod
    def make_appliance(cls):
        return Proxied()

    def log_in(self):
        self.browser.get(self.appliance.outside)
        self.fill_access(user="admin", password=PASSWORD)
        eventually("pictures", lambda: any(self.browser.picture_numbers().values()))

    def asked(self, path, body=None):
        """The interface's answer to the page's own scripts."""
        return self.browser.execute_async_script("""
            const [path, body, done] = arguments;
            const post = { method: 'POST', body, headers:
              { 'Content-Type': 'application/json', 'X-Orbwatch': 'test' } };
            fetch(path, body ? post : {}).then((a) => a.json()).then(done);""",
            path, body and json.dumps(body))

    def requested_outside_the_path(self):
        """Addresses outside the path that the page has loaded."""
        return self.browser.execute_script("""
            return performance.getEntriesByType('resource').map(({ name }) => name)
              .filter((name) => !new URL(name).pathname.startsWith(arguments[0]));""", PATH)

    def test_1_the_board_is_not_at_the_browser(self):
        self.browser.get(self.appliance.outside)
        eventually("the form for the code", lambda: self.browser.find_elements(By.NAME, "code"))
        self.assertEqual(self.browser.find_elements(By.TAG_NAME, "canvas"), [])
        self.assertEqual(self.asked("api/v1/session")["role"], "")
        refused = self.asked("api/v1/set_user", {
            "user": "stranger", "password": PASSWORD, "role": "administrator"})
        self.assertIn("needs the role administrator", refused["error"])

    def test_2_one_logs_in_and_everything_streams(self):
        subprocess.run([ROOT / "build/release/app/orbwatch", "password", "--config",
                        self.appliance.folder / "demo.toml"], input=PASSWORD + "\n",
                       encoding="utf-8", check=True, capture_output=True)
        self.log_in()
        before = self.browser.picture_numbers()
        eventually("more pictures of each view", lambda: all(
            number > before[view] for view, number in self.browser.picture_numbers().items()))
        (cookie,) = self.browser.get_cookies()
        self.assertEqual((cookie["name"], cookie["secure"], cookie["path"]),
                         ("__Secure-orbwatch_session", True, PATH))
        heat = next(view["index"] for view in self.asked("api/v1/views")["views"]
                    if view["name"] == "heat")
        turned = {"view": heat, "yaw": 10, "pitch": 0, "h_fov": 0}
        self.assertEqual(self.asked("api/v1/command/point_view", turned)["result_text"], "done")
        for page in ("look", "align", "process", "system", "fleet"):
            self.browser.get(f"{self.appliance.outside}#/{page}")
            eventually(f"the page {page}", lambda page=page: self.browser.find_element(
                By.ID, page).is_displayed() and "running" in self.browser.text("#condition"))
            self.assertEqual(self.requested_outside_the_path(), [])
        self.assertEqual([entry for entry in self.browser.complaints()
                          if entry["source"] != "rendering" and "401" not in entry["message"]], [])

    def test_3_the_audit_has_what_the_proxy_says(self):
        self.log_in()
        wrong = json.dumps({"user": "admin", "password": "not the right one"})
        with self.appliance.through("POST", "api/v1/login", ["X-Forwarded-For: 198.51.100.7"],
                                    wrong) as (head, _):
            self.assertIn("401", head[0])
        newest = self.asked("api/v1/audit")["entries"][-1]
        # An address of the board, named by a proxy, does not belong to one of its own programs.
        self.assertEqual((newest["from"], newest["result"]), (f"{CLIENT} (by proxy)", "refused"))
        described = self.asked("api/v1/openapi.json")
        self.assertEqual(self.browser.execute_script(
            "return new URL(arguments[0], new URL('api/v1/openapi.json', document.baseURI)).pathname",
            described["servers"][0]["url"]), PATH)

    def test_4_a_player_streams_by_its_token(self):
        self.log_in()
        token = self.asked("api/v1/create_token", {"name": "recorder", "role": "viewer"})["token"]
        basic = base64.b64encode(f"recorder:{token}".encode()).decode()
        for version in ("1.0", "1.1"):
            with self.appliance.through("GET", STREAM, version=version) as (head, _):
                self.assertIn("401", head[0])
                self.assertIn("www-authenticate: basic", "\n".join(head).lower())
            with self.appliance.through("GET", STREAM, [f"Authorization: Basic {basic}"],
                                        version=version) as (head, answer):
                self.assertIn("200", head[0])
                read = b""
                while read.count(JPEG_BEGINS) < 5:
                    block = answer.read1(65536)
                    self.assertTrue(block, "the stream ended")
                    read += block


if __name__ == "__main__":
    unittest.main()
