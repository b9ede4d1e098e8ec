# SPDX-License-Identifier: Apache-2.0
"""runs.py: the runs it keeps and the rows it reports; revision.py: the state that names them."""
import datetime
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
import costs  # noqa: E402
import runs  # noqa: E402
from revision import revision  # noqa: E402

DAY = datetime.datetime(2026, 1, 1, tzinfo=datetime.timezone.utc)
STAGES = """| stage | s | CPU s | result |
|---|---|---|---|
| release-build | 9 | {} | passed |
| **together** | 9 | {} | |
"""


class Keep(unittest.TestCase):
    def test_keeps_the_newest_twenty(self):
        with tempfile.TemporaryDirectory() as place:
            folder, source = Path(place) / "runs", Path(place) / "stages.md"
            source.write_text("table")
            (Path(place) / "runs").mkdir()
            (folder / "note.md").write_text("not a run")
            for hour in range(23):
                # Commits are not in chronological order.
                runs.keep(source, folder, f"{99 - hour:012}", DAY + datetime.timedelta(hours=hour))
            kept = runs.runs(folder)
            self.assertEqual(len(kept), 20)
            self.assertEqual(kept[0].name, "000000000096-20260101T030000Z.md")
            self.assertEqual(kept[-1].name, "000000000077-20260101T220000Z.md")
            self.assertEqual(kept[-1].read_text(), "table")
            self.assertTrue((folder / "note.md").exists())
            self.assertEqual(runs.chosen("00000000008", folder).name, kept[16].name)
            with self.assertRaises(SystemExit):
                runs.chosen("1", folder)


class Compare(unittest.TestCase):
    def test_reads_the_column_by_its_name(self):
        self.assertEqual(runs.seconds_of(STAGES.format(7, 8)),
                         {("", "release-build"): 7, ("", "together"): 8})

    def test_reads_the_tables_of_costs(self):
        lines = costs.table("x: CPU seconds per target", [costs.Cost("a", "a.o", 3)], 6, "job", "jobs")
        self.assertEqual(runs.seconds_of("\n".join(lines)), {("x: CPU seconds per target", "a"): 6})

    def test_tables_that_are_not_whole_are_no_error(self):
        for text in ("", "|\n", "| CPU s |\n|---|\n| 3 |\n", "| a | CPU s |\n|---|---|\n| b |\n| c | x |\n",
                     "| a | b |\n|---|---|\n| c | 3 |\n"):
            self.assertEqual(runs.seconds_of(text), {}, text)

    def test_names_what_is_dearer_by_more_than_a_tenth(self):
        before = {("", "same"): 100, ("", "tenth"): 100, ("", "more"): 100, ("", "tiny"): 0.5,
                  ("", "gone"): 10}
        after = {("", "same"): 100, ("", "tenth"): 110, ("", "more"): 111, ("", "tiny"): 0.9,
                 ("", "new"): 20}
        self.assertEqual([row[1] for row in runs.dearer(before, after)], ["new", "more"])
        text = "\n".join(runs.comparison(before, after))
        self.assertIn("|  | more | 100.0 | 111.0 | +11 % |", text)
        self.assertIn("|  | new |  | 20.0 | new |", text)

    def test_says_so_when_nothing_is(self):
        self.assertEqual(runs.comparison({("", "a"): 9}, {("", "a"): 5}),
                         ["Nothing costs more than 10 % more."])


class Revision(unittest.TestCase):
    def test_changes_with_what_is_not_committed(self):
        with tempfile.TemporaryDirectory() as root:
            def git(*words):
                subprocess.run(["git", "-c", "user.name=a", "-c", "user.email=a@b", *words], cwd=root,
                               check=True, capture_output=True)
            git("init")
            file = Path(root) / "file"
            file.write_text("1")
            git("add", ".")
            git("commit", "-m", "first")
            clean = revision(root)
            self.assertRegex(clean, r"^[0-9a-f]{12}$")
            file.write_text("2")
            changed = revision(root)
            self.assertRegex(changed, rf"^{clean}\+[0-9a-f]{{8}}$")
            (Path(root) / "new").write_text("a")
            other = revision(root)
            (Path(root) / "new").write_text("b")
            self.assertEqual(len({clean, changed, other, revision(root)}), 4)
            git("checkout", "file")
            (Path(root) / "new").unlink()
            self.assertEqual(revision(root), clean)
