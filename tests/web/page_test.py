# SPDX-License-Identifier: Apache-2.0
"""Actions of a user on the page, against a running daemon.

Folders: app/ports/web/page/files app/ports/web/status app/ports/web/history
"""

import json
import unittest
import urllib.request

from selenium.webdriver.common.by import By

from appliance import ALARM_S, PATIENCE_S, Appliance, eventually
from browser import module_address
from page_case import PageCase

VIEWS = {"panorama", "door", "heat", "process"}
# The first request for the session is never answered; it can only be given up.
HANG_ONCE = """{
  const { fetch } = window;
  let hangs = true;
  window.fetch = (address, options = {}) => {
    if (!hangs || address !== 'api/v1/session') return fetch(address, options);
    hangs = false;
    return new Promise((_, fail) => options.signal.addEventListener('abort', () => fail(options.signal.reason)));
  };
}"""
# Notes by path whether all requests for it were limited in time.
NOTE_LIMITS = """{
  const { fetch } = window;
  window.limited = {};
  window.fetch = (address, options) => {
    const [path] = String(address).split('?');
    window.limited[path] = Boolean(options?.signal) && window.limited[path] !== false;
    return fetch(address, options);
  };
}"""
# Paths that pages ask for again and again, one request at a time.
REPEATED = [("live", "recipe"), ("look", "sphere"), ("align", "alignment"), ("process", "history"),
            ("system", "log"), ("fleet", "appliances")]


