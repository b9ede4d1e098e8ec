# SPDX-License-Identifier: Apache-2.0
"""Alignment on the page, against a running daemon whose rig file is wrong.

Folders: app/ports/web/align app/ports/web/page/files/align app/alignment app/watch proc/align
"""

import json
import unittest

import cv2
import numpy
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.select import Select

from align_case import AlignCase
from appliance import eventually
from misaligned_machine import degrees_between, direction_of, rotation_of, seen_at

CLICK_PX = 5  # px; a shorter drag may count as a click
VIEW_SIDE = 480  # px


class Outline(AlignCase):
    def tearDown(self):
        if (self.camera() or {}).get("proposed"):
            self.answer("api/v1/command/discard_alignment", {"camera": 0})

    def expect_outline(self, shown, truth, share):
        """Checks that centre and radii agree within that share of the radius."""
        for key in ("u", "v"):
            self.assertLess(abs(shown[key] - truth[key]), share * truth["rx"], key)
        self.assertLess(abs((shown["rx"] + shown["ry"] - truth["rx"] - truth["ry"]) / 2),
                        share * truth["rx"])

    def test_the_ball_is_found_and_taken_back(self):
        self.open()
        wrong = self.camera()["in_force"]["outline"]
        self.press("Find the ball")
        proposed = self.found()
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
        # Returns to the previous alignment, which is the rig file's.
        self.press("Back to the alignment before")
        eventually("it is written", lambda: len(self.calibrations()) == 2)
        eventually("the rig file counts",
                   lambda: (self.camera() or {}).get("in_force", {}).get("outline") == before)
        self.expect_no_complaint()


