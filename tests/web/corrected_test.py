# SPDX-License-Identifier: Apache-2.0
"""A misaligned machine, corrected on the page alone by a hand that clicks, on a screen of 1440x900 without scrolling.

Folders: app/ports/web/align app/ports/web/page/files/align app/alignment proc/align/place proc/align/detect
"""

import json
import random
import unittest

import numpy
from selenium.webdriver.common.by import By

from align_case import AlignCase
from appliance import eventually
from misaligned_machine import direction_of, seen_at

MOST_CLICKS = 25
WIDTH, HEIGHT = 1440, 900
HAND_PX = 1  # error of a click, pixels of the screen
WITHIN_MM = {"colour": 1, "thermal": 3}
CENTRE_OF_WORKPIECE = (-110, -50, 178)


class Corrected(AlignCase):
    # Corners that the thermal camera's ball shows, well apart.
    POINTS = [(-600, -500, 0), (600, -500, 0), (-600, -500, 800), (600, -500, 800), (600, 500, 800),
              (250, -200, 140), (-190, -130, 178)]

    def setUp(self):
        super().setUp()
        self.browser.show_on(WIDTH, HEIGHT)
        self.clicks = 0
        self.hand = random.Random(35)

    def click_at(self, x, y):
        """Presses the mouse at a place of the screen, to which nothing is scrolled."""
        for kind in ("mouseMoved", "mousePressed", "mouseReleased"):
            self.browser.execute_cdp_cmd("Input.dispatchMouseEvent", {
                "type": kind, "x": x, "y": y, "button": "none" if kind == "mouseMoved" else "left", "clickCount": 1})
        self.clicks += 1

    def box_of(self, shown):
        """Left, top, width and height on the screen, which shows all of it."""
        left, top, width, height = self.browser.execute_script("""
            const { left, top, width, height } = arguments[0].getBoundingClientRect();
            return [left, top, width, height];""", shown)
        for low, high, most in ((left, left + width, WIDTH), (top, top + height, HEIGHT)):
            self.assertGreaterEqual(low, 0, shown.text)
            self.assertLessEqual(high, most, shown.text)
        return left, top, width, height

    def click(self, shown):
        def middle():
            """Its middle, once nothing covers it: the page may still move after an answer."""
            return self.browser.execute_script("""
                const { left, top, width, height } = arguments[0].getBoundingClientRect();
                const [x, y] = [left + width / 2, top + height / 2];
                return arguments[0].contains(document.elementFromPoint(x, y)) && [x, y];""", shown)
        self.box_of(shown)
        self.click_at(*eventually("it can be clicked", middle))

    def press(self, label):
        def buttons():
            return self.browser.find_elements(
                By.XPATH, f"//*[@id='align']//button[text()='{label}' and not(@disabled)]")
        self.click(eventually(f"{label} can be pressed", buttons)[0])

    def choose(self, camera):
        """Chooses a camera: one click opens the list, one chooses. The list is the system's, beyond the page."""
        self.click(self.browser.find_element(By.CSS_SELECTOR, "#align [name=camera]"))
        self.clicks += 1
        self.browser.execute_script("""
            const list = document.querySelector('#align [name=camera]');
            list.blur();
            list.value = arguments[0];
            list.dispatchEvent(new Event('change'));""", camera)
        eventually("its picture", lambda: self.browser.text("#align .ball .age").endswith("old"))

    def find_the_ball(self, camera):
        self.press("Find the ball")
        return self.found(camera)

    def placed(self, camera):
        """Waits for a proposal that states an error at the work piece. The ball's, which stands until then, states none."""
        def proposed():
            proposal = self.found(camera)
            return proposal["work_sigma"] is not None and proposal
        return eventually(f"a placement of {camera}", proposed)

    def click_in_picture(self, pixel, size):
        """Clicks at a pixel of the ball's picture, as well as a hand can."""
        left, top, width, height = self.box_of(self.browser.find_element(By.CSS_SELECTOR, "#align .ball svg"))
        u, v = ((place + 0.5) / side for place, side in zip(pixel, size))
        x, y = left + u * width, top + v * height
        self.click_at(*(round(place + self.hand.uniform(-HAND_PX, HAND_PX)) for place in (x, y)))

    def error(self, camera):
        """Distance at the work piece, mm, between the truth and what the alignment in force shows there."""
        rig = self.appliance.rig
        stated = next(one for one in rig["camera"] if one["name"] == camera)
        towards = numpy.subtract(CENTRE_OF_WORKPIECE, rig["ball"]["centre"])
        u, v = seen_at(stated, rig["ball"], CENTRE_OF_WORKPIECE)
        shown = json.loads(self.answer(f"api/v1/alignment/direction?camera={camera}&u={u}&v={v}"))
        distance = numpy.linalg.norm(towards)
        cosine = direction_of(shown["yaw"], shown["pitch"]) @ towards / distance
        return distance * numpy.arccos(numpy.clip(cosine, -1, 1))

    def test_both_cameras_are_right_after_25_clicks_without_scrolling(self):
        self.open("colour")
        rig = self.appliance.rig
        thermal = rig["camera"][1]
        before = {camera: self.error(camera) for camera in WITHIN_MM}
        self.find_the_ball("colour")
        self.accept("colour")
        self.choose("thermal")
        self.find_the_ball("thermal")
        self.click(self.browser.find_element(By.CSS_SELECTOR, "#step-place > summary"))
        for count, point in enumerate(self.POINTS, start=1):
            self.click_in_picture(seen_at(thermal, rig["ball"], point), (thermal["width"], thermal["height"]))
            self.press("Corner at " + ", ".join(f"{place:.1f}" for place in point))
            eventually("it is marked", lambda count=count: len(self.camera("thermal")["points"]) == count)
        self.press("Place")
        proposed = self.placed("thermal")
        self.box_of(self.browser.find_element(By.CSS_SELECTOR, "#place tbody tr:last-child"))
        self.browser.keep_picture("corrected")
        self.accept("thermal")
        after = {camera: self.error(camera) for camera in WITHIN_MM}
        self.assertGreater(proposed["work_sigma"], after["thermal"])
        print(f"{self.clicks} clicks; mm at the work piece before {before}, after {after}")
        for camera, most in WITHIN_MM.items():
            self.assertGreater(before[camera], most)
            self.assertLess(after[camera], most)
        self.assertLessEqual(self.clicks, MOST_CLICKS)
        self.assertEqual(self.browser.execute_script("return [scrollX, scrollY]"), [0, 0])
        self.expect_no_complaint()


if __name__ == "__main__":
    unittest.main()
