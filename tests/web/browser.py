# SPDX-License-Identifier: Apache-2.0
"""Debian's Chromium without a screen."""

import base64
import os
import pathlib
import subprocess
import tempfile
import unittest

from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service

from appliance import PATIENCE_S

PICTURES = pathlib.Path(__file__).resolve().parents[2] / "build/web"
AXE = PICTURES / "node_modules/axe-core/axe.min.js"
PAGE = pathlib.Path(__file__).resolve().parents[2] / "app/ports/web/page/files"
# Options for root in a container, without network access of the browser itself.
ARGUMENTS = ["--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--disable-gpu",
             "--disable-quic", "--no-first-run", "--disable-background-networking",
             "--disable-component-update", "--disable-sync", "--window-size=1280,900",
             "--enable-unsafe-swiftshader"]  # WebGL by software, without a complaint

# Begins a script: from now on pictures are decoded, as blank ones, only after release().
HOLD_DECODING = """
    const decode = window.createImageBitmap.bind(window);
    let release;
    const released = new Promise((go) => { release = go; });
    window.createImageBitmap = async () => (await released, decode(new ImageData(8, 8)));"""


def module_address(name):
    """Address of a module of the page with those that it imports; for pages with ignore_policy(). The appliance
    serves modules only in its bundle."""
    bundle = subprocess.run(["esbuild", PAGE / name, "--bundle", "--format=esm", "--charset=utf8"],
                            capture_output=True, check=True)
    source = base64.b64encode(bundle.stdout).decode()
    return f"data:text/javascript;base64,{source}"


