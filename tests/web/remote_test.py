# SPDX-License-Identifier: Apache-2.0
"""A browser on another computer: HTTPS, and the first password by the appliance's code.

Folders: app/ports/web/tls app/ports/web/access app/certificates app/ports/web/http
"""

import hashlib
import json
import os
import re
import ssl
import subprocess
import unittest
import urllib.request

from selenium.webdriver.common.by import By

from appliance import PATIENCE_S, ROOT, Appliance, eventually, free_port
from page_case import PageCase

PASSWORD = "correct horse battery"


def own_address():
    """An address of this computer outside of loopback, from which a browser here then connects,
    too."""
    said = subprocess.run(["ip", "-json", "-4", "address", "show", "scope", "global"],
                          check=True, capture_output=True, encoding="utf-8").stdout
    addresses = [address["local"] for link in json.loads(said) for address in link["addr_info"]]
    missing = "missing: a network interface besides loopback"
    if not addresses and os.environ.get("ORBWATCH_ACCEPTANCE"):
        raise AssertionError(missing)
    if not addresses:
        raise unittest.SkipTest(f"skipped, {missing}")
    return addresses[0]


class RemoteAppliance(Appliance):
    """Serves only this address, and only HTTPS on it."""

    def __init__(self):
        super().__init__()
        self.host, self.https_port = own_address(), free_port()
        site = (self.folder / "demo.toml").read_text(encoding="utf-8")
        site = site.replace("[web]", f'[web]\naddress = "{self.host}"\nhttps_port = {self.https_port}')
        (self.folder / "demo.toml").write_text(site, encoding="utf-8")

    @property
    def address(self):
        return f"https://{self.host}:{self.https_port}/"

    @property
    def http_address(self):
        return f"http://{self.host}:{self.port}/"

    def is_healthy(self):
        def answers():
            # The fingerprint below identifies the server.
            context = ssl._create_unverified_context()  # pylint: disable=protected-access
            with urllib.request.urlopen(self.address + "healthz", timeout=PATIENCE_S,
                                        context=context):
                return True
        return self.says(answers)

    def shown(self):
        """Output of `orbwatch password --show`."""
        return subprocess.run(
            [ROOT / "build/release/app/orbwatch", "password", "--show",
             "--config", self.folder / "demo.toml"],
            check=True, capture_output=True, encoding="utf-8").stdout

    def log(self):
        return (self.folder / "log").read_text(encoding="utf-8")


class Remote(PageCase):
    """Cases in order: each one continues after the previous one."""

    # Replaces a user who has compared the fingerprint and told the browser to continue.
    ARGUMENTS = ["--ignore-certificate-errors"]

    @classmethod
    def setUpClass(cls):
        cls.appliance = RemoteAppliance()
        cls.addClassCleanup(cls.appliance.close)
        cls.appliance.start(cls.appliance.is_healthy)

    def refusal(self):
        return self.browser.text("#access [role=alert]")

    def session(self):
        return self.browser.execute_async_script(
            "fetch('/api/v1/session').then((a) => a.json()).then(arguments[0])")

    def test_1_the_fingerprint_is_that_of_what_is_served(self):
        served = ssl.get_server_certificate((self.appliance.host, self.appliance.https_port))
        digest = hashlib.sha256(ssl.PEM_cert_to_DER_cert(served)).hexdigest().upper()
        fingerprint = ":".join(re.findall("..", digest))
        self.assertIn(fingerprint, self.appliance.shown())
        self.assertIn(fingerprint, self.appliance.log())

    def test_2_nothing_keeps_anybody_out(self):
        def show():
            self.browser.get(self.appliance.address)
            eventually("the form", lambda: self.browser.find_elements(By.NAME, "code"))

        self.expect_no_barriers(show)

    def test_3_the_code_sets_the_first_password(self):
        code = re.search(r"code for another computer (\S+)", self.appliance.shown())[1]
        self.assertIn(code, self.appliance.log())
        self.browser.get(self.appliance.http_address)
        eventually("the redirect to HTTPS",
                   lambda: self.browser.current_url.startswith(self.appliance.address))
        self.fill_access(code="0000-0000", password=PASSWORD, again=PASSWORD)
        eventually("the page says so", lambda: "code is wrong" in self.refusal())
        self.assertEqual(self.browser.find_elements(By.TAG_NAME, "canvas"), [])
        self.browser.keep_picture("first-code")
        self.fill_access(code=code.lower(), password=PASSWORD, again=PASSWORD + "x")
        eventually("the page says that they differ", lambda: "differ" in self.refusal())
        self.fill_access(code=code.lower(), password=PASSWORD, again=PASSWORD)
        eventually("pictures", lambda: any(self.browser.picture_numbers().values()))
        self.assertLessEqual({"user": "admin", "role": "administrator", "has_users": True}.items(),
                             self.session().items())
        users = json.loads((self.appliance.folder / "state/users.json").read_text(encoding="utf-8"))
        self.assertEqual([(one["name"], one["role"]) for one in users["users"]],
                         [("admin", "administrator")])
        self.assertFalse((self.appliance.folder / "state/first-code").exists())
        self.assertIn("first password: set", self.appliance.shown())
        (cookie,) = self.browser.get_cookies()
        self.assertEqual((cookie["name"], cookie["secure"], cookie["httpOnly"], cookie["sameSite"]),
                         ("__Host-orbwatch_session", True, True, "Strict"))

    def test_4_afterwards_one_logs_in(self):
        self.browser.get(self.appliance.address)
        self.fill_access(user="admin", password=PASSWORD)
        eventually("pictures", lambda: any(self.browser.picture_numbers().values()))
        self.assertEqual(self.session()["user"], "admin")
        self.assertEqual(self.browser.complaints(), [])

    def test_5_the_certificate_outlasts_a_restart(self):
        where = (self.appliance.host, self.appliance.https_port)
        before = ssl.get_server_certificate(where)
        self.appliance.stop()
        self.appliance.start(self.appliance.is_healthy)
        self.assertEqual(ssl.get_server_certificate(where), before)


if __name__ == "__main__":
    unittest.main()
