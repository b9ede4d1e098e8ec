# SPDX-License-Identifier: Apache-2.0
"""The page of alignment: its steps, and the pictures that a user judges by.

Folders: app/ports/web/page/files/align app/alignment app/watch
"""

import json
import signal
import unittest
import urllib.error

import numpy
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.select import Select

from align_case import AlignCase
from appliance import eventually

GOOD = 1  # state of an alignment that is watched


class Steps(AlignCase):
    def test_the_first_step_needs_no_scrolling(self):
        self.browser.show_on(1440, 900)
        self.open()
        shown = self.browser.execute_script("""
            const named = (text) => [...document.querySelectorAll('#align button')]
                .find((button) => button.textContent === text);
            return [document.querySelector('#align .ball canvas'), named('Find the ball'), named('Accept')]
                .map((one) => one.getBoundingClientRect()).map(({ top, bottom, left }) => ({ top, bottom, left }));""")
        self.browser.keep_picture("align-steps")
        for box in shown:
            self.assertGreaterEqual(box["top"], 0)
            self.assertLessEqual(box["bottom"], 900)
        picture, find, _ = shown
        self.assertGreater(find["left"], picture["left"])
        self.browser.execute_script("scrollTo(0, document.body.scrollHeight)")
        top = self.browser.execute_script(
            "return document.querySelector('#align .ball canvas').getBoundingClientRect().top")
        self.assertGreaterEqual(top, 0)
        self.expect_no_complaint()

    def test_steps_say_what_is_done_and_what_is_stale(self):
        self.open()
        eventually("the rig file's outline does not count", lambda: self.state_of("ball") == "open")
        self.assertEqual(self.state_of("register"), "")
        self.press("Find the ball")
        self.found()
        self.accept()
        eventually("the ball is found", lambda: self.state_of("ball") == "done")
        self.assertEqual(self.state_of("place"), "open")
        eventually("the check says so", lambda: self.state_of("check") == "done")
        self.handle("rx").send_keys(Keys.SHIFT + Keys.ARROW_RIGHT * 20)
        eventually("a wrong outline is proposed", self.proposed)
        self.accept()
        eventually("the outline is wrong again", lambda: self.state_of("ball") == "stale: repeat it")
        self.expect_no_complaint()

    def test_a_correction_of_the_drift_is_proposed(self):
        self.open()
        eventually("the zero is learnt", lambda: self.appliance.status()["cameras"][0]["alignment"] == GOOD)
        self.press("Propose a correction of the drift")
        self.assertEqual(self.found()["method"], "drift")
        self.press("Discard")
        eventually("nothing is proposed", lambda: not self.proposed())

    def test_a_registration_shows_its_steps_and_is_cancelled(self):
        self.open("thermal")
        self.press("Register")
        eventually("its step", lambda: "recording pictures" in self.browser.text("#working:not([hidden])"))
        eventually("its progress", lambda: self.browser.execute_script(
            "return document.querySelector('#working progress').value > 0"))
        self.browser.keep_picture("align-working")
        self.press("Cancel")
        eventually("the page says so", lambda: self.browser.text("#align [role=status]")
                   == "Cancelled: nothing is changed")
        self.assertFalse(self.browser.find_element(By.ID, "working").is_displayed())
        self.assertEqual(self.camera("thermal")["state_text"], "nothing is proposed")
        self.assertEqual(self.camera("thermal")["steps"], 0)
        eventually("another one can begin", lambda: self.browser.find_elements(
            By.XPATH, "//*[@id='align']//button[text()='Register' and not(@disabled)]"))
        self.expect_no_complaint()

    def test_the_next_registration_begins_at_once_after_a_cancelled_one(self):
        def give(name):
            return json.loads(self.answer(f"api/v1/command/{name}", {"camera": camera["index"]}))["result_text"]

        camera = self.camera("thermal")
        self.assertEqual(give("register_camera"), "done")
        eventually("it records", lambda: self.camera("thermal")["step_text"] == "recording pictures")
        self.assertEqual(give("cancel_alignment"), "done")
        self.assertEqual(give("register_camera"), "done")
        eventually("it matches", lambda: self.camera("thermal")["step_text"].startswith("matching"))
        self.assertEqual(give("cancel_alignment"), "done")
        self.assertEqual(self.camera("thermal")["state_text"], "nothing is proposed")
        with self.assertRaisesRegex(urllib.error.HTTPError, "409"):
            give("cancel_alignment")

    def test_the_clean_ball_is_learnt(self):
        self.open()
        self.press("Learn the clean ball")
        eventually("it is in the audit", lambda: "learn_clean_ball" in [
            entry["what"] for entry in json.loads(self.answer("api/v1/audit"))["entries"]])
        self.assertEqual(self.browser.text("#align [role=alert]"), "")
        self.expect_no_complaint()


