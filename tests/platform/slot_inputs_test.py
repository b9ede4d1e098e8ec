#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A slot of an image is made again when the builder's files differ in any way, not only in their contents, when
Debian's packages are newer, and with packages of the present commit. Relative paths in the options are those of the
caller's folder. Programs that need a chroot are replaced."""
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]


class SlotInputs(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="orbwatch-slot-")
        self.addCleanup(folder.cleanup)
        self.files = pathlib.Path(folder.name)
        (self.files / "etc").mkdir()
        (self.files / "etc/eth.network").write_text("[Match]\n", encoding="utf-8")
        (self.files / "etc/eth.network").chmod(0o644)

    def names(self):
        return subprocess.run(["bash", "-euc", 'source platform/image/slot.sh; names_in "$1"', "names", self.files],
                              cwd=ROOT, capture_output=True, check=True, text=True).stdout

    def test_any_difference_of_names_modes_and_links_counts(self):
        before = self.names()
        self.assertEqual(self.names(), before)
        changes = [
            lambda: (self.files / "etc/eth.network").rename(self.files / "etc/10-eth.network"),
            lambda: (self.files / "etc/10-eth.network").chmod(0o755),
            lambda: (self.files / "etc/x.service").symlink_to("/usr/lib/systemd/system/x.service"),
            lambda: os.replace(self.link_to("/dev/null"), self.files / "etc/x.service"),
            lambda: (self.files / "etc/empty folder").mkdir()]
        for change in changes:
            change()
            self.assertNotEqual(self.names(), before)
            before = self.names()

    def link_to(self, target):
        link = self.files / "new"
        link.symlink_to(target)
        return link


# Programs in place of those that make systems and packages: both have the contents of a file of the tree.
PROGRAMS = {
    "bin/unshare": """#!/bin/sh
[ ! -e build/fails ] || exit 1
echo built >>build/builds
cp app/program "$9/orbwatch_1.2_amd64.deb"
""",
    "platform/debian/unpack_source": "#!/bin/sh\nmkdir -p $1\n",
    "platform/debian/make_chroot": "#!/bin/sh\nmkdir $1\n",
    "platform/debian/needed_by": "#!/bin/sh\necho libc6\n",
    "platform/install_packages": "#!/bin/sh\n",
    "platform/image/make_root": "#!/bin/sh\n",
    "platform/image/make_efi": "#!/bin/sh\n",
    "platform/image/make_tools": "#!/bin/sh\nmkdir -p $1/var/lib/dpkg && cp build/debian $1/var/lib/dpkg/status\n",
    "platform/image/make_base": "#!/bin/sh\nmkdir -p $1/var/lib/dpkg && cp build/debian $1/var/lib/dpkg/status\n",
    "platform/image/make_slot": """#!/bin/sh
mkdir $1
cat $2/var/lib/dpkg/status $5/var/lib/dpkg/status >$1/root.img
""",
}
FILES = {"CMakeLists.txt": "project(orbwatch VERSION 1.2)\n", ".gitignore": "/build/\n", "app/program": "first\n",
         "platform/debian/control": "Source: orbwatch\n", "platform/image/system/etc/file": "\n"}
FIND = """source platform/image/slot.sh
suite=trixie architecture=amd64 packages="" && find_packages && cp "${files[0]}" build/found"""
MAKE = """source platform/image/slot.sh
suite=trixie architecture=amd64 packages=$PWD/build/packages version=1 consoles=tty0 key=""
certificate=- configuration=- more=- added=()
make_signed_slot"""


