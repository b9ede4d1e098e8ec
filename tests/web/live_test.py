# SPDX-License-Identifier: Apache-2.0
"""What a picture shows where one points, beside the machine's truth; a view turned, mixed and coloured by hand.

Folders: app/ports/web/pixels app/ports/web/views app/ports/web/streams
    app/ports/web/page/files/live app/ports/web/page/files/appliance
"""

import json
import math
import pathlib
import statistics
import tempfile
import unittest
import urllib.error
import urllib.parse
import urllib.request

import cv2
import numpy
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.actions.wheel_input import ScrollOrigin
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.select import Select

from appliance import PATIENCE_S, Appliance, eventually
from page_case import PageCase

BALL = (120, 60, 430)  # position in demo-rig.toml, mm
TABLE_TOP = 140
TABLE_DEGC = (35, 42)  # table of the simulated machine: 40, its slots 37, and noise
# View "heat" in demo.toml.
YAW, PITCH, H_FOV, WIDTH, HEIGHT = -115, -40, 80, 320, 240
ON_THE_TABLE = (-220, 60, TABLE_TOP)  # beside workpiece and nozzle

# The next request for a pixel is never answered; giveUp() lets its time limit pass.
HANG_ONCE = """
    const { fetch } = window, { timeout } = AbortSignal, limit = new AbortController();
    AbortSignal.timeout = () => limit.signal;
    window.fetch = (address, options) => {
      if (!String(address).startsWith('api/v1/live/pixel')) return fetch(address, options);
      Object.assign(window, { fetch, giveUp() {
        AbortSignal.timeout = timeout;
        limit.abort();
      } });
      return new Promise((_, fail) => options?.signal.addEventListener('abort', () => fail(options.signal.reason)));
    };"""


def pixel_of(point):
    """Pixel at which "heat" shows a point of the machine."""
    x, y, z = (a - b for a, b in zip(point, BALL))
    a, b = math.radians(YAW), math.radians(PITCH)
    right = x * math.cos(a) - y * math.sin(a)
    level = x * math.sin(a) + y * math.cos(a)
    forward = level * math.cos(b) + z * math.sin(b)
    up = z * math.cos(b) - level * math.sin(b)
    focal = WIDTH / 2 / math.tan(math.radians(H_FOV) / 2)
    return (WIDTH - 1) / 2 + focal * right / forward, (HEIGHT - 1) / 2 - focal * up / forward


class MixingAppliance(Appliance):
    """Adds a view of both cameras, `both`, to the demo's."""

    def __init__(self):
        super().__init__()
        with (self.folder / "demo.toml").open("a", encoding="utf-8") as site:
            site.write(f"""
[[view]]
name = "both"
yaw = {YAW}
pitch = {PITCH}
h_fov = {H_FOV}
width = {WIDTH}
height = {HEIGHT}
[[view.source]]
camera = "colour"
[[view.source]]
camera = "thermal"
colour_map = "inferno"
range = [15, 60]
""")


