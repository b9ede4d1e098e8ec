# SPDX-License-Identifier: Apache-2.0
"""Update on System, Device: a device that runs an image with two slots, and one that does not.

Folders: app/ports/web/device app/ports/web/page/files/system app/daemon/device app/update
"""

import pathlib
import shutil
import subprocess
import tempfile
import time
import unittest

from selenium.webdriver.common.by import By

from appliance import ROOT, Appliance, eventually
from page_case import PageCase


# Counts reads of the state; the next answer is not JSON, for example that of a proxy.
UNREADABLE_STATE = """
    const fetched = window.fetch;
    window.reads = 0;
    window.fetch = (address, ...more) => (address === 'api/v1/update' && ++window.reads === 1
      ? Promise.resolve(new Response('<html>')) : fetched(address, ...more));"""


class ImageAppliance(Appliance):
    """Its root is a folder with the files of an image, version 1.9 in slot a; RAUC's service is the test's."""

    def __init__(self):
        super().__init__()
        self.root = self.folder / "root"
        shutil.copytree("/etc", self.root / "etc", symlinks=True, ignore_dangling_symlinks=True)
        (self.root / "etc/os-release").unlink()
        for name, text in (("etc/os-release", "IMAGE_ID=orbwatch\nIMAGE_VERSION=1.9\n"),
                           ("etc/rauc/keyring.pem", "certificate\n"), ("run/orbwatch-image/slot", "a\n"),
                           ("data/keep", "")):
            self.write(name, text)
        self.rauc = subprocess.Popen([ROOT / "build/release/tests/app/fake_rauc", self.folder],
                                     stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.address_of_bus = self.rauc.stdout.readline().strip()

    def write(self, name, text):
        file = self.root / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")

    def end_installation(self, error=""):
        self.rauc.stdin.write(f"{error}\n")
        self.rauc.stdin.flush()

    def environment(self):
        return {"DBUS_SYSTEM_BUS_ADDRESS": self.address_of_bus}

    def around(self):
        return ["unshare", "--map-root-user", "--mount", "sh", "-c", """
            for folder in /*; do
              place="$0$folder"
              if [ -L "$folder" ]; then cp -P "$folder" "$place"
              elif [ -d "$folder" ] && [ ! -e "$place" ]; then mkdir "$place" && mount --rbind "$folder" "$place"; fi
            done
            exec chroot "$0" "$@" """, self.root]

    def spool(self):
        return sorted(file.name for file in self.folder.glob("state/update/*"))

    def close(self):
        self.stop()
        self.rauc.stdin.close()
        self.rauc.wait()
        shutil.rmtree(self.folder)


class UpdateCase(PageCase):
    def setUp(self):
        super().setUp()
        self.saved = pathlib.Path(tempfile.mkdtemp(prefix="orbwatch-update-"))
        self.addCleanup(shutil.rmtree, self.saved)
        self.browser.get(f"{self.appliance.address}#/system")
        eventually("the card", lambda: self.browser.find_elements(By.CSS_SELECTOR, "#device > summary"))[0].click()

    def shown(self):
        return self.browser.find_element(By.ID, "update").text

    def expect(self, text):
        try:
            eventually(text, lambda: text in self.shown())
        except AssertionError as error:
            self.fail(f"{error}; shown: {self.shown()}")

    def send(self, content):
        bundle = self.saved / "update.raucb"
        bundle.write_text(content, encoding="utf-8")
        send = self.browser.find_element(By.CSS_SELECTOR, "#update form button")
        eventually("updates are accepted", lambda: send.is_displayed() and send.is_enabled())
        self.browser.find_element(By.CSS_SELECTOR, "#update [name=file]").send_keys(str(bundle))
        send.click()


class UpdateOfAnImage(UpdateCase):
    make_appliance = ImageAppliance

    def tearDown(self):
        for name in ("run/orbwatch-image/trial", "data/update/tried"):
            (self.appliance.root / name).unlink(missing_ok=True)

    def test_update_is_uploaded_installed_and_waits_for_a_restart(self):
        self.expect("Version 1.9 runs in slot a. It is kept.")
        # Some parts: the rest of the bundle is not read by the test's RAUC.
        self.send("bundle orbwatch-amd64 1.10\n" + "x" * 100000)
        self.expect("is being installed: 40 %, Copying image to rootfs.1")
        self.browser.keep_picture("update")
        self.assertEqual(self.appliance.spool(), ["update.raucb"])
        self.appliance.end_installation()
        self.expect("Version 1.10 is installed, and tried at the next start.")
        self.assertEqual(self.appliance.spool(), [])
        self.assertTrue(self.browser.find_element(By.CSS_SELECTOR, "#update > button").is_displayed())
        self.browser.find_element(By.CSS_SELECTOR, "#update > button").click()
        self.browser.switch_to.alert.dismiss()
        (self.appliance.root / "data/update/tried").write_text("1.10\nan earlier start\n", encoding="utf-8")
        self.expect("returned from version 1.10: it crashed, lost its power")

    def test_refusals_are_sentences(self):
        for content, reason in (("foreign", "not signed by the key of this device"),
                                ("half", "incomplete or not an update"),
                                ("bundle orbwatch-amd64 1.8", "1.8, is older than the running one, 1.9"),
                                ("", "empty")):
            self.send(content)
            self.expect(reason)
            self.assertEqual(self.appliance.spool(), [])

    def test_update_that_cannot_be_read_any_more_is_refused_and_another_is_accepted(self):
        self.browser.hold_answers("api/v1/upload_update")
        self.send("bundle orbwatch-amd64 1.10\n" + "x" * 100000)
        eventually("a part is sent", self.browser.held_answers)
        (self.saved / "update.raucb").unlink()
        self.browser.let_go()
        self.expect("update.raucb cannot be read")
        self.assertTrue(self.browser.find_element(By.CSS_SELECTOR, "#update form button").is_enabled())
        self.send("half")
        self.expect("incomplete or not an update")

    def test_state_is_read_again_after_an_unreadable_answer(self):
        self.expect("It is kept.")
        self.browser.execute_script(UNREADABLE_STATE)
        eventually("it is read again", lambda: self.browser.execute_script("return window.reads") > 1)

    def test_trial_is_shown_with_its_seconds_and_takes_no_update(self):
        now = int(time.clock_gettime(time.CLOCK_BOOTTIME))
        self.appliance.write("run/orbwatch-image/trial", f"{now + 5000}\n{now + 4000}\n")
        self.expect("It is on trial, and kept in 3")
        self.assertFalse(self.browser.find_element(By.CSS_SELECTOR, "#update form").is_displayed())
        self.appliance.write("run/orbwatch-image/trial", f"{now + 5000}\n-\n")
        self.expect("does not work yet; the device returns in 4")
        (self.appliance.root / "run/orbwatch-image/trial").unlink()
        self.expect("It is kept.")
        self.assertTrue(self.browser.find_element(By.CSS_SELECTOR, "#update form").is_displayed())


class UpdateByPackages(UpdateCase):
    def test_card_explains_that_updates_come_by_packages(self):
        self.expect("updates come by its packages")
        self.assertFalse(self.browser.find_element(By.CSS_SELECTOR, "#update form").is_displayed())


if __name__ == "__main__":
    unittest.main()
