"""What others computed, against the program: docs/background/agreement.md says where each number was published."""

import json
import math
import unittest

from program import InOwnFolder

SIX_BAR = """format: 1
name: six-bar
workspace: {theta: {angle: [0, 360 deg], of: AB}}
drawn: {A: [7, 4], B: [5, 16], C: [25, 25], D: [23, 10], E: [18, 35], F: [43, 32], G: [45, 17], M: [16, 76/3], Q: [44, 24.5]}
links:
  AB: {points: [A, B], mass: 5, inertia: 0.1}
  BCE: {points: [B, C, E, M], mass: 10, com: M, inertia: 0.2}
  CD: {points: [C, D], mass: 5, inertia: 0.1}
  EF: {points: [E, F], mass: 10, inertia: 0.2}
  FG: {points: [F, G, Q], mass: 5, inertia: 0.1}
joints:
  A: {revolute: [ground, AB], at: A, actuated: true}
  B: {revolute: [AB, BCE], at: B}
  C: {revolute: [BCE, CD], at: C}
  D: {revolute: [ground, CD], at: D}
  E: {revolute: [BCE, EF], at: E}
  F: {revolute: [EF, FG], at: F}
  G: {revolute: [ground, FG], at: G}
end_effector: {link: FG, at: Q}
loads: [{link: FG, at: Q, force: [50, 0]}]
gravity: [0, -9.81]
"""

SLIDER_CRANK = """format: 1
name: slider-crank with a tracer
workspace: {theta: {angle: [0, 360 deg], of: AB}}
drawn: {A: [0, 0], B: [4, 2], C: [12, 0], D: [20, 2]}
links:
  AB: {points: [A, B]}
  BCD: {points: [B, C, D]}
  block: {points: [C]}
joints:
  A: {revolute: [ground, AB], at: A, actuated: true}
  B: {revolute: [AB, BCD], at: B}
  C: {revolute: [BCD, block], at: C}
  G: {prismatic: [ground, block], at: C, axis: [1, 0]}
end_effector: {link: BCD, at: D}
loads: [{link: BCD, at: D, force: [0, -100]}]
"""

# A six-bar whose address of PMKS+ is published, at the places and with the masses that the address holds.
LIFTER = """format: 1
name: lifter
workspace: {theta: {angle: [0, 360 deg], of: AB}}
drawn:
  A: [1.4, 0.485]
  B: [1.67, 0.99]
  C: [0.255, 1.035]
  D: [0.285, 0.055]
  E: [0.195, 2.54]
  F: [-0.98, 2.57]
  G: [0.05, 0.2]
  H: [-1.715, 4.26]
  G_AB: [1.537, 0.741]
  G_BC: [0.965, 1.012]
  G_EF: [-0.39, 2.555]
  G_DCE: [0.24, 1.304]
  G_GFH: [-0.831, 2.227]
links:
  AB: {points: [A, B, G_AB], mass: 8.03, com: G_AB, inertia: 0.26}
  BC: {points: [B, C, G_BC], mass: 19.41, com: G_BC, inertia: 3.39}
  EF: {points: [E, F, G_EF], mass: 16.16, com: G_EF, inertia: 1.97}
  DCE: {points: [C, D, E, G_DCE], mass: 33.48, com: G_DCE, inertia: 17.81}
  GFH: {points: [F, G, H, G_GFH], mass: 59.68, com: G_GFH, inertia: 99.17}
joints:
  A: {revolute: [ground, AB], at: A, actuated: true}
  B: {revolute: [AB, BC], at: B}
  C: {revolute: [BC, DCE], at: C}
  D: {revolute: [ground, DCE], at: D}
  E: {revolute: [EF, DCE], at: E}
  F: {revolute: [EF, GFH], at: F}
  G: {revolute: [ground, GFH], at: G}
end_effector: {link: GFH, at: H}
loads: [{link: GFH, at: H, force: [0, -200]}]
gravity: [0, -9.80665]
"""

