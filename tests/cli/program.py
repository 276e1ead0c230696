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

    def model(self, change=lambda text: text, name="model.yaml"):
        """The five-bar's file, changed, in the test's folder."""
        path = self.folder / name
        text = change(FIVE_BAR.read_text(encoding="utf-8"))
        path.write_text(text, encoding="utf-8")
        return path
