# SPDX-License-Identifier: Apache-2.0
"""The page of alignment: its steps, and the pictures that a user judges by.

Folders: app/ports/web/page/files/align app/alignment app/watch
"""

import json
import signal
import unittest
import urllib.error

import numpy
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.select import Select

from align_case import AlignCase
from appliance import eventually

GOOD = 1  # state of an alignment that is watched
COMMAND = "api/v1/command/"

# Pixel of the picture at which an edge of the scene can be pressed.
FREE_PIXEL = """
    const svg = document.querySelector('#align .ball svg');
    svg.scrollIntoView({ block: 'center' });
    for (const grip of svg.querySelectorAll('.grip')) {
      for (const { x, y } of grip.points) {
        const place = new DOMPoint(x, y).matrixTransform(svg.getScreenCTM());
        if (document.elementFromPoint(place.x, place.y) === grip) return [x, y];
      }
    }
    return null;"""
# Presses a key of a handle of the outline, of all of them within one change.
PRESS_HANDLES = """
    for (const name of ['centre', 'rx']) {
      document.querySelector(`#align [data-handle=${name}]`)
        .dispatchEvent(new KeyboardEvent('keydown', { key: 'ArrowRight', bubbles: true }));
    }"""


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


class OtherCamera(AlignCase):
    """Another camera is chosen while the requests of a gesture are under way."""

    def tearDown(self):
        if (self.camera() or {}).get("proposed"):
            self.answer("api/v1/command/discard_alignment", {"camera": 0})

    def switch(self, held):
        """Chooses the other camera once so many answers are held; returns when the page has gone on with them."""
        eventually("the answers are held", lambda: self.browser.held_answers() == held)
        Select(self.browser.find_element(By.CSS_SELECTOR, "#align [name=camera]")).select_by_value("thermal")
        before = len(self.browser.asked("api/v1/alignment"))
        self.browser.let_go()
        eventually("the page goes on", lambda: len(self.browser.asked("api/v1/alignment")) > before + 6)

    def hold_edge(self, path):
        """Holds the answers of this path, and returns the drag of an edge of the colour camera, to be performed."""
        self.open("colour")
        self.press("Find the ball")
        self.found()
        end = self.proposed()["edges"][0]["pixels"][0][0]
        eventually("the page draws the proposal", lambda: str(end) in self.browser.execute_script(
            "return document.querySelector('#align .ball .edges').innerHTML"))
        u, v = eventually("an edge", lambda: self.browser.execute_script(FREE_PIXEL))
        self.browser.hold_answers(path)
        return self.pointer_at(u, v).click_and_hold().move_by_offset(30, 20)

    def given(self):
        """Commands that the page gave, with the index of the camera of each."""
        return [(address.removeprefix(COMMAND), json.loads(body)["camera"])
                for address, body in self.browser.asked(COMMAND)]

    def alert(self):
        return self.browser.text("#align [role=alert]")

    def test_a_point_is_not_marked_for_another_camera(self):
        self.open("colour")
        self.open_step("place")
        self.browser.hold_answers("command/pick_pixel")
        self.fill("#point", u=300, v=300, x=1, y=2, z=3)
        self.press("Add the point")
        self.switch(held=1)
        self.assertEqual(self.given(), [("pick_pixel", 0)])
        self.assertEqual(self.alert(), "")
        self.assertEqual([self.camera(name)["points"] for name in ("colour", "thermal")], [[], []])
        self.expect_no_complaint()

    def test_an_edge_does_not_turn_another_camera(self):
        self.hold_edge("alignment/direction").release().perform()
        self.switch(held=2)
        self.assertEqual(self.given(), [])
        self.assertEqual(self.camera("thermal")["steps"], 0)
        self.expect_no_complaint()

    def test_an_edge_that_is_held_does_not_turn_another_camera(self):
        self.hold_edge("nothing").perform()
        eventually("an edge is held", lambda: self.browser.find_elements(By.CSS_SELECTOR, "#align .ball path.pull"))
        self.switch(held=0)
        ActionChains(self.browser).release().perform()
        self.assertEqual(self.browser.asked("alignment/direction"), [])
        self.assertEqual(self.given(), [])
        self.expect_no_complaint()

    def test_the_rest_of_a_changed_outline_does_not_change_another_camera(self):
        self.open("colour")
        eventually("the outline", lambda: self.handle("centre").is_displayed())
        self.browser.hold_answers("command/move_outline")
        self.browser.execute_script(PRESS_HANDLES)
        self.switch(held=1)
        self.assertEqual(self.given(), [("move_outline", 0)])
        self.assertEqual(self.camera("thermal")["steps"], 0)
        self.handle("centre").send_keys(Keys.ARROW_RIGHT)
        eventually("the other camera can be changed", lambda: self.camera("thermal")["steps"] == 1)
        self.press("Discard")
        eventually("nothing is proposed", lambda: not self.proposed("thermal"))
        self.expect_no_complaint()

    def test_a_refusal_names_the_camera_that_is_not_shown_any_more(self):
        self.open("colour")
        self.browser.hold_answers("command/turn_camera", "the ball is hidden")
        self.open_step("register")
        self.press("Yaw +0.05°")
        self.switch(held=1)
        eventually("the refusal", lambda: self.alert() == "Refused: colour: the ball is hidden")