class Page(PageCase):
    def open(self, page="live"):
        self.browser.get(f"{self.appliance.address}#/{page}")
        eventually("the page shows the state",
                   lambda: "running" in self.browser.text("#condition"))

    def expect_pictures(self, views):
        before = self.browser.picture_numbers()
        eventually(f"new pictures of {views}",
                   lambda: set(now := self.browser.picture_numbers()) == views
                   and all(now[view] != before.get(view, 0) for view in views))

    def expect_no_complaint(self):
        self.assertEqual(self.browser.complaints(), [])

    def test_live_shows_every_view_over_one_stream(self):
        self.open()
        self.expect_pictures(VIEWS)
        self.expect_pictures(VIEWS)
        for view in VIEWS:
            mean, deviation = self.browser.brightness(view)
            self.assertGreater(mean, 20, view)
            self.assertGreater(deviation, 10, f"{view} is one colour")
        # Another selection of views begins another stream; the former one ends.
        eventually("one stream is open", lambda: self.appliance.status()["web"]["streams"] == 1)
        # The page's own connection, and the one of this query. Those that loaded its files end when
        # they are idle.
        eventually("two connections are left",
                   lambda: self.appliance.status()["web"]["connections"] <= 2)
        self.browser.keep_picture("live")
        self.expect_no_complaint()

    def test_a_first_request_that_is_never_answered_is_given_up(self):
        self.browser.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": HANG_ONCE})
        self.browser.get(self.appliance.address)
        eventually("the page says so", lambda: "No connection" in self.browser.text("#condition"))
        eventually("the next one is answered", lambda: "running" in self.browser.text("#condition"))
        self.expect_no_complaint()

    def test_a_stream_that_is_asked_for_without_an_answer_is_lost(self):
        self.open()
        self.expect_pictures(VIEWS)
        self.browser.hold_answers("api/v1/live")
        self.browser.execute_script("location.hash = '#/system'")  # needs no views: another stream
        eventually("the page says so", lambda: "No connection" in self.browser.text("#condition"))
        self.browser.let_go()
        eventually("the page shows the state again", lambda: "running" in self.browser.text("#condition"))
        self.expect_no_complaint()

    def test_a_request_that_is_never_answered_stops_none_after_it(self):
        self.browser.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": NOTE_LIMITS})
        self.open()
        for page, path in REPEATED:
            self.browser.execute_script("location.hash = `#/${arguments[0]}`", page)
            with self.subTest(path=path):
                [is_limited] = eventually(f"a request for it on {page}", lambda path=path: self.browser.execute_script(
                    "return [window.limited[`api/v1/${arguments[0]}`]].filter((one) => one !== undefined)", path))
                self.assertTrue(is_limited)

    def test_a_command_that_is_never_answered_is_given_up_and_the_newest_is_given(self):
        self.browser.ignore_policy()
        self.open()
        asked, said = self.browser.execute_async_script("""
            const [module, done] = arguments;
            (async () => {
              const { NewestCommand } = await import(module);
              const { fetch } = window, { timeout } = AbortSignal, asked = [], said = [];
              const kAppliancesMs = 10000; // the appliance itself may let a request wait for so long
              AbortSignal.timeout = (ms) => timeout.call(AbortSignal, ms > kAppliancesMs ? 1 : ms);
              window.fetch = (address, options) => {
                if (!String(address).includes('command/')) return fetch(address, options);
                asked.push(JSON.parse(options.body).yaw);
                return new Promise((_, fail) =>
                  options.signal?.addEventListener('abort', () => fail(options.signal.reason)));
              };
              const turn = new NewestCommand('point_view', (why) => said.push(why));
              const all = turn.send({ yaw: 1 });
              turn.send({ yaw: 2 });
              turn.send({ yaw: 3 });
              await all;
              done([asked, said]);
            })();""", module_address("appliance/newest_command.js"))
        self.assertEqual(asked, [1, 3])
        self.assertEqual([bool(why) for why in said], [True, True])

    def test_a_view_that_is_not_chosen_is_not_sent(self):
        self.open()
        self.expect_pictures(VIEWS)
        for view in ("panorama", "door", "process"):
            self.browser.find_element(By.NAME, view).click()
        self.expect_pictures({"heat"})
        self.expect_pictures({"heat"})
        numbers = self.browser.execute_script(
            "return [...document.querySelectorAll('figure[hidden] canvas')]"
            ".map((c) => c.dataset.number)")
        self.expect_pictures({"heat"})
        self.assertEqual(numbers, self.browser.execute_script(
            "return [...document.querySelectorAll('figure[hidden] canvas')]"
            ".map((c) => c.dataset.number)"))
        eventually("one stream", lambda: self.appliance.status()["web"]["streams"] == 1)
        self.expect_no_complaint()

    def history(self, query):
        with urllib.request.urlopen(f"{self.appliance.address}api/v1/history{query}",
                                    timeout=PATIENCE_S) as answer:
            return json.load(answer)

    def charted_before_it_was_opened(self):
        """Seconds before the loading of the page that the chart of a region shows; None: it is empty."""
        return self.browser.execute_script("""
            const canvas = document.querySelector('[data-region] canvas');
            if (!canvas?.width) return null;
            const copy = new OffscreenCanvas(canvas.width, canvas.height)
              .getContext('2d', { willReadFrequently: true });
            copy.drawImage(canvas, 0, 0);
            const { data } = copy.getImageData(0, 0, canvas.width, canvas.height);
            const drawn = [...data.keys()].filter((k) => k % 4 === 3 && data[k] > 0);
            if (drawn.length === 0) return null;
            const first = Math.min(...drawn.map((k) => (k - 3) / 4 % canvas.width));
            return 600 * (1 - first / canvas.width) - performance.now() / 1000;""")

    def expect_history_after_a_reload(self):
        acknowledged = eventually("it is remembered", lambda: [
            event for event in self.history("/alarms")["alarms"]
            if event["event_text"] == "acknowledged"])
        self.assertEqual(acknowledged[-1]["by"], "over HTTP")
        eventually("there is something to remember", lambda: len(self.history(
            "?region=pool&figure=hot_spot_peak_temperature")["low"]) > 20)
        self.browser.refresh()
        eventually("the chart begins before the page does",
                   lambda: (self.charted_before_it_was_opened() or 0) > 5)
        eventually("what happened to alarms", lambda: "acknowledged" in self.browser.text(
            "#alarm-history tbody"))

    def test_an_alarm_is_acknowledged(self):
        def states():
            return [alarm["state_text"] for alarm in self.appliance.status()["alarms"]]

        self.open("process")
        eventually("an alarm waits for somebody",
                   lambda: any("not acknowledged" in state for state in states()), ALARM_S)
        done = self.appliance.status()["web"]["commands_done"]
        self.browser.keep_picture("process")
        eventually("the header and the title name it", lambda: (
            "not acknowledged" in self.browser.text("#notices a[href='#/process']")
            and self.browser.title.startswith("(")
            and "(" in self.browser.text("nav a[href='#/process']")))
        for button in self.browser.find_elements(By.CSS_SELECTOR, "#alarms > button"):
            button.click()
        eventually("the command was carried out",
                   lambda: self.appliance.status()["web"]["commands_done"] == done + 1)
        self.assertEqual(self.browser.text("#process [role=alert]"), "")
        self.expect_history_after_a_reload()
        self.expect_no_complaint()

    def test_every_page_has_a_title_and_names_the_recipe(self):
        self.open()
        for page, title in (("process", "Process"), ("system", "System"), ("live", "Live")):
            self.browser.find_element(By.CSS_SELECTOR, f"nav a[href='#/{page}']").click()
            eventually(title, lambda title=title: f"{title} – orbwatch" in self.browser.title)
            eventually("the recipe", lambda: "Recipe 1" in self.browser.text("#notices"))

    def test_figures_are_those_of_the_interface(self):
        self.open("system")
        self.browser.find_element(By.CSS_SELECTOR, "#state > summary").click()

        def shown():
            return {row[0]: row[1:] for row in self.browser.execute_script(
                "return [...document.querySelectorAll('#state tbody tr')]"
                ".map((r) => [...r.children].map((c) => c.textContent))")}

        def system():
            return self.appliance.status()["system"]

        figures = eventually("the figures", shown)
        self.assertEqual(set(figures), {name for name in system() if not name.endswith("_text")})
        self.assertEqual(figures["recipe"][0], str(system()["recipe"]))
        self.assertEqual(figures["busy_ms"][1], "ms")
        # On a busy machine a camera that is late degrades the state for a moment.
        eventually("the same state", lambda: shown()["state"][0] == system()["state_text"])
        self.browser.keep_picture("system")
        self.expect_no_complaint()

    def test_a_picture_that_cannot_be_decoded_stops_nothing(self):
        self.browser.ignore_policy()
        self.open()
        shown = self.browser.execute_async_script("""
            const [module, done] = arguments;
            (async () => {
              const { NewestPicture } = await import(module);
              const canvas = document.createElement('canvas');
              const blob = await new Promise((give) => canvas.toBlob(give, 'image/jpeg'));
              const good = new Uint8Array(await blob.arrayBuffer());
              const shown = [];
              const pictures = new NewestPicture((picture, { head }) => {
                if (head.number === 2) throw new Error('not drawn');
                shown.push(head.number);
              });
              const show = (number, body) => pictures.show({ head: { name: 'front', number }, body });
              await show(1, new Uint8Array([1, 2, 3]));
              await show(2, good).catch(() => shown.push('refused'));
              await show(3, good);
              done(shown);
            })();""", module_address("appliance/newest_picture.js"))
        self.assertEqual(shown, ["refused", 3])

    def test_a_hidden_tab_takes_no_stream(self):
        self.open()
        self.expect_pictures(VIEWS)
        self.hide_for_a_while()
        self.expect_pictures(VIEWS)

    def test_the_page_of_another_version_is_loaded_at_the_next_connection(self):
        self.open()
        self.browser.execute_script("window.isTheSamePage = true")
        self.hide_for_a_while()
        self.expect_pictures(VIEWS)
        self.assertTrue(self.browser.execute_script("return window.isTheSamePage"))
        self.browser.state_another_version()
        self.hide_for_a_while()
        eventually("a new page", lambda: not self.browser.execute_script("return window.isTheSamePage ?? false"))
        self.expect_pictures(VIEWS)

    def test_the_oldest_of_several_pictures_is_judged(self):
        self.browser.ignore_policy()
        self.open()
        both, newer, none = self.browser.execute_async_script("""
            const [module, done] = arguments;
            import(module).then(({ Freshness }) => {
              const picture = document.createElement('div'), freshness = new Freshness(picture);
              freshness.drew(60000, performance.now(), 'older');
              freshness.drew(0, performance.now(), 'newer');
              const both = freshness.tick('');
              freshness.keep(['newer']);
              const newer = [freshness.tick(''), picture.classList.contains('veiled')];
              freshness.forget();
              done([both, newer, freshness.age.textContent]);
            });""", module_address("elements/freshness.js"))
        self.assertRegex(both, "^No new picture for 6")
        self.assertEqual(newer, ["", False])
        self.assertEqual(none, "no picture yet")

    def sends_no_pictures(self):
        """True if no picture is sent while the pipeline continues."""
        before = self.appliance.status()
        eventually("more frame sets", lambda: self.appliance.status()["system"]["frame_set"]
                   > before["system"]["frame_set"] + 15)
        return self.appliance.status()["web"]["pictures_sent"] == before["web"]["pictures_sent"]

    def test_pages_that_show_no_views_take_none(self):
        self.open()
        for page in ("align", "system", "fleet"):
            self.browser.find_element(By.CSS_SELECTOR, "nav a[href='#/live']").click()
            self.expect_pictures(VIEWS)
            self.browser.find_element(By.CSS_SELECTOR, f"nav a[href='#/{page}']").click()
            with self.subTest(page=page):
                eventually("no picture is sent", self.sends_no_pictures)
                eventually("the state", lambda: "running" in self.browser.text("#condition"))
        self.expect_no_complaint()

    def test_what_cannot_be_pressed_looks_so(self):
        self.open("align")
        looks = eventually("buttons that can be pressed and others", lambda: (
            found := self.browser.execute_script("""
                const looks = { true: [], false: [] };
                for (const button of document.querySelectorAll('#align button')) {
                  looks[button.disabled].push(Number(getComputedStyle(button).opacity));
                }
                return looks;""")) and found["true"] and found["false"] and found)
        self.assertEqual(set(looks["false"]), {1})
        self.assertLess(max(looks["true"]), 0.6)

    def test_pictures_come_back_after_a_restart_of_the_daemon(self):
        self.open()
        self.expect_pictures(VIEWS)
        self.appliance.stop()
        eventually("the page says so", lambda: "No connection" in self.browser.text("#condition"))
        eventually("the page says how old its pictures are",
                   lambda: "No new picture" in self.browser.text("#tiles .overlay"))
        self.browser.keep_picture("lost")
        self.appliance.start()
        self.expect_pictures(VIEWS)
        eventually("the page shows the state again",
                   lambda: "running" in self.browser.text("#condition"))

    def test_nothing_keeps_anybody_out(self):
        for page in ("live", "align", "process", "system"):
            with self.subTest(page=page):
                self.expect_no_barriers(lambda page=page: self.open(page))

    def test_a_phone_needs_no_sideways_scrolling(self):
        self.browser.set_window_size(500, 844)
        for page in ("live", "align", "process", "system"):
            self.open(page)
            self.expect_fits_its_width()
        self.browser.keep_picture("phone")
        self.expect_no_complaint()


class UnpluggedCameras(PageCase):
    """Both cameras are unplugged after some frames, and stay so."""

    @classmethod
    def make_appliance(cls):
        appliance = Appliance()
        appliance.unplug("colour", "thermal")
        return appliance

    def veils(self, page):
        """Text over each displayed live picture of a page, and whether it is veiled."""
        return self.browser.execute_script("""
            return [...document.querySelectorAll(`#${arguments[0]} .picture:has(.overlay)`)]
                .filter((picture) => picture.offsetParent !== null)
                .map((picture) => [picture.querySelector('.overlay').textContent,
                                   picture.classList.contains('veiled')]);""", page)

    def test_every_live_picture_is_veiled_and_names_its_fault(self):
        for page, pictures in (("live", len(VIEWS)), ("look", 1), ("process", 1), ("align", 1)):
            self.browser.get(f"{self.appliance.address}#/{page}")
            with self.subTest(page=page):
                eventually("all pictures are veiled", lambda page=page, pictures=pictures: (
                    len(veils := self.veils(page)) >= pictures
                    and all("not connected" in text and veiled for text, veiled in veils)))
                self.browser.keep_picture(f"unplugged-{page}")


if __name__ == "__main__":
    unittest.main()
