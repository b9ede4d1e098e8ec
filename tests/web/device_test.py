# SPDX-License-Identifier: Apache-2.0
"""Support file, backup, restore and factory reset on System, by an administrator.

Folders: app/ports/web/device app/ports/web/page/files/system app/daemon/device app/cli/backup app/cli/support
"""

import base64
import json
import pathlib
import random
import shutil
import subprocess
import tempfile
import unittest
import urllib.request

from selenium.webdriver.common.by import By

from appliance import PATIENCE_S, ROOT, Appliance, eventually
from page_case import PageCase

PASSPHRASE = "correct horse battery"
SECRET = "hash-of-kim"


class InstalledAppliance(Appliance):
    """Its delivered configuration is where the package has it, in a mount namespace of the daemon's own."""

    def __init__(self):
        super().__init__()
        site = self.folder / "demo.toml"
        self.note('[recorder]\nfolder = "recordings"')
        delivered = self.folder / "root/orbwatch/demo"
        delivered.mkdir(parents=True)
        for file in self.folder.glob("demo*.toml"):
            shutil.copy(file, delivered)
        (delivered / "demo.toml").rename(delivered / "site.toml")
        self.site, self.delivered = site, (delivered / "site.toml").read_text(encoding="utf-8")

    def around(self):
        share = pathlib.Path(subprocess.run(
            ["sed", "-n", "s/^CMAKE_INSTALL_PREFIX:PATH=//p", ROOT / "build/release/CMakeCache.txt"],
            capture_output=True, text=True, check=True).stdout.strip()) / "share"
        return ["unshare", "--map-root-user", "--mount", "sh", "-c",
                'mount --bind "$0" "$1" && shift && exec "$@"', self.folder / "root", share]

    def note(self, line):
        """Adds lines to the configuration file."""
        site = self.folder / "demo.toml"
        site.write_text(f'{site.read_text(encoding="utf-8")}{line}\n', encoding="utf-8")

    def requests(self):
        """Number since the last restart."""
        return self.status()["web"]["requests"]

    def upload_backup(self, content):
        """Another client's upload of a backup."""
        part = {"offset": 0, "bytes": base64.b64encode(content).decode()}
        request = urllib.request.Request(f"{self.address}api/v1/upload_backup", json.dumps(part).encode(),
                                         {"Content-Type": "application/json"})
        with urllib.request.urlopen(request, timeout=PATIENCE_S) as answer:
            return json.load(answer)["size"]

    def audited(self):
        with urllib.request.urlopen(f"{self.address}api/v1/audit", timeout=PATIENCE_S) as answer:
            return [entry["what"] for entry in json.load(answer)["entries"]]


