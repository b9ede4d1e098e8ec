#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Packages that a bundle has, and what its `install` does with those that are installed. Packages are empty files of
dpkg-deb. apt decides and installs nothing: it simulates, on a list of installed packages of the test's own."""
import os
import pathlib
import shutil
import subprocess
import tarfile
import tempfile
import unittest

DEBIAN = pathlib.Path(__file__).resolve().parents[2] / "platform/debian"


class Packages(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="orbwatch-bundle-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.folder.chmod(0o755)
        self.environment = {**os.environ, "LC_ALL": "C.UTF-8"}

    def write(self, name, text, mode=0o644):
        (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
        (self.folder / name).write_text(text, encoding="utf-8")
        (self.folder / name).chmod(mode)

    def pack(self, folder, name, version, depends="", source=""):
        """Makes a package and returns its file's name."""
        fields = {"Package": name, "Source": source, "Version": version, "Architecture": "all", "Depends": depends,
                  "Maintainer": "test <test@localhost>", "Description": "of the test"}
        self.write("package/DEBIAN/control", "".join(f"{key}: {value}\n" for key, value in fields.items() if value))
        (self.folder / folder).mkdir(parents=True, exist_ok=True)
        subprocess.run(["dpkg-deb", "--root-owner-group", "-Znone", "--build", self.folder / "package",
                        self.folder / folder], check=True, capture_output=True)
        return f"{name}_{version}_all.deb"


class MakeBundle(Packages):
    def bundled(self, base, needed):
        """Returns the names of the packages in a bundle. `base`: files of every system; `needed`: all that are used."""
        for name in ("make_bundle", "install_bundle"):
            (self.folder / "platform/debian").mkdir(parents=True, exist_ok=True)
            shutil.copy(DEBIAN / name, self.folder / "platform/debian")
        self.write("tests/support/debian_apt",
                   '#!/bin/sh\nmkdir -p "$1/cache/archives" && touch "$1/apt.conf"\n', 0o755)
        lines = "\n".join(f"echo \"'http://localhost/{name}' {name} 1 SHA256:0\"" for name in base)
        copies = " ".join(f'"{self.folder}/debian/{name}"' for name in needed)
        self.write("bin/apt-get", f"""#!/bin/sh
case " $* " in
  *' --print-uris '*) {lines} ;;
  *) cp {copies} "${{APT_CONFIG%/*}}/cache/archives" ;;
esac
""", 0o755)
        self.pack("made", "orbwatch", "1.2", "libgomp1")
        done = subprocess.run([self.folder / "platform/debian/make_bundle", self.folder / "made", "trixie", "amd64"],
                              env={**self.environment, "PATH": f"{self.folder}/bin:{os.environ['PATH']}"},
                              capture_output=True, check=False, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        with tarfile.open(self.folder / "made/orbwatch-trixie-amd64.tar") as bundle:
            return {pathlib.Path(name).name.split("_")[0] for name in bundle.getnames() if name.endswith(".deb")}

    def test_packages_of_every_system_are_in_it_with_others_of_their_source_only(self):
        base = [self.pack("debian", "gcc-12-base", "12.2", source="gcc-12"),
                self.pack("debian", "libgcc-s1", "12.2", "gcc-12-base (= 12.2)", "gcc-12 (12.2)"),
                self.pack("debian", "libc6", "2.36", source="glibc"),
                self.pack("debian", "udev", "252")]
        needed = [self.pack("debian", "libgomp1", "12.2", "gcc-12-base (= 12.2)", "gcc-12"),
                  self.pack("debian", "libmodbus5", "3.1", source="libmodbus")]
        self.assertEqual(self.bundled(base, base[:3] + needed),
                         {"orbwatch", "libmodbus5", "libgomp1", "gcc-12-base", "libgcc-s1"})


class InstallBundle(Packages):
    def setUp(self):
        super().setUp()
        (self.folder / "bundle/packages").mkdir(parents=True)
        shutil.copy(DEBIAN / "install_bundle", self.folder / "bundle/install")
        for name in ("state/lists/partial", "cache/archives/partial", "dpkg/updates", "dpkg/info", "sources"):
            (self.folder / name).mkdir(parents=True)
        self.environment |= {"APT_CONFIG": str(self.folder / "apt.conf"), "DPKG_ADMINDIR": str(self.folder / "dpkg")}
        self.write("dpkg/status", "")
        self.write("apt.conf", f"""Dir::State "{self.folder}/state";
Dir::State::status "{self.folder}/dpkg/status";
Dir::Cache "{self.folder}/cache";
#clear APT::Update::Post-Invoke;
#clear DPkg::Post-Invoke;
APT::Sandbox::User "";
""")
        # apt-get update has no simulation, and needs none here.
        self.write("bin/apt-get", """#!/bin/sh
case " $* " in *' install '*) set -- --simulate "$@" ;; esac
exec /usr/bin/apt-get "$@"
""", 0o755)
        self.environment["PATH"] = f"{self.folder}/bin:{os.environ['PATH']}"

    def have(self, *packages):
        """Lets packages of a version be installed: (name, version, dependencies)."""
        self.write("dpkg/status", "\n".join(
            f"Package: {name}\nStatus: install ok installed\nVersion: {version}\nArchitecture: all\n"
            "Maintainer: test <test@localhost>\nDescription: of the test\n" +
            (f"Depends: {depends}\n" if depends else "")
            for name, version, depends in packages))

    def bundle(self, *names, version="1.3"):
        self.pack("bundle/packages", "orbwatch", version)
        for name in names:
            self.pack("bundle/packages", f"orbwatch-camera-{name}", version, f"orbwatch (= {version})")

    def install(self, *names):
        """Returns exit status, steps of apt (Inst, Remv) and messages."""
        done = subprocess.run([self.folder / "bundle/install", *names], env=self.environment, capture_output=True,
                              check=False, text=True)
        steps = {tuple(line.split()[:2]) for line in done.stdout.splitlines() if line.startswith(("Inst ", "Remv "))}
        return done.returncode, steps, done.stderr

    def test_a_first_installation_has_no_further_package(self):
        self.bundle("genicam", "libcamera")
        self.assertEqual(self.install()[:2], (0, {("Inst", "orbwatch")}))

    def test_installed_packages_of_cameras_are_upgraded_with_it(self):
        self.bundle("genicam", "libcamera")
        self.have(("orbwatch", "1.2", ""), ("orbwatch-camera-genicam", "1.2", "orbwatch (= 1.2)"))
        self.assertEqual(self.install()[:2], (0, {("Inst", "orbwatch"), ("Inst", "orbwatch-camera-genicam")}))

    def test_a_package_that_the_bundle_lacks_is_named_and_nothing_is_changed(self):
        self.bundle("genicam")
        self.have(("orbwatch", "1.2", ""), ("orbwatch-camera-video", "1.2", "orbwatch (= 1.2)"))
        status, steps, messages = self.install()
        self.assertEqual((status, steps), (1, set()))
        self.assertIn("install: orbwatch-camera-video is installed, and this bundle lacks its version 1.3", messages)

    def test_a_package_that_the_bundle_lacks_stays_beside_orbwatch_of_its_version(self):
        self.bundle("genicam")
        self.have(("orbwatch", "1.3", ""), ("orbwatch-camera-video", "1.3", "orbwatch (= 1.3)"))
        self.assertEqual(self.install("orbwatch-camera-genicam")[:2], (0, {("Inst", "orbwatch-camera-genicam")}))

    def test_no_other_package_is_removed(self):
        self.bundle()
        self.have(("orbwatch", "1.2", ""), ("of-the-board", "1", "orbwatch (= 1.2)"))
        status, steps, messages = self.install()
        self.assertNotEqual(status, 0, steps)
        self.assertIn("remove", messages)

    def test_apt_upgrades_all_that_are_named_as_the_manual_says(self):
        self.bundle("genicam")
        self.have(("orbwatch", "1.2", ""), ("orbwatch-camera-genicam", "1.2", "orbwatch (= 1.2)"))
        (self.folder / "none").touch()
        done = subprocess.run(["apt-get", "install", "-y", "-o", f"Dir::Etc::sourcelist={self.folder}/none",
                               "-o", "Dir::Etc::sourceparts=-", "./orbwatch_1.3_all.deb",
                               "./orbwatch-camera-genicam_1.3_all.deb"], cwd=self.folder / "bundle/packages",
                              env=self.environment, capture_output=True, check=False, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("Remv ", done.stdout)


if __name__ == "__main__":
    unittest.main()
