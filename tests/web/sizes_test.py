# SPDX-License-Identifier: Apache-2.0
"""Size of the pictures on the wire by the size of their tiles, and places in them, which do not depend on it.

Folders: app/ports/web/streams app/pictures app/ports/web/page/files/live app/ports/web/page/files/appliance
    app/ports/web/page/files/process app/ports/web/page/files/look
"""

import base64
import json
import pathlib
import tempfile
import threading
import unittest
import urllib.parse
import urllib.request

import cv2
import numpy
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

from appliance import PATIENCE_S, Appliance, eventually
from browser import module_address
from page_case import PageCase

VIEWS = ["panorama", "door", "heat", "process"]
FOUR, NINE = 2, 4  # indexes of layouts
LEAST_SHARE = 0.9  # kSmaller of asked_widths.js: a tile that shrinks keeps its size until then
MOST_SHIFT_PX = 0.3  # displacement of a picture on the canvas, pixels of the view
MOST_DIFFERENCE = 20  # mean difference of a picture that has lost its details, grey levels
NOTE_REQUESTS = """{
  const { fetch } = window;
  window.requests = [];
  window.fetch = (...request) => {
    window.requests.push(String(request[0]));
    return fetch(...request);
  };
}"""
ASKED_IN_TURN = """
const [module, sizes, shown, done] = arguments;
import(module).then(({ AskedWidths }) => {
  const listed = new AskedWidths({ sizesOf: () => sizes }), own = new AskedWidths({ sizesOf: () => [] });
  done([listed, own].map((widths) => shown.map((width) =>
    widths.of([{ name: 'door', width, ...(widths === own && { sizes }) }])[0].width)));
}, (error) => done(String(error)));"""


def decoded(picture):
    return cv2.imdecode(numpy.frombuffer(picture, numpy.uint8), cv2.IMREAD_GRAYSCALE)


def shift(one, other):
    """Distance by which a picture is displaced in another one, px: least squares over their gradients, smoothed to the
    same sharpness."""
    one, other = (cv2.GaussianBlur(numpy.float64(picture), (0, 0), 4) for picture in (one, other))
    gradients = numpy.stack([part.ravel() for part in numpy.gradient(one)], axis=1)
    return numpy.hypot(*numpy.linalg.lstsq(gradients, (one - other).ravel(), rcond=None)[0])


class FullPictures:
    """Receives the full pictures of a view, while it is entered."""

    def __init__(self, appliance, view):
        self.address = f"{appliance.address}api/v1/live?view={view}"
        self.by_number = {}
        self.has_ended = threading.Event()
        self.thread = threading.Thread(target=self.receive)

    def receive(self):
        with urllib.request.urlopen(self.address, timeout=PATIENCE_S) as answer:
            while not self.has_ended.is_set():  # the status comes without pictures, too
                head = json.loads(answer.readline())
                body = answer.read(head["bytes"])
                if head["kind"] == "view":
                    self.by_number[head["number"]] = body

    def __enter__(self):
        self.thread.start()
        return self

    def __exit__(self, *_):
        self.has_ended.set()
        self.thread.join()


