"""The schemas of share/: every mechanism file shipped keeps to the one for editors, and what the commands print to theirs."""

import json
import re
import unittest

import jsonschema
import yaml
from program import FIVE_BAR, FOUR_BAR, PICK_AND_PLACE, SOURCE, InOwnFolder

EXAMPLES = SOURCE / "examples"


class Yaml12(yaml.SafeLoader):
    """YAML 1.2, as editors and the program read it: `on` is a name and no truth value."""


Yaml12.yaml_implicit_resolvers = {
    first: [(tag, pattern) for tag, pattern in resolvers if tag != "tag:yaml.org,2002:bool"]
    for first, resolvers in yaml.SafeLoader.yaml_implicit_resolvers.items()
}
Yaml12.add_implicit_resolver(
    "tag:yaml.org,2002:bool", re.compile("^(true|True|TRUE|false|False|FALSE)$"), list("tTfF")
)


def validator(name):
    schema = json.loads((SOURCE / "share" / f"{name}.schema.json").read_text(encoding="utf-8"))
    kind = jsonschema.Draft202012Validator
    kind.check_schema(schema)
    return kind(schema)


def complaints(schema, instance):
    return [f"{list(error.absolute_path)}: {error.message[:200]}" for error in schema.iter_errors(instance)]


class MechanismFiles(InOwnFolder):
    def setUp(self):
        super().setUp()
        self.schema = validator("mechanism")

    def test_every_example_keeps_to_it(self):
        files = sorted([*EXAMPLES.glob("*.yaml"), EXAMPLES / "pick_and_place" / "manipulator.yaml"])
        self.assertGreater(len(files), 20)
        for file in files:
            document = yaml.load(file.read_text(encoding="utf-8"), Yaml12)
            self.assertEqual(complaints(self.schema, document), [], file.name)

    def test_every_drawing_keeps_to_it(self):
        files = sorted((SOURCE / "tests" / "mechanism" / "assembly" / "twins").glob("*.yaml"))
        self.assertGreater(len(files), 20)
        for file in files:
            document = yaml.load(file.read_text(encoding="utf-8"), Yaml12)
            self.assertEqual(complaints(self.schema, document), [], file.name)
            printed = self.run_program("normalize", file).stdout
            self.assertEqual(complaints(self.schema, yaml.load(printed, Yaml12)), [], file.name)

    def test_what_the_program_refuses_is_marked(self):
        text = FIVE_BAR.read_text(encoding="utf-8")
        for wrong, right in [
            ("mas: 1", "mass: 1"),
            ("side: up", "side: right"),
            ("units: {length: parsec}\nformat: 1", "format: 1"),
            ("clearance: {radius: 10e-6", "clearance: {radial: 10e-6"),
            ("format: 2", "format: 1"),
        ]:
            if right not in text:
                continue
            document = yaml.load(text.replace(right, wrong, 1), Yaml12)
            self.assertNotEqual(complaints(self.schema, document), [], wrong)

    def test_it_has_the_words_of_every_shipped_form(self):
        text = (SOURCE / "share" / "mechanism.schema.json").read_text(encoding="utf-8")
        for key in ["repeat", "units", "frames", "masses", "relative_to", "fit", "diameter", "dyad", "slider", "place"]:
            self.assertIn(f'"{key}"', text)


