"""The examples of docs/mechanism-file.md that change a shipped mechanism run."""

import json
import re
import unittest

from program import SOURCE, InOwnFolder

TEXT = (SOURCE / "docs" / "mechanism-file.md").read_text(encoding="utf-8")


def sections(text):
    """The top-level keys of a YAML text in order, each with its lines."""
    found = {}
    for line in text.splitlines():
        if re.match(r"\w", line):
            key = line.split(":")[0]
            found[key] = []
        if found:
            found[key].append(line)
    return found


def changed(base, snippet):
    """`base` with the joints of the snippet in place of its own, and with the snippet's other sections."""
    result, more = sections(base), sections(snippet)
    for entry in more.pop("joints", [])[1:]:
        name = entry.split(":")[0]
        result["joints"] = [entry if line.split(":")[0] == name else line for line in result["joints"]]
    result.update(more)
    return "\n".join(line for lines in result.values() for line in lines) + "\n"


class Documented(InOwnFolder):
    def test_examples_run(self):
        blocks = re.findall(r"^```yaml\n# with (examples/\S+)\n(.*?)^```$", TEXT, re.MULTILINE | re.DOTALL)
        self.assertGreaterEqual(len(blocks), 4)
        for number, (base, snippet) in enumerate(blocks):
            with self.subTest(snippet):
                model = self.folder / f"model{number}.yaml"
                model.write_text(changed((SOURCE / base).read_text(encoding="utf-8"), snippet), encoding="utf-8")
                self.run_program("pose", model, "--at", "0.2,-0.6")
                self.run_program("loci", model, "--quiet", "-o", f"out{number}")

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
        task = self.folder / "task.yaml"
        task.write_text("format: 1\nbox: {x: [0.2, 0.3], y: [-0.95, -0.8]}\n", encoding="utf-8")
        self.assertIn("beyond the limit of the distance A1-P at 0.92 m",
                      self.run_program("verify", model, task, status=1).stdout)


if __name__ == "__main__":
    unittest.main()