SYMMETRIC = """format: 1
name: symmetric five-bar
workspace: {x: [-3, 3], y: [-3, 3]}
points:
  A1: [-1/2, 0]
  A2: [1/2, 0]
  P: [x, y]
  B1: {dyad: [A1, P], lengths: [6/5, 1], side: left}
  B2: {dyad: [A2, P], lengths: [6/5, 1], side: right}
links: {A1B1: {points: [A1, B1]}, B1P: {points: [B1, P]}, A2B2: {points: [A2, B2]}, B2P: {points: [B2, P]}}
joints:
  A1: {revolute: [ground, A1B1], at: A1, actuated: true}
  B1: {revolute: [A1B1, B1P], at: B1}
  P: {revolute: [B1P, B2P], at: P}
  B2: {revolute: [A2B2, B2P], at: B2}
  A2: {revolute: [ground, A2B2], at: A2, actuated: true}
end_effector: {link: B2P, at: P}
loads: [{link: B2P, at: P, force: [30, 40]}]
"""

DEGREE = math.pi / 180
TEN_RPM = 10 * 2 * math.pi / 60


class Agreement(InOwnFolder):
    def posed(self, text, at, *options):
        model = self.folder / "model.yaml"
        model.write_text(text, encoding="utf-8")
        return json.loads(self.run_program("pose", model, "--at", repr(at), "--json", *options).stdout)

    def test_pin_forces_of_a_six_bar_with_masses(self):
        start = 1.7359450042095235
        # Degrees on from the start, then the force on the pin E; at 40 it is near a singularity.
        published = {
            0: (8.3070018283867881, 31.593211405435341),
            1: (7.7241281659898711, 31.398096255410447),
            10: (4.5236299624644261, 31.196378728143504),
            20: (19.255093992490007, 36.137077975534282),
            30: (166.55359714783702, 53.636059188815665),
            36: (1018.2907706533085, 26.632799430486411),
            40: (18258.684620625882, -3416.0966650107553),
        }
        for step, force in published.items():
            options = ("--velocity", repr(TEN_RPM), "--acceleration", "0")
            own = self.posed(SIX_BAR, start + step * DEGREE, *options)["reactions"]["E"]
            # There the force on the other link is meant.
            apart = math.hypot(own["fx"] + force[0], own["fy"] + force[1])
            self.assertLess(apart, 1e-12 * math.hypot(*force), step)

    def test_path_of_a_point_of_a_connecting_rod(self):
        published = {
            0: (20, 2),
            30: (18.061966008454785, 0.16741529076037942),
            60: (15.419776361327255, -0.67614482291371925),
            90: (13.456193037040897, -0.13595174073976946),
            123: (12.135221521700949, 1.7323754976613133),
        }
        for step, place in published.items():
            own = self.posed(SLIDER_CRANK, math.atan2(2, 4) + step * DEGREE)["posture"]["D"]
            self.assertLess(math.dist(own, place), 1e-13 * 16, step)

    def test_torques_of_a_lifter_at_rest_and_at_speed(self):
        start = math.atan2(0.99 - 0.485, 1.67 - 1.4)
        at_rest = self.posed(LIFTER, start)["reactions"]["A"]["M"]
        self.assertAlmostEqual(at_rest, -504.264, 3)
        speed = 23.1481481481481 * 2 * math.pi / 60
        moving = self.posed(LIFTER, start, "--velocity", repr(speed), "--acceleration", "0")
        self.assertAlmostEqual(moving["reactions"]["A"]["M"], -47.039, 3)

    def test_curves_of_a_symmetric_five_bar(self):
        model = self.folder / "model.yaml"
        model.write_text(SYMMETRIC, encoding="utf-8")
        curves = json.loads(self.run_program("loci", model, "--json", "--quiet", "--working-mode", "all").stdout)["curves"]
        found = {(curve["kind"], curve["implicit"]["polynomial"]) for curve in curves}
        # The order in which terms are written is the program's own.
        sextic = ("10000*x^6 + 30000*x^4*y^2 + 30000*x^2*y^4 + 10000*y^6 - 13800*x^4 - 17600*x^2*y^2 - 3800*y^4 "
                  "+ 4761*x^2 - 9639*y^2")
        self.assertIn(("direct-singularity", sextic), found)
        for circle in ("100*x^2 + 100*y^2 - 220*x - 160*y + 41", "100*x^2 + 100*y^2 + 20*x + 160*y - 79"):
            self.assertIn(("contact-loss", circle), found)
        circles = [curve["closed_form"] for curve in curves if "circles" in (curve.get("closed_form") or {})]
        self.assertEqual({one["radius_squared"] for pair in circles for one in pair["circles"]}, {"1"})
        centres = {one["centre"][1] for pair in circles for one in pair["circles"]}
        self.assertEqual(centres, {"1/10*sqrt(119)", "-1/10*sqrt(119)"})


if __name__ == "__main__":
    unittest.main()
