#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""prose.py [--list] [FOLDER...]: figures of the prose in comments, manuals and READMEs, below FOLDER or everywhere.

Fails when a figure is above its limit. --list: prints the places that count, too.

beginnings: comments that begin with a loose Of, What, Whether, How, Where, By, With, As or Who, of all comments
is no: "is no X" in place of "is not an X", of all comments and paragraphs
people: whoever, somebody, nobody, anybody, everybody in place of a role, of all comments and paragraphs
everyday verbs: says, tells, hears, stands and their forms, where the field has a term, of all comments and paragraphs
"""
import dataclasses
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
CODE = {".h", ".cpp", ".js"}
SCRIPTS = {".py", ".sh", ".cmake", ".txt"}

TRANSLATION = re.compile(r"\.[a-z]{2}\.md$")  # manuals in other languages
CPP, SCRIPT = r"//[/!]?<?", r"#(?!!)"  # patterns that begin a comment

LOOSE = re.compile(r"(of|what|whether|how|where|by|with|as|who|whose|whom)\b", re.IGNORECASE)
IS_NO = re.compile(r"\b(is|are|was|were) no (?!longer|more|less|fewer|later|earlier|other\b)", re.IGNORECASE)
PEOPLE = re.compile(r"\b(who|what|which)ever\b|\b(some|no|any|every)body('s)?\b", re.IGNORECASE)
EVERYDAY = re.compile(
    r"\b(says?|said|saying|tells?|told|telling|hears?|heard|hearing|stands?|stood|standing)\b", re.IGNORECASE)


@dataclasses.dataclass(frozen=True)
class Figure:
    name: str
    pattern: re.Pattern
    limit: float  # percent
    is_beginning: bool = False


FIGURES = (
    Figure("beginnings", LOOSE, 5, is_beginning=True),
    Figure("is no", IS_NO, 1),
    Figure("people", PEOPLE, 1),
    Figure("everyday verbs", EVERYDAY, 2),
)


@dataclasses.dataclass(frozen=True)
class Text:
    """A comment with all of its lines, or a paragraph of a page."""
    place: str
    words: str
    is_comment: bool


def comments(name, lines, mark):
    """Blocks of whole lines, and comments behind code; `mark`: the pattern that begins one."""
    whole, behind = re.compile(rf"\s*{mark} ?(.*)"), re.compile(rf".*?\S.*?\s{mark} (.*)")
    block, first = [], 0
    for number, line in enumerate([*lines, ""], 1):
        if "SPDX-License-Identifier" in line:
            line = ""
        found = whole.fullmatch(line)
        if found:
            first = first or number
            block.append(found[1].strip())
            continue
        if words := " ".join(block).strip():
            yield Text(f"{name}:{first}", words, True)
        block, first = [], 0
        # A mark within a text, such as an address, is none.
        trailing = behind.fullmatch(line)
        if trailing and line[: trailing.start(1)].count('"') % 2 == 0:
            yield Text(f"{name}:{number}", trailing[1], True)


def paragraphs(name, lines):
    """Of Markdown, without blocks of code and without code in sentences."""
    is_code = False
    for number, line in enumerate(lines, 1):
        if line.startswith("```"):
            is_code = not is_code
        elif not is_code and line.strip():
            yield Text(f"{name}:{number}", re.sub(r"`[^`]*`|\([^)]*\)", "", line), False)


def texts(name):
    path = ROOT / name
    lines = path.read_text(encoding="utf-8").splitlines()
    if path.suffix == ".md":
        return paragraphs(name, lines)
    if path.suffix in CODE:
        return comments(name, lines, CPP)
    return comments(name, lines, SCRIPT)


def is_script(path):
    """By its ending, or by its first line."""
    if path.suffix:
        return path.suffix in SCRIPTS
    with path.open("rb") as file:
        return file.read(2) == b"#!"


def sources(folders):
    listed = subprocess.run(["git", "ls-files", "-z", "--", *folders], cwd=ROOT, check=True,
                            capture_output=True, text=True).stdout
    for name in filter(None, listed.split("\0")):
        path = ROOT / name
        is_prose = path.is_file() and (path.suffix in CODE | {".md"} or is_script(path))
        if is_prose and path.stem not in {"prose", "prose_test"} and not TRANSLATION.search(name):
            yield name


def hits(figure, all_texts):
    for text in all_texts:
        if figure.is_beginning and not text.is_comment:
            continue
        found = figure.pattern.match(text.words) if figure.is_beginning else figure.pattern.search(text.words)
        if found:
            yield text


def share(figure, all_texts):
    counted = sum(text.is_comment or not figure.is_beginning for text in all_texts)
    return 100 * len(list(hits(figure, all_texts))) / max(counted, 1)


def main(arguments):
    if "--help" in arguments:
        print(__doc__.strip())
        return 0
    lists, folders = "--list" in arguments, [a for a in arguments if a != "--list"]
    all_texts = [text for name in sources(folders) for text in texts(name)]
    failed = False
    for figure in FIGURES:
        found = list(hits(figure, all_texts))
        if lists:
            for text in found:
                print(f"{text.place}: {figure.name}: {text.words[:100]}")
        percent = share(figure, all_texts)
        failed |= percent > figure.limit
        print(f"{figure.name}: {len(found)}, {percent:.1f} % of {len(all_texts)}; at most {figure.limit} %")
    return int(failed)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