class Browser(webdriver.Chrome):
    def __init__(self, more_arguments=()):
        options = Options()
        options.binary_location = "/usr/bin/chromium"
        self.profile = tempfile.TemporaryDirectory()
        for argument in [*ARGUMENTS, *more_arguments, f"--user-data-dir={self.profile.name}"]:
            options.add_argument(argument)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        super().__init__(service=Service("/usr/bin/chromedriver"), options=options)
        self.set_script_timeout(PATIENCE_S)

    def close_all(self):
        self.quit()
        self.profile.cleanup()

    def complaints(self):
        """Messages on the console since the last call, except notes. On a busy machine a pixel may be asked for after
        its picture has gone, which the page expects and the browser reports."""
        return [entry for entry in self.get_log("browser") if entry["level"] != "INFO"
                and not ("/live/pixel?" in entry["message"] and "410 (Gone)" in entry["message"])]

    def ignore_policy(self):
        """Opens pages without their Content-Security-Policy from now on."""
        self.execute_cdp_cmd("Page.setBypassCSP", {"enabled": True})

    def text(self, selector):
        return self.execute_script(
            "return document.querySelector(arguments[0])?.textContent ?? ''", selector)

    def state(self):
        """What the page says, and the newest messages on the console, for the message of a failure."""
        console = [entry["message"] for entry in self.get_log("browser")]
        return f"{self.current_url}: {self.text('body').strip()[:300]!r}, console: {console[-5:]}"

    def picture_numbers(self):
        """For each view the number of the picture on its canvas; 0: none."""
        return self.execute_script("""
            const numbers = {};
            for (const figure of document.querySelectorAll('#tiles figure:not([hidden])')) {
              const canvas = figure.querySelector('canvas');
              numbers[figure.querySelector('strong').textContent] = Number(canvas.dataset.number ?? 0);
            }
            return numbers;""")

    def brightness(self, view):
        """Mean grey level of the view's canvas, and how far its pixels differ from it."""
        return self.execute_script("""
            const named = [...document.querySelectorAll('#tiles figure')]
              .find((f) => f.querySelector('strong').textContent === arguments[0]);
            const canvas = named.querySelector('canvas');
            const pixels = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
            let sum = 0, squares = 0;
            for (let k = 0; k < pixels.length; k += 4) {
              const grey = (pixels[k] + pixels[k + 1] + pixels[k + 2]) / 3;
              sum += grey;
              squares += grey * grey;
            }
            const count = pixels.length / 4, mean = sum / count;
            return [mean, Math.sqrt(squares / count - mean * mean)];""", view)

    def show_on(self, width, height):
        """Emulates a screen of this size, CSS px; of a phone below 600."""
        self.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
            "width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 600})

    def show_in(self, scheme):
        """Emulates a colour scheme, light or dark."""
        self.execute_cdp_cmd("Emulation.setEmulatedMedia", {
            "features": [{"name": "prefers-color-scheme", "value": scheme}]})

    def live_in(self, zone):
        """Emulates a time zone for pages that are opened from now on."""
        self.execute_cdp_cmd("Emulation.setTimezoneOverride", {"timezoneId": zone})

    def look_for_barriers(self):
        """Prepares barriers(), before a page is opened whose policy would forbid it. Skips the test
        when axe-core is missing, except for acceptance."""
        if not AXE.exists() and not os.environ.get("ORBWATCH_ACCEPTANCE"):
            raise unittest.SkipTest("skipped, missing: axe-core, which npm installs")
        self.ignore_policy()

    def pixels(self, selector):
        """The pixels of a canvas, as one number each; None if there is no such canvas."""
        return self.execute_script("""
            const canvas = document.querySelector(arguments[0]);
            if (!canvas) return null;
            const copy = new OffscreenCanvas(canvas.width, canvas.height)
              .getContext('2d', { willReadFrequently: true });
            copy.drawImage(canvas, 0, 0);
            const pixels = copy.getImageData(0, 0, canvas.width, canvas.height).data;
            const sums = [];
            for (let k = 0; k < pixels.length; k += 4) sums.push(pixels[k] + pixels[k + 1] + pixels[k + 2]);
            return sums;""", selector)

    def hold_answers(self, path, refusal=""):
        """Holds the answers to requests whose path contains this one back from the page, until let_go(). `refusal`:
        reason that is answered in place of the appliance, which receives no such request then."""
        self.execute_script("""
            const [path, refusal] = arguments, fetched = window.fetch;
            const hold = { held: [], asked: [] };
            window.answers = hold;
            window.fetch = async (address, ...more) => {
              hold.asked.push([String(address), more[0]?.body ?? '']);
              const isHeld = hold.held && String(address).includes(path);
              const answer = isHeld && refusal
                ? new Response(JSON.stringify({ error: refusal }), { status: 409 }) : await fetched(address, ...more);
              if (isHeld) await new Promise((go) => (hold.held ? hold.held.push(go) : go()));
              return answer;
            };""", path, refusal)

    def held_answers(self):
        """Number of answers that wait for let_go()."""
        return self.execute_script("return window.answers.held.length")

    def let_go(self):
        """Passes on what hold_answers() has held, the oldest first, and holds nothing more."""
        self.execute_script("""
            const { held } = window.answers;
            window.answers.held = null;
            for (const go of held) go();""")

    def asked(self, path):
        """Addresses and bodies of the page's requests since hold_answers() whose path contains this one."""
        return self.execute_script(
            "return window.answers.asked.filter(([address]) => address.includes(arguments[0]))", path)

    def silence_pipeline(self):
        """From now on the page receives what an appliance sends whose pipeline does not report: the last status again
        and again, no pictures, and no history. Loading the page ends it."""
        self.execute_async_script("""
            const [done] = arguments, fetched = window.fetch, kPeriodMs = 250, kAgeS = 10;
            const encode = (text) => new TextEncoder().encode(text);
            const repeat = (parts, signal) => new ReadableStream({ start(sender) {
              const again = setInterval(() => parts.forEach((part) => sender.enqueue(part)), kPeriodMs);
              signal.addEventListener('abort', () => {
                clearInterval(again);
                sender.error(new Error('aborted'));
              });
            } });
            fetched('api/v1/status').then((answer) => answer.json()).then((status) => {
              const body = encode(JSON.stringify({ ...status, age: kAgeS }));
              const head = encode(`${JSON.stringify({ kind: 'status', bytes: body.length })}\\n`);
              window.fetch = async (address, options) => {
                const isFor = (path) => String(address).startsWith(path);
                if (isFor('api/v1/live?')) return new Response(repeat([head, body], options.signal));
                return isFor('api/v1/history?') ? new Response('', { status: 503 }) : fetched(address, options);
              };
              document.dispatchEvent(new Event('visibilitychange')); // opens the stream anew
              done();
            });""")

    def state_another_version(self):
        """From now on the page receives another version of the appliance, as after an update. Loading the page ends
        it."""
        self.execute_script("""
            const fetched = window.fetch;
            window.versions = 0;
            window.fetch = async (address, ...more) => {
              const answer = await fetched(address, ...more);
              if (!String(address).endsWith('openapi.json')) return answer;
              const description = await answer.json();
              description.info.version = 'another';
              ++window.versions;
              return new Response(JSON.stringify(description));
            };""")

    def touch(self, kind, points):
        self.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [
            {"x": x, "y": y, "id": finger} for finger, (x, y) in enumerate(points)]})

    def middle_of(self, shown):
        """Centre of an element, for fingers."""
        return self.execute_script("""
            const box = arguments[0].getBoundingClientRect();
            return [box.x + box.width / 2, box.y + box.height / 2];""", shown)

    def tap(self, shown):
        self.touch("touchStart", [self.middle_of(shown)])
        self.touch("touchEnd", [])

    def drag_by_finger(self, shown, right, down):
        x, y = self.middle_of(shown)
        self.touch("touchStart", [(x, y)])
        for share in (0.5, 1):
            self.touch("touchMove", [(x + share * right, y + share * down)])
        self.touch("touchEnd", [])

    def pinch(self, shown):
        """Moves two fingers twice as far apart."""
        x, y = self.middle_of(shown)
        for kind, distance in [("touchStart", 50), ("touchMove", 75), ("touchMove", 100)]:
            self.touch(kind, [(x - distance, y), (x + distance, y)])
        self.touch("touchEnd", [])

    def barriers(self):
        """Serious findings of axe-core."""
        self.execute_script(AXE.read_text(encoding="utf-8"))
        return self.execute_async_script("""
            axe.run().then((result) => arguments[0](result.violations
              .filter((found) => ['serious', 'critical'].includes(found.impact))
              .map((found) => `${found.id}: ${found.nodes[0].html}`)));""")

    def keep_picture(self, name):
        PICTURES.mkdir(parents=True, exist_ok=True)
        shot = self.execute_cdp_cmd("Page.captureScreenshot", {"format": "jpeg", "quality": 70})
        (PICTURES / f"{name}.jpg").write_bytes(base64.b64decode(shot["data"]))
