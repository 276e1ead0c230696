"""Every file and command of docs/tutorial/tutorial.md works as it is printed there."""

import pathlib
import re
import shlex
import subprocess
import tempfile
import unittest

from program import PROGRAM, SOURCE, page

TUTORIAL = page("tutorial.md")


def blocks(language):
    return re.findall(rf"^```{language}\n(.*?)^```$", TUTORIAL, re.MULTILINE | re.DOTALL)


class Tutorial(unittest.TestCase):
    def test_local_links_lead_somewhere(self):
        for target in re.findall(r"\]\(([^)]+)\)", TUTORIAL):
            self.assertTrue((SOURCE / "docs" / "tutorial" / target.partition("#")[0]).exists(), target)

    def test_every_command_ends_as_it_says(self):
        printed = {}
        with tempfile.TemporaryDirectory() as name:
            for block in blocks("yaml"):
                title = re.match(r"# (\S+\.yaml)\n", block)
                self.assertIsNotNone(title, "a file opens with its name")
                (pathlib.Path(name) / title[1]).write_text(block, encoding="utf-8")
            for line in "".join(blocks("sh")).splitlines():
                command, _, remark = line.partition("#")
                status = re.match(r" exit status (\d+)", remark)
                words = shlex.split(command)
                self.assertEqual(words[0], "clearloci")
                with self.subTest(line):
                    process = subprocess.run(
                        [PROGRAM, *words[1:]], cwd=name, capture_output=True, text=True, timeout=300
                    )
                    self.assertEqual(process.returncode, int(status[1]) if status else 0, process.stdout + process.stderr)
                    printed[command.strip()] = process.stdout
        first = printed["clearloci pose press.yaml --at x=60,y=250"]
        self.assertIn("dx [mm]", first)
        self.assertIn("H7/g6 at 12 mm: a radial clearance of 3 to 17.5 µm", first)
        self.assertIn("link BP parallel to the load", printed["clearloci loci press.yaml"])
        self.assertIn("VERIFIED", printed["clearloci verify press.yaml out/moved/moved.yaml"])
        self.assertIn("VERIFIED", printed["clearloci verify press.yaml moved.yaml"])
        self.assertIn("REFUTED", printed["clearloci verify press.yaml task.yaml"])


if __name__ == "__main__":
    unittest.main()