class Register(AlignCase):
    def compared(self, way):
        Select(self.browser.find_element(By.NAME, "way")).select_by_value(way)
        return numpy.reshape(self.browser.pixels("#register canvas"), (480, 480))

    def number(self):
        return int(self.browser.execute_script(
            "return document.querySelector('#register canvas').dataset.number ?? 0"))

    def pair(self):
        """Both pictures of the interface's pair with their heads: [(head, picture)]."""
        body, messages = self.answer("api/v1/alignment/pair?camera=thermal"), []
        while body:
            head, _, body = body.partition(b"\n")
            head = json.loads(head)
            jpeg, body = body[:head["bytes"]], body[head["bytes"]:]
            messages.append((head, cv2.imdecode(numpy.frombuffer(jpeg, numpy.uint8), cv2.IMREAD_COLOR)))
        return messages

    def test_compared_pictures_are_of_one_frame_set(self):
        (first, in_colour), (second, in_grey) = self.pair()
        self.assertEqual([first["camera"], second["camera"]], ["colour", "thermal"])
        self.assertEqual(first["stamp"], second["stamp"])
        self.assertGreater(cv2.cvtColor(in_colour, cv2.COLOR_BGR2HSV)[:, :, 1].mean(), 10)
        self.assertEqual(cv2.cvtColor(in_grey, cv2.COLOR_BGR2HSV)[:, :, 1].max(), 0)
        self.open("thermal")
        self.open_step("register")
        eventually("a comparison", self.number)
        Select(self.browser.find_element(By.NAME, "way")).select_by_value("blend")
        self.assertIn("colour, thermal, of one frame set", self.browser.text("#register figcaption"))
        shown = self.browser.execute_script(
            "return document.querySelector('#register canvas').dataset.stamp")
        self.assertGreater(shown, first["stamp"])
        self.expect_no_complaint()

    def test_a_comparison_without_one_of_its_cameras_is_refused_with_the_reason(self):
        self.appliance.unplug("colour")
        self.addCleanup(eventually, "it is there again", self.delivers)
        self.addCleanup(self.appliance.plug_in, "colour")
        self.open("thermal")
        self.open_step("register")
        eventually("the page says so", lambda: (
            "first camera: there is no picture: camera is not connected"
            in self.browser.text("#register [role=alert]")))

    def delivers(self):
        """Whether all cameras deliver."""
        return all(camera["fault"] == 0 for camera in self.appliance.status()["cameras"])

    def test_both_cameras_are_compared_and_one_is_turned_by_hand(self):
        self.open("thermal")
        self.open_step("register")
        eventually("a comparison", self.number)
        blend, board = self.compared("blend"), self.compared("checkerboard")
        self.assertGreater(numpy.std(board), 10)
        # Fields alternate between the cameras: half of them differ equally from the mixture.
        self.assertGreater(numpy.mean(numpy.abs(board - blend)), 5)
        before = rotation_of(self.camera("thermal")["in_force"]["rotation"])
        shown = self.number()
        self.press("Yaw +0.05°")
        eventually("a proposal", lambda: self.proposed("thermal"))
        self.press("Yaw +0.05°")
        self.press("Pitch −0.05°")
        eventually("three steps", lambda: self.camera("thermal")["steps"] == 3)
        after = rotation_of(self.proposed("thermal")["rotation"])
        self.assertAlmostEqual(degrees_between(after, before), numpy.hypot(0.1, 0.05), delta=1e-3)
        eventually("it is compared anew", lambda: self.number() > shown)
        self.browser.keep_picture("register")
        self.press("Discard")
        eventually("nothing is proposed", lambda: not self.proposed("thermal"))
        self.expect_no_complaint()

    def test_what_is_5_percent_and_10_degrees_wrong_becomes_right(self):
        """Finds both balls and the second camera's orientation; the limits are those of the
        methods."""
        self.open("colour")
        eventually("the header says that it is not aligned", lambda: (
            "colour is not aligned" in self.browser.text("#notices a[href='#/align']")))
        for name, share in (("colour", 0.0015), ("thermal", 0.01)):
            Select(self.browser.find_element(By.CSS_SELECTOR, "#align [name=camera]")
                   ).select_by_value(name)
            self.press("Find the ball")
            self.found(name)
            entry = self.accept(name)
            self.assertEqual(entry["method"], "detect")
            self.expect_outline(entry["outline"], self.appliance.truth[name][0], share)
        self.assertGreater(self.registration_error(), 8)
        self.press("Register")
        self.assertIn("residual", self.found("thermal")["quality"])
        eventually("the page says how well", lambda: "residual" in self.browser.text(
            "#align [role=status]"))
        entry = self.accept("thermal")
        self.assertIn("register", entry["method"])
        self.assertLess(self.registration_error(), 0.8)
        self.browser.keep_picture("registered")
        self.expect_no_complaint()

    def test_nothing_keeps_anybody_out(self):
        def show():
            self.open("thermal")
            self.open_step("register")
            eventually("a comparison", self.number)

        self.expect_no_barriers(show)
        self.browser.set_window_size(500, 844)
        self.expect_fits_its_width()
        self.browser.keep_picture("align-phone")

    def registration_error(self):
        """Error of the alignment in force, degrees."""
        return degrees_between(rotation_of(self.camera("thermal")["in_force"]["rotation"]),
                               self.appliance.truth["thermal"][1])

    def expect_outline(self, entry, truth, share):
        """Checks that centre and radius in calibration.toml agree within that share of the
        radius."""
        radii = entry.get("radii", [entry.get("radius")] * 2)
        self.assertLess(abs(entry["centre"][0] - truth["u"]), share * truth["rx"])
        self.assertLess(abs(entry["centre"][1] - truth["v"]), share * truth["rx"])
        self.assertLess(abs(sum(radii) - truth["rx"] - truth["ry"]) / 2, share * truth["rx"])


