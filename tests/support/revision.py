# SPDX-License-Identifier: Apache-2.0
"""The state of the checkout that a run tests."""

import hashlib
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent


def _git(root, *words):
    return subprocess.run(["git", *words], cwd=root, check=True, capture_output=True).stdout


def revision(root=ROOT):
    """The commit, 12 digits; with uncommitted changes also a hash of them, joined by "+"."""
    head = _git(root, "rev-parse", "--short=12", "HEAD").decode().strip()
    changes = hashlib.sha256(diff := _git(root, "diff", "--binary", "HEAD"))
    names = _git(root, "ls-files", "--others", "--exclude-standard", "-z").split(b"\0")[:-1]
    for name in names:
        file = pathlib.Path(root) / name.decode(errors="surrogateescape")
        changes.update(name + b"\0" + (file.read_bytes() if file.is_file() else b""))
    return f"{head}+{changes.hexdigest()[:8]}" if diff or names else head
