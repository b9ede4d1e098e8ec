# SPDX-License-Identifier: Apache-2.0
"""The page in German and Japanese.

Folders: app/ports/web/page/files/texts app/ports/web/page/files proc/signals app/model
"""

import json
import unittest
import urllib.request

from selenium.webdriver.common.by import By
from selenium.webdriver.support.select import Select

from appliance import PATIENCE_S, eventually
from browser import module_address
from page_case import PageCase

# Pages with an element that each has once it is complete.
PAGES = {"live": "canvas[data-number]", "look": "canvas", "align": "button", "process": ".key",
         "recordings": "[role=status]:not(:empty)", "system": ".card", "fleet": ".appliance"}
LONG = 12  # characters of a text that is recognised within another
OTHERS = ("de", "ja")

# Texts by path, with the kind of each: functions have as many arguments.
KINDS = """
    const [address, done] = arguments;
    const kinds = (one, path) => typeof one === 'object'
      ? Object.entries(one).flatMap(([name, part]) => kinds(part, `${path}.${name}`))
      : [`${path}: ${typeof one}${typeof one === 'function' ? ` of ${one.length}` : ''}`];
    import(address).then(({ texts }) => done(kinds(texts, 'texts')), (wrong) => done(String(wrong)));"""

# Fixed texts, and translations by the appliance's texts.
WORDS = """
    const [address, done] = arguments;
    const all = (one) => typeof one === 'string' ? [one] : Object.values(one).flatMap(all);
    import(address).then(({ texts, words }) => done({ texts: all(texts), words: words ?? {} }),
      (wrong) => done(String(wrong)));"""

# Texts of shown elements, and of those that readers of the screen hear, except names and what the appliance writes
# in English for programmers.
SHOWN = """
    const own = 'code, pre, [lang], .figures td:last-child, #log td, #people td, #interfaces td, #about td';
    const texts = [];
    const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    while (walker.nextNode()) {
      const parent = walker.currentNode.parentElement;
      if (!parent.closest(own) && parent.checkVisibility()) texts.push(walker.currentNode.data.trim());
    }
    for (const one of document.querySelectorAll('[aria-label], [title]')) {
      if (!one.closest(own) && one.checkVisibility()) texts.push(one.ariaLabel ?? one.title);
    }
    return texts.filter(Boolean);"""


def texts_of_the_appliance(description):
    """Titles of signals and texts of codes of the complete status, of the events of alarms and of alignments."""
    def listed(path, name):
        content = description["paths"][path]["get"]["responses"]["200"]["content"]
        return content["application/json"]["schema"]["properties"][name]
    kinds = description["components"]["schemas"]["Status"]["properties"]
    found = set()
    for kind in [*kinds.values(), listed("/api/v1/history/alarms", "alarms"), listed("/api/v1/alignment", "cameras")]:
        one = kind.get("items", kind)
        for name, figure in one.get("properties", {}).items():
            found.update([figure["title"]] if "title" in figure else [])
            # Codes of signals are their identifiers.
            found.update(figure.get("x-enum-descriptions", []) if name != "signal" else [])
    return found


class Languages(PageCase):
    def speak(self, language):
        """The browser asks for pages in this language from now on."""
        self.browser.execute_cdp_cmd("Emulation.setUserAgentOverride", {
            "userAgent": self.browser.execute_script("return navigator.userAgent"),
            "acceptLanguage": language})

    def open(self, page):
        self.browser.get(f"{self.appliance.address}#/{page}")
        eventually(page, lambda: self.browser.find_elements(
            By.CSS_SELECTOR, f"#{page}:not([hidden]) {PAGES[page]}"))

    def module(self, script, language):
        own = module_address("texts/en.js") if language == "en" else f"{self.appliance.address}texts/{language}.js"
        read = self.browser.execute_async_script(script, own)
        self.assertNotIsInstance(read, str)
        return read

    def test_no_text_is_missing_or_stale(self):
        self.browser.ignore_policy()
        self.open("live")
        with urllib.request.urlopen(f"{self.appliance.address}api/v1/openapi.json", timeout=PATIENCE_S) as answer:
            said = texts_of_the_appliance(json.load(answer))
        self.assertIn("Hot spot area", said)
        self.assertIn("camera delivers", said)
        english = self.module(KINDS, "en")
        for language in OTHERS:
            with self.subTest(language=language):
                self.assertEqual(sorted(self.module(KINDS, language)), sorted(english))
                words = self.module(WORDS, language)["words"]
                self.assertEqual(set(words), said)
                self.assertTrue(all(words.values()))

    def test_no_page_shows_english_in_another_language(self):
        self.browser.ignore_policy()
        self.open("live")
        english = set(self.module(WORDS, "en")["texts"])
        for language in OTHERS:
            translations = self.module(WORDS, language)
            foreign = (english | set(translations["words"])) - {*translations["texts"], *translations["words"].values()}
            self.speak(language)
            for page in PAGES:
                with self.subTest(language=language, page=page):
                    self.browser.get("about:blank")
                    self.open(page)
                    self.assertEqual(self.browser.execute_script("return document.documentElement.lang"), language)
                    eventually("the state", lambda: self.browser.text("#condition") in translations["words"].values())
                    for summary in self.browser.find_elements(By.CSS_SELECTOR, f"#{page} details:not([open]) > summary"):
                        self.browser.execute_script("arguments[0].click()", summary)
                    shown = self.browser.execute_script(SHOWN)
                    self.assertEqual([(text, one) for text in foreign for one in shown
                                      if text == one or (len(text) > LONG and text in one)], [])
            self.browser.keep_picture(f"language-{language}")

    def test_a_language_is_chosen_and_kept(self):
        self.open("process")
        Select(self.browser.find_element(By.ID, "language")).select_by_value("de")
        eventually("German", lambda: self.browser.text("#process-title") == "Prozess")
        self.browser.refresh()
        eventually("German again", lambda: self.browser.text("#process-title") == "Prozess")
        figure = eventually("a key figure", lambda: self.browser.text(".key"))
        self.assertNotRegex(figure, r"\d\.\d")
        self.browser.keep_picture("process-german")
        Select(self.browser.find_element(By.ID, "language")).select_by_value("en")
        eventually("English", lambda: self.browser.text("#process-title") == "Process")

    def test_a_phone_needs_no_sideways_scrolling_in_any_language(self):
        self.browser.set_window_size(500, 844)
        for language in OTHERS:
            self.speak(language)
            for page in PAGES:
                with self.subTest(language=language, page=page):
                    self.browser.get("about:blank")
                    self.open(page)
                    self.expect_fits_its_width()

    def test_nothing_keeps_anybody_out_in_any_language(self):
        for language in OTHERS:
            self.speak(language)
            with self.subTest(language=language):
                self.expect_no_barriers(lambda: self.open("process"))


if __name__ == "__main__":
    unittest.main()
