# SPDX-License-Identifier: Apache-2.0
"""Common parts of the cases of alignment: a daemon whose rig file is wrong, and what a user does on the page."""

import json
import tomllib
import urllib.request

from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.support.select import Select

from appliance import PATIENCE_S, eventually
from misaligned_machine import MisalignedMachine
from page_case import PageCase

READY, REFUSED = 2, 3  # states of a proposal


class AlignCase(PageCase):
    @classmethod
    def make_appliance(cls):
        return MisalignedMachine()

    def open(self, camera="colour"):
        self.browser.get(f"{self.appliance.address}#/align")
        eventually("cameras", lambda: self.browser.find_elements(
            By.CSS_SELECTOR, f"#align [name=camera] option[value={camera}]"))
        Select(self.browser.find_element(By.CSS_SELECTOR, "#align [name=camera]")
               ).select_by_value(camera)
        eventually("a picture of this camera",
                   lambda: self.browser.text("#align .ball .age").endswith("old"))

    def answer(self, path, body=None):
        """Answer to a request without a browser, like curl's."""
        request = urllib.request.Request(
            self.appliance.address + path, data=None if body is None else json.dumps(body).encode(),
            headers={"Content-Type": "application/json"})
        with urllib.request.urlopen(request, timeout=PATIENCE_S) as answer:
            return answer.read()

    def camera(self, name="colour"):
        """State of its alignment from the interface; None while the daemon does not answer."""
        try:
            cameras = json.loads(self.answer("api/v1/alignment"))["cameras"]
        except OSError:
            return None
        return next(camera for camera in cameras if camera["name"] == name)

    def proposed(self, name="colour"):
        return (self.camera(name) or {}).get("proposed")

    def found(self, name="colour"):
        """Waits for a proposal and returns it; fails with the reason when it was refused."""
        def answered():
            camera = self.camera(name) or {}
            self.assertNotEqual(camera.get("state"), REFUSED, camera.get("refusal"))
            return camera.get("state") == READY and camera["proposed"]
        # A registration takes ten seconds of a processor, of which a busy machine has little.
        return eventually(f"a proposal for {name}", answered, 5 * PATIENCE_S)

    def calibrations(self):
        file = self.appliance.folder / "state/calibration.toml"
        return tomllib.loads(file.read_text(encoding="utf-8"))["entry"] if file.exists() else []

    def press(self, label):
        """Presses a button of the page, once it is enabled, in its step."""
        def button():
            return self.browser.find_elements(
                By.XPATH, f"//*[@id='align']//button[text()='{label}' and not(@disabled)]")
        pressed = eventually(f"{label} can be pressed", button)[0]
        for step in pressed.find_elements(By.XPATH, "ancestor::details[not(@open)]"):
            step.find_element(By.TAG_NAME, "summary").click()
        pressed.click()

    def open_step(self, name):
        """Opens a step of the alignment, which is closed."""
        self.browser.find_element(By.CSS_SELECTOR, f"#step-{name}:not([open]) > summary").click()

    def state_of(self, step):
        return self.browser.text(f"#step-{step} .state")

    def accept(self, name="colour"):
        """Accepts the proposal; returns once the daemon has restarted with it."""
        count = len(self.calibrations())
        self.press("Accept")
        eventually("it is written", lambda: len(self.calibrations()) == count + 1)
        entry = self.calibrations()[-1]
        eventually("it is in force", lambda: (self.camera(name) or {}).get("in_force", {}).get(
            "number") == entry["number"])
        return entry

    def pointer_at(self, u, v, width=1000, height=1000):
        """Moves to a place in the picture, to a pixel of the screen."""
        picture = self.browser.find_element(By.CSS_SELECTOR, "#align .ball svg")
        self.browser.execute_script("arguments[0].scrollIntoView({block: 'center'})", picture)
        scale = picture.size["width"] / width
        return ActionChains(self.browser).move_to_element_with_offset(
            picture, (u + 0.5 - width / 2) * scale, (v + 0.5 - height / 2) * scale)

    def handle(self, name):
        return self.browser.find_element(By.CSS_SELECTOR, f"#align [data-handle={name}]")

    def fill(self, form, **values):
        for name, value in values.items():
            field = self.browser.find_element(By.CSS_SELECTOR, f"{form} [name={name}]")
            field.clear()
            field.send_keys(str(value))

    def expect_no_complaint(self):
        # A restart of the daemon ends connections, and one of both compared cameras may be late then.
        self.assertEqual([entry for entry in self.browser.complaints()
                          if "ERR_" not in entry["message"] and "status of 5" not in entry["message"]
                          and not ("/pair?" in entry["message"] and "409" in entry["message"])], [])
