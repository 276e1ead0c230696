"""Every command of README.md, and of the pages that go on from it, works as it is printed there."""

import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from program import BUILD, PROGRAM, SOURCE, page

README = (SOURCE / "README.md").read_text(encoding="utf-8")


def blocks(text, language):
    return re.findall(rf"^```{language}\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)


def commands(text):
    return [line for block in blocks(text, "sh") for line in block.splitlines() if line.strip()]


def as_run_here(command):
    """The command for the build that is being tested; None where there is no way to run it.

    The scripts get the preset of this build.
    """
    if command.startswith("script/"):
        return f"{SOURCE}/{command} {BUILD.name}" if BUILD.parent == SOURCE / "build" else None
    if command.startswith("clearloci view"):
        return f"timeout 6 {command} | head -n 3"  # it serves until it is ended
    return command


def demo_build(folder):
    """A build folder as script/demo leaves it: configured without what only tests need, with the files that the program is
    made of and no others. Those are taken from the build that is being tested. pybind11 may be there: the rules that
    install the module then are, without the module."""
    absent = ("GTest", "rapidcheck", "benchmark", "MPI")
    subprocess.run(
        ["cmake", "-G", "Ninja", "-S", SOURCE, "-B", folder, "-DCMAKE_BUILD_TYPE=Release", "-DCLEARLOCI_BUILD_TESTS=OFF"]
        + [f"-DCMAKE_DISABLE_FIND_PACKAGE_{name}=ON" for name in absent],
        check=True, capture_output=True,
    )
    for target in ("clearloci", "cli/clearloci"):
        inputs = subprocess.run(["ninja", "-C", folder, "-t", "inputs", target], check=True, capture_output=True, text=True)
        for name in [*inputs.stdout.split("\n"), target]:
            made = BUILD / name
            if name and not name.startswith("/") and made.is_file() and not (folder / name).exists():
                (folder / name).parent.mkdir(parents=True, exist_ok=True)
                os.link(made, folder / name) if made.stat().st_dev == folder.stat().st_dev else shutil.copy2(made, folder / name)


class Shell:
    """A shell that is open from command to command: what one exports the next ones see."""

    def __init__(self, folder):
        self.folder = folder
        self.environment = os.environ | {"HOME": str(folder), "PATH": os.environ["PATH"]}

    def run(self, command):
        kept = self.folder / ".environment"
        process = subprocess.run(
            ["sh", "-c", f"{command}\nstatus=$?; env -0 >'{kept}'; exit $status"],
            cwd=self.folder, env=self.environment, capture_output=True, text=True,
        )
        if kept.exists():
            pairs = kept.read_text(encoding="utf-8").split("\0")
            self.environment = dict(pair.split("=", 1) for pair in pairs if "=" in pair)
        return process


class Readme(unittest.TestCase):
    def test_it_shows_what_a_newcomer_needs(self):
        self.assertEqual(commands(README)[0], "script/demo")
        self.assertLessEqual(README.count("\n"), 200)
        first_screen = README[:2500]
        self.assertIn("docs/images/five_bar_loci.png", first_screen)
        self.assertIn("script/demo", first_screen)

    def test_local_links_lead_somewhere(self):
        for target in re.findall(r"\]\(([^)]+)\)", README):
            if not target.startswith("http"):
                self.assertTrue((SOURCE / target).exists(), target)

    def run_page(self, text, shell):
        folder = shell.folder
        for block in blocks(text, "yaml"):
            title = re.match(r"# (\S+\.yaml)\n", block)
            self.assertIsNotNone(title, "a file opens with its name")
            (folder / title[1]).write_text(block, encoding="utf-8")
        for command in commands(text):
            words = as_run_here(command)
            if words is None:
                print(f"left out in this build folder: {command}")
                continue
            with self.subTest(command):
                process = shell.run(words)
                self.assertEqual(process.returncode, 0, f"{words}\n{process.stdout}\n{process.stderr}")
                if not command.startswith("export "):
                    self.assertTrue(process.stdout.strip(), f"{words} says something")

    def test_every_command_works(self):
        """In their order, in a clone in which nothing but script/demo has run, and in a home without anything."""
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            shutil.copytree(SOURCE / "examples", folder / "examples")
            demo_build(folder / "build" / "release")
            self.run_page(README, Shell(folder))
            installed = folder / ".local" / "bin" / "clearloci"
            self.assertTrue(subprocess.run([installed, "--version"], check=True, capture_output=True).stdout)

    def test_every_command_of_the_next_pages_works(self):
        for name in ("commands.md", "task-files.md"):
            with tempfile.TemporaryDirectory() as place:
                folder = pathlib.Path(place)
                shutil.copytree(SOURCE / "examples", folder / "examples")
                shell = Shell(folder)
                shell.environment["PATH"] = f"{PROGRAM.parent}:{shell.environment['PATH']}"
                self.run_page(page(name), shell)


class Bootstrap(unittest.TestCase):
    def packages(self, *words):
        answer = subprocess.run([SOURCE / "script/bootstrap", *words, "--list"], check=True, capture_output=True, text=True)
        return set(answer.stdout.split())

    def test_the_program_needs_no_package_of_the_tests(self):
        program = self.packages()
        self.assertIn("libginac-dev", program)
        for word in ("pytest", "gtest", "gmock", "rapidcheck", "benchmark", "chromium", "matplotlib", "ezdxf", "jsonschema",
                     "python", "pybind", "mpi-", "clang", "doxygen"):
            self.assertFalse([package for package in program if word in package], word)
        python, tests = self.packages("--python"), self.packages("--tests")
        self.assertLess(program, python)
        self.assertLess(python | self.packages("--cluster"), tests)
        self.assertLess(tests, self.packages("--checks"))

    def test_words_that_it_does_not_know_are_refused(self):
        answer = subprocess.run([SOURCE / "script/bootstrap", "--tset"], capture_output=True, text=True)
        self.assertEqual(answer.returncode, 2)
        self.assertIn("--tests", answer.stderr)


if __name__ == "__main__":
    unittest.main()
