#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Manuals as HTML: languages, links, pictures. Exit 77: cmark-gfm is missing."""
import html.parser
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
TEXTS = ROOT / "app/ports/web/page/files/texts"  # the page's texts: a file of two letters for each language
TRANSLATED = ("commissioning", "gige", "installation")
SKIPPED = 77


class Page(html.parser.HTMLParser):
    """Language, links and pictures of a page."""

    def __init__(self, file):
        super().__init__()
        self.language, self.links, self.pictures = None, set(), set()
        self.feed(file.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        found = dict(attributes)
        if tag == "html":
            self.language = found["lang"]
        elif tag == "a" and not re.match("https?:|#", found["href"]):
            self.links.add(found["href"])
        elif tag == "img":
            self.pictures.add(found["src"])


class HtmlManuals(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        subprocess.run([ROOT / "platform/html_manuals", cls.folder], check=True)
        cls.pages = {file.name: Page(file) for file in cls.folder.glob("*.html")}

    def test_links_and_pictures_lead_to_files(self):
        for name, page in self.pages.items():
            with self.subTest(page=name):
                self.assertEqual([one for one in page.links | page.pictures if not (self.folder / one).is_file()], [])

    def test_each_page_is_reached_from_the_first(self):
        reached, new = set(), {"index.html"}
        while new:
            reached |= new
            new = set().union(*(self.pages[name].links for name in new)) - reached
        self.assertEqual(reached, set(self.pages))

    def test_the_installers_manuals_link_each_other_in_their_language(self):
        for language in sorted(file.stem for file in TEXTS.glob("??.js")):
            ending = ".html" if language == "en" else f".{language}.html"
            with self.subTest(language=language):
                self.assertEqual({self.pages[name + ending].language for name in TRANSLATED}, {language})
                self.assertLessEqual({"commissioning" + ending, "gige" + ending},
                                     self.pages["installation" + ending].links)
                self.assertIn("installation" + ending, self.pages["commissioning" + ending].links)

    def test_the_guide_keeps_its_links_to_the_manuals_of_the_files(self):
        self.assertLessEqual({"configuration.html", "rig.html", "recipes.html"}, self.pages["guide.html"].links)


if __name__ == "__main__":
    if not shutil.which("cmark-gfm"):
        print("html_manuals_test: skipped, there is no cmark-gfm")
        sys.exit(SKIPPED)
    unittest.main()