class LiveCase(PageCase):
    make_appliance = staticmethod(MixingAppliance)

    def open(self):
        self.browser.get(f"{self.appliance.address}#/live")
        eventually("pictures are shown",
                   lambda: all(self.browser.picture_numbers().values() or [0]))
        eventually("what their colours mean is known",
                   lambda: self.legend("heat"))

    def legend(self, view):
        found = self.tile(view).find_elements(By.CLASS_NAME, "legend")
        return found[0].text if found else ""

    def tile(self, view):
        return self.browser.execute_script("""
            return [...document.querySelectorAll('#tiles figure')]
              .find((f) => f.querySelector('strong').textContent === arguments[0]);""", view)

    def canvas(self, view):
        canvas = self.tile(view).find_element(By.TAG_NAME, "canvas")
        self.browser.execute_script("arguments[0].scrollIntoView({block: 'center'})", canvas)
        return canvas

    def unlock(self, view):
        self.tile(view).find_element(By.CLASS_NAME, "locked").click()

    def get(self, path):
        with urllib.request.urlopen(self.appliance.address + path, timeout=PATIENCE_S) as answer:
            return json.load(answer)

    def view(self, name):
        return next(view for view in self.get("api/v1/views")["views"] if view["name"] == name)

    def expect_aim(self, view, yaw, pitch, h_fov):
        def aims():
            aim = self.view(view)["aim"]
            return all(abs(aim[name] - value) < 0.2 for name, value in
                       [("yaw", yaw), ("pitch", pitch), ("h_fov", h_fov)])
        eventually(f"{view} looks to {yaw:.2f}, {pitch:.2f}, {h_fov:.2f} wide", aims)

    def command(self, name, **arguments):
        """Returns status and answer."""
        request = urllib.request.Request(
            f"{self.appliance.address}api/v1/command/{name}", json.dumps(arguments).encode(),
            {"Content-Type": "application/json"})
        try:
            with urllib.request.urlopen(request, timeout=PATIENCE_S) as answer:
                return answer.status, json.load(answer)
        except urllib.error.HTTPError as error:
            return error.code, json.load(error)


