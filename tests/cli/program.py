"""Runs the built program as its user does."""

import os
import pathlib
import subprocess
import tempfile
import unittest

PROGRAM = pathlib.Path(os.environ["CLEARLOCI_PROGRAM"])
SOURCE = pathlib.Path(os.environ["CLEARLOCI_SOURCE_DIR"])
BUILD = pathlib.Path(os.environ["CLEARLOCI_BUILD_DIR"])
FIVE_BAR = SOURCE / "examples" / "five_bar.yaml"
FOUR_BAR = SOURCE / "examples" / "four_bar.yaml"
PICK_AND_PLACE = [SOURCE / "examples" / "pick_and_place" / name for name in ("manipulator.yaml", "path.yaml")]


def page(name):
    """The text of a page of the documentation, whichever folder of docs/ it is in."""
    (found,) = SOURCE.glob(f"docs/*/{name}")
    return found.read_text(encoding="utf-8")


def run(*words, cwd):
    return subprocess.run([PROGRAM, *map(str, words)], cwd=cwd, capture_output=True, text=True)


class InOwnFolder(unittest.TestCase):
    """Every test runs in an empty folder, so that default output folders are its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_program(self, *words, status=0):
        """The finished process; a test fails where its exit status is another."""
        process = run(*words, cwd=self.folder)
        self.assertEqual(process.returncode, status, f"{words}\n{process.stdout}\n{process.stderr}")
        return process

    def written_twice(self, *words, but_for=lambda name, data: data):
        """The names of the files that a command writes, sorted, and what it printed; `first` has them. A test fails where
        a second run writes other bytes, but for what `but_for` leaves out."""
        folders = [self.folder / name for name in ("first", "second")]
        process = [self.run_program(*words, "-o", folder) for folder in folders][0]
        names, again = (sorted(path.name for path in folder.iterdir()) for folder in folders)
        self.assertEqual(names, again)
        for name in names:
            first, second = (but_for(name, (folder / name).read_bytes()) for folder in folders)
            self.assertEqual(first, second, name)
        return names, process.stdout

    def model(self, change=lambda text: text, name="model.yaml"):
        """The five-bar's file, changed, in the test's folder."""
        path = self.folder / name
        text = change(FIVE_BAR.read_text(encoding="utf-8"))
        path.write_text(text, encoding="utf-8")
        return path
