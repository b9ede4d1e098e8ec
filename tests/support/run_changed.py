#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""run_changed.py [BASE]: runs the tests for all changes since BASE (HEAD: uncommitted changes), for
`tests/run --changed`.
run_changed.py --passed: records that the release tests of all programs, as they are built now, passed, except
for the long gates of alignment.

Builds the release preset and runs the test programs that differ from those whose tests passed here
before, and those of the changed folders. A program whose tests start `orbwatchd` or `orbwatch` differs by
its own code alone; `tests/run` runs them all. Then the programs of the changed folders under the suitable
sanitizer: proc starts no thread (ASan and UBSan), hal and app do (TSan). Then clang-format and clang-tidy,
and those of the long stages (page, packages, emulated machines, arm64's kernels) whose folders changed.
"""

import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
LOGS = ROOT / "build/logs"
# The long gates of alignment, for changes that affect them (tests/support/drawn.sh).
GATES = "align_gate_tests"
# Tests of the tree itself: its includes and documents.
ALWAYS = "architecture_tests"
# Folders, and the tests for their changes in addition to the release tests.
PACKAGED = r"platform/(?!demo)|tests/platform/"
STAGES = [
    ("page", r"app/ports/web/page/|tests/web/", ["tests/web/run", "--drawn"]),
    ("package", PACKAGED, ["platform/build-deb", "--here", "--bundle"]),
    ("package-tests", PACKAGED, ["tests/platform/packages/run", "--drawn"]),
    ("machines", r"hal/|tests/hil/|platform/debian/", ["tests/hil/run", "--drawn"]),
    ("demo", r"platform/demo|platform/config/demo",
     ["platform/demo", "--seconds", "5", "--out", "build/demo-views"]),
]


def git(*words):
    return subprocess.run(["git", *words], cwd=ROOT, check=True, capture_output=True, text=True).stdout


def changed_since(base):
    names = git("diff", "--name-only", base).splitlines()
    return sorted({*names, *git("ls-files", "--others", "--exclude-standard").splitlines()})


class Stages:
    """Runs commands, keeps their output, and records whether all passed."""

    def __init__(self):
        LOGS.mkdir(parents=True, exist_ok=True)
        self.passed = True

    def run(self, name, command, **more):
        log = LOGS / f"{name}.log"
        begin = time.monotonic()
        with log.open("w") as out:
            code = subprocess.run(command, cwd=ROOT, stdout=out, stderr=subprocess.STDOUT, **more).returncode
        verdict = "FAILED  " if code else "passed  "
        print(f"{verdict} {name} ({time.monotonic() - begin:.0f} s)", flush=True)
        if code:
            self.passed = False
            print(*log.read_text(errors="replace").splitlines()[-60:], f"see {log}", sep="\n")
        return code == 0


class Preset:
    """A build folder, and its test programs by name."""

    def __init__(self, name, stages):
        self.name = name
        self.stages = stages
        self.folder = ROOT / "build" / name
        self.record = self.folder / "passed.json"

    def configure(self):
        return self.stages.run(f"{self.name}-configure", ["cmake", "--preset", self.name])

    def build(self, *targets):
        chosen = ["--target", *targets] if targets else []
        return self.stages.run(f"{self.name}-build",
                               ["cmake", "--build", "--preset", self.name, *chosen])

    def tests(self):
        """Each test program's path and CTest's names for its parts, by program name."""
        listing = subprocess.run(["ctest", "--preset", self.name, "--show-only=json-v1"], cwd=ROOT,
                                 check=True, capture_output=True, text=True).stdout
        found = {}
        for test in json.loads(listing)["tests"]:
            if "command" not in test:
                continue
            built = [word for word in test["command"]
                     if word.startswith(str(self.folder)) and not pathlib.Path(word).is_dir()]
            if built:
                program = pathlib.Path(built[0])
                found.setdefault(program.name, (program, []))[1].append(test["name"])
        return found

    def digests(self):
        """The digest of each test program that is built."""
        return {name: digest(program) for name, (program, _) in self.tests().items() if program.exists()}

    def run(self, names):
        """Runs the named programs' tests; records those that passed."""
        if not names:
            return
        found = self.tests()
        parts = [re.escape(part) for name in names for part in found[name][1]]
        places = 3 * len(os.sched_getaffinity(0))
        right = self.stages.run(
            f"{self.name}-tests",
            ["setarch", "-R", "ctest", "--preset", self.name, "-j", str(places), "-R",
             f"^({'|'.join(parts)})$"])
        if right:
            self.keep(names)

    def keep(self, names):
        """Records that the named programs' tests passed."""
        digests = self.digests()
        known = {**self.passed(), **{name: digests[name] for name in names if name in digests}}
        self.record.write_text(json.dumps(known, indent=1) + "\n")

    def passed(self):
        return json.loads(self.record.read_text()) if self.record.exists() else {}


def digest(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()


def folders_of_programs():
    """The folders of each test program's sources, below the project, by program name."""
    found = {}
    for listing in ROOT.glob("tests/**/CMakeLists.txt"):
        for name, body in re.findall(r"orbwatch_tests\((\w+)([^)]*)\)", listing.read_text()):
            listed = re.search(r"SOURCES(.*?)(LIBRARIES|$)", body, re.DOTALL)
            for source in listed[1].split() if listed else ():
                folder = os.path.normpath((listing.parent / source).parent)
                found.setdefault(name, set()).add(os.path.relpath(folder, ROOT))
    return found


def mirrored(changed, programs):
    """Those of `programs` with tests in the folder that mirrors a changed source's, or in the next one
    above."""
    folders = folders_of_programs()
    chosen = set()
    for name in changed:
        place = pathlib.PurePath(name).parent
        if place.parts[:1] != ("tests",):
            place = "tests" / place
        for above in (place, *place.parents):
            fitting = {program for program in programs if str(above) in folders.get(program, ())}
            chosen |= fitting
            if fitting:
                break
    return chosen


def sources(changed, tops):
    return [name for name in changed if re.match(rf"(tests/)?({tops})/.*\.(cpp|h|c)$", name)]


def sanitized(changed, stages):
    """Runs the mirrored programs: those of hal and app under TSan if it has any, others under ASan."""
    remaining = sources(changed, "proc")
    threads = sources(changed, "hal|app")
    for name, files in (("tsan", threads), ("asan-ubsan", remaining)):
        if not files:
            continue
        preset = Preset(name, stages)
        if not preset.configure():
            return
        programs = sorted(mirrored(files, preset.tests()))
        if not programs and name == "tsan":
            remaining += threads
        elif programs and preset.build(*programs):
            preset.run(programs)


def of_alignment(base):
    """True if a change since `base` affects the long gates."""
    return not subprocess.run(["bash", "-c", '. tests/support/drawn.sh; tests/support/changed "$1" "${alignment[@]}"',
                               "changed", base], cwd=ROOT).returncode


def main():
    if sys.argv[1:] == ["--passed"]:
        release = Preset("release", Stages())
        release.keep(release.tests().keys() - {GATES})
        return 0
    if sys.argv[1:2] == ["--help"] or len(sys.argv) > 2:
        print(__doc__)
        return 0 if sys.argv[1:2] == ["--help"] else 2
    base = sys.argv[1] if sys.argv[1:] and sys.argv[1] else "HEAD"
    changed = changed_since(base)
    if not changed:
        print(f"nothing has changed since {base}")
        return 0
    stages = Stages()
    stages.run("packages", ["platform/install_packages", "build", "test", "demo"])
    release = Preset("release", stages)
    if not (stages.passed and release.configure() and release.build()):
        return 1
    known = release.passed()
    built = release.digests()
    chosen = {name for name, now in built.items() if known.get(name) != now}
    chosen |= mirrored(sources(changed, "app|hal|proc"), built)
    release.run(sorted((chosen if of_alignment(base) else chosen - {GATES}) | {ALWAYS}))
    sanitized(changed, stages)
    stages.run("format", ["tests/support/check_format"])
    if sources(changed, "app|hal|proc"):
        stages.run("tidy", ["tests/tidy", base])
    if any(name.startswith("proc/remap/kernel/") for name in changed):
        arm64 = Preset("aarch64", stages)
        if arm64.configure() and arm64.build("remap_tests"):
            arm64.run(["remap_tests"])
    os.environ["ORBWATCH_SINCE"] = base
    for name, pattern, command in STAGES:
        if any(re.match(pattern, file) for file in changed):
            stages.run(name, command)
    return 0 if stages.passed else 1


if __name__ == "__main__":
    sys.exit(main())
