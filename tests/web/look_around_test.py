# SPDX-License-Identifier: Apache-2.0
"""Views of the room that the browser draws, beside those of the appliance.

Folders: app/ports/web/look_around app/ports/web/page/files/look
"""

import base64
import json
import os
import unittest
import urllib.request

import cv2
import numpy
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.actions.wheel_input import ScrollOrigin
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

from appliance import PATIENCE_S, Appliance, eventually
from browser import HOLD_DECODING, module_address
from page_case import PageCase
from rendered_machine import PICTURES, RenderedMachine

WITH_WEBGL = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
WITHOUT_WEBGL = ["--disable-3d-apis"]
NEAR_BLIND_CONE_DEG = 6


class LookingAround(PageCase):
    QUALITY = 100  # without losses by JPEG
    WIDTH, HEIGHT = RenderedMachine.WIDTH, RenderedMachine.HEIGHT  # of the product's view
    ARGUMENTS = WITH_WEBGL

    @classmethod
    def make_appliance(cls):
        if not PICTURES.exists():
            if os.environ.get("ORBWATCH_ACCEPTANCE"):
                raise AssertionError(f"missing: {PICTURES}")
            raise unittest.SkipTest(f"skipped, missing: {PICTURES}")
        return RenderedMachine(cls.QUALITY)

    def open(self):
        self.browser.get(f"{self.appliance.address}#/look")
        eventually("there is a canvas",
                   lambda: self.browser.find_elements(By.CSS_SELECTOR, "#look canvas"))
        self.browser.execute_script(
            "const style = document.querySelector('#look canvas').style;"
            "style.width = `${arguments[0]}px`; style.height = `${arguments[1]}px`;",
            self.WIDTH, self.HEIGHT)
        eventually("the canvas shows a picture",
                   lambda: int(self.canvas.get_dom_attribute("data-number") or 0) > 0)

    @property
    def canvas(self):
        return self.browser.find_element(By.CSS_SELECTOR, "#look canvas")

    def get(self, path):
        with urllib.request.urlopen(self.appliance.address + path, timeout=PATIENCE_S) as answer:
            return answer.read()

    def point(self, view, yaw, pitch, h_fov):
        views = [one["name"] for one in self.appliance.status()["views"]]
        body = {"view": views.index(view), "yaw": yaw, "pitch": pitch, "h_fov": h_fov}
        request = urllib.request.Request(
            self.appliance.address + "api/v1/command/point_view", json.dumps(body).encode(),
            {"Content-Type": "application/json"})
        with urllib.request.urlopen(request, timeout=PATIENCE_S) as answer:
            self.assertEqual(answer.status, 200)

    def choose(self, **values):
        """Sets controls by their names."""
        for name, value in values.items():
            self.browser.execute_script("""
                const control = document.querySelector(`#look [name=${arguments[0]}]`);
                if (control.type === 'checkbox') control.checked = arguments[1];
                else control.value = arguments[1];
                control.dispatchEvent(new Event('input'));
                control.dispatchEvent(new Event('change'));""", name, value)

    def gaze(self):
        """Yaw, pitch and field of view of the canvas, once it is at rest."""
        self.browser.execute_async_script(
            "const done = arguments[0]; requestAnimationFrame(() => requestAnimationFrame(done));")
        return [float(self.canvas.get_dom_attribute(f"data-{name}"))
                for name in ("yaw", "pitch", "fov")]

    def drawn(self):
        """The canvas in grey."""
        url = self.browser.execute_script("return arguments[0].toDataURL('image/png')", self.canvas)
        png = numpy.frombuffer(base64.b64decode(url.split(",")[1]), numpy.uint8)
        return cv2.imdecode(png, cv2.IMREAD_GRAYSCALE)

    def snapshot(self, view):
        jpeg = numpy.frombuffer(self.get(f"snapshot.jpg?view={view}"), numpy.uint8)
        return cv2.imdecode(jpeg, cv2.IMREAD_GRAYSCALE)

    def expect_alike(self, view, where, least, tolerance=2):
        """Waits until the appliance's view shows the same as the canvas; its picture may precede
        the command that pointed it, so it is requested again."""
        shares = []

        def is_alike():
            difference = cv2.absdiff(self.drawn(), self.snapshot(view))
            shares.append(float(numpy.mean(difference[where] <= tolerance)))
            return shares[-1] >= least
        try:
            eventually("the appliance's view is the browser's", is_alike)
        finally:
            yaw, pitch, fov = self.gaze()
            print(f"{view} at yaw {yaw:.1f} pitch {pitch:.1f}, {fov:.0f} deg wide, JPEG quality "
                  f"{self.QUALITY}: {100 * max(shares):.2f} % alike of {numpy.mean(where):.2f}")

    def beyond_blind_cone(self):
        """Distance of each pixel from camera A's blind cone, degrees; below 0 within."""
        head = json.loads(self.get("api/v1/sphere?view=ball").split(b"\n", 1)[0])
        away = self.appliance.angle_from([-x for x in head["facing"]], *self.gaze())
        return away - self.appliance.blind_half_angle


