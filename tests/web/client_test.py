# SPDX-License-Identifier: Apache-2.0
"""A client in TypeScript with types that openapi-typescript generates from the OpenAPI description of a running daemon.

Folders: app/ports/web app/model
"""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest
import urllib.request

from appliance import PATIENCE_S, ROOT, Appliance

BUILD = ROOT / "build/web"
PROGRAMS = BUILD / "node_modules/.bin"
CLIENT = ROOT / "tests/web/client.mts"


class Client(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if not (PROGRAMS / "openapi-typescript").exists() and not os.environ.get("ORBWATCH_ACCEPTANCE"):
            raise unittest.SkipTest("skipped, missing: openapi-typescript, which npm installs")
        cls.appliance = Appliance()
        cls.addClassCleanup(cls.appliance.close)
        cls.appliance.start()

    def setUp(self):
        # Below the installed packages, where the compiler and node look for them.
        folder = tempfile.TemporaryDirectory(dir=BUILD)
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "openapi.json").write_text(json.dumps(self.get("openapi.json")), encoding="utf-8")
        self.run_program(PROGRAMS / "openapi-typescript", "openapi.json", "--output", "api.d.ts")

    def get(self, name):
        with urllib.request.urlopen(f"{self.appliance.address}api/v1/{name}", timeout=PATIENCE_S) as answer:
            return json.load(answer)

    def run_program(self, *command):
        """Returns what it prints; fails with it when the program does."""
        ran = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertEqual(ran.returncode, 0, ran.stdout + ran.stderr)
        return ran.stdout

    def compile(self, *sources):
        """Compiles each source, as client0.mts and so on; returns the errors."""
        files = [f"client{number}.mts" for number in range(len(sources))]
        for file, source in zip(files, sources):
            (self.folder / file).write_text(source, encoding="utf-8")
        return subprocess.run(
            [PROGRAMS / "tsc", "--strict", "--noUncheckedIndexedAccess", "--target", "es2022", "--module", "nodenext",
             *files], cwd=self.folder, capture_output=True, text=True, check=False).stdout.splitlines()

    def test_reads_the_demo(self):
        self.assertEqual(self.compile(CLIENT.read_text(encoding="utf-8")), [])
        read = json.loads(self.run_program("node", "client0.mjs", self.appliance.address))
        views, recipe = self.get("views")["views"], self.get("recipe")
        self.assertEqual(read, {
            "runs": True,
            "cameras": [camera["name"] for camera in self.get("status")["cameras"]],
            "views": [view["name"] for view in views],
            "fields": [view["configured"]["h_fov"] for view in views],
            "regions": [region["name"] for region in recipe["regions"]],
            "units": ["mm"] * len(recipe["regions"]),
            "acknowledgement": "done"})

    def test_misuse_does_not_compile(self):
        source = CLIENT.read_text(encoding="utf-8")
        cases = [
            ('"/api/v1/views"', '"/api/v1/view"', "'views' does not exist"),
            ("status.system.state", "status.system.stat", "'stat' does not exist"),
            ("state === 1", "state === 99", "have no overlap"),
            ("(number | null)[] = views", "number[] = views", "is not assignable to type 'number[]'"),
            ("status.cameras?.", "status.cameras.", "possibly 'undefined'"),
            ('figure: "hot_spot_width"', "", "'figure' is missing"),
            ("{ alarm: 0 }", "{}", "'alarm' is missing")]
        for right, _, _ in cases:
            self.assertEqual(source.count(right), 1, right)
        errors = self.compile(*[source.replace(right, wrong) for right, wrong, _ in cases])
        for number, (_, wrong, error) in enumerate(cases):
            own = [line for line in errors if line.startswith(f"client{number}.mts")]
            self.assertTrue(any(error in line for line in own), f"{wrong}: {own}")


if __name__ == "__main__":
    unittest.main()