class Edges(AlignCase):
    def test_an_edge_that_is_dragged_onto_the_machine_s_turns_the_camera(self):
        """Drags at two corners alternately, until the error is too small to be dragged on the
        screen."""
        self.browser.set_window_size(1800, 1400)
        self.open("colour")
        self.press("Find the ball")
        self.found()
        self.answer("api/v1/command/turn_camera", {"camera": 0, "yaw": 6, "pitch": -4, "roll": 5})
        truth = self.appliance.truth["colour"][1]
        wrong = degrees_between(rotation_of(self.proposed()["rotation"]), truth)
        self.assertGreater(wrong, 8)
        rig = self.appliance.rig
        scale = self.browser.find_element(By.CSS_SELECTOR, "#align .ball svg").size["width"] / 1000
        for point in [(-600, -500, 800), (600, -500, 0)] * 3:
            target = seen_at(rig["camera"][0], rig["ball"], point)
            u, v = self.corner_near(target)
            by = [round((target[0] - u) * scale), round((target[1] - v) * scale)]
            if numpy.hypot(*by) < CLICK_PX:
                continue
            steps = self.camera()["steps"]
            eventually("the page draws it", lambda u=u: str(u) in self.browser.execute_script(
                "return document.querySelector('#align .edges').innerHTML"))
            self.pointer_at(u, v).click_and_hold().move_by_offset(*by).release().perform()
            eventually("it is turned", lambda steps=steps: self.camera()["steps"] == steps + 1)
        self.browser.keep_picture("edges")
        # A pixel of the screen is 0.3 degrees.
        self.assertLess(degrees_between(rotation_of(self.proposed()["rotation"]), truth),
                        0.3 * CLICK_PX)
        self.press("Discard")
        eventually("nothing is proposed", lambda: not self.proposed())
        self.expect_no_complaint()

    def test_an_edge_that_is_dragged_in_a_view_turns_the_camera(self):
        """Uses corners behind the camera, on its left and right."""
        self.open("colour")
        self.press("Find the ball")
        self.found()
        self.open_step("check")
        self.answer("api/v1/command/turn_camera", {"camera": 0, "yaw": 6, "pitch": -4, "roll": 5})
        truth = self.appliance.truth["colour"][1]
        rig = self.appliance.rig
        for point in [(-600, -500, 800), (600, -500, 0)] * 3:
            where = numpy.subtract(point, rig["ball"]["centre"])
            self.look_at(where)
            u, v = seen_at(rig["camera"][0], rig["ball"], point)
            shown = json.loads(self.answer(f"api/v1/alignment/direction?camera=colour&u={u}&v={v}"))
            view = self.browser.find_element(By.CSS_SELECTOR, "#scene svg")
            scale = view.size["width"] / VIEW_SIDE
            drawn, there = (numpy.round(scale * self.in_view(direction)) for direction in
                            (where, direction_of(shown["yaw"], shown["pitch"])))
            if numpy.hypot(*(there - drawn)) < CLICK_PX:
                continue
            steps = self.camera()["steps"]
            self.browser.execute_script("arguments[0].scrollIntoView({block: 'center'})", view)
            ActionChains(self.browser).move_to_element_with_offset(view, *drawn).click_and_hold(
            ).move_by_offset(*(there - drawn)).release().perform()
            eventually("it is turned", lambda steps=steps: self.camera()["steps"] == steps + 1)
        self.browser.keep_picture("scene")
        # A pixel of the screen is at most 0.25 degrees.
        self.assertLess(degrees_between(rotation_of(self.proposed()["rotation"]), truth),
                        0.25 * CLICK_PX)
        self.press("Discard")
        eventually("nothing is proposed", lambda: not self.proposed())
        self.expect_no_complaint()

    def look_at(self, direction):
        """Turns the page's view close to it, until it and the edges are shown."""
        yaw = round(numpy.degrees(numpy.arctan2(direction[0], direction[1]))) // 5 * 5
        pitch = round(numpy.degrees(numpy.arcsin(direction[2] / numpy.linalg.norm(direction)))) // 5 * 5
        wanted = {"yaw": yaw, "pitch": pitch}
        def ends():
            return self.browser.execute_script(
                "return [...document.querySelectorAll('#scene polyline:not(.grip)')].flatMap("
                "line => [...line.points].map(({x, y}) => [x, y]))")
        for name, value in wanted.items():
            field = self.browser.find_element(By.CSS_SELECTOR, f"#scene [name={name}]")
            field.clear()
            field.send_keys(str(value), Keys.TAB)
        self.view = wanted
        corner = self.in_view(direction) + VIEW_SIDE / 2
        eventually("an edge ends in the corner", lambda: any(
            numpy.hypot(*(numpy.array(end) + 0.5 - corner)) < 1 for end in ends()))

    def in_view(self, direction):
        """Position relative to the middle of the page's view, px."""
        forward = direction_of(self.view["yaw"], self.view["pitch"])
        right = direction_of(self.view["yaw"] + 90, 0)
        focal = VIEW_SIDE / 2 / numpy.tan(numpy.radians(80) / 2)
        return focal / (direction @ forward) * numpy.array(
            [direction @ right, -direction @ numpy.cross(right, forward)])

    def corner_near(self, pixel):
        """The drawn end of an edge that is nearest to a pixel."""
        ends = [end for edge in self.proposed()["edges"]
                for end in (edge["pixels"][0], edge["pixels"][-1])]
        return min(ends, key=lambda end: numpy.hypot(*numpy.subtract(end, pixel)))