class WebGl(LookingAround):
    def drag(self, x, y):
        ActionChains(self.browser).drag_and_drop_by_offset(self.canvas, x, y).perform()

    def test_draws_what_the_appliance_draws(self):
        self.open()
        self.choose(second="", blind=False)
        for x, y, zoom in [(0, 0, ""), (400, 0, ""), (400, 150, ""), (-300, -250, ""),
                           (300, 0, "+++++"), (-400, 0, "----------")]:
            self.drag(x, y)
            if zoom:
                self.canvas.send_keys(zoom)
            gaze = self.gaze()
            with self.subTest(gaze=gaze):
                where = self.beyond_blind_cone() > NEAR_BLIND_CONE_DEG
                self.assertGreater(numpy.mean(where), 0.5)
                self.point("turned", *gaze)
                # A wide gaze needs a smaller picture, whose quality is lower.
                least, tolerance = (0.9, 16) if zoom.startswith("-") else (0.99, 2)
                self.expect_alike("turned", where, least, tolerance)
        self.browser.keep_picture("look")
        # Reading a canvas slows its processor down, which only this test does.
        self.assertEqual([entry for entry in self.browser.complaints()
                          if "GPU stall due to ReadPixels" not in entry["message"]], [])

    def test_keys_wheel_and_fingers_turn_it(self):
        self.open()
        yaw, pitch, fov = self.gaze()
        self.canvas.send_keys(Keys.ARROW_RIGHT, Keys.ARROW_UP)
        self.assertAlmostEqual(self.gaze()[0], yaw + fov / 20, 6)
        self.assertAlmostEqual(self.gaze()[1], pitch + fov / 20, 6)
        self.canvas.send_keys("+")
        self.assertAlmostEqual(self.gaze()[2], fov / 1.1, 6)
        self.canvas.send_keys(Keys.HOME)
        self.assertEqual(self.gaze(), [yaw, pitch, fov])
        self.browser.execute_script("arguments[0].scrollIntoView({block: 'center'})", self.canvas)
        ActionChains(self.browser).scroll_from_origin(
            ScrollOrigin.from_element(self.canvas), 0, -200).perform()
        self.assertLess(self.gaze()[2], fov)
        self.canvas.send_keys(Keys.HOME)
        self.browser.pinch(self.canvas)
        self.assertLess(self.gaze()[2], fov / 1.5)
        self.assertAlmostEqual(self.gaze()[0], yaw, 0)

    def test_marks_are_drawn(self):
        self.open()
        self.choose(second="", blind=False)
        self.gaze()
        plain = self.drawn()
        for mark in ("resolution", "wireFrame"):
            self.choose(**{mark: True})
            self.gaze()
            changed = numpy.mean(cv2.absdiff(self.drawn(), plain) > 10)
            self.assertGreater(changed, 0.5 if mark == "resolution" else 0.001, mark)
            self.browser.keep_picture(f"look-{mark}")
            self.choose(**{mark: False})
            self.gaze()
            self.assertLess(numpy.mean(cv2.absdiff(self.drawn(), plain) > 2), 0.001)
        # The view is away from the camera's best resolution.
        self.drag(440, 0), self.drag(440, 0), self.drag(440, 0), self.drag(440, 0)
        self.gaze()
        unmarked, beyond = self.drawn(), self.beyond_blind_cone()
        self.choose(blind=True)
        self.gaze()
        differs = cv2.absdiff(self.drawn(), unmarked) > 10
        self.assertGreater(numpy.mean(beyond < -1), 0.005)
        self.assertGreater(numpy.mean(differs[beyond < -1]), 0.15)
        self.assertLess(numpy.mean(differs[beyond > NEAR_BLIND_CONE_DEG]), 0.01)
        self.browser.keep_picture("look-blind")

    def test_nothing_keeps_anybody_out(self):
        self.expect_no_barriers(self.open)

    def test_one_stream_brings_only_what_is_shown(self):
        self.open()
        self.choose(second="")
        eventually("one stream", lambda: self.appliance.status()["web"]["streams"] == 1)


