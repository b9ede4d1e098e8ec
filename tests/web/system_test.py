# SPDX-License-Identifier: Apache-2.0
"""Log, interfaces and versions on the page of a running daemon.

Folders: app/ports/web/log app/ports/web/interfaces app/ports/web/page/files/system
"""

import json
import pathlib
import socket
import struct
import tempfile
import unittest
import urllib.error
import urllib.request

from selenium.webdriver.common.by import By

from appliance import Appliance, eventually, free_port
from page_case import ZONE, PageCase


# Answers the page with the log of an earlier start, of one line, until `isRestarted`.
EARLIER_LOG = """
    const fetched = window.fetch;
    window.fetch = (address, ...more) => {
      if (window.isRestarted || !String(address).startsWith('api/v1/log?')) return fetched(address, ...more);
      const line = { number: 1, time: '2026-01-01T00:00:01Z', level: 'info', text: 'an earlier start' };
      return Promise.resolve(new Response(JSON.stringify({ started: '2026-01-01T00:00:00Z', newest: 1,
        lines: address.includes('after=0') ? [line] : [] })));
    };"""
# The first answer with the versions is not JSON, for example that of a proxy.
UNREADABLE_VERSIONS = """{
  const { fetch } = window;
  let isReadable = false;
  window.fetch = (address, ...more) => {
    if (isReadable || address !== 'api/v1/about') return fetch(address, ...more);
    isReadable = true;
    return Promise.resolve(new Response('<html>'));
  };
}"""
# Counts reads of the interfaces; the next ones wait until the case lets them begin.
WAITING_READS = """
    const { fetch: fetched, setTimeout: later } = window;
    Object.assign(window, { reads: 0, waiting: [] });
    window.fetch = (address, ...more) => {
      if (address === 'api/v1/interfaces') ++window.reads;
      return fetched(address, ...more);
    };
    window.setTimeout = (act, ms, ...more) => {
      if (ms !== 2000) return later(act, ms, ...more);
      window.waiting.push(act);
      return 0;
    };"""


class WithPlc(Appliance):
    """Appliance with Modbus on a port of its own."""

    def __init__(self):
        super().__init__()
        self.modbus_port = free_port()
        self.site = self.folder / "demo.toml"
        self.site.write_text(f'{self.site.read_text(encoding="utf-8")}'
                             f'[modbus]\naddress = "127.0.0.1"\nport = {self.modbus_port}\n',
                             encoding="utf-8")

    def get(self, path):
        with urllib.request.urlopen(f"{self.address}api/v1/{path}", timeout=60) as answer:
            return json.load(answer)

    def metrics(self):
        """Values of a metric by its label."""
        with urllib.request.urlopen(f"{self.address}metrics", timeout=60) as answer:
            lines = answer.read().decode().splitlines()
        samples = [line.rsplit(" ", 1) for line in lines if not line.startswith("#")]
        return {name: float(value) for name, value in samples}

    def command(self, name):
        request = urllib.request.Request(
            f"{self.address}api/v1/command/{name}", data=b"{}",
            headers={"Content-Type": "application/json"})
        with urllib.request.urlopen(request, timeout=60) as answer:
            return json.load(answer)


