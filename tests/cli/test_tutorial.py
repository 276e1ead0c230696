"""Every file and command of the tutorial, and of the guides that are made like it, works as it is printed there."""

import pathlib
import re
import shlex
import shutil
import subprocess
import tempfile
import unittest

from program import PROGRAM, SOURCE, page


def blocks(text, language):
    return re.findall(rf"^```{language}\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)


class Pages(unittest.TestCase):
    def outputs(self, text):
        """Of every command what it prints, in a folder with the page's files and the examples."""
        printed = {}
        with tempfile.TemporaryDirectory() as name:
            shutil.copytree(SOURCE / "examples", pathlib.Path(name) / "examples")
            for block in blocks(text, "yaml"):
                title = re.match(r"# (\S+\.yaml)\n", block)
                self.assertIsNotNone(title, "a file opens with its name")
                (pathlib.Path(name) / title[1]).write_text(block, encoding="utf-8")
            for line in "".join(blocks(text, "sh")).splitlines():
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
        self.assertTrue(printed)
        return printed

    def test_tutorial(self):
        printed = self.outputs(page("tutorial.md"))
        first = printed["clearloci pose press.yaml --at x=60,y=250"]
        self.assertIn("dx [mm]", first)
        self.assertIn("H7/g6 at 12 mm: a radial clearance of 3 to 17.5 µm", first)
        self.assertIn("link BP parallel to the load", printed["clearloci loci press.yaml"])
        self.assertIn("VERIFIED", printed["clearloci verify press.yaml out/moved/moved.yaml"])
        self.assertIn("VERIFIED", printed["clearloci verify press.yaml moved.yaml"])
        self.assertIn("REFUTED", printed["clearloci verify press.yaml task.yaml"])

    def test_placing_a_task(self):
        text = page("place-a-task.md")
        printed = self.outputs(text)
        answers = "\n".join(printed.values())
        shown = [line for block in blocks(text, "text") for line in block.splitlines()]
        self.assertGreater(len(shown), 4)
        for line in shown:  # an answer is cut where it says ..., and columns may be wider apart
            words = r"\s+".join(re.escape(word) for word in line.removesuffix("...").split())
            self.assertRegex(answers, words)

        def numbers(change, what):
            command = f"clearloci verify examples/five_bar.yaml weld.yaml {change}"
            line = re.search(rf"^{what}.*$", next(printed[c] for c in printed if c.startswith(command)), re.MULTILINE)
            return [float(word) for word in re.findall(r"-?\d+\.\d+", line[0])]

        # What the table of changes says of each.
        for change, what, expected in (("--fit nearest", "moved by", [0.055, -0.094]), ("--fit best", "moved by", [-0.250, -0.279]),
                                       ("--fit best", "margin", [0.146]), ("--fit largest", "scaled by", [0.219]),
                                       ("--working-mode right,right", "margin", [0.126])):
            for known, found in zip(expected, numbers(change, what), strict=True):
                self.assertIn(f"{known:.3f}", text)
                self.assertAlmostEqual(found, known, delta=6e-4, msg=change)

    def test_export_to_cad(self):
        text = page("export-to-cad.md")
        printed = self.outputs(text)
        written = " ".join(" ".join(answer.splitlines()[-1:]) for answer in printed.values())
        for file in ("loci.dxf", "loci-r12.dxf", "zones.geojson", "zones.svg", "loci-s1-contact-loss.stl", "loci.obj", "loci.vtp", "zones-z1.stl"):
            self.assertIn(file, written)


if __name__ == "__main__":
    unittest.main()