class Tree(unittest.TestCase):
    """A checkout with the scripts under test."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="orbwatch-slot-")
        self.addCleanup(folder.cleanup)
        self.tree = pathlib.Path(folder.name)
        copies = {name: (ROOT / name).read_text(encoding="utf-8").replace("((EUID == 0))", "true")
                  for name in ("platform/build-deb", "platform/build-image", "platform/build-bundle",
                               "platform/image/slot.sh", "tests/support/cached")}
        for name, text in {**copies, **FILES, **PROGRAMS}.items():
            self.write(name, text)
            (self.tree / name).chmod(0o755)
        (self.tree / "build").mkdir()
        self.environment = {name: value for name, value in os.environ.items() if not name.startswith("GIT_")}
        self.environment["PATH"] = f"{self.tree}/bin:{os.environ['PATH']}"
        self.git("init", "--quiet")
        self.commit()

    def write(self, name, text):
        (self.tree / name).parent.mkdir(parents=True, exist_ok=True)
        (self.tree / name).write_text(text, encoding="utf-8")

    def git(self, *words):
        subprocess.run(["git", "-c", "user.name=test", "-c", "user.email=test@localhost", *words], cwd=self.tree,
                       check=True, capture_output=True, env=self.environment)

    def commit(self):
        self.git("add", "--all")
        self.git("commit", "--quiet", "--allow-empty", "--message", "test")

    def run_script(self, script):
        return subprocess.run(["bash", "-euo", "pipefail", "-c", script, "build-image"], cwd=self.tree,
                              capture_output=True, check=False, text=True, env=self.environment)


class PackagesOfTheCommit(Tree):
    def find(self):
        """Returns the content of the package that an image takes, and the number of builds until then."""
        done = self.run_script(FIND)
        self.assertEqual(done.returncode, 0, done.stderr)
        builds = (self.tree / "build/builds").read_text(encoding="utf-8")
        return (self.tree / "build/found").read_text(encoding="utf-8"), builds.count("built")

    def test_packages_are_built_once_for_each_commit(self):
        self.assertEqual(self.find(), ("first\n", 1))
        self.assertEqual(self.find(), ("first\n", 1))
        self.write("app/program", "second\n")
        self.commit()
        self.assertEqual(self.find(), ("second\n", 2))
        self.assertEqual(self.find(), ("second\n", 2))

    def test_packages_of_changed_files_are_built_each_time(self):
        self.find()
        self.write("app/program", "changed\n")
        self.assertEqual(self.find(), ("changed\n", 2))
        self.write("app/program", "again\n")
        self.assertEqual(self.find(), ("again\n", 3))
        self.git("checkout", "--quiet", "app/program")
        self.assertEqual(self.find(), ("first\n", 4))
        self.write("app/new", "untracked\n")
        self.assertEqual(self.find(), ("first\n", 5))

    def test_files_that_no_package_has_are_no_change(self):
        self.find()
        self.write("machine/site.toml", "")
        self.write("orbwatch.img", "")
        self.assertEqual(self.find(), ("first\n", 1))

    def test_packages_of_a_failed_build_are_not_taken(self):
        self.find()
        self.write("app/program", "second\n")
        self.commit()
        self.write("build/fails", "")
        self.assertNotEqual(self.run_script(FIND).returncode, 0)
        self.assertFalse((self.tree / "build/deb/trixie-amd64/commit").exists())
        self.assertNotEqual(self.run_script(FIND).returncode, 0)
        (self.tree / "build/fails").unlink()
        self.assertEqual(self.find(), ("second\n", 2))

    def test_changes_are_looked_for_in_the_files_that_are_packaged(self):
        packaged = "CMakeLists.txt LICENSE README.md app hal platform proc"
        for script in ("platform/build-deb", "platform/debian/unpack_source"):
            self.assertTrue(packaged in (ROOT / script).read_text(encoding="utf-8"), script)


class SystemsOfDebian(Tree):
    def make(self):
        done = self.run_script(MAKE)
        self.assertEqual(done.returncode, 0, done.stderr)
        return (self.tree / "build/image/trixie-amd64-1/root.img").read_text(encoding="utf-8")

    def test_slot_is_made_again_of_newer_systems(self):
        self.write("build/packages/orbwatch_1.2_amd64.deb", "")
        self.write("build/debian", "older ")
        self.assertEqual(self.make(), "older older ")
        self.write("build/debian", "newer ")
        self.assertEqual(self.make(), "older older ", "nothing was deleted")
        shutil.rmtree(self.tree / "build/chroots/image-trixie-amd64")
        (self.tree / "build/chroots/image-trixie-amd64.made-from").unlink()
        self.assertEqual(self.make(), "older newer ")
        for entry in (self.tree / "build/chroots").glob("image-*"):
            shutil.rmtree(entry) if entry.is_dir() else entry.unlink()
        self.assertEqual(self.make(), "newer newer ")


class OptionsFromAnotherFolder(Tree):
    def build(self, script, *more):
        """Returns what a build, called in another folder by relative paths, passed on, and that folder."""
        folder = tempfile.TemporaryDirectory(prefix="orbwatch-caller-")
        self.addCleanup(folder.cleanup)
        caller = pathlib.Path(folder.name).resolve()
        for name in ("site/site.toml", "files/etc/file", "packages/orbwatch_1.2_amd64.deb", "cert.pem", "key.pem"):
            (caller / name).parent.mkdir(parents=True, exist_ok=True)
            (caller / name).touch()
        self.write("build/debian", "")
        self.write("platform/image/make_slot", '#!/bin/sh\nmkdir $1\necho "$@" >build/options\n')
        for program in ("make_disk", "make_bundle"):
            self.write(f"platform/image/{program}", '#!/bin/sh\necho "$@" >>build/options\ntouch "$1"\n')
            (self.tree / "platform/image" / program).chmod(0o755)
        self.write("platform/sign-bundle", "#!/bin/sh\n")
        (self.tree / "platform/sign-bundle").chmod(0o755)
        done = subprocess.run(
            [os.path.relpath(self.tree / script, caller), "--suite", "trixie", "--arch", "amd64", "--version", "1",
             "--packages", "packages", "--configuration", "site", "--files", "files", "--cert", "cert.pem", *more],
            cwd=caller, capture_output=True, check=False, text=True, env=self.environment)
        self.assertEqual(done.returncode, 0, done.stderr)
        return (self.tree / "build/options").read_text(encoding="utf-8").split(), caller

    def test_an_image_takes_and_leaves_files_of_the_callers_folder(self):
        options, caller = self.build("platform/build-image", "-o", "orbwatch.img")
        for name in ("cert.pem", "site", "files", "packages/orbwatch_1.2_amd64.deb", "orbwatch.img"):
            self.assertIn(str(caller / name), options)
        self.assertTrue((caller / "orbwatch.img").exists())

    def test_an_update_takes_and_leaves_files_of_the_callers_folder(self):
        options, caller = self.build("platform/build-bundle", "--key", "key.pem", "-o", "update.raucb")
        for name in ("cert.pem", "key.pem", "site", "files", "packages/orbwatch_1.2_amd64.deb", "update.raucb"):
            self.assertIn(str(caller / name), options)
        self.assertTrue((caller / "update.raucb").exists())


if __name__ == "__main__":
    unittest.main()