class Live(LiveCase):
    def reading(self, view):
        """Reading of a pixel on the tile, with its place: {text, u, v, number}, or null without
        one."""
        return self.browser.execute_script("""
            const { textContent: text, dataset } = arguments[0].querySelector('.reading');
            return dataset.number ? { text, ...dataset } : null;""", self.tile(view))

    def read_with_the_interface(self, view):
        """Reading on the page, and the interface's values for the same pixel of the same
        picture."""
        def both():
            said = self.reading(view)
            if not said:
                return None
            pixel = {name: said[name] for name in ("number", "u", "v")}
            query = urllib.parse.urlencode({"view": view, **pixel})
            try:
                return said, self.get(f"api/v1/live/pixel?{query}")
            except urllib.error.HTTPError as error:
                self.assertEqual(error.code, 410)  # the picture is older than the kept ones
                return None
        return eventually("the same picture is read by page and interface", both)

    def expect_the_table(self, said, known):
        """Checks a reading by the geometry of the machine alone."""
        u, v = pixel_of(known["point"])
        self.assertAlmostEqual(u, float(said["u"]), delta=0.01)
        self.assertAlmostEqual(v, float(said["v"]), delta=0.01)
        self.assertAlmostEqual(known["point"][2], TABLE_TOP, delta=0.01)
        self.assertAlmostEqual(known["distance"], math.dist(known["point"], BALL), delta=0.01)
        self.assertGreater(known["temperature"], TABLE_DEGC[0])
        self.assertLess(known["temperature"], TABLE_DEGC[1])

    def point_at_the_table(self):
        """Points into "heat"; returns what is read, and the interface's values for the same pixel."""
        canvas = self.canvas("heat")
        u, v = pixel_of(ON_THE_TABLE)
        width, height = canvas.size["width"], canvas.size["height"]
        ActionChains(self.browser).move_to_element_with_offset(
            canvas, round((u + 0.5) / WIDTH * width - width / 2),
            round((v + 0.5) / HEIGHT * height - height / 2)).perform()

        def read_the_table():
            said, known = self.read_with_the_interface("heat")
            return (said, known) if known["temperature"] < TABLE_DEGC[1] else None

        said, known = eventually("no spark flies over the table", read_the_table)
        pixels = max(1, WIDTH / width)  # step of the pointer in the view
        self.assertAlmostEqual(float(said["u"]), u, delta=1 + pixels)
        self.assertAlmostEqual(float(said["v"]), v, delta=1 + pixels)
        self.expect_the_table(said, known)
        return said, known

    def test_pointing_into_a_small_tile_reads_the_pixels_of_the_view(self):
        self.browser.show_on(800, 600)
        self.open()
        self.browser.find_elements(By.CSS_SELECTOR, ".layouts button")[-2].click()  # nine tiles
        eventually("the picture is sent smaller", lambda: self.browser.execute_script(
            "return arguments[0].dataset.sent", self.canvas("heat")) == str(WIDTH // 2))
        self.point_at_the_table()
        self.assertEqual(self.browser.complaints(), [])

    def test_pointing_reads_the_picture_that_is_seen(self):
        self.open()
        said, known = self.point_at_the_table()
        for shown in (f"yaw {known['yaw']:.2f}°", f"pitch {known['pitch']:.2f}°",
                      f"{known['temperature']:.1f} °C", f"{known['distance']:.0f} mm"):
            self.assertIn(shown, said["text"])
        # The text follows the picture.
        eventually("a newer picture is read",
                   lambda: int(self.reading("heat")["number"]) > int(said["number"]))
        self.browser.keep_picture("pointing")
        self.assertEqual(self.browser.complaints(), [])

    def test_a_pixel_that_is_never_answered_does_not_stop_the_next_one(self):
        self.open()
        canvas = self.canvas("heat")
        self.browser.execute_script(HANG_ONCE)
        ActionChains(self.browser).move_to_element(canvas).perform()
        eventually("it is asked for", lambda: self.browser.execute_script("return 'giveUp' in window"))
        self.browser.execute_script("giveUp()")
        eventually("the next one is answered", lambda: self.reading("heat"))

    def test_keys_move_a_crosshair(self):
        self.open()
        canvas = self.canvas("heat")
        self.browser.execute_script("arguments[0].focus()", canvas)
        ActionChains(self.browser).send_keys(
            Keys.ARROW_RIGHT, Keys.ARROW_RIGHT, Keys.ARROW_DOWN).perform()

        def has_read_the_last_place():
            said = self.reading("heat")
            return said and (said["u"], said["v"]) == ("174", "127")

        eventually("the last place is read", has_read_the_last_place)
        said, known = self.read_with_the_interface("heat")
        self.assertIn(f"yaw {known['yaw']:.2f}°", said["text"])
        mark = self.tile("heat").find_element(By.CLASS_NAME, "crosshair")
        self.assertTrue(mark.is_displayed())
        self.assertIn("yaw", self.tile("heat").find_element(By.CLASS_NAME, "spoken").text)
        ActionChains(self.browser).send_keys(Keys.ESCAPE).perform()
        self.assertFalse(mark.is_displayed())
        self.assertEqual(self.browser.complaints(), [])

    def test_hand_wheel_and_keys_turn_a_view(self):
        self.open()
        canvas = self.canvas("heat")
        before = self.view("heat")["aim"]
        ActionChains(self.browser).drag_and_drop_by_offset(canvas, 60, 30).perform()
        self.assertIn("Locked", self.tile("heat").find_element(By.CSS_SELECTOR, "[role=alert]").text)
        self.assertEqual(self.view("heat")["aim"], before)
        self.unlock("heat")
        self.assertEqual(self.tile("heat").find_element(By.CSS_SELECTOR, "[role=alert]").text, "")
        degrees = H_FOV / canvas.size["width"]
        ActionChains(self.browser).drag_and_drop_by_offset(canvas, 60, 30).perform()
        yaw, pitch = YAW - 60 * degrees, PITCH + 30 * degrees
        self.expect_aim("heat", yaw, pitch, H_FOV)
        # After a click the tile handles the wheel; otherwise the page scrolls.
        ActionChains(self.browser).scroll_from_origin(
            ScrollOrigin.from_element(canvas), 0, -200).perform()
        h_fov = H_FOV * math.exp(-200 * 0.0015)
        self.expect_aim("heat", yaw, pitch, h_fov)
        ActionChains(self.browser).key_down(Keys.SHIFT).send_keys(Keys.ARROW_RIGHT).key_up(
            Keys.SHIFT).perform()
        self.expect_aim("heat", yaw + h_fov / 20, pitch, h_fov)
        ActionChains(self.browser).send_keys(Keys.HOME).perform()
        self.expect_aim("heat", YAW, PITCH, H_FOV)
        self.assertEqual(self.browser.complaints(), [])

    def test_back_turns_a_locked_view_to_its_configured_direction(self):
        self.open()
        self.assertEqual(self.command("point_view", view=self.view("heat")["index"], yaw=10, pitch=5, h_fov=60)[0], 200)
        self.expect_aim("heat", 10, 5, 60)
        self.tile("heat").find_element(By.CLASS_NAME, "back").click()
        self.expect_aim("heat", YAW, PITCH, H_FOV)
        for name in ("locked", "back"):
            self.assertFalse(self.tile("process").find_element(By.CLASS_NAME, name).is_displayed())
        self.assertEqual(self.browser.complaints(), [])

    def test_fingers_read_and_turn_a_view(self):
        self.open()
        canvas = self.canvas("heat")
        self.browser.tap(canvas)
        said, known = self.read_with_the_interface("heat")
        self.assertIn(f"{known['temperature']:.1f} °C", said["text"])
        self.assertTrue(self.tile("heat").find_element(By.CLASS_NAME, "crosshair").is_displayed())
        self.unlock("heat")
        self.browser.pinch(canvas)
        eventually("it is zoomed to a half", lambda: abs(
            self.view("heat")["aim"]["h_fov"] - H_FOV / 2) < 0.2)
        canvas.send_keys(Keys.HOME)
        self.expect_aim("heat", YAW, PITCH, H_FOV)
        self.assertEqual(self.browser.complaints(), [])

    def test_what_is_measured_stays_put(self):
        self.open()
        before = self.view("process")
        ActionChains(self.browser).drag_and_drop_by_offset(self.canvas("process"), 40, 0).perform()
        said = self.tile("process").find_element(By.CSS_SELECTOR, "[role=alert]").text
        self.assertIn("measured", said)
        status, answer = self.command("point_view", view=before["index"], yaw=0, pitch=0, h_fov=0)
        self.assertEqual((status, answer["result_text"]),
                         (409, "not possible with this configuration"))
        self.assertEqual(self.view("process")["aim"], before["aim"])
        self.assertEqual(self.browser.complaints(), [])

    def mean_of(self, view):
        """Mean level of the visible picture."""
        place = self.view(view)["index"] + 1
        return statistics.mean(self.browser.pixels(f"#tiles figure:nth-child({place}) canvas"))

    def test_a_slider_mixes_two_cameras(self):
        self.open()
        seen = {}
        for share in (0, 100):
            slider = self.tile("both").find_element(By.NAME, "share-thermal")
            self.browser.execute_script("""
                arguments[0].value = arguments[1];
                arguments[0].dispatchEvent(new Event('input'));""", slider, share)

            def is_mixed(share=share):
                colour, thermal = self.view("both")["aim"]["weights"]
                return abs(thermal / (colour + thermal) - share / 100) < 0.01
            eventually(f"the thermal camera has {share} %", is_mixed)
            number = self.browser.picture_numbers()["both"]
            eventually("newer pictures are shown",
                       lambda number=number: self.browser.picture_numbers()["both"] > number + 2)
            seen[share] = self.mean_of("both")
        self.assertGreater(abs(seen[100] - seen[0]), 20)
        self.assertEqual(slider.get_attribute("value"), "100")
        self.browser.keep_picture("mixing")
        self.assertEqual(self.browser.complaints(), [])

    def recolour(self, view, colour_map, first, last):
        """Recolours a view with the controls of its tile."""
        tile = self.tile(view)
        self.browser.execute_script(
            "arguments[0].querySelector('.colours').open = true;"
            "arguments[0].scrollIntoView({block: 'center'});", tile)
        Select(tile.find_element(By.NAME, "colour_map")).select_by_visible_text(colour_map)
        for name, value in (("first", first), ("last", last)):
            tile.find_element(By.NAME, name).send_keys(Keys.CONTROL, "a", Keys.NULL, str(value),
                                                       Keys.ENTER)

    def colours(self, view):
        """Colours of its only one-channel camera."""
        return next(filter(None, self.view(view)["aim"]["colours"]))

    def test_colours_change_with_their_legend(self):
        self.open()
        bright = self.mean_of("heat")
        self.recolour("heat", "grey", 900, 1000)  # the room is far below
        eventually("it is changed", lambda: self.colours("heat") == {
            "colour_map": "grey", "range": [900, 1000]})
        eventually("the legend says so",
                   lambda: self.legend("heat") == "thermal 900 °C1000 °C")
        self.assertLess(self.mean_of("heat"), bright - 50)
        # A measured view can be recoloured, too; only its picture changes.
        self.recolour("process", "viridis", 30, 800)
        eventually("it is changed", lambda: self.colours("process") == {
            "colour_map": "viridis", "range": [30, 800]})
        self.browser.keep_picture("colours")
        # An impossible value is refused with a sentence, and the picture is unchanged.
        self.recolour("heat", "grey", 900, 800)
        eventually("it is refused", lambda: "first is 900; it must be below last, which is 800" in
                   self.tile("heat").find_element(By.CSS_SELECTOR, "[role=alert]").text)
        self.assertEqual(self.colours("heat"), {"colour_map": "grey", "range": [900, 1000]})
        status, answer = self.command("set_colour_map", view=self.view("door")["index"], source=0,
                                      colour_map=1)
        self.assertEqual((status, answer["result_text"]),
                         (409, "not possible with this configuration"))
        place = {"view": self.view("process")["index"], "source": 1}
        noted = next(entry for entry in self.get("api/v1/audit")["entries"]
                     if entry["what"] == "set_colour_range"
                     and json.loads(entry["after"]).items() >= place.items())
        self.assertEqual(json.loads(noted["before"]), {**place, "first": 20, "last": 800})
        self.assertEqual(json.loads(noted["after"]), {**place, "first": 30, "last": 800})
        place = {"view": self.view("heat")["index"], "source": 0}
        self.command("set_colour_map", **place, colour_map=2)
        self.command("set_colour_range", **place, first=15, last=200)
        self.assertEqual([one for one in self.browser.complaints() if "400" not in one["message"]], [])

    def test_colours_have_a_legend_in_tile_and_snapshot(self):
        self.open()
        self.assertEqual(self.legend("heat"), "thermal 15 °C200 °C")
        self.assertFalse(self.tile("door").find_elements(By.CLASS_NAME, "legend"))
        with tempfile.TemporaryDirectory() as folder:
            self.browser.execute_cdp_cmd("Browser.setDownloadBehavior",
                                         {"behavior": "allow", "downloadPath": folder})
            self.tile("heat").find_element(By.CLASS_NAME, "cameras").click()
            file = eventually("the file is there", lambda: next(
                pathlib.Path(folder).glob("heat-*.jpg"), None))
            picture = cv2.imread(str(file))  # it has this name once it is complete
        self.assertEqual(picture.shape[1], WIDTH)
        self.assertGreater(picture.shape[0], HEIGHT)
        # The ramp below the picture goes from turbo's dark blue over green to its dark red.
        ramp = picture[-13].astype(int)
        ramp -= numpy.median(ramp, axis=1, keepdims=True).astype(int)  # 0 for grey, such as text
        blue, green, red = (ramp[:, channel].argmax() for channel in range(3))
        self.assertTrue(blue < green < red, (blue, green, red))
        self.assertEqual(self.browser.complaints(), [])


class ChangedViews(LiveCase):
    """The appliance restarts with other views while the page is open."""

    FIRST = '''[[view]]
name = "first"
yaw = 171
h_fov = 60
width = 320
height = 240
[[view.source]]
camera = "colour"

'''

    def setUp(self):
        super().setUp()
        self.site = self.appliance.folder / "demo.toml"
        self.before = self.site.read_text(encoding="utf-8")
        self.addCleanup(self.restart_with, self.before)
        self.open()

    def restart_with(self, site):
        self.appliance.stop()
        self.site.write_text(site, encoding="utf-8")
        self.appliance.start()

    def named(self):
        """Names of the tiles, and those that can be chosen."""
        return self.browser.execute_script("""
            const texts = (selector) => [...document.querySelectorAll(selector)]
              .map(({ textContent }) => textContent.trim());
            return [texts('#tiles figure strong'), texts('#live fieldset label')];""")

    def expect_all_views(self):
        names = [view["name"] for view in self.get("api/v1/views")["views"]]
        eventually(f"tiles and choices of {names}", lambda: self.named() == [names, names])
        before = self.browser.picture_numbers()
        eventually("pictures", lambda: all(number not in (0, before[name])
                                           for name, number in self.browser.picture_numbers().items()))
        eventually("the state", lambda: self.browser.text("#condition").startswith("running"))
        return names

    def test_tiles_are_those_of_the_restarted_appliance(self):
        self.assertIn("both", self.expect_all_views())
        self.restart_with(self.before.replace('name = "both"', 'name = "mixed"'))
        names = self.expect_all_views()
        self.assertIn("mixed", names)
        self.restart_with(self.before.replace("[[view]]", f"{self.FIRST}[[view]]", 1))
        self.assertEqual(self.expect_all_views()[0], "first")

    def test_the_form_of_colours_stays_open_over_a_restart(self):
        tile = self.tile("heat")
        self.browser.execute_script("arguments[0].querySelector('.colours').open = true", tile)
        field = tile.find_element(By.NAME, "first")
        self.restart_with(f"{self.before}\n{self.FIRST}")
        eventually("the views are known", lambda: (added := self.tile("first"))
                   and added.find_element(By.CLASS_NAME, "locked").is_displayed())
        self.assertTrue(field.is_displayed())

    def test_a_page_that_was_hidden_over_a_restart_commands_the_view_that_is_shown(self):
        index = self.view("heat")["index"]
        self.hide_for_a_while(lambda: self.restart_with(self.before.replace("[[view]]", f"{self.FIRST}[[view]]", 1)))
        moved = self.view("heat")["index"]
        self.assertGreater(moved, index)
        eventually("the views are known", lambda: (tile := self.tile("first"))
                   and tile.find_element(By.CLASS_NAME, "locked").is_displayed())
        self.command("point_view", view=moved, yaw=10, pitch=5, h_fov=60)
        self.expect_aim("heat", 10, 5, 60)
        self.tile("heat").find_element(By.CLASS_NAME, "back").click()
        self.expect_aim("heat", YAW, PITCH, H_FOV)


class SingleStream(Appliance):
    def __init__(self):
        super().__init__()
        site = self.folder / "demo.toml"
        site.write_text(site.read_text(encoding="utf-8").replace("[web]\n", "[web]\nmax_streams = 1\n"),
                        encoding="utf-8")


class NoFreeStream(PageCase):
    make_appliance = staticmethod(SingleStream)

    def test_the_page_states_why_it_receives_nothing(self):
        with urllib.request.urlopen(f"{self.appliance.address}api/v1/live", timeout=PATIENCE_S) as other:
            other.readline()
            self.browser.get(self.appliance.address)
            eventually("the reason", lambda: self.browser.text("#condition")
                       == "Refused: all streams are in use; raise max_streams of [web]")
        eventually("the state", lambda: self.browser.text("#condition").startswith("running"))


if __name__ == "__main__":
    unittest.main()
