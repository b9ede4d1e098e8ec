#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Figures of the prose: what counts, what does not, and that the project is below its limits."""
import contextlib
import io
import unittest

import prose


def words(lines, mark=prose.CPP):
    return [text.words for text in prose.comments("a.cpp", lines, mark)]


class Comments(unittest.TestCase):
    def test_the_lines_of_a_block_are_one(self):
        self.assertEqual(words(["/// Limit of", "/// the queue.", "int limit;"]), ["Limit of the queue."])

    def test_one_behind_code_counts_by_itself(self):
        self.assertEqual(words(["int size;  ///< bytes", "int next;  // of them"]), ["bytes", "of them"])

    def test_an_address_in_a_text_is_none(self):
        self.assertEqual(words(['open("http://a // b");']), [])

    def test_those_of_scripts_begin_otherwise(self):
        self.assertEqual(words(["#!/bin/sh", "# Limit.", "x=1  # bytes"], prose.SCRIPT), ["Limit.", "bytes"])


class Paragraphs(unittest.TestCase):
    def test_code_is_none(self):
        lines = ["Run it:", "```sh", "whoever", "```", "The `whoever` key."]
        self.assertEqual([t.words for t in prose.paragraphs("a.md", lines)], ["Run it:", "The  key."])


class Figures(unittest.TestCase):
    def found(self, name, text, is_comment=True):
        figure = next(f for f in prose.FIGURES if f.name == name)
        return len(list(prose.hits(figure, [prose.Text("a:1", text, is_comment)])))

    def test_a_loose_beginning_counts_in_comments_only(self):
        self.assertEqual(self.found("beginnings", "Of the queue."), 1)
        self.assertEqual(self.found("beginnings", "Office hours."), 0)
        self.assertEqual(self.found("beginnings", "With a rig, views are exact.", is_comment=False), 0)

    def test_words_count_anywhere(self):
        self.assertEqual(self.found("is no", "This is no picture."), 1)
        self.assertEqual(self.found("is no", "It is no longer used."), 0)
        self.assertEqual(self.found("people", "Nobody reads it.", is_comment=False), 1)
        self.assertEqual(self.found("everyday verbs", "The file says so."), 1)
        self.assertEqual(self.found("everyday verbs", "It is understood."), 0)

    def test_the_project_is_below_the_limits(self):
        with contextlib.redirect_stdout(io.StringIO()) as printed:
            self.assertEqual(prose.main([]), 0)
        self.assertIn("beginnings: ", printed.getvalue())

    def test_translations_are_left_out(self):
        manuals = {name for name in prose.sources(["platform"]) if "INSTALL" in name}
        self.assertEqual(manuals, {"platform/INSTALL.md"})

    def test_a_limit_that_is_passed_fails(self):
        text = prose.Text("a:1", "Of the queue.", True)
        self.assertGreater(prose.share(prose.FIGURES[0], [text]), prose.FIGURES[0].limit)


if __name__ == "__main__":
    unittest.main()
