# SPDX-License-Identifier: Apache-2.0
"""Layouts of the tiles on a desktop, and swiping through them on a phone.

Folders: app/ports/web/page/files/live app/ports/web/page/files/elements
"""

import unittest
import urllib.parse

from selenium.webdriver.common.by import By

from appliance import eventually
from page_case import PageCase

VIEWS = ["panorama", "door", "heat", "process"]
# Number of tiles beside each other and below each other that fill the screen, by layout.
PLACES = {"1": (1, 1), "2": (2, 1), "4": (2, 2), "6": (3, 2), "9": (3, 3)}
CLOSE_PX = 2
NOTE_STREAMS = """{
  const fetch = window.fetch;
  window.streams = [];
  window.fetch = (...request) => {
    if (String(request[0]).startsWith('api/v1/live?')) window.streams.push(String(request[0]));
    return fetch(...request);
  };
}"""


class Tiles(PageCase):
    def open(self, width, height):
        self.browser.show_on(width, height)
        self.browser.get("about:blank")
        self.browser.get(f"{self.appliance.address}#/live")
        # A phone shows one tile.
        are_there = any if width < 600 else all
        eventually("pictures are shown", lambda: are_there(self.browser.picture_numbers().values() or [0]))
        eventually("legends and locks", lambda: self.browser.find_elements(By.CSS_SELECTOR, "#tiles .legend")
                   and any(lock.is_displayed() for lock in self.browser.find_elements(By.CSS_SELECTOR, ".locked")))

    def choose(self, layout):
        names = [*PLACES, "large"]
        self.browser.find_elements(By.CSS_SELECTOR, ".layouts button")[names.index(layout)].click()

    def boxes(self, selector):
        """Left, top, width and height of the shown elements."""
        return self.browser.execute_script("""
            return [...document.querySelectorAll(arguments[0])].filter((one) => one.checkVisibility())
              .map((one) => one.getBoundingClientRect())
              .map(({ left, top, width, height }) => [left, top, width, height]);""", selector)

    def expect_pictures_as_wide_as_they_are_sent(self):
        for shape, shown in self.browser.execute_script("""
                return [...document.querySelectorAll('#tiles figure:not([hidden]) canvas')].map((canvas) => [
                  canvas.width / canvas.height, canvas.clientWidth / canvas.clientHeight]);"""):
            self.assertAlmostEqual(shown, shape, delta=0.03 * shape)

    def test_each_layout_fills_the_screen(self):
        self.open(1440, 900)
        self.assertEqual(self.browser.find_element(By.CSS_SELECTOR, ".layouts [aria-pressed=true]")
                         .get_attribute("aria-label"), "4 views")
        self.browser.keep_picture("tiles")
        for layout, (across, down) in PLACES.items():
            with self.subTest(layout=layout):
                self.choose(layout)
                [(left, top, width, height)] = self.boxes("#tiles")
                self.assertLessEqual(top + height, 900)
                self.assertGreater(top + height, 880)
                tiles = self.boxes("#tiles figure")
                self.assertEqual(len(tiles), len(VIEWS))
                self.assertAlmostEqual(tiles[0][0], left, delta=CLOSE_PX)
                for tile in tiles:
                    self.assertAlmostEqual(tile[2] * across, width, delta=20 * across)
                    self.assertAlmostEqual(tile[3] * down, height, delta=20 * down)
                self.expect_pictures_as_wide_as_they_are_sent()
                self.expect_fits_its_width()

    def streamed(self):
        """Views that the page asked for last."""
        path = self.browser.execute_script("return window.streams.at(-1)")
        return urllib.parse.parse_qs(urllib.parse.urlsplit(path).query).get("view", [])

    def test_tiles_out_of_sight_are_not_streamed(self):
        self.browser.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": NOTE_STREAMS})
        self.open(1440, 900)
        self.assertEqual(self.streamed(), VIEWS)
        self.choose("1")
        eventually("the first view alone", lambda: self.streamed() == VIEWS[:1])
        self.expect_only("panorama")
        self.browser.execute_script("document.querySelectorAll('#tiles figure')[2].scrollIntoView()")
        eventually("the third view alone", lambda: self.streamed() == ["heat"])
        self.expect_only("heat")
        self.choose("4")
        eventually("all views", lambda: self.streamed() == VIEWS)
        before = self.browser.picture_numbers()
        eventually("pictures of all", lambda: all(
            number > before[view] for view, number in self.browser.picture_numbers().items()))
        self.assertEqual(self.browser.complaints(), [])

    def expect_only(self, view):
        """The page shows new pictures of this view, and of no other."""
        def advanced_from(number):
            return lambda: self.browser.picture_numbers()[view] > number

        eventually("a first one", advanced_from(self.browser.picture_numbers()[view]))
        before = self.browser.picture_numbers()
        eventually("more", advanced_from(before[view] + 10))
        now = self.browser.picture_numbers()
        self.assertEqual({name for name in now if now[name] != before[name]}, {view})

    def test_one_view_is_large_and_the_others_small(self):
        self.open(1440, 900)
        self.choose("large")
        for large in (0, 2):
            if large:
                self.browser.find_elements(By.CSS_SELECTOR, "#tiles .enlarge")[large].click()
            [(_, top, _, height)] = self.boxes("#tiles")
            tiles = self.boxes("#tiles figure")
            small = [tile for n, tile in enumerate(tiles) if n != large]
            for tile in small:
                self.assertGreater(tiles[large][2], 2.8 * tile[2])
                self.assertGreater(tiles[large][3], 2.8 * tile[3])
                self.assertGreaterEqual(tile[0], tiles[large][0] + tiles[large][2])
                self.assertLessEqual(tile[1] + tile[3], top + height + CLOSE_PX)
        self.browser.keep_picture("tiles-large")
        self.browser.refresh()
        eventually("the layout is kept", lambda: self.browser.execute_script(
            "return document.getElementById('tiles')?.dataset.layout") == "large")
        self.assertEqual(self.browser.complaints(), [])

    def test_legend_and_reading_lie_over_the_picture(self):
        self.open(1440, 900)
        before = self.boxes("#tiles figure")
        self.browser.find_elements(By.CSS_SELECTOR, "#tiles canvas")[2].click()
        eventually("the reading", lambda: self.browser.text("#tiles figure:nth-child(3) .reading"))
        self.assertEqual(self.boxes("#tiles figure"), before)
        [(left, top, width, height)] = self.boxes("#tiles figure:nth-child(3) .picture")
        for part in (".reading", ".legend"):
            [box] = self.boxes(f"#tiles figure:nth-child(3) {part}")
            self.assertGreaterEqual(box[0], left)
            self.assertGreaterEqual(box[1], top)
            self.assertLessEqual(box[0] + box[2], left + width)
            self.assertLessEqual(box[1] + box[3], top + height)

    def test_a_phone_shows_one_tile_for_each_swipe(self):
        self.open(390, 844)
        self.browser.keep_picture("tiles-phone")
        self.expect_fits_its_width()
        [(left, top, width, height)] = self.boxes("#tiles")
        self.assertLessEqual(top + height, 844)

        def shown():
            """Index of the tile that fills the width; None while it moves."""
            return next((n for n, tile in enumerate(self.boxes("#tiles figure"))
                         if abs(tile[0] - left) < CLOSE_PX and abs(tile[2] - width) < CLOSE_PX), None)

        def rested():
            """The same when nothing has moved for five looks; -1 otherwise."""
            looks.append(shown())
            return looks[-1] if len(looks) >= 5 and looks[-1] is not None and len(set(looks[-5:])) == 1 else -1

        self.assertEqual(shown(), 0)
        for expected in (1, 2):
            # A busy browser takes a swipe for a short one, and moves back.
            for _ in range(5):
                _, y = self.browser.middle_of(
                    self.browser.find_elements(By.CSS_SELECTOR, "#tiles canvas")[expected - 1])
                self.browser.touch("touchStart", [(340, y)])
                for x in (300, 200, 100, 50):
                    self.browser.touch("touchMove", [(x, y)])
                self.browser.touch("touchEnd", [])
                looks = []
                eventually("it rests", lambda: rested() >= 0)
                if shown() == expected:
                    break
            self.assertEqual(shown(), expected)
        for view in self.views():
            self.assertEqual(view["aim"]["yaw"], view["configured"]["yaw"], view["name"])
        small = self.browser.execute_script("""
            return [...document.querySelectorAll('#live :is(button, summary)')].filter((one) => one.checkVisibility())
              .map((one) => [one.outerHTML.slice(0, 80), one.getBoundingClientRect()])
              .filter(([, { width, height }]) => Math.min(width, height) < 24).map(([text]) => text);""")
        self.assertEqual(small, [])

    def views(self):
        return self.browser.execute_async_script(
            "fetch('api/v1/views').then((answer) => answer.json()).then(({ views }) => arguments[0](views))")

    def test_tiles_keep_nobody_out(self):
        self.expect_no_barriers(lambda: self.open(1440, 900))


if __name__ == "__main__":
    unittest.main()
