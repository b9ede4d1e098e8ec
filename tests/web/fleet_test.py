# SPDX-License-Identifier: Apache-2.0
"""Two appliances of one DDS domain on the page of one of them.

Folders: app/ports/web/fleet app/ports/dds/fleet app/ports/web/page/files/system
"""

import json
import signal
import unittest
import urllib.request

from selenium.webdriver.common.by import By

from appliance import LOOPBACK_DDS, Appliance, eventually, free_port
from page_case import PageCase

RIG = """
[[camera]]
name = "colour"
width = 200
height = 200
[camera.outline]
centre = [99.5, 99.5]
radius = 90
distance = 12
rotation = [0, 0, 0]
"""

SITE = """
rig = "rig.toml"
state_folder = "state"
[modbus]
enabled = false
[web]
enabled = true
address = "0.0.0.0"
port = {port}
https_port = {https_port}
[dds]
name = "{name}"
[[camera]]
name = "colour"
back_end = "test_pattern"
width = 200
height = 200
frame_rate = 1
[camera.test_pattern]
pixel_format = "nv12"
[[view]]
name = "room"
kind = "equirectangular"
width = 200
height = 100
[[view.source]]
camera = "colour"
"""


class Cell(Appliance):
    """Appliance with little load: one picture a second without processor time."""

    def __init__(self, name):
        super().__init__()
        self.https_port = free_port()
        (self.folder / "rig.toml").write_text(RIG, encoding="utf-8")
        (self.folder / "demo.toml").write_text(
            SITE.format(port=self.port, https_port=self.https_port, name=name), encoding="utf-8")

    def environment(self):
        return {"CYCLONEDDS_URI": LOOPBACK_DDS}

    def kill(self):
        self.daemon.send_signal(signal.SIGKILL)
        self.daemon.wait(60)

    def appliances(self):
        with urllib.request.urlopen(self.address + "api/v1/appliances", timeout=60) as answer:
            return json.load(answer)["appliances"]


class FleetPage(PageCase):
    @classmethod
    def make_appliance(cls):
        return Cell("cell 1 <i>")

    def cards(self):
        return self.browser.execute_script("""
            return [...document.querySelectorAll('#appliances > li')].map((card) => ({
              text: card.innerText, page: card.querySelector('a').href,
              seen: card.querySelector('img').naturalWidth}));""")

    def expect_refusal_stays(self, forget):
        self.browser.hold_answers("forget_appliances", "the disk is full")
        forget.click()
        eventually("it is asked for", self.browser.held_answers)
        self.browser.let_go()
        reads = len(self.browser.asked("api/v1/appliances"))
        eventually("the list is read again", lambda: len(self.browser.asked("api/v1/appliances")) > reads + 1)
        self.assertIn("the disk is full", self.browser.text("#fleet [role=alert]"))

    def test_all_appliances_are_listed_and_one_that_dies_is_marked(self):
        self.browser.look_for_barriers()
        other = Cell("cell 2")
        self.addCleanup(other.close)
        other.start()
        self.browser.get(f"{self.appliance.address}#/fleet")
        cards = eventually("both with what they see", lambda: (
            len(shown := self.cards()) == 2 and all(card["seen"] for card in shown) and shown))
        self.assertIn("cell 1 <i>", cards[0]["text"])
        self.assertIn("(this appliance)", cards[0]["text"])
        self.assertIn("cell 2", cards[1]["text"])
        eventually("the state of the other one", lambda: "running" in self.cards()[1]["text"])
        self.assertIn("No alarm", cards[1]["text"])
        self.assertEqual(cards[1]["page"], f"https://127.0.0.1:{other.https_port}/")
        self.assertEqual([one["page"] for one in self.appliance.appliances()],
                         [card["page"] for card in cards])
        self.browser.keep_picture("fleet")
        self.assertEqual(self.browser.barriers(), [])
        self.browser.set_window_size(390, 800)
        self.expect_fits_its_width()

        other.kill()
        eventually("it is marked", lambda: "Gone since" in self.cards()[1]["text"])
        self.assertEqual([one["is_gone"] for one in self.appliance.appliances()], [False, True])
        self.assertEqual(self.browser.barriers(), [])
        other.start()
        eventually("it is back in its own place", lambda: (
            len(shown := self.cards()) == 2 and not any("Gone" in card["text"] for card in shown)))

        other.kill()
        forget = self.browser.find_element(By.CSS_SELECTOR, "#fleet button")
        eventually("it can be forgotten", forget.is_displayed)
        self.expect_refusal_stays(forget)
        forget.click()
        eventually("it is forgotten", lambda: len(self.cards()) == 1)
        self.assertEqual(len(self.appliance.appliances()), 1)
        eventually("no refusal is left", lambda: self.browser.text("#fleet [role=alert]") == "")
        self.assertEqual(self.browser.complaints(), [])
        other.start()


if __name__ == "__main__":
    unittest.main()
