# SPDX-License-Identifier: Apache-2.0
"""Placement of a camera by known points, on the page, against a running daemon whose rig file is wrong.

Folders: app/ports/web/align app/ports/web/page/files/align app/alignment app/watch proc/align
"""

import unittest

import cv2
import numpy
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.support.select import Select

from align_case import AlignCase
from appliance import eventually
from misaligned_machine import degrees_between, seen_at


class Place(AlignCase):
    # Corners of enclosure and workpiece, well apart in the ball.
    POINTS = [(-600, -500, 0), (600, -500, 0), (-600, -500, 800), (600, -500, 800),
              (-190, -130, 178), (-30, -130, 178), (250, -200, 140)]

    def pixels(self):
        """Pixels at which the colour camera's ball shows the points."""
        rig = self.appliance.rig
        return [seen_at(rig["camera"][0], rig["ball"], point) for point in self.POINTS]

    def add_a_wrong_point_and_remove_it(self):
        points = self.camera()["points"]
        self.answer("api/v1/command/pick_pixel", {"camera": 0, "u": 400, "v": 400})
        self.answer("api/v1/command/mark_point", {"camera": 0, "x": 1.5, "y": 2, "z": 3})
        wrong = eventually("it is on the page", lambda: self.browser.find_elements(
            By.CSS_SELECTOR, "#place [aria-label='Remove the point at 1.50, 2.00, 3.00']:enabled"))
        wrong[0].click()
        eventually("only it is removed", lambda: self.camera()["points"] == points)

    def crosses(self):
        """Number of points drawn in the picture."""
        return len(self.browser.find_elements(By.CSS_SELECTOR, "#align .marks path"))

    def position(self):
        """Top of the picture on the screen."""
        return self.browser.execute_script(
            "return document.querySelector('#align .ball canvas').getBoundingClientRect().top")

    def test_a_clicked_point_is_drawn_at_once_and_the_picture_stays(self):
        for width in (1440, 500):
            with self.subTest(width=width):
                self.browser.set_window_size(width, 900)
                self.browser.get("about:blank")
                self.open("colour")
                self.pointer_at(300, 300).click().perform()
                self.assertEqual(self.crosses(), 0, "no point is being marked")
                self.open_step("place")
                self.pointer_at(300, 300).perform()
                before = self.position()
                ActionChains(self.browser).click().perform()
                self.assertEqual(self.crosses(), 1)
                self.assertAlmostEqual(self.position(), before, delta=1)
                clicked = float(self.browser.find_element(By.NAME, "u").get_property("value"))
                self.assertAlmostEqual(clicked, 300, delta=3)
        self.expect_no_complaint()

    def test_corners_of_the_scene_beside_a_clicked_point_are_offered_and_added(self):
        self.open("colour")
        self.open_step("place")
        self.assertNotIn("Corner at", self.browser.text("#place"))
        self.pointer_at(*self.pixels()[0]).click().perform()
        self.press("Corner at -600.0, -500.0, 0.0")
        eventually("it is marked", lambda: [tuple(one["point"]) for one in self.camera()["points"]] ==
                   self.POINTS[:1])
        self.expect_no_complaint()

    def test_coordinates_are_written_as_in_the_page_s_language(self):
        self.open("colour")
        Select(self.browser.find_element(By.ID, "language")).select_by_value("de")
        eventually("German", lambda: self.browser.text("#align-title") == "Ausrichten")
        eventually("a picture", lambda: self.browser.text("#align .ball .age").endswith("alt"))
        self.open_step("place")
        self.pointer_at(*self.pixels()[0]).click().perform()
        self.assertIn("Ecke bei -600,0; -500,0; 0,0", self.browser.text("#place"))
        self.expect_no_complaint()

    def typed(self):
        return [self.browser.find_element(By.CSS_SELECTOR, f"#point [name={name}]").get_property("value")
                for name in "uvxyz"]

    def test_the_next_point_that_is_begun_while_one_is_added_stays(self):
        self.open("colour")
        self.open_step("place")
        self.fill("#point", u=300, v=310, x=1, y=2, z=3)
        self.browser.hold_answers("command/mark_point")
        self.press("Add the point")
        eventually("its answer waits", lambda: self.browser.held_answers() == 1)
        self.addCleanup(self.answer, "api/v1/command/forget_points", {"camera": 0})
        self.fill("#point", u=400, v=410, x=4)
        # The page empties it at the end of the command, and judges the form in the same step.
        self.browser.execute_script("document.querySelector('#align [role=alert]').textContent = 'an earlier refusal'")
        self.browser.let_go()
        eventually("the point is added", lambda: self.browser.text("#align [role=alert]") == "")
        self.assertEqual(self.typed(), ["400", "410", "4", "2", "3"])
        self.press("Add the point")
        eventually("nothing is left of a point that was added", lambda: self.typed() == [""] * 5)
        self.assertEqual([one["point"] for one in self.camera()["points"][-2:]], [[1, 2, 3], [4, 2, 3]])
        self.expect_no_complaint()

    def test_a_loupe_shows_the_picture_under_the_pointer(self):
        self.open("colour")
        self.open_step("place")
        self.pointer_at(300, 400).perform()
        loupe = self.browser.find_element(By.CSS_SELECTOR, "#align .loupe")
        self.assertTrue(loupe.is_displayed())
        self.browser.keep_picture("loupe")
        zoomed, below, scale = self.browser.execute_script("""
            const [loupe, picture] = ['.loupe', 'canvas'].map((one) =>
                document.querySelector(`#align .ball ${one}`));
            const scale = picture.width / picture.getBoundingClientRect().width;
            const grey = (canvas, x, y, side) => {
                const { data } = canvas.getContext('2d').getImageData(x, y, side, side);
                return Array.from({ length: side * side }, (_, k) => data[4 * k + 1]);
            };
            const side = Math.round(160 / 4 * scale);
            const [x, y] = [[loupe.style.left, picture.width], [loupe.style.top, picture.height]].map(
                ([share, length]) => Math.round(parseFloat(share) / 100 * length - side / 2));
            return [grey(loupe, 0, 0, 160), grey(picture, x, y, side), scale];""")
        side = round(40 * scale)
        zoomed, below = numpy.reshape(zoomed, (160, 160)), numpy.reshape(below, (side, side))
        enlarged = cv2.resize(below.astype(numpy.uint8), (160, 160), interpolation=cv2.INTER_NEAREST)
        correlation = numpy.corrcoef(zoomed.ravel(), enlarged.ravel())[0, 1]
        self.assertGreater(correlation, 0.8)
        ActionChains(self.browser).move_to_element(
            self.browser.find_element(By.CSS_SELECTOR, "#step-place summary")).perform()
        self.assertFalse(loupe.is_displayed())
        self.expect_no_complaint()

    def test_a_camera_is_placed_by_points_that_are_clicked(self):
        self.open("colour")
        self.press("Find the ball")
        self.found()
        self.open_step("place")
        # The placed rotation must follow from the points alone.
        self.answer("api/v1/command/turn_camera", {"camera": 0, "yaw": 10, "pitch": 5, "roll": -7})
        pixels = self.pixels()
        for count, (point, (u, v)) in enumerate(zip(self.POINTS, pixels), start=1):
            if count == 1:
                self.pointer_at(u, v).click().perform()
                clicked = float(self.browser.find_element(By.NAME, "u").get_property("value"))
                self.assertAlmostEqual(clicked, u, delta=2)
            self.fill("#point", u=round(u, 1), v=round(v, 1),
                      **dict(zip("xyz", point)))
            self.press("Add the point")
            eventually("it is marked", lambda count=count: len(self.camera()["points"]) == count)
        self.assertEqual([tuple(point["point"]) for point in self.camera()["points"]], self.POINTS)
        self.add_a_wrong_point_and_remove_it()
        self.press("Place")
        eventually("residuals", lambda: all(point["residual"] for point in self.camera()["points"]))
        self.found()
        residuals = [numpy.hypot(*point["residual"]) for point in self.camera()["points"]]
        self.assertLess(max(residuals), 0.5)
        first = self.camera()["points"][0]["residual"]
        eventually("the page shows them", lambda: ", ".join(f"{one:.2f}" for one in first)
                   in self.browser.text("#place tbody"))
        self.browser.keep_picture("place")
        entry = self.accept()
        self.assertIn("place by 7 points", entry["method"])
        truth = self.appliance.rig["camera"][0]["pose"]
        rotation = numpy.reshape(entry["pose"]["rotation"], (3, 3))
        self.assertLess(degrees_between(rotation, numpy.reshape(truth["rotation"], (3, 3))), 0.2)
        self.assertLess(numpy.linalg.norm(numpy.subtract(entry["pose"]["position"],
                                                         truth["position"])), 3)
        self.expect_no_complaint()


if __name__ == "__main__":
    unittest.main()