class Brightness(AlignCase):
    def test_a_thermal_picture_is_stretched_and_says_so(self):
        self.open("thermal")
        # Sums of three equal samples.
        grey = numpy.array(self.browser.pixels("#align .ball canvas")) / 3
        black, white = numpy.percentile(grey, [1, 99])
        self.assertLess(black, 15)
        self.assertGreater(white, 240)
        self.assertIn("stretched: 1st to 99th percentile",
                      self.browser.text("#align .ball figcaption"))
        self.browser.keep_picture("align-thermal")
        self.expect_no_complaint()


class Veils(AlignCase):
    def tearDown(self):
        if (self.camera() or {}).get("proposed"):
            self.answer("api/v1/command/discard_alignment", {"camera": 0})

    def propose(self):
        self.open("colour")
        self.press("Find the ball")
        self.found()
        eventually("it can be accepted", self.can_accept)

    def can_accept(self):
        return self.browser.find_element(By.XPATH, "//*[@id='align']//button[text()='Accept']").is_enabled()

    def reason(self):
        """Reason why nothing can be accepted, while the button and the picture agree."""
        veil = self.browser.text("#align .ball .veiled .overlay")
        reason = self.browser.text("#not-acceptable")
        return "" if self.can_accept() or not veil or veil not in reason else reason

    def test_nothing_is_accepted_over_the_picture_of_a_lost_camera(self):
        self.propose()
        self.appliance.unplug("colour")
        self.addCleanup(self.appliance.plug_in, "colour")
        eventually("the reason", lambda: "colour: camera is not connected" in self.reason())
        self.open_step("check")
        eventually("the view is veiled", lambda: "colour: camera is not connected" in self.browser.text(
            "#scene .veiled .overlay"))
        self.browser.keep_picture("align-lost")
        Select(self.browser.find_element(By.CSS_SELECTOR, "#align [name=camera]")
               ).select_by_value("thermal")
        eventually("the comparison names its first camera", lambda: "colour: camera is not connected"
                   in self.browser.text("#register .veiled .overlay"))
        Select(self.browser.find_element(By.CSS_SELECTOR, "#align [name=camera]")
               ).select_by_value("colour")
        self.appliance.plug_in("colour")
        eventually("it can be accepted again", self.can_accept)
        self.assertEqual(self.browser.text("#not-acceptable"), "")

    def test_nothing_is_accepted_over_an_old_picture(self):
        self.propose()
        self.appliance.daemon.send_signal(signal.SIGSTOP)
        self.addCleanup(self.appliance.daemon.send_signal, signal.SIGCONT)
        eventually("the reason", lambda: "No new picture for" in self.reason())
        self.appliance.daemon.send_signal(signal.SIGCONT)
        eventually("it can be accepted again", self.can_accept)

    def test_still_pictures_are_replaced_by_newer_ones(self):
        self.open("thermal")
        self.open_step("register")
        stamp = ("return document.querySelector('#register canvas').dataset.stamp")
        first = eventually("a comparison", lambda: self.browser.execute_script(stamp))
        eventually("a newer one", lambda: self.browser.execute_script(stamp) > first)
        self.assertRegex(self.browser.text("#register .age"), "old$")
        self.expect_no_complaint()


class Fingers(AlignCase):
    def test_two_fingers_zoom_the_ball(self):
        self.open()
        picture = self.browser.find_element(By.CSS_SELECTOR, "#align .ball svg")
        self.browser.execute_script("arguments[0].scrollIntoView({block: 'center'})", picture)
        # The places are away from handles and edges, which a finger drags.
        allowed = self.browser.execute_script(
            "return getComputedStyle(arguments[0]).touchAction", picture)
        self.assertIn(allowed, ("manipulation", "pan-x pan-y pinch-zoom"))


if __name__ == "__main__":
    unittest.main()
