#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Access to the configuration in the root of an image, which is made of a few files, with a program in place of those
that enter it."""
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
GROUP = 900 if os.geteuid() == 0 else os.getgid()
ENTER = """#!/bin/sh
root=$1
shift
case "$*" in
  *" -- env "*dpkg*) mkdir "$root/packages" ;;
  "-- chgrp -R orbwatch "*) chgrp -R "$GROUP" "$root$5" ;;
  "-- dpkg --print-architecture") echo amd64 ;;
  "-- systemd-sysusers -") cat >/dev/null ;;
esac
"""
DEMO = "usr/share/orbwatch/demo"
BASE = {f"{DEMO}/site.toml": '# address = "0.0.0.0" of all\n', f"{DEMO}/recipes/demo.toml": "",
        "etc/orbwatch/old.toml": "", "etc/shadow": "", "usr/lib/os-release": "", "boot/vmlinuz-6.12": "",
        "usr/lib/modules/6.12/modules.dep": "", "var/lib/dpkg/status": ""}


class MakeRoot(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="orbwatch-root-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        for script in ("platform/image/make_root", "tests/support/enter_root"):
            (self.folder / script).parent.mkdir(parents=True)
            shutil.copy(ROOT / script, self.folder / script)
        shutil.copytree(ROOT / "platform/image/system", self.folder / "platform/image/system")
        (self.folder / "tests/support/enter_root").write_text(ENTER, encoding="utf-8")
        for name, text in BASE.items():
            self.write(f"base/{name}", text)
        self.write("orbwatch.deb", "")
        self.made = self.folder / "root"

    def write(self, name, text, mode=0o644):
        (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
        (self.folder / name).write_text(text, encoding="utf-8")
        (self.folder / name).chmod(mode)

    def make(self, configuration="-"):
        done = subprocess.run([self.folder / "platform/image/make_root", self.made, self.folder / "base", "0", "1", "-",
                               configuration, "-", self.folder / "orbwatch.deb"], capture_output=True, text=True,
                              check=False, umask=0o027, env={**os.environ, "GROUP": str(GROUP)})
        self.assertEqual(done.returncode, 0, done.stderr)

    def access(self, name):
        status = (self.made / name).stat()
        return oct(status.st_mode & 0o7777), status.st_gid

    def test_service_may_write_every_folder_of_the_configuration(self):
        self.write("machine/site.toml", "", 0o664)
        self.write("machine/recipes/parts/one.toml", "")
        (self.folder / "machine/recipes/parts").chmod(0o700)
        self.make(self.folder / "machine")
        for folder in ("etc/orbwatch", "etc/orbwatch/recipes", "etc/orbwatch/recipes/parts"):
            self.assertEqual(self.access(folder), ("0o2775", GROUP), folder)
        for file in ("site.toml", "recipes/parts/one.toml"):
            self.assertEqual(self.access(f"etc/orbwatch/{file}"), ("0o644", GROUP), file)
        self.assertEqual(self.access(f"{DEMO}/recipes/parts")[0], "0o755")
        self.assertFalse((self.made / "etc/orbwatch/old.toml").exists())

    def test_key_is_readable_for_the_service_only(self):
        self.write("machine/site.toml", "")
        self.write("machine/tls/page.key", "secret", 0o600)
        self.make(self.folder / "machine")
        for folder in ("etc/orbwatch", DEMO):
            self.assertEqual(self.access(f"{folder}/tls/page.key"), ("0o640", GROUP))

    def test_demo_is_the_configuration_without_another(self):
        self.make()
        self.assertEqual((self.made / "etc/orbwatch/site.toml").read_text(encoding="utf-8"), 'address = "0.0.0.0"\n')
        self.assertEqual(self.access("etc/orbwatch/recipes"), ("0o2775", GROUP))
        self.assertEqual(self.access("etc/orbwatch/site.toml")[0], "0o644")


if __name__ == "__main__":
    unittest.main()
