"""Every command of README.md works as it is printed there."""

import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from program import BUILD, PROGRAM, SOURCE

README = (SOURCE / "README.md").read_text(encoding="utf-8")


def blocks(language):
    return re.findall(rf"^```{language}\n(.*?)^```$", README, re.MULTILINE | re.DOTALL)


def commands():
    return [line for block in blocks("sh") for line in block.splitlines() if line.strip()]


def as_run_here(command):
    """The command for the build that is being tested; None where there is no way to run it.

    The scripts get the preset of this build, and script/test lists the tests instead of running them, this one among them.
    """
    preset = BUILD.name if BUILD.parent == SOURCE / "build" else None
    if command in ("script/demo", "script/test"):
        if preset is None:
            return None
        return f"{SOURCE}/{command} {preset}" + (" --show-only" if command == "script/test" else "")
    if command.startswith("clearloci view"):
        return f"timeout 6 {command} | head -n 3"  # it serves until it is ended
    return command.replace("build/release", str(BUILD))


class Readme(unittest.TestCase):
    def test_it_shows_what_a_newcomer_needs(self):
        self.assertIn("script/demo", commands())
        self.assertIn("script/test", commands())
        first_screen = README[:2500]
        self.assertIn("docs/images/five_bar_loci.png", first_screen)
        self.assertIn("script/demo", first_screen)

    def test_local_links_lead_somewhere(self):
        for target in re.findall(r"\]\(([^)]+)\)", README):
            if not target.startswith("http"):
                self.assertTrue((SOURCE / target).exists(), target)

    def test_every_command_works(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            shutil.copytree(SOURCE / "examples", folder / "examples")
            for block in blocks("yaml"):
                title = re.match(r"# (\S+\.yaml)\n", block)
                self.assertIsNotNone(title, "a file in the README opens with its name")
                (folder / title[1]).write_text(block, encoding="utf-8")
            environment = os.environ | {"PATH": f"{PROGRAM.parent}:{os.environ['PATH']}", "HOME": name}
            for command in commands():
                words = as_run_here(command)
                if words is None:
                    print(f"left out in this build folder: {command}")
                    continue
                with self.subTest(command):
                    process = subprocess.run(
                        words, shell=True, cwd=folder, env=environment, capture_output=True, text=True
                    )
                    self.assertEqual(process.returncode, 0, f"{words}\n{process.stdout}\n{process.stderr}")
                    self.assertTrue(process.stdout.strip(), f"{words} says something")


if __name__ == "__main__":
    unittest.main()