class SizesCase(PageCase):
    def setUp(self):
        super().setUp()
        self.browser.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": NOTE_REQUESTS})

    def show(self, width, height, page="live", scale=1):
        self.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
            "width": width, "height": height, "deviceScaleFactor": scale, "mobile": width < 600})
        self.browser.get("about:blank")
        self.browser.get(f"{self.appliance.address}#/{page}")

    def show_nine_places(self):
        """Tiles that are much smaller than their views."""
        self.show(800, 600)
        self.choose(NINE)

    def choose(self, layout):
        """Index of a layout."""
        buttons = eventually("layouts", lambda: self.browser.find_elements(By.CSS_SELECTOR, ".layouts button"))
        buttons[layout].click()

    def described(self):
        with urllib.request.urlopen(f"{self.appliance.address}api/v1/views", timeout=PATIENCE_S) as answer:
            return {view["name"]: view for view in json.load(answer)["views"]}

    def stream(self):
        """Address of the stream that the page opened last; empty: none."""
        return next((request for request in reversed(self.browser.execute_script("return window.requests"))
                     if request.startswith("api/v1/live?")), "")

    def asked(self):
        """Width that the page asked for last, by view."""
        query = urllib.parse.parse_qs(urllib.parse.urlsplit(self.stream()).query)
        return dict(zip(query.get("view", []), map(int, query.get("width", []))))

    def sent(self):
        """Width in which the shown picture was sent, by view."""
        return {name: int(sent) for name, sent, _ in self.tiles()}

    def displayed(self):
        """Device pixels across each tile, by view."""
        return {name: displayed for name, _, displayed in self.tiles()}

    def tiles(self):
        return self.browser.execute_script("""
            return [...document.querySelectorAll('#tiles figure')].map((figure) => {
              const { dataset, clientWidth } = figure.querySelector('canvas');
              return [figure.querySelector('strong').textContent, dataset.sent ?? '0',
                clientWidth * window.devicePixelRatio];
            });""")