class SystemPage(PageCase):
    @classmethod
    def make_appliance(cls):
        return WithPlc()

    def open(self, part):
        self.browser.get(f"{self.appliance.address}#/system")
        summary = eventually(part, lambda: self.browser.find_elements(By.CSS_SELECTOR, f"#{part} > summary"))[0]
        # A press misses if what is above grows meanwhile.
        eventually(f"{part} is open", lambda: self.browser.execute_script(
            "return arguments[0].parentElement.open", summary) or summary.click())

    def rows(self, selector):
        return self.browser.execute_script(
            "return [...document.querySelectorAll(arguments[0])].filter((row) => !row.hidden)"
            ".map((row) => [...row.cells].map((cell) => cell.textContent))", f"{selector} tbody tr")

    def expect_all_lines(self):
        """Those that are logged meanwhile are on the page a little later."""
        eventually("all lines of the log", lambda: [row[2] for row in reversed(self.rows("#log"))] == [
            line["text"] for line in self.appliance.get("log?lines=1000")["lines"]])

    def test_log_is_that_of_the_interface(self):
        self.open("log")
        lines = self.appliance.get("log")["lines"]
        self.assertTrue(any("runs with 2 cameras" in line["text"] for line in lines))
        self.expect_all_lines()
        self.browser.keep_picture("log")

    def test_log_begins_again_after_a_restart_that_has_logged_more_lines(self):
        self.browser.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": EARLIER_LOG})
        self.open("log")
        eventually("the log before", lambda: [row[2] for row in self.rows("#log")] == ["an earlier start"])
        self.browser.execute_script("window.isRestarted = true")
        self.expect_all_lines()
        self.assertEqual(self.browser.complaints(), [])

    def test_log_has_local_times(self):
        self.browser.live_in(ZONE)
        self.open("log")
        self.expect_local_times("log?lines=1000", "lines", "#log")

    def test_log_shows_what_is_logged_while_one_looks(self):
        self.open("log")
        eventually("lines of all levels", lambda: self.rows("#log"))
        self.browser.find_element(By.CSS_SELECTOR, "#log select").send_keys("error")
        eventually("the lines of that level", lambda: self.rows("#log") == [])
        text = self.appliance.site.read_text(encoding="utf-8")
        self.appliance.site.write_text("nonsense = \n" + text, encoding="utf-8")
        self.addCleanup(lambda: self.appliance.site.write_text(text, encoding="utf-8"))
        with self.assertRaisesRegex(urllib.error.HTTPError, "409"):
            self.appliance.command("restart")
        eventually("why it does not restart", lambda: any(
            row[1] == "error" and "demo.toml:1" in row[2] for row in self.rows("#log")))
        eventually("the card counts it", lambda: self.browser.text("#log .state").startswith("1 error,"))
        colours = {level: self.browser.execute_script(
            "return getComputedStyle(document.querySelector(arguments[0])).color", f"#log tr.{level} td")
            for level in ("info", "error")}
        self.assertNotEqual(colours["info"], colours["error"])
        self.assertEqual(self.browser.complaints(), [])

    def test_log_is_filtered_by_text_and_saved_as_it_is_shown(self):
        self.open("log")
        everything = eventually("lines", lambda: self.rows("#log"))
        self.browser.find_element(By.CSS_SELECTOR, "#log [type=search]").send_keys("2 CAMERAS")
        shown = self.rows("#log")
        self.assertLess(len(shown), len(everything))
        self.assertTrue(all("2 cameras" in row[2].lower() for row in shown) and shown)
        with tempfile.TemporaryDirectory() as folder:
            self.browser.execute_cdp_cmd("Browser.setDownloadBehavior", {"behavior": "allow", "downloadPath": folder})
            self.browser.find_element(By.CSS_SELECTOR, "#log a.button").click()
            file = eventually("the file", lambda: next(pathlib.Path(folder).glob("orbwatch.log"), None))
            saved = file.read_text(encoding="utf-8").splitlines()
        self.assertEqual([line.split(" ", 2)[1:] for line in saved], [row[1:] for row in reversed(shown)])
        times = {line["time"] for line in self.appliance.get("log")["lines"]}
        self.assertLessEqual({line.split(" ")[0] for line in saved}, times)

    def test_interfaces_show_registers_clients_and_topics(self):
        with socket.create_connection(("127.0.0.1", self.appliance.modbus_port), timeout=60) as plc:
            # Reads input register 0 of unit 1.
            plc.sendall(struct.pack(">HHHBBHH", 1, 0, 6, 1, 4, 0, 1))
            self.assertEqual(len(plc.recv(260)), 11)
            self.open("interfaces")
            parts = eventually("the interfaces", lambda: [
                part for part in self.browser.find_elements(
                    By.CSS_SELECTOR, "#interfaces details")
                if part.text.startswith(("modbus: ", "dds: "))] or None)
            for part in parts:
                self.browser.execute_script("arguments[0].open = true", part)
            modbus = self.appliance.get("interfaces")["modbus"]
            self.assertEqual([(client["address"], client["may_write"], client["requests"])
                              for client in modbus["clients"]], [("127.0.0.1", True, 1)])
            names = {register["name"] for register in modbus["registers"]}
            shown = eventually("the registers", lambda: {
                row[4]: row[5] for row in self.rows("#interfaces") if len(row) == 8})
            self.assertEqual(set(shown), names)
            recipe = self.appliance.status()["system"]["recipe"]
            self.assertEqual(shown["system_recipe"], str(recipe))
            eventually("the client", lambda: any(
                row[:3] == ["127.0.0.1", "true", "1"] for row in self.rows("#interfaces")))
            eventually("the values move", lambda: {
                row[4]: row[5] for row in self.rows("#interfaces") if len(row) == 8
            }["system_heartbeat"] != shown["system_heartbeat"])
        topics = {row[0] for row in eventually("the topics", lambda: [
            row for row in self.rows("#interfaces") if len(row) == 9])}
        self.assertEqual(topics, {topic["topic"] for topic in
                                  self.appliance.get("interfaces")["dds"]["topics"]})
        metrics = self.appliance.metrics()
        self.assertEqual(metrics["orbwatch_modbus_answered"], 1)
        self.assertEqual({f'orbwatch_dds_topic_readers{{name="{topic}"}}' for topic in topics},
                         {name for name in metrics if name.startswith("orbwatch_dds_topic_readers{")})
        self.browser.keep_picture("interfaces")
        self.assertEqual(self.browser.complaints(), [])

    def turn_to(self, page):
        self.browser.execute_script("location.hash = `#/${arguments[0]}`", page)
        eventually(page, lambda: self.browser.find_elements(By.CSS_SELECTOR, f"#{page}:not([hidden])"))

    def test_interfaces_are_read_only_while_their_page_is_open(self):
        def reads():
            """Lets the waiting reads begin; returns the number of those that did."""
            return self.browser.execute_script("""
                window.reads = 0;
                for (const act of window.waiting.splice(0)) act();
                return window.reads;""")

        self.open("interfaces")
        self.browser.execute_script(WAITING_READS)
        eventually("they are read", reads)
        eventually("the next read waits", lambda: self.browser.execute_script("return window.waiting.length"))
        self.turn_to("live")
        self.assertEqual(reads(), 0)
        self.turn_to("system")
        eventually("they are read again", reads)
        self.assertEqual(self.browser.complaints(), [])

    def test_stages_are_those_of_the_interface(self):
        self.open("stages")
        rows = eventually("the stages", lambda: self.browser.execute_script(
            "return [...document.querySelectorAll('#stages tbody tr')]"
            ".map((row) => [...row.cells].map((cell) => cell.textContent))"))
        status = self.appliance.status()
        self.assertEqual([row[0] for row in rows],
                         [stage["name"] for stage in status["stages"]])
        for row in rows:
            for figure in row[1:4]:
                self.assertRegex(figure, r"^([0-9.]+|–)$")
        share = self.browser.text("#stages p span")
        self.assertRegex(share, r"^[0-9]+ %$")
        # The two are from different seconds, so they are only nearly the same.
        self.assertLess(abs(float(share[:-2]) / 100 - status["system"]["load"]), 0.5)
        self.browser.keep_picture("stages")
        self.assertEqual(self.browser.complaints(), [])

    def test_versions_are_those_of_the_interface(self):
        self.open("about")
        about = self.appliance.get("about")
        shown = dict(eventually("the versions", lambda: self.rows("#about")))
        self.assertEqual(shown, about["versions"])
        self.assertIn(about["commanders"], self.browser.text("#about p"))

    def test_versions_are_read_again_after_an_unreadable_answer(self):
        self.browser.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": UNREADABLE_VERSIONS})
        self.open("about")
        eventually("the versions", lambda: self.rows("#about"))
        self.assertEqual(self.browser.complaints(), [])

    def test_system_keeps_nobody_out(self):
        self.browser.look_for_barriers()
        self.open("log")
        for part in ("interfaces", "about"):
            self.browser.find_element(By.CSS_SELECTOR, f"#{part} > summary").click()
        eventually("the interfaces", lambda: self.browser.find_elements(
            By.CSS_SELECTOR, "#interfaces details"))
        self.assertEqual(self.browser.barriers(), [])


if __name__ == "__main__":
    unittest.main()