class Roles(AlignCase):
    def test_a_page_without_the_role_offers_no_command_and_says_so(self):
        self.add_users("viewer", "operator")
        learn, learning_needs = "Learn the clean ball", "Learning needs the role operator."
        for role, offered in (("viewer", set()), ("operator", {learn})):
            with self.subTest(role=role):
                self.log_in_as(role, "#/align")
                self.open("colour")
                eventually("edges", lambda: self.browser.find_elements(By.CSS_SELECTOR, "#align .ball .edges polyline"))
                labels = {button.get_property("textContent") for button in self.browser.find_elements(
                    By.CSS_SELECTOR, "#align button")}
                self.assertEqual(labels, offered)
                self.assertEqual(self.browser.find_elements(By.CSS_SELECTOR, "#align .grip, #align [data-handle]"), [])
                self.assertIn("Aligning needs the role integrator.", self.browser.text("#step-ball"))
                self.assertEqual(learning_needs in self.browser.text("#step-clean"), role == "viewer")
                self.browser.keep_picture(f"align-{role}")


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


    def test_pictures_that_never_come_are_given_up(self):
        self.open("thermal")
        self.browser.execute_script("""
            const fetched = window.fetch;
            window.limited = [];
            window.fetch = (address, options) => {
              if (String(address).includes('alignment/pair')) window.limited.push(Boolean(options?.signal));
              return fetched(address, options);
            };""")
        self.open_step("register")
        self.assertTrue(eventually("a request", lambda: self.browser.execute_script("return window.limited"))[0])


class RenamedCamera(AlignCase):
    """A restart renames a camera."""

    def rename(self, before, after):
        for file in self.appliance.folder.glob("demo*.toml"):
            text = file.read_text(encoding="utf-8")
            for key in ("name", "camera", "measured"):
                text = text.replace(f'{key} = "{before}"', f'{key} = "{after}"')
            file.write_text(text, encoding="utf-8")
        self.appliance.plug_in(after)

    def offered(self):
        return self.browser.execute_script(
            "return [...document.querySelectorAll('#align [name=camera] option')].map(({ value }) => value)")

    def test_a_renamed_camera_is_offered_by_its_new_name(self):
        self.open("thermal")
        self.appliance.stop()
        self.rename("thermal", "infrared")
        self.appliance.start()
        eventually("the new name", lambda: self.offered() == ["colour", "infrared"])
        choice = Select(self.browser.find_element(By.CSS_SELECTOR, "#align [name=camera]"))
        for camera in ("colour", "infrared"):
            choice.select_by_value(camera)
            eventually("a picture of this camera", lambda: self.browser.text("#align .ball .age").endswith("old"))
            self.assertEqual(self.browser.text("#align [role=alert]"), "")


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