class Judge(AlignCase):
    def served(self, **query):
        """The view that the interface serves, as a picture."""
        arguments = "&".join(f"{name}={value}" for name, value in query.items())
        jpeg = self.answer(f"api/v1/alignment/view.jpg?{arguments}")
        return cv2.imdecode(numpy.frombuffer(jpeg, numpy.uint8), cv2.IMREAD_COLOR)

    def test_the_exact_model_shows_the_room_where_it_is_and_the_paper_s_does_not(self):
        """Uses the edge between ceiling and front wall, in views of a camera that found its
        ball."""
        self.answer("api/v1/command/detect_ball", {"camera": 0})
        self.found()
        self.answer("api/v1/command/accept_alignment", {"camera": 0})
        eventually("it is in force", lambda: (self.camera() or {}).get("in_force", {}).get("number"))
        self.assertLess(self.edge_error("exact"), 1.5)
        self.assertGreater(self.edge_error("paper"), 8)

    def edge_error(self, model):
        """Median distance of the edge from its true place, px."""
        side, yaw, pitch, h_fov = 800, 180, 20, 90
        view = self.served(camera="colour", model=model, yaw=yaw, pitch=pitch, h_fov=h_fov,
                           width=side, height=side)
        right, forward = direction_of(yaw + 90, 0), direction_of(yaw, pitch)
        up = numpy.cross(right, forward)
        scene = self.appliance.rig["scene"]
        points = numpy.array([[x, scene["low"][1], scene["high"][2]] for x in range(-200, 400, 10)])
        points = points - self.appliance.rig["ball"]["centre"]
        focal = side / 2 / numpy.tan(numpy.radians(h_fov) / 2)
        u = (side - 1) / 2 + focal * (points @ right) / (points @ forward)
        v = (side - 1) / 2 - focal * (points @ up) / (points @ forward)
        inside = (u > 0) & (u < side - 1)
        # The wall has a colour, the ceiling has none.
        saturation = cv2.cvtColor(view, cv2.COLOR_BGR2HSV)[:, :, 1]
        rows = [numpy.argmax(saturation[:, int(round(one))] > 60) for one in u[inside]]
        self.assertGreater(len(rows), 10)
        return numpy.median(numpy.abs(numpy.array(rows) - v[inside]))

    def test_drift_focus_and_dirt_are_shown_over_time(self):
        self.open("colour")
        self.open_step("check")
        def watched():
            return next(camera for camera in self.appliance.status()["cameras"]
                        if camera["name"] == "colour")
        eventually("its drift is measured", lambda: watched()["drift_error"] is not None)
        eventually("the page says so", lambda: watched()["alignment_text"]
                   in self.browser.text("#watched p"))
        eventually("the page says so", lambda: watched()["outline_check_text"]
                   in self.browser.text("#watched p:last-child"))
        eventually("the chart has it", lambda: "Error of the view directions in the last ten minutes"
                   in self.browser.find_element(By.CSS_SELECTOR, "#watched canvas")
                   .get_attribute("aria-label"))
        self.browser.keep_picture("watched")
        self.expect_no_complaint()


if __name__ == "__main__":
    unittest.main()