class Sizes(SizesCase):
    def fits(self, views):
        """The appliance sends each of these views in the size that its tile needs."""
        if not set(views) <= set(self.asked()):
            return False
        described, displayed, sent = self.described(), self.displayed(), self.sent()
        for name in views:
            sizes = described[name]["widths"]
            smaller = [size for size in sizes if size < sent[name]]
            if sent[name] < min(displayed[name], sizes[0]):
                return False
            if smaller and displayed[name] <= LEAST_SHARE * smaller[0]:
                return False
        return True

    def test_tiles_ask_for_the_size_that_fills_them(self):
        for width, height, scale, layout, views in (
                (1440, 900, 1, FOUR, VIEWS), (1440, 900, 1, NINE, VIEWS), (800, 600, 1, NINE, VIEWS),
                (1440, 900, 2, NINE, VIEWS), (390, 844, 1, None, VIEWS[:1]), (390, 844, 2, None, VIEWS[:1])):
            with self.subTest(width=width, scale=scale, layout=layout):
                self.show(width, height, scale=scale)
                if layout is not None:  # a phone has none
                    self.choose(layout)
                eventually("sizes that fit", lambda views=views: self.fits(views))
                described = self.described()
                for canvas_width, canvas_height, name in self.browser.execute_script("""
                        return [...document.querySelectorAll('#tiles figure:not([hidden])')].map((figure) => {
                          const { width, height } = figure.querySelector('canvas');
                          return [width, height, figure.querySelector('strong').textContent];
                        });"""):
                    view = described[name]
                    self.assertEqual((canvas_width, canvas_height), (view["width"], view["height"]))
        self.assertEqual(self.browser.complaints(), [])

    def test_small_tiles_receive_small_pictures(self):
        self.show_nine_places()
        described = self.described()
        eventually("smaller pictures", lambda: set(self.asked()) == set(VIEWS) and all(
            width < described[name]["width"] for name, width in self.sent().items()))

    def test_another_size_is_asked_for_only_when_it_is_due(self):
        self.browser.ignore_policy()
        self.browser.get(self.appliance.address)
        module = module_address("appliance/asked_widths.js")
        for sizes, shown, expected in (
                # Grows at once, shrinks with hysteresis.
                ([640, 480, 320, 160], [300, 310, 320, 321, 319, 300, 289, 288, 500, 470, 433, 432],
                 [300, 300, 300, 321, 321, 321, 321, 288, 500, 500, 500, 432]),
                # In full, as in Look around.
                ([640, 480, 320, 160], [300, 0, 450, 430], [300, 0, 0, 430]),
                # Wider than the view.
                ([640, 480, 320, 160], [2000, 641, 600], [2000, 2000, 2000]),
                # Sizes are not known yet.
                ([], [300, 900], [300, 300])):
            # Of a view that is listed, and of a picture that is not, which states its sizes.
            self.assertEqual(self.browser.execute_async_script(ASKED_IN_TURN, module, sizes, shown),
                             [expected, expected])

    def expect_no_shift(self, selector, view):
        """The picture on a canvas lies where it does in full."""
        with FullPictures(self.appliance, view) as full:
            def both():
                number, shown = self.browser.execute_script("""
                    const canvas = document.querySelector(arguments[0]);
                    return [Number(canvas.dataset.number), canvas.toDataURL().split(',')[1]];""", selector)
                sent = full.by_number.get(number)
                return (decoded(base64.b64decode(shown)), decoded(sent)) if sent else None
            shown, sent = eventually("the same picture in both sizes", both)
        self.assertLess(shift(shown, sent), MOST_SHIFT_PX)
        self.assertLess(numpy.abs(shown - 1.0 * sent).mean(), MOST_DIFFERENCE)

    def test_pictures_of_every_size_lie_at_the_same_place(self):
        self.show_nine_places()
        described = self.described()
        eventually("a smaller picture", lambda: 0 < self.asked().get("door", 0) <= described["door"]["widths"][1])
        before = self.browser.picture_numbers()["door"]
        eventually("it is shown", lambda: self.browser.picture_numbers()["door"] > before + 2)
        self.expect_no_shift("#tiles figure:nth-child(2) canvas", "door")

    def test_regions_lie_over_what_they_measure_on_a_phone(self):
        self.show(390, 844, "process")
        number = "return Number(document.querySelector('#regions canvas')?.dataset.number ?? 0)"
        described = self.described()
        eventually("a smaller picture", lambda: 0 < self.asked().get("process", 0) <= described["process"]["widths"][1])
        before = self.browser.execute_script(number)
        eventually("it is shown", lambda: self.browser.execute_script(number) > before + 2)
        view = described["process"]
        box, width, height = self.browser.execute_script("""
            const canvas = document.querySelector('#regions canvas');
            return [document.querySelector('#regions svg').getAttribute('viewBox'), canvas.width, canvas.height];""")
        self.assertEqual((width, height), (view["width"], view["height"]))
        self.assertEqual(box, f"-0.5 -0.5 {width} {height}")
        self.expect_no_shift("#regions canvas", "process")
        self.assertEqual(self.browser.complaints(), [])

    def test_a_snapshot_of_a_small_tile_is_the_full_picture(self):
        self.show_nine_places()
        eventually("smaller pictures", lambda: 0 < self.asked().get("door", 0) <= 480)
        before = self.browser.picture_numbers()["door"]
        eventually("it is shown", lambda: self.browser.picture_numbers()["door"] > before + 2)
        with tempfile.TemporaryDirectory() as folder:
            self.browser.execute_cdp_cmd("Browser.setDownloadBehavior",
                                         {"behavior": "allow", "downloadPath": folder})
            self.browser.find_elements(By.CSS_SELECTOR, "#tiles .cameras")[1].click()
            file = eventually("the file is there", lambda: next(pathlib.Path(folder).glob("door-20*.jpg"), None))
            picture = cv2.imread(str(file))  # it has this name once it is complete
        self.assertEqual(picture.shape[1], self.described()["door"]["width"])
        self.assertIn("snapshot.jpg?view=door", self.browser.execute_script("return window.requests"))
        self.assertEqual(self.browser.complaints(), [])