class DevicePage(PageCase):
    make_appliance = InstalledAppliance

    def setUp(self):
        super().setUp()
        self.saved = pathlib.Path(tempfile.mkdtemp(prefix="orbwatch-saved-"))
        self.addCleanup(shutil.rmtree, self.saved)
        self.browser.execute_cdp_cmd(
            "Browser.setDownloadBehavior", {"behavior": "allow", "downloadPath": str(self.saved)})
        self.browser.get(f"{self.appliance.address}#/system")
        eventually("the card", lambda: self.browser.find_elements(By.CSS_SELECTOR, "#device > summary"))[0].click()

    def section(self, place):
        return self.browser.find_elements(By.CSS_SELECTOR, "#device > section")[place]

    def said(self, place):
        return self.section(place).find_element(By.CSS_SELECTOR, "[role=status]").text

    def save(self, place, name):
        """The file that the browser saves after the button of a section is pressed."""
        self.section(place).find_element(By.CSS_SELECTOR, "form button").click()
        eventually(name, lambda: "Made" in self.said(place) or "refuse" in self.said(place))
        return eventually(f"{name}: {self.said(place)}", lambda: next(self.saved.glob(f"*{name}*.tar.zst"), None))

    def names_in(self, archive):
        return subprocess.run(["tar", "--zstd", "-tf", archive], capture_output=True, text=True,
                              check=True).stdout.split()

    def test_support_file_has_the_figures_of_the_running_program(self):
        names = self.names_in(self.save(0, "support"))
        self.assertLessEqual({"contents.txt", "doctor.txt", "running/status.json", "running/metrics.txt",
                              "running/figures.csv", "running/log.json"}, set(names))
        self.assertIn("make_support_file", self.appliance.audited())

    def choose(self, archive, passphrase=""):
        form = self.section(2).find_element(By.CSS_SELECTOR, "form")
        form.find_element(By.NAME, "file").send_keys(str(archive))
        field = form.find_element(By.NAME, "passphrase")
        field.clear()
        field.send_keys(passphrase)
        form.find_element(By.CSS_SELECTOR, "button").click()

    def backed_up(self):
        """A backup with secrets, saved by the browser."""
        self.section(1).find_element(By.NAME, "passphrase").send_keys(PASSPHRASE)
        return self.save(1, "backup")

    def restarted(self, press):
        before = self.appliance.requests()
        press()
        eventually("a restart", lambda: self.appliance.says(lambda: self.appliance.requests() < before))
        eventually("it runs", self.appliance.runs)

    def restore(self):
        def press():
            self.section(2).find_element(By.CSS_SELECTOR, ":scope > div button").click()
            self.browser.switch_to.alert.accept()
        self.restarted(press)

    def test_backup_is_restored_with_its_secrets(self):
        secret = self.appliance.folder / "key.pem"
        secret.write_text(SECRET, encoding="utf-8")
        secret.chmod(0o600)
        text = self.appliance.site.read_text(encoding="utf-8")
        archive = self.backed_up()
        self.assertNotIn(SECRET.encode(), subprocess.run(
            ["zstd", "-dc", archive], capture_output=True, check=True).stdout)
        secret.write_text("changed", encoding="utf-8")
        self.appliance.note("# changed")
        self.choose(archive, "another passphrase")
        eventually("it is refused", lambda: "passphrase is wrong" in self.said(2))
        self.choose(archive, PASSPHRASE)
        eventually("what it changes", lambda: "configuration/demo.toml" in self.section(2).text)
        self.browser.keep_picture("device")
        self.assertEqual(secret.read_text(encoding="utf-8"), "changed", "checking changes nothing")
        self.restore()
        self.assertEqual(self.appliance.site.read_text(encoding="utf-8"), text)
        self.assertEqual(secret.read_text(encoding="utf-8"), SECRET)
        self.assertIn("restore", self.appliance.audited())
        secret.unlink()

    def test_kept_events_go_along_when_asked_for(self):
        event = self.appliance.folder / "recordings/events/20260101T000000.000Z-alarm"
        event.mkdir(parents=True)
        self.addCleanup(shutil.rmtree, event)
        content = random.Random(1).randbytes(6 << 20)
        (event / "event.mcap").write_bytes(content)
        (event / "pinned").touch()
        self.section(1).find_element(By.NAME, "events").click()
        archive = self.save(1, "backup")
        shutil.rmtree(event)
        self.choose(archive)
        eventually("it is listed", lambda: f"events/{event.name}" in self.section(2).text)
        self.assertFalse(event.exists(), "checking changes nothing")
        self.restore()
        self.assertEqual((event / "event.mcap").read_bytes(), content)
        self.assertTrue((event / "pinned").exists())

    def test_file_that_is_no_backup_is_refused(self):
        for content in (b"", b"no archive", bytes(range(256)) * 400):
            archive = self.saved / "wrong.zst"
            archive.write_bytes(content)
            self.choose(archive)
            eventually("it is refused", lambda: "Refused" in self.said(2) or "refused" in self.said(2))
            self.assertFalse(self.section(2).find_element(By.CSS_SELECTOR, ":scope > div").is_displayed())
            self.browser.refresh()
            eventually("the card", lambda: self.browser.find_elements(
                By.CSS_SELECTOR, "#device > summary"))[0].click()

    def restore_button(self):
        return self.section(2).find_element(By.CSS_SELECTOR, "form button")

    def is_offered(self):
        """True: the checked contents are shown, to be restored."""
        return self.section(2).find_element(By.CSS_SELECTOR, ":scope > div").is_displayed()

    def test_backup_is_not_offered_after_a_change_of_the_form_meanwhile(self):
        archive = self.save(1, "backup")
        self.browser.hold_answers("api/v1/check_restore")
        self.choose(archive)
        eventually("it is checked", self.browser.held_answers)
        self.assertFalse(self.restore_button().is_enabled(), "one check at a time")
        self.section(2).find_element(By.NAME, "events").click()
        self.browser.let_go()
        eventually("another check can begin", lambda: self.restore_button().is_enabled())
        self.assertFalse(self.is_offered())
        self.restore_button().click()
        eventually("what it changes", self.is_offered)
        bodies = [json.loads(body) for _, body in self.browser.asked("api/v1/check_restore")]
        self.assertEqual([body["events"] for body in bodies], [True, False])

    def test_backup_that_another_client_uploaded_meanwhile_is_not_restored(self):
        self.choose(self.save(1, "backup"))
        eventually("what it changes", self.is_offered)
        self.appliance.upload_backup(b"another backup")
        self.section(2).find_element(By.CSS_SELECTOR, ":scope > div button").click()
        self.browser.switch_to.alert.accept()
        eventually("it is refused", lambda: "another backup was uploaded meanwhile" in self.said(2))

    def test_backup_is_uploaded_no_further_after_another_file_is_chosen(self):
        large, archive = self.saved / "large.zst", self.save(1, "backup")
        large.write_bytes(bytes(300000))
        self.browser.hold_answers("api/v1/upload_backup")
        self.choose(large)
        eventually("a part is sent", self.browser.held_answers)
        self.section(2).find_element(By.NAME, "file").send_keys(str(archive))
        self.browser.let_go()
        eventually("another check can begin", lambda: self.restore_button().is_enabled())
        self.assertEqual([json.loads(body)["offset"] for _, body in self.browser.asked("api/v1/upload_backup")], [0])
        self.restore_button().click()
        eventually("what it changes", self.is_offered)

    def test_backup_that_cannot_be_read_any_more_is_refused(self):
        gone = self.saved / "gone.zst"
        gone.write_bytes(bytes(100000))
        self.browser.hold_answers("api/v1/upload_backup")
        self.choose(gone)
        eventually("a part is sent", self.browser.held_answers)
        gone.unlink()
        self.browser.let_go()
        eventually("it is refused", lambda: "gone.zst cannot be read" in self.said(2))
        self.assertTrue(self.restore_button().is_enabled())

    def test_reset_needs_the_words_and_puts_the_delivered_configuration_back(self):
        self.appliance.note("# changed")
        field = self.section(3).find_element(By.NAME, "confirmation")
        field.send_keys("reset")
        self.section(3).find_element(By.CSS_SELECTOR, "button").click()
        eventually("it is refused", lambda: "must be: factory reset" in self.said(3))
        field.clear()
        field.send_keys("factory reset")
        self.restarted(self.section(3).find_element(By.CSS_SELECTOR, "button").click)
        self.assertEqual(self.appliance.site.read_text(encoding="utf-8"), self.appliance.delivered)


if __name__ == "__main__":
    unittest.main()
