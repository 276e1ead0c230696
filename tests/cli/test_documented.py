"""Every example of docs/reference/mechanism-file.md runs, and so do the commands that other pages show."""

import json
import re
import shlex
import unittest

from program import FOUR_BAR, SOURCE, InOwnFolder, page, run

TEXT = page("mechanism-file.md")


def sections(text):
    """The top-level keys of a YAML text in order, each with its lines."""
    found = {}
    for line in text.splitlines():
        if re.match(r"\w", line):
            key = line.split(":")[0]
            found[key] = []
        if line.startswith("    ") and len(found[key]) > 1:
            found[key][-1] += "\n" + line  # of the entry before
        elif found:
            found[key].append(line)
    return found


def changed(base, snippet):
    """`base` with the joints, points and frames of the snippet in place of its own or added, and with its other sections."""
    result, more = sections(base), sections(snippet)
    for section in ("joints", "points", "frames"):
        for entry in more.pop(section, [])[1:]:
            name = entry.split(":")[0]
            own = result[section]
            if any(line.split(":")[0] == name for line in own):
                result[section] = [entry if line.split(":")[0] == name else line for line in own]
            else:
                own.append(entry)
    result.update(more)
    return "\n".join(line for lines in result.values() for line in lines) + "\n"


# A pose within reach, by the file that an example changes.
POSES = {"examples/five_bar.yaml": "0.2,-0.6", "examples/gough_stewart_poses.yaml": "0,0,0.5,0,0,0",
         "examples/stephenson_outside.yaml": "123 deg", "examples/geared_five_bar.yaml": "20 deg", None: "0.05,0.02"}


