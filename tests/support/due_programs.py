#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""due_programs.py FOLDER BASE: prints the test programs and fuzz targets of the configured build in FOLDER,
a line each: `own NAME` when something changed since the commit BASE in the folder of its tests or in the one
that they mirror, `due NAME` when another change affects it, otherwise `same NAME`. Without a known BASE, or when a
file of the whole build changed, all are `own`.

A program is affected by its sources, by what they include, by what it links and by the programs that it
starts, as Ninja knows them. Another file, such as a list of registers or the page, affects all sources of
the nearest folder with a CMakeLists.txt.
"""

import pathlib
import re
import subprocess
import sys

from run_changed import mirrored

ROOT = pathlib.Path(__file__).resolve().parents[2]
SOURCE = re.compile(r"\.(cpp|h|c)$")
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)
# Files that affect every program.
COMMON = re.compile(r"CMakeLists\.txt$|CMakePresets\.json$|toolchains/|tests/CMakeLists\.txt$|tests/data/"
                    r"|tests/support/[^/]*\.supp$|platform/config/")
# Files that no program reads under a sanitizer: documents, scripts and the cases that they run.
NONE = re.compile(r".*\.(md|py|sh)$|(platform|\.ci)/|tests/(web|hil|bench|platform|acceptance)/(?!.*\.(cpp|h)$)")
EXECUTABLE = re.compile(r"^(?:.*/)?(\w+): \w+_EXECUTABLE_LINKER__", re.MULTILINE)
# CTest's name of a share of a program's cases.
SHARE = re.compile(r"Test +#\d+: (\w+)\.")


def output_of(*command):
    return subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout


def includes(text, folder):
    """Paths, below the project, that a source in `folder` includes."""
    for name in INCLUDE.findall(text):
        for path in (name, f"{folder}/{name}"):
            if (ROOT / path).is_file():
                yield path


def with_includers(changed, files):
    """`changed` and every source that includes one of them, also indirectly."""
    includers = {}
    for name in files:
        if SOURCE.search(name):
            text = (ROOT / name).read_text(errors="replace")
            for included in includes(text, pathlib.PurePath(name).parent):
                includers.setdefault(included, set()).add(name)
    found, waiting = set(changed), list(changed)
    while waiting:
        fresh = includers.get(waiting.pop(), set()) - found
        found |= fresh
        waiting += fresh
    return found


def built_with(name, files):
    """The sources that a file of another kind affects; None: all."""
    if COMMON.match(name):
        return None
    if NONE.match(name):
        return ()
    for folder in pathlib.PurePath(name).parents:
        if (ROOT / folder / "CMakeLists.txt").exists():
            if str(folder) in (".", "tests"):
                return ()
            return [file for file in files if file.startswith(f"{folder}/") and SOURCE.search(file)]
    return ()


def affected(changed, files):
    """The sources that the changed files affect; None: all."""
    sources = set()
    for name in changed:
        more = (name,) if SOURCE.search(name) else built_with(name, files)
        if more is None:
            return None
        sources |= set(more)
    return with_includers(sources, files)


def inputs_of(program, build):
    """Paths, below the project, of the sources that a program and what it needs are made of."""
    found = set()
    for name in output_of("ninja", "-C", build, "-t", "inputs", program).splitlines():
        path = pathlib.Path(name) if name.startswith("/") else build / name
        if "Unity" in path.parts and path.suffix == ".cxx":
            paths = INCLUDE.findall(path.read_text())
        else:
            paths = [str(path)]
        found |= {str(pathlib.Path(one).relative_to(ROOT)) for one in paths if one.startswith(f"{ROOT}/")}
    return found


def programs_of(build):
    """The executables with a test in CTest, and the fuzz targets."""
    tested = set(SHARE.findall(output_of("ctest", "--test-dir", build, "-N")))
    for name in EXECUTABLE.findall(output_of("ninja", "-C", build, "-t", "targets", "all")):
        if name in tested or name.startswith("fuzz_"):
            yield name


def fates(build, base):
    """`own`, `due` or `same` by program's name."""
    files = output_of("git", "ls-files").splitlines()
    known = base and not subprocess.run(["git", "merge-base", "--is-ancestor", base, "HEAD"], cwd=ROOT,
                                        capture_output=True).returncode
    programs = list(programs_of(build))
    changed = output_of("git", "diff", "--name-only", base).splitlines() if known else []
    sources = affected(changed, files) if known else None
    if sources is None:
        return dict.fromkeys(programs, "own")
    own = mirrored([name for name in changed if SOURCE.search(name)], programs)
    return {name: "same" if inputs_of(name, build).isdisjoint(sources) else "own" if name in own else "due"
            for name in programs}


def main():
    if len(sys.argv) != 3:
        print(__doc__)
        return 0 if sys.argv[1:] == ["--help"] else 2
    for name, fate in fates(pathlib.Path(sys.argv[1]).resolve(), sys.argv[2]).items():
        print(fate, name)
    return 0


if __name__ == "__main__":
    sys.exit(main())
