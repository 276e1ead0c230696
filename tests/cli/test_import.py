"""Other programs' files in place of a mechanism file, and written as one."""

import json
import pathlib
import re
import unittest

from program import FIVE_BAR, SOURCE, InOwnFolder

FILES = SOURCE / "tests" / "mechanism" / "import" / "files"
ONE_OF_EACH = [
    "pmks/address.txt", "linkage/four_bar.linkage2", "mjcf/four_bar.xml", "urdf/four_bar.urdf", "sdf/four_bar_1_6.sdf",
    "dxf/four_bar_r12.dxf", "pyslvs/crank_rocker.txt", "cuik/four_bar.world",
]


class Imports(InOwnFolder):
    def loci(self, model):
        answer = json.loads(self.run_program("loci", model, "--json", "--quiet").stdout)
        return {key: value for key, value in answer.items() if key not in ("timing", "notes")}

    def test_one_of_each_program_is_read_and_written(self):
        for name in ONE_OF_EACH:
            with self.subTest(name):
                own = self.folder / "own.yaml"
                said = self.run_program("import", FILES / name, "-o", own).stdout
                self.assertTrue(said.endswith(f"Written to {own}\n"))
                told = json.loads(self.run_program("import", FILES / name, "--json").stdout)
                text = own.read_text(encoding="utf-8")
                self.assertEqual(told["text"], text)
                self.assertEqual(self.run_program("import", FILES / name).stdout, text)
                for note in told["notes"]:
                    self.assertIn(note + "\n", said)
                # Commands take either.
                self.assertEqual(self.loci(FILES / name), self.loci(own))

    def test_every_command_takes_them(self):
        model = FILES / "pmks" / "four_bar.txt"
        task = self.folder / "task.yaml"
        task.write_text("format: 1\nbox: {theta: [20 deg, 40 deg]}\n", encoding="utf-8")
        self.assertIn("ERIFIED", self.run_program("verify", model, task).stdout)
        posed = json.loads(self.run_program("pose", model, "--at", "1", "--json").stdout)
        self.assertIn("masses are in kg", " ".join(posed["notes"]))
        for words in (["zones"], ["error", "--grid", "20"], ["equations"], ["normalize"], ["validate", "--grid", "100"]):
            self.run_program(words[0], model, *words[1:])

    def test_an_address_stands_in_place_of_a_path(self):
        address = (FILES / "pmks" / "address.txt").read_text(encoding="utf-8").strip()
        self.run_program("loci", address, "--quiet")
        self.assertTrue((self.folder / "out" / "address" / "loci.json").exists())
        self.assertEqual([path.name for path in (self.folder / "out").iterdir()], ["address"])
        refused = self.run_program("loci", "https://example.org/?nothing", status=2)
        self.assertIn("holds no mechanism", refused.stderr)

    def test_clearances_and_loops_are_given(self):
        given = self.run_program("import", FILES / "pmks" / "four_bar.txt", "--clearance", "30 um").stdout
        self.assertEqual(set(re.findall(r"radial: ([^}]*)}", given)), {"30 um"})
        robot = self.folder / "robot.urdf"
        robot.write_bytes((FILES / "urdf" / "four_bar.urdf").read_bytes())
        loops = FILES / "urdf" / "four_bar.yaml"
        tree = self.run_program("import", robot).stdout
        closed = self.run_program("import", robot, "--loops", loops).stdout
        self.assertNotEqual(tree, closed)
        (self.folder / "robot.yaml").write_bytes(loops.read_bytes())
        self.assertEqual(self.run_program("import", robot).stdout, closed)

    def test_what_cannot_be_read_is_one_line(self):
        for name, named in [
            ("linkage/curved_slot.linkage2", "slot"), ("mjcf/free_body.xml", "freejoint"),
            ("mjcf/curved_equality.xml", "polycoef"), ("urdf/mimic_across.urdf", "follows"), ("sdf/screw.sdf", "screw"),
        ]:
            for command in ("import", "loci", "equations"):
                refused = self.run_program(command, FILES / name, status=2)
                self.assertEqual(refused.stdout, "")
                self.assertEqual(refused.stderr.count("\n"), 1)
                self.assertRegex(refused.stderr, re.escape(pathlib.Path(name).name) + r":\d+: .*" + re.escape(named))
        refused = self.run_program("import", FIVE_BAR, status=2)
        self.assertIn("a mechanism file already", refused.stderr)
        self.assertIn("PMKS+", refused.stderr)


if __name__ == "__main__":
    unittest.main()
