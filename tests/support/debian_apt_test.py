# SPDX-License-Identifier: Apache-2.0
"""Sources of the state that `debian_apt` makes. apt-get is replaced: nothing is downloaded."""

import os
import pathlib
import subprocess
import tempfile
import unittest

DEBIAN_APT = pathlib.Path(__file__).with_name("debian_apt")
CLASSIC = "deb http://localhost/debian RELEASE main\ndeb http://localhost/debian RELEASE-updates main\n"
DEB822 = "Types: deb\nURIs: http://localhost/debian\nSuites: RELEASE RELEASE-updates\nComponents: main\n"


def release_here():
    lines = pathlib.Path("/etc/os-release").read_text(encoding="utf-8").splitlines()
    return dict(line.split("=", 1) for line in lines if "=" in line)["VERSION_CODENAME"]


class DebianApt(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="orbwatch-apt-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.write("bin/apt-get", "#!/bin/sh\n")
        (self.folder / "bin/apt-get").chmod(0o755)
        (self.folder / "etc").mkdir()

    def write(self, name, text):
        (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
        (self.folder / name).write_text(text, encoding="utf-8")

    def make(self):
        environment = {**os.environ, "PATH": f"{self.folder}/bin:{os.environ['PATH']}",
                       "ORBWATCH_APT_FOLDER": str(self.folder / "etc")}
        return subprocess.run([DEBIAN_APT, self.folder / "apt", "amd64", "other"], env=environment,
                              capture_output=True, text=True, check=False)

    def sources(self):
        """Returns the texts of the files that callers pass to mmdebstrap, by name."""
        done = self.make()
        self.assertEqual(done.returncode, 0, done.stderr)
        # apt reads the same folder and no other file.
        self.assertEqual((self.folder / "apt/sources.list").read_text(encoding="utf-8"), "")
        self.assertIn(f'Dir::Etc::sourceparts "{self.folder}/apt/sources";',
                      (self.folder / "apt/apt.conf").read_text(encoding="utf-8"))
        return {file.name: file.read_text(encoding="utf-8") for file in (self.folder / "apt/sources").iterdir()}

    def test_the_classic_list_is_among_the_sources(self):
        self.write("etc/sources.list", CLASSIC.replace("RELEASE", release_here()))
        self.assertEqual(self.sources(), {"debian.list": CLASSIC.replace("RELEASE", "other")})

    def test_a_classic_list_without_a_source_is_left_out(self):
        self.write("etc/sources.list.d/debian.sources", DEB822.replace("RELEASE", release_here()))
        for text in (None, "", "# See sources.list.d/debian.sources\n# deb cdrom:[Debian]/ other main\n"):
            if text is not None:
                self.write("etc/sources.list", text)
            self.assertEqual(self.sources(), {"debian.sources": DEB822.replace("RELEASE", "other")})

    def test_no_source_at_all_is_refused(self):
        done = self.make()
        self.assertEqual(done.returncode, 1)
        self.assertIn("sources.list.d/debian.sources must name", done.stderr)


if __name__ == "__main__":
    unittest.main()