class Results(InOwnFolder):
    def holds(self, name, *words, status=0):
        printed = self.run_program(*words, "--json", status=status).stdout
        self.assertEqual(complaints(validator(name), json.loads(printed)), [], words)

    def test_loci(self):
        self.holds("loci", "loci", FIVE_BAR)
        self.holds("loci", "loci", FOUR_BAR)
        self.holds("loci", "loci", EXAMPLES / "minitaur_leg.yaml", "--joint", "A1")

    def test_what_is_left_at_a_time_limit(self):
        task = EXAMPLES / "tasks" / "pick_and_place.yaml"
        for name, *words in [
            ("loci", FIVE_BAR),
            ("zones", FIVE_BAR),
            ("verify", FIVE_BAR, task),
            ("error", EXAMPLES / "three_upu.yaml"),
            ("validate", FIVE_BAR),
        ]:
            self.holds(name, name, *words, "--time-limit", "0.00001", status=3)

    def test_zones(self):
        self.holds("zones", "zones", FIVE_BAR)
        self.holds("zones", "zones", FOUR_BAR)
        self.holds("zones", "zones", FOUR_BAR, "--working-mode", "all")
        self.holds("zones", "zones", EXAMPLES / "three_upu.yaml", "--cells", "5000")

    def test_verify(self):
        task = EXAMPLES / "tasks" / "pick_and_place.yaml"
        self.holds("verify", "verify", EXAMPLES / "studies" / "antagonistic.yaml", EXAMPLES / "tasks" / "preload.yaml")
        law = self.folder / "law.yaml"
        law.write_text("format: 1\nbox: {x: [-0.05, 0.15], y: [0.45, 0.6]}\npreload: controlled\n", encoding="utf-8")
        self.holds("verify", "verify", EXAMPLES / "studies" / "antagonistic.yaml", law)
        self.holds("verify", "verify", FIVE_BAR, task)
        refuted = self.folder / "task.yaml"
        refuted.write_text("format: 1\nbox: {x: [0.1, 0.4], y: [-0.8, -0.2]}\n", encoding="utf-8")
        self.holds("verify", "verify", FIVE_BAR, refuted, status=1)
        poses = self.folder / "poses.yaml"
        poses.write_text("format: 1\nbox: {theta: [70 deg, 80 deg]}\n", encoding="utf-8")
        self.holds("verify", "verify", FOUR_BAR, poses)
        poses.write_text("format: 1\npath: [50 deg, 80 deg]\n", encoding="utf-8")
        self.holds("verify", "verify", FOUR_BAR, poses, status=1)

    def test_pose(self):
        self.holds("pose", "pose", FIVE_BAR, "--at", "0.25,-0.7", "--iterate")
        self.holds("pose", "pose", FIVE_BAR, "--at", "y=-0.7,x=0.25", "--working-mode", "all")
        self.holds("pose", "pose", EXAMPLES / "gripper.yaml", "--at", "s=10")
        self.holds("pose", "pose", EXAMPLES / "studies" / "antagonistic.yaml", "--at", "0.05,0.5", "--min-couple", "2")
        self.holds("pose", "pose", EXAMPLES / "hexapod.yaml", "--at", "0,0")

    def test_error(self):
        self.holds("error", "error", FIVE_BAR, "--grid", "20x20")
        self.holds("error", "error", EXAMPLES / "gripper.yaml", "--grid", "40")
        self.holds("error", "error", EXAMPLES / "three_upu.yaml", "--grid", "4x5x6")

    def test_trajectory(self):
        self.holds("trajectory", "trajectory", *PICK_AND_PLACE)

    def test_validate(self):
        self.holds("validate", "validate", FIVE_BAR, "--grid", "20x20")
        self.holds("validate", "validate", FOUR_BAR, "--grid", "200")
        self.holds("validate", "validate", EXAMPLES / "three_upu.yaml", "--grid", "8x8x8")
        self.holds("validate", "validate", EXAMPLES / "minitaur_leg.yaml", "--grid", "20x20")
        self.holds("validate", "validate", EXAMPLES / "hexapod.yaml", "--grid", "20x20", "--joint", "S1")

    def test_import(self):
        files = SOURCE / "tests" / "mechanism" / "import" / "files"
        for name in ("pmks/four_bar.txt", "linkage/four_bar.linkage2", "mjcf/four_bar.xml", "urdf/four_bar.urdf",
                     "sdf/four_bar_1_6.sdf", "dxf/four_bar_r12.dxf", "pyslvs/crank_rocker.txt", "cuik/four_bar.world"):
            self.holds("import", "import", files / name)
            written = yaml.load(self.run_program("import", files / name).stdout, Yaml12)
            self.assertEqual(complaints(validator("mechanism"), written), [], name)

    def test_equations(self):
        self.holds("equations", "equations", FIVE_BAR)


if __name__ == "__main__":
    unittest.main()
