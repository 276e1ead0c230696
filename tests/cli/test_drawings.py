"""Ten mechanisms from drawings that others published, entered as they are drawn: agreement.md has the table."""

import json
import math
import re
import shutil
import unittest

from program import SOURCE, InOwnFolder, page

DRAWINGS = sorted((SOURCE / "tests" / "cli" / "drawings").glob("*.yaml"))


class Drawings(InOwnFolder):
    def place(self, name, degrees, point):
        model = SOURCE / "tests" / "cli" / "drawings" / f"{name}.yaml"
        answer = self.run_program("pose", model, "--at", repr(math.radians(degrees)), "--json").stdout
        return json.loads(answer)["posture"][point]

    def test_each_is_understood(self):
        self.assertEqual(len(DRAWINGS), 10)
        for model in DRAWINGS:
            with self.subTest(model.name):
                self.run_program("normalize", model)

    def test_the_guide_from_a_cad_sketch_runs(self):
        text = page("cad-sketch.md")
        workspace, task = re.findall(r"^```yaml\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
        commands = [line for block in re.findall(r"^```sh\n(.*?)^```$", text, re.MULTILINE | re.DOTALL) for line in block.splitlines()]
        self.assertEqual(len(commands), 3)
        shutil.copy(SOURCE / "examples" / "sketches" / "press.dxf", self.folder)
        for command in commands[:-1]:
            self.run_program(*command.split()[1:])
        model = self.folder / "press.yaml"
        own = model.read_text(encoding="utf-8")
        model.write_text(re.sub(r"^workspace:\n(  .*\n)+", workspace, own, flags=re.MULTILINE), encoding="utf-8")
        (self.folder / "task.yaml").write_text(task, encoding="utf-8")
        self.assertIn("VERIFIED", self.run_program(*commands[-1].split()[1:]).stdout)

    def test_hoeken_draws_nearly_a_straight_line(self):
        # Over the half turn of the crank on the far side of the base.
        places = [self.place("hoeken", degrees, "P") for degrees in range(90, 271, 20)]
        wide, high = (max(p[k] for p in places) - min(p[k] for p in places) for k in (0, 1))
        self.assertGreater(wide, 0.28)
        self.assertLess(high, 0.02 * wide)

    def test_peaucellier_draws_a_straight_line(self):
        places = [self.place("peaucellier", degrees, "P") for degrees in (-30, -17, 0, 11, 29)]
        for place in places:
            self.assertLess(abs(place[0] - 0.28), 1e-12)
        self.assertGreater(places[-1][1] - places[0][1], 0.1)

    def test_the_yoke_moves_by_twice_the_crank(self):
        ends = [self.place("scotch_yoke", degrees, "H")[0] for degrees in (0, 180)]
        self.assertAlmostEqual(ends[0] - ends[1], 0.2, 12)

    def test_the_four_bar_is_drawn_where_its_readme_has_it(self):
        # The crank hangs at -atan(sqrt(15)) and the pins lie on a rhomboid.
        crank = math.degrees(-math.atan(math.sqrt(15)))
        self.assertLess(math.dist(self.place("drake_four_bar", crank, "B"), (-3, -math.sqrt(15))), 1e-9)


if __name__ == "__main__":
    unittest.main()