class Documented(InOwnFolder):
    def test_examples_run(self):
        blocks = re.findall(r"^```yaml\n(.*?)^```$", TEXT, re.MULTILINE | re.DOTALL)
        self.assertGreaterEqual(len(blocks), 10)
        for number, block in enumerate(blocks):
            with self.subTest(block):
                named = re.match(r"# with (examples/\S+)\n", block)
                whole = block.startswith("format: 1\n")
                # What is a comment alone goes before any file.
                comment = not sections(block)
                self.assertTrue(named or whole or comment, "says which file it changes, or is one")
                base = None if whole else named[1] if named else "examples/five_bar.yaml"
                text = block
                if base is not None:
                    own = (SOURCE / base).read_text(encoding="utf-8")
                    text = block + own if comment else changed(own, block)
                model = self.folder / f"model{number}.yaml"
                model.write_text(text, encoding="utf-8")
                self.run_program("pose", model, "--at", POSES[base])
                if base != "examples/gough_stewart_poses.yaml":  # loci take three coordinates at most
                    process = run("loci", model, "--quiet", "-o", f"out{number}", cwd=self.folder)
                    self.assertIn(process.returncode, (0, 3), process.stderr)  # 3: some places of the loci are open

    def test_drawings_are_constructed(self):
        text = page("drawn-form.md")
        drawings = re.findall(r"^```yaml\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
        self.assertEqual(len(drawings), 8)
        for number, drawing in enumerate(drawings):
            with self.subTest(drawing.splitlines()[0]):
                model = self.folder / f"drawing{number}.yaml"
                model.write_text(drawing, encoding="utf-8")
                own = self.folder / f"own{number}.yaml"
                self.run_program("normalize", model, "-o", own)
                self.assertNotIn("drawn:", own.read_text(encoding="utf-8"))
                for one in (model, own):
                    self.run_program("loci", one, "--quiet", "-o", f"{one.stem}_out")
                if number == 0:
                    blocks = re.findall(r"^```(\w*)\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
                    printed = next(block for language, block in blocks if not language)
                    for line in printed.splitlines():
                        self.assertIn(line + "\n", own.read_text(encoding="utf-8"))

    def test_commands_of_other_pages_run(self):
        for name in ("certificates.md", "preload.md", "studies.md"):
            text = page(name)
            blocks = re.findall(r"^```sh\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
            commands = [line for block in blocks for line in block.splitlines() if line.startswith("clearloci ")]
            self.assertTrue(commands, name)
            for command in commands:
                with self.subTest(command):
                    words = [str(SOURCE / word) if word.startswith("examples/") else word for word in shlex.split(command)]
                    self.run_program(*words[1:])

    def test_torsion_springs_are_known_to_every_command(self):
        model = self.model(lambda text: text.replace("x: [-0.5, 1.0]", "x: [0.1, 0.6]")
                           .replace("y: [-1.0, 1.0]", "y: [-0.9, -0.3]")
                           + "springs: [{name: T, joint: A1, stiffness: 20, rest: 150 deg}]\n")
        self.run_program("pose", model, "--at", "0.2,-0.6", "--iterate")
        self.run_program("error", model, "--grid", "20x20", "--quiet")
        self.assertIn("aT = atan2(", self.run_program("equations", model).stdout)
        loci = json.loads(self.run_program("loci", model, "--json", "--quiet").stdout)
        backlash = [curve for curve in loci["curves"] if curve["kind"] == "backlash"]
        self.assertEqual(len(backlash), 1)
        self.assertIsNone(backlash[0]["implicit"])
        self.assertTrue(backlash[0]["certified"])
        self.run_program("validate", model, "--grid", "60x60", "--quiet")
        self.run_program("loci", model, "--certificate", "t.cert", "--quiet")
        self.run_program("check", model, "t.cert")
        refused = self.run_program("loci", model, "--engine", "exact", status=2)
        self.assertEqual(refused.stderr.count("\n"), 1)
        task = self.folder / "task.yaml"
        task.write_text("format: 1\nbox: {x: [0.2, 0.35], y: [-0.75, -0.6]}\n", encoding="utf-8")
        self.assertIn("VERIFIED", self.run_program("verify", model, task).stdout)

    def test_a_limit_is_named_where_it_is_broken(self):
        model = self.model(lambda text: text + "limits: [{distance: [A1, P], within: [0.31, 0.92]}]\n")
        refused = self.run_program("pose", model, "--at", "0.2,0.1", status=2)
        self.assertIn("distance A1-P at 0.31 m", refused.stderr)
        in_mm = self.model(lambda text: text.replace("L: 0.5", "L: 500").replace("[-0.5, 1.0]", "[-500, 1000]")
                           .replace("[-1.0, 1.0]", "[-1000, 1000]")
                           + "units: {length: mm}\nlimits: [{distance: [A1, P], within: [310, 920]}]\n", name="mm.yaml")
        refused = self.run_program("pose", in_mm, "--at", "200,100", status=2)
        self.assertIn("distance A1-P at 310 mm", refused.stderr)
        task = self.folder / "task.yaml"
        task.write_text("format: 1\nbox: {x: [0.2, 0.3], y: [-0.95, -0.8]}\n", encoding="utf-8")
        self.assertIn("beyond the limit of the distance A1-P at 0.92 m",
                      self.run_program("verify", model, task, status=1).stdout)

    def test_a_task_over_poses_names_the_limit_that_it_breaks(self):
        model = self.folder / "limited.yaml"
        model.write_text(FOUR_BAR.read_text(encoding="utf-8") + "limits: [{angle: [B, C, D], within: [60 deg, 140 deg]}]\n",
                         encoding="utf-8")
        task = self.folder / "turn.yaml"
        task.write_text("format: 1\nbox: {theta: [5 deg, 35 deg]}\n", encoding="utf-8")
        process = self.run_program("verify", model, task, status=1)
        self.assertIn("beyond the limit of the angle B-C-D at 60 deg", process.stdout)
        told = json.loads(self.run_program("verify", model, task, "--json", "--quiet", status=1).stdout)
        self.assertEqual(told["witness"]["limit"], "angle B-C-D at 60 deg")


if __name__ == "__main__":
    unittest.main()