class WithoutWebGl(LookingAround):
    ARGUMENTS = WITHOUT_WEBGL

    def test_the_appliance_turns_a_view(self):
        self.open()
        self.assertIn("no WebGL", self.browser.text("#look"))
        before = self.snapshot("turned")
        done = self.appliance.status()["web"]["commands_done"]
        self.canvas.send_keys(Keys.ARROW_RIGHT * 8)
        eventually("it was commanded",
                   lambda: self.appliance.status()["web"]["commands_done"] > done)
        eventually("the view has turned",
                   lambda: numpy.mean(cv2.absdiff(self.snapshot("turned"), before)) > 10)
        self.browser.keep_picture("look-server")
        self.assertEqual(self.browser.complaints(), [])


class WithoutAView(LookingAround):
    """The demo, which has no view of kind ball."""

    QUALITY = 85
    WIDTH, HEIGHT = 640, 400  # view "door" in demo.toml, of the colour camera alone

    @classmethod
    def make_appliance(cls):
        return Appliance()

    def test_the_cameras_own_pictures_are_drawn(self):
        self.assertEqual(json.loads(self.get("api/v1/look-around"))["spheres"],
                         ["ball:colour", "ball:thermal"])
        self.open()
        self.choose(second="", blind=False)
        self.point("door", *self.gaze())
        # The view is sharpened, both pictures are compressed, and the nozzle moves.
        self.expect_alike("door", numpy.ones((self.HEIGHT, self.WIDTH), bool), 0.9, tolerance=16)
        self.browser.keep_picture("look-demo")
        self.assertEqual([entry for entry in self.browser.complaints()
                          if "GPU stall due to ReadPixels" not in entry["message"]], [])

    def test_a_picture_that_is_decoded_after_another_view_was_chosen_is_not_drawn(self):
        self.browser.ignore_policy()
        self.browser.get(f"{self.appliance.address}#/system")
        drawn = self.browser.execute_async_script(f"""{HOLD_DECODING}
            const [module, done] = arguments, drawn = [];
            import(module).then(({{ ServerLook }}) => {{
              const look = new ServerLook(document.createElement('canvas'), {{}}, () => {{}}, ({{ name }}) => {{
                drawn.push(name);
                if (name === 'chosen') done(drawn);
              }});
              const send = (name) => look.picture({{ head: {{ name }}, body: '' }});
              look.offer(['former', 'chosen'].map((name, index) => ({{ name, index }})));
              send('former');
              look.choice.value = 'chosen';
              send('chosen');
              release();
            }}).catch((wrong) => done(String(wrong)));""", module_address("look/server_look.js"))
        self.assertEqual(drawn, ["chosen"])


class RenamedBall(LookingAround):
    """The demo with a view of kind ball, which a restart renames."""

    @classmethod
    def make_appliance(cls):
        appliance = Appliance()
        appliance.add_ball_view(500)
        return appliance

    def test_a_renamed_ball_is_drawn_by_its_new_name(self):
        self.open()
        self.choose(second="")
        self.appliance.stop()
        last = self.canvas.get_dom_attribute("data-number")
        site = self.appliance.folder / "demo.toml"
        site.write_text(site.read_text(encoding="utf-8").replace('"whole"', '"room"'), encoding="utf-8")
        self.appliance.start()
        eventually("the new name", lambda: self.browser.execute_script(
            "return document.querySelector('#look [name=first]').value") == "room")
        eventually("its pictures", lambda: self.canvas.get_dom_attribute("data-number") != last)
        eventually("the state", lambda: self.browser.text("#condition").startswith("running"))


class UnpluggedCamera(LookingAround):
    """The thermal camera is unplugged after some frames, and stays so."""

    @classmethod
    def make_appliance(cls):
        appliance = Appliance()
        appliance.unplug("thermal")
        return appliance

    def veil(self):
        """True if the picture is veiled, and the text over it."""
        return self.browser.execute_script("""
            const seen = document.querySelector('#look .picture');
            return [seen.classList.contains('veiled'), seen.querySelector('.overlay').textContent];""")

    def test_only_faults_of_shown_cameras_veil_the_picture(self):
        self.open()
        eventually("the fault", lambda: "degraded" in self.browser.text("#condition"))
        eventually("a veil over both that names the fault",
                   lambda: (veil := self.veil())[0] and "thermal: camera is not connected" in veil[1])
        self.choose(second="")
        eventually("no veil over the colour camera alone", lambda: self.veil() == [False, ""])
        self.choose(first="ball:thermal")
        eventually("a veil over the thermal one", lambda: "thermal: camera is not connected" in self.veil()[1])
        self.assertNotIn("colour", self.veil()[1])
        self.choose(first="ball:colour")
        eventually("no veil over the colour camera", lambda: self.veil() == [False, ""])
        self.browser.keep_picture("look-one-camera")


if __name__ == "__main__":
    unittest.main()