class LookingAround(SizesCase):

    ARGUMENTS = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"]  # WebGL
    WIDTH, HEIGHT = 560, 350  # shape of the view "door" in demo.toml

    def canvas(self):
        return self.browser.find_element(By.CSS_SELECTOR, "#look canvas")

    def show_one_ball(self):
        """*Look around* in the first ball alone, on a small canvas."""
        self.show(1440, 900, "look")
        eventually("a picture", lambda: self.browser.execute_script(
            "return Number(document.querySelector('#look canvas')?.dataset.number ?? 0)"))
        self.browser.execute_script(
            "const { style } = document.querySelector('#look canvas');"
            "style.width = `${arguments[0]}px`; style.height = `${arguments[1]}px`;", self.WIDTH, self.HEIGHT)
        self.browser.execute_script("""
            const [second, blind] = ['second', 'blind'].map((name) => document.querySelector(`#look [name=${name}]`));
            second.value = '';
            second.dispatchEvent(new Event('change'));
            blind.click();""")

    def drawn(self):
        url = self.browser.execute_script("return arguments[0].toDataURL('image/png')", self.canvas())
        return decoded(base64.b64decode(url.split(",")[1]))

    def turned_door(self):
        """The appliance's view in the direction of the gaze."""
        gaze = {name: float(self.canvas().get_dom_attribute(f"data-{name}")) for name in ("yaw", "pitch", "fov")}
        names = [view["name"] for view in self.appliance.status()["views"]]
        body = {"view": names.index("door"), "yaw": gaze["yaw"], "pitch": gaze["pitch"], "h_fov": gaze["fov"]}
        urllib.request.urlopen(urllib.request.Request(
            f"{self.appliance.address}api/v1/command/point_view", json.dumps(body).encode(),
            {"Content-Type": "application/json"}), timeout=PATIENCE_S).close()
        with urllib.request.urlopen(f"{self.appliance.address}snapshot.jpg?view=door", timeout=PATIENCE_S) as answer:
            return cv2.resize(decoded(answer.read()), (self.WIDTH, self.HEIGHT), interpolation=cv2.INTER_AREA)


class SizesOfABall(LookingAround):
    """A view of kind ball."""

    @classmethod
    def make_appliance(cls):
        appliance = Appliance()
        appliance.add_ball_view(1000)
        return appliance

    def test_looking_around_asks_for_what_the_gaze_needs(self):
        self.show_one_ball()
        widths = self.described()["whole"]["widths"]
        eventually("in full: the ball has less than the screen", lambda: self.asked().get("whole") == 0)
        self.canvas().send_keys("-" * 6)
        eventually("half the size", lambda: widths[3] < self.asked().get("whole", 0) <= widths[2])
        before = self.canvas().get_dom_attribute("data-number")
        eventually("it is drawn", lambda: int(self.canvas().get_dom_attribute("data-number")) > int(before) + 2)
        # It lies where the appliance's own view has it.
        eventually("it is at the same place", lambda: shift(self.drawn(), self.turned_door()) < MOST_SHIFT_PX)
        self.browser.keep_picture("look-half")
        self.canvas().send_keys(Keys.HOME)
        eventually("in full again", lambda: self.asked().get("whole") == 0)


class SizesOfACamera(LookingAround):
    """A camera's own picture, without a view of kind ball."""

    def test_looking_around_asks_for_what_the_gaze_needs_of_a_camera(self):
        self.show_one_ball()
        with urllib.request.urlopen(f"{self.appliance.address}api/v1/sphere?view=ball:colour",
                                    timeout=PATIENCE_S) as answer:
            widths = json.loads(answer.readline())["widths"]
        self.canvas().send_keys("-" * 6)
        eventually("a smaller size", lambda: 0 < self.asked().get("ball:colour", 0) <= widths[1])
        with urllib.request.urlopen(f"{self.appliance.address}snapshot.jpg?view=ball:colour"
                                    f"&width={self.asked()['ball:colour']}", timeout=PATIENCE_S) as answer:
            self.assertIn(decoded(answer.read()).shape[1], widths[1:])
        before = self.canvas().get_dom_attribute("data-number")
        eventually("it is drawn", lambda: int(self.canvas().get_dom_attribute("data-number")) > int(before) + 2)
        eventually("it is at the same place", lambda: shift(self.drawn(), self.turned_door()) < MOST_SHIFT_PX)
        self.canvas().send_keys("+" * 20)
        eventually("in full: the picture has less than the screen", lambda: self.asked().get("ball:colour") == 0)
        self.assertEqual([entry for entry in self.browser.complaints()
                          if "GPU stall due to ReadPixels" not in entry["message"]], [])


if __name__ == "__main__":
    unittest.main()
