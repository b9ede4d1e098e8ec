"""Alignment on the page, against a running daemon whose rig file is wrong."""

import json
import tomllib
import unittest
import urllib.request

import numpy
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.select import Select

from appliance import PATIENCE_S, eventually
from misaligned_machine import MisalignedMachine, degrees_between, rotation_of
from page_case import PageCase

READY = 2


class AlignCase(PageCase):
    @classmethod
    def make_appliance(cls):
        return MisalignedMachine()

    def open(self, camera="colour"):
        self.browser.get(f"{self.appliance.address}#/align")
        eventually("cameras", lambda: self.browser.find_elements(By.CSS_SELECTOR, "#align option"))
        Select(self.browser.find_element(By.CSS_SELECTOR, "#align [name=camera]")
               ).select_by_value(camera)
        eventually("a picture", lambda: self.browser.execute_script(
            "return document.querySelector('#align .ball canvas').dataset.number"))

    def answer(self, path, body=None):
        """Of a request as curl sends it."""
        request = urllib.request.Request(
            self.appliance.address + path, data=None if body is None else json.dumps(body).encode(),
            headers={"Content-Type": "application/json"})
        with urllib.request.urlopen(request, timeout=PATIENCE_S) as answer:
            return answer.read()

    def camera(self, name="colour"):
        """What the interface says of its alignment; None while the daemon does not answer."""
        try:
            cameras = json.loads(self.answer("api/v1/alignment"))["cameras"]
        except OSError:
            return None
        return next(camera for camera in cameras if camera["name"] == name)

    def proposed(self, name="colour"):
        return (self.camera(name) or {}).get("proposed")

    def calibrations(self):
        file = self.appliance.folder / "state/calibration.toml"
        return tomllib.loads(file.read_text(encoding="utf-8"))["entry"] if file.exists() else []

    def press(self, label):
        """A button of the page, once it can be pressed."""
        def button():
            return self.browser.find_elements(
                By.XPATH, f"//*[@id='align']//button[text()='{label}' and not(@disabled)]")
        eventually(f"{label} can be pressed", button)[0].click()

    def accept(self, name="colour"):
        """Until the daemon has restarted with it."""
        count = len(self.calibrations())
        self.press("Accept")
        eventually("it is written", lambda: len(self.calibrations()) == count + 1)
        number = self.calibrations()[-1]
        eventually("it is in force", lambda: (self.camera(name) or {}).get("in_force", {}).get(
            "method") == number["method"] and not self.proposed(name))
        return number

    def handle(self, name):
        return self.browser.find_element(By.CSS_SELECTOR, f"#align [data-handle={name}]")

    def expect_no_complaint(self):
        # A restart of the daemon ends connections.
        self.assertEqual([entry for entry in self.browser.complaints()
                          if "ERR_" not in entry["message"] and "status of 5" not in entry["message"]],
                         [])


class Outline(AlignCase):
    def tearDown(self):
        if (self.camera() or {}).get("proposed"):
            self.answer("api/v1/command/discard_alignment", {"camera": 0})

    def expect_outline(self, shown, truth, share):
        """Centre and radii within that share of the radius."""
        for key in ("u", "v"):
            self.assertLess(abs(shown[key] - truth[key]), share * truth["rx"], key)
        self.assertLess(abs((shown["rx"] + shown["ry"] - truth["rx"] - truth["ry"]) / 2),
                        share * truth["rx"])

    def test_the_ball_is_found_and_taken_back(self):
        self.open()
        wrong = self.camera()["in_force"]["outline"]
        self.press("Find the ball")
        eventually("a proposal", lambda: self.camera()["state"] == READY)
        proposed = self.proposed()
        self.expect_outline(proposed["outline"], self.appliance.truth["colour"][0], 0.0015)
        self.assertIn("confidence", proposed["quality"])
        eventually("the page says how sure it is",
                   lambda: proposed["quality"] in self.browser.text("#align [role=status]"))
        self.browser.keep_picture("align")
        self.press("Undo")
        eventually("nothing is proposed", lambda: not self.proposed())
        self.assertEqual(self.camera()["in_force"]["outline"], wrong)
        self.assertEqual(self.calibrations(), [])
        self.expect_no_complaint()

    def test_keys_move_the_outline_by_a_tenth_of_a_pixel(self):
        self.open()
        before = self.camera()["in_force"]["outline"]
        self.handle("centre").send_keys(Keys.ARROW_RIGHT)
        eventually("a proposal", self.proposed)
        self.assertAlmostEqual(self.proposed()["outline"]["u"], before["u"] + 0.1)
        self.assertAlmostEqual(self.proposed()["outline"]["v"], before["v"])
        self.handle("centre").send_keys(Keys.SHIFT + Keys.ARROW_UP)
        eventually("another step", lambda: self.camera()["steps"] == 2)
        self.assertAlmostEqual(self.proposed()["outline"]["v"], before["v"] - 1)
        self.handle("rx").send_keys(Keys.ARROW_LEFT)
        eventually("a third step", lambda: self.camera()["steps"] == 3)
        self.assertAlmostEqual(self.proposed()["outline"]["rx"], before["rx"] - 0.1)
        self.assertAlmostEqual(self.proposed()["outline"]["ry"], before["ry"])
        self.press("Undo")
        eventually("the radius is back", lambda: self.camera()["steps"] == 2)
        self.assertAlmostEqual(self.proposed()["outline"]["rx"], before["rx"])
        self.assertAlmostEqual(self.proposed()["outline"]["v"], before["v"] - 1)
        self.press("Discard")
        eventually("nothing is proposed", lambda: not self.proposed())
        self.assertEqual(self.calibrations(), [])
        self.expect_no_complaint()

    def test_what_is_dragged_and_accepted_is_the_calibration(self):
        self.open()
        before = self.camera()["in_force"]["outline"]
        scale = self.browser.execute_script(
            "const canvas = document.querySelector('#align .ball canvas');"
            "return canvas.width / canvas.getBoundingClientRect().width")
        ActionChains(self.browser).drag_and_drop_by_offset(self.handle("centre"), -11, -7).perform()
        proposed = eventually("a proposal", self.proposed)
        self.assertAlmostEqual(proposed["outline"]["u"], before["u"] - 11 * scale, delta=scale)
        self.assertAlmostEqual(proposed["outline"]["v"], before["v"] - 7 * scale, delta=scale)
        self.assertEqual(self.calibrations(), [])
        entry = self.accept()
        self.assertEqual(entry["method"], "outline by hand")
        numpy.testing.assert_allclose(
            entry["outline"]["centre"], [proposed["outline"]["u"], proposed["outline"]["v"]])
        # And back to what counted before, which is the rig file's.
        self.press("Back to the alignment before")
        eventually("it is written", lambda: len(self.calibrations()) == 2)
        eventually("the rig file counts",
                   lambda: (self.camera() or {}).get("in_force", {}).get("outline") == before)
        self.expect_no_complaint()


if __name__ == "__main__":
    unittest.main()
