#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""An update that was built without the key is signed on another computer. RAUC's own check of such a bundle is in
tests/platform/image/run."""
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAYLOAD = bytes(range(256)) * 64
MANIFEST = (b"[update]\ncompatible=orbwatch-amd64\nversion=1.1\n\n[bundle]\nformat=verity\n"
            b"verity-hash=3e3797739a5e7924\nverity-size=4096\n")


def run(*command, **more):
    return subprocess.run([str(word) for word in command], capture_output=True, check=False, **more)


def openssl(*arguments, **more):
    return subprocess.run(["openssl", *[str(word) for word in arguments]], capture_output=True, check=True,
                          **more).stdout


class SignBundle(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="orbwatch-sign-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.key = self.make_key("builder")
        self.bundle = self.make_bundle("unsigned.raucb", MANIFEST)
        self.signed = self.folder / "signed.raucb"

    def make_key(self, name):
        made = run(ROOT / "platform/make-update-key", self.folder / name, name)
        self.assertEqual(made.returncode, 0, made.stderr)
        return self.folder / name / "update"

    def make_bundle(self, name, manifest):
        """A bundle as RAUC lays it out, signed by a key that is thrown away."""
        key = self.folder / "thrown_away"
        if not key.exists():
            openssl("req", "-x509", "-newkey", "rsa:2048", "-noenc", "-days", 1, "-subj", "/CN=not signed yet",
                    "-keyout", key, "-out", f"{key}.crt")
        message = openssl("cms", "-sign", "-binary", "-nodetach", "-outform", "DER", "-signer", f"{key}.crt",
                          "-inkey", key, input=manifest)
        bundle = self.folder / name
        bundle.write_bytes(PAYLOAD + message + len(message).to_bytes(8, "big"))
        return bundle

    def sign(self, bundle=None, key=None):
        key = key or self.key
        return run(ROOT / "platform/sign-bundle", bundle or self.bundle, "--key", f"{key}.key", "--cert",
                   f"{self.key}.crt", "-o", self.signed)

    def expect_refused(self, reason, result):
        self.assertEqual(result.returncode, 2)
        self.assertIn(reason, result.stderr.decode())
        self.assertFalse(self.signed.exists())

    def test_signed_bundle_has_the_contents_and_the_signature_of_the_key(self):
        done = self.sign()
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("version 1.1\nverity-hash 3e3797739a5e7924\n", done.stdout.decode())
        content = self.signed.read_bytes()
        self.assertEqual(content[:len(PAYLOAD)], PAYLOAD)
        length = int.from_bytes(content[-8:], "big")
        self.assertEqual(len(content), len(PAYLOAD) + length + 8)
        manifest = openssl("cms", "-verify", "-binary", "-inform", "DER", "-CAfile", f"{self.key}.crt",
                           input=content[len(PAYLOAD):-8])
        self.assertEqual(manifest, MANIFEST)

    def test_contents_are_printed_without_a_key(self):
        shown = run(ROOT / "platform/sign-bundle", self.bundle)
        self.assertEqual(shown.stdout.decode(),
                         "compatible orbwatch-amd64\nversion 1.1\nverity-hash 3e3797739a5e7924\n")

    def test_key_of_another_certificate_is_refused(self):
        self.expect_refused("is not the key of", self.sign(key=self.make_key("other")))

    def test_files_that_are_no_bundles_are_refused(self):
        whole = self.bundle.read_bytes()
        for content in (b"", b"text", whole[:-1], whole[:len(PAYLOAD)], whole[len(PAYLOAD):],
                        whole[:-8] + (2**62).to_bytes(8, "big")):
            file = self.folder / "wrong"
            file.write_bytes(content)
            self.expect_refused("not an update", self.sign(file))
        self.expect_refused("format verity", self.sign(self.make_bundle("plain", b"[update]\nversion=1\n")))

    def test_key_has_the_name_of_its_owner_or_is_not_made(self):
        for number, name in enumerate(("HUBER+SUHNER", "Müller GmbH", "A, B & C = D", "x" * 64)):
            certificate = f"{self.make_key_of(number, name)}.crt"
            subject = openssl("x509", "-in", certificate, "-noout", "-subject", "-nameopt", "multiline,utf8,-esc_msb")
            self.assertIn(f"organizationName          = {name}\n", subject.decode())
        refused = run(ROOT / "platform/make-update-key", self.folder / "long", "x" * 65)
        self.assertEqual(refused.returncode, 2)
        self.assertIn(b"65 characters", refused.stderr)
        self.assertFalse((self.folder / "long").exists())

    def make_key_of(self, number, name):
        folder = self.folder / str(number)
        made = run(ROOT / "platform/make-update-key", folder, name, env={**os.environ, "LC_ALL": "C.UTF-8"})
        self.assertEqual(made.returncode, 0, made.stderr)
        self.assertEqual(sorted(one.name for one in folder.iterdir()), ["update.crt", "update.key"])
        return folder / "update"

    def test_missing_openssl_is_named(self):
        programs = self.programs()
        needed = run("bash", ROOT / "platform/install_packages", "--list", "image").stdout.decode().split()
        self.assertIn("openssl", needed)
        refused = run(ROOT / "platform/sign-bundle", self.bundle, env={"PATH": programs})
        self.assertEqual((refused.returncode, refused.stderr), (2, b"sign-bundle: openssl is not installed\n"))

    def programs(self):
        """A folder with the programs of this computer, except openssl."""
        folder = self.folder / "programs"
        folder.mkdir()
        for name in ("bash", "cat", "dirname", "mkdir", "mktemp", "rm"):
            (folder / name).symlink_to(shutil.which(name))
        return folder

    def test_errors_of_openssl_are_shown_when_a_bundle_cannot_be_made(self):
        programs = self.programs()
        make = [ROOT / "platform/image/make_bundle", self.folder / "new.raucb", "tools", "amd64", "1",
                self.folder / "slot"]
        failed = run(*make, env={"PATH": programs})
        self.assertNotEqual(failed.returncode, 0)
        self.assertIn(b"openssl: command not found", failed.stderr)
        (programs / "openssl").write_text("#!/bin/sh\necho disk full >&2\nexit 1\n", encoding="utf-8")
        (programs / "openssl").chmod(0o755)
        self.assertEqual(run(*make, env={"PATH": programs}).stderr, b"disk full\n")

    def test_file_is_not_overwritten(self):
        self.signed.write_text("precious", encoding="utf-8")
        self.assertIn(b"exists", self.sign().stderr)
        self.assertEqual(self.signed.read_text(encoding="utf-8"), "precious")


if __name__ == "__main__":
    unittest.main()
