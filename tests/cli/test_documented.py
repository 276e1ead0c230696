"""The examples of docs/mechanism-file.md that change a shipped mechanism run."""

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

    def test_torsion_springs_are_known_to_poses_and_refused_by_loci(self):
        model = self.model(lambda text: text + "springs: [{joint: A1, stiffness: 2.5, rest: 30 deg}]\n")
        self.run_program("pose", model, "--at", "0.2,-0.6", "--iterate")
        self.run_program("error", model, "--grid", "20x20", "--quiet")
        for command in ("loci", "equations", "zones"):
            refused = self.run_program(command, model, status=2)
            self.assertEqual(refused.stderr.count("\n"), 1)
            self.assertIn("torsion spring S1", refused.stderr)

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
