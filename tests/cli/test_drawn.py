"""Drawings against the examples that they draw: loci, zones and verdicts, number by number."""

import json
import unittest

from program import SOURCE, InOwnFolder, run

EXAMPLES = SOURCE / "examples"
TWINS = SOURCE / "tests" / "mechanism" / "assembly" / "twins"
#: What says how long it took, and how it closed.
BESIDE = {"timing", "notes"}


#: What calls the sides of dyads by their names, which are those of the construction that is found.
SIDES = {"working_mode", "factor"}


def differences(one, other, where="", beside=BESIDE):
    """Places at which two answers differ: numbers by more than 1e-9 of their size."""
    if isinstance(one, (int, float)) and isinstance(other, (int, float)) and not isinstance(one, bool):
        return [] if abs(one - other) <= 1e-9 * max(1, abs(one)) else [where]
    if isinstance(one, list) and isinstance(other, list) and len(one) == len(other):
        return [d for i, (a, b) in enumerate(zip(one, other)) for d in differences(a, b, f"{where}[{i}]", beside)]
    if isinstance(one, dict) and isinstance(other, dict) and set(one) - beside == set(other) - beside:
        return [d for key in set(one) - beside for d in differences(one[key], other[key], f"{where}.{key}", beside)]
    return [] if one == other else [where]


class Twins(InOwnFolder):
    def answers(self, *words, status=0):
        """Of the example and of its drawing; a word EXAMPLE/... stands for either."""
        for folder in (EXAMPLES, TWINS):
            own = [folder / word[8:] if isinstance(word, str) and word.startswith("EXAMPLE/") else word for word in words]
            process = self.run_program(*own, "--json", status=status) if status is not None else run(*own, "--json", cwd=self.folder)
            yield json.loads(process.stdout)

    def assert_equal(self, *words, status=0, beside=BESIDE):
        one, other = self.answers(*words, status=status)
        self.assertEqual(differences(one, other, beside=beside), [], words)

    def test_loci(self):
        for name in ["five_bar", "five_bar_preloaded", "prrrp", "rprpr", "slider_crank", "watt_six_bar", "squeezer"]:
            self.assert_equal("loci", f"EXAMPLE/{name}.yaml")

    def test_loci_of_other_constructions(self):
        for name in ["gripper", "klann_leg", "toggle_press"]:
            self.assert_equal("loci", f"EXAMPLE/{name}.yaml", beside=BESIDE | SIDES)

    def test_zones(self):
        for name in ["five_bar", "four_bar"]:
            self.assert_equal("zones", f"EXAMPLE/{name}.yaml")

    def test_zones_by_cells(self):
        for name in ["three_upu", "three_rpr_orientation"]:
            self.assert_equal("zones", f"EXAMPLE/{name}.yaml", "--cells", "5000", status=None)

    def test_zones_by_cells_of_another_construction(self):
        """Bounds are proven from inside: they differ by less than what stays in doubt."""
        one, other = self.answers("zones", "EXAMPLE/jansen_leg.yaml")
        self.assertEqual(len(one["zones"]), len(other["zones"]))
        doubt = max(one["in_doubt"], other["in_doubt"])
        self.assertLess(doubt, 1e-6)
        for a, b in zip(one["zones"], other["zones"]):
            self.assertEqual((a["id"], a["signs"]), (b["id"], b["signs"]))
            self.assertEqual([end["kind"] for end in a["ends"]], [end["kind"] for end in b["ends"]])
            self.assertEqual([end["vanishing"] for end in a["ends"]], [end["vanishing"] for end in b["ends"]])
            for key in ("lower", "upper"):
                self.assertLessEqual(abs(a[key][0] - b[key][0]), doubt)

    def test_verdicts(self):
        self.assert_equal("verify", "EXAMPLE/five_bar.yaml", EXAMPLES / "tasks" / "pick_and_place.yaml")

    def test_a_pose_in_space(self):
        self.assert_equal("pose", "EXAMPLE/three_upu.yaml", "--at", "0.05,0.02,0.6")
        self.assert_equal("pose", "EXAMPLE/three_ruu.yaml", "--at", "0.05,0.02,-0.6")

    def test_the_construction_answers_as_the_drawing(self):
        for name in ["five_bar", "slider_crank"]:
            own = self.folder / f"{name}.yaml"
            self.run_program("normalize", TWINS / f"{name}.yaml", "-o", own)
            answers = [json.loads(self.run_program("loci", file, "--json").stdout) for file in (TWINS / f"{name}.yaml", own)]
            for answer in answers:
                for key in BESIDE:
                    answer.pop(key, None)
            self.assertEqual(json.dumps(answers[0]), json.dumps(answers[1]))

# J0 bears nothing in any pose: its force is nought to rounding, of which there is more at some poses.
SLIDES_ON_A_LEVER = """format: 1
workspace: {q: {angle: [90 deg, 220 deg], of: L1}}
drawn: {J0: [-0.15, -0.65], J1: [0.8, 0.6], J2: [0.45, -0.95], J3: [0.9, 0.75], J4: [-0.6, 0.05], J5: [0.85, 0.2],
  J6: [0.45, 0.65], E: [-0.65, -0.4]}
links:
  L1: {points: [J0, E]}
  L2: {points: [J1, J3, J5]}
  L3: {points: [J3, J6]}
  L4: {points: [J2, J4]}
  L5: {points: [J5, J6]}
joints:
  J0: {revolute: [ground, L1], at: J0, clearance: {radial: 1.0e-05, angular: 0.001}, actuated: true}
  J1: {prismatic: [L1, L2], at: J1, axis: [0.1, 1.0], clearance: {gap: 1.0e-05, half_length: 0.05}}
  J2: {revolute: [ground, L4], at: J2, clearance: {radial: 1.0e-05}}
  J3: {revolute: [L3, L2], at: J3, clearance: {radial: 1.0e-05}}
  J4: {prismatic: [L5, L4], at: J4, axis: [0.2, -0.8]}
  J5: {revolute: [L2, L5], at: J5, clearance: {radial: 1.0e-05}}
  J6: {revolute: [L5, L3], at: J6, clearance: {radial: 1.0e-05}}
end_effector: {link: L2, at: J5}
loads:
- {link: L4, at: J2, force: [-14, 13], couple: 0.8}
- {link: L4, at: J4, force: [-11, -5]}
springs:
- {links: [L2, L3], at: [J1, J3], force: -19}
"""


class SlidesOnALever(InOwnFolder):
    def test_what_bears_nothing_leaves_nothing_in_doubt(self):
        file = self.folder / "lever.yaml"
        file.write_text(SLIDES_ON_A_LEVER, encoding="utf-8")
        answer = json.loads(self.run_program("zones", file, "--time-limit", "60", "--json").stdout)
        self.assertTrue(answer["complete"])
        self.assertEqual(len(answer["zones"]), 1)


if __name__ == "__main__":
    unittest.main()
