"""The law of preloads: random mechanisms with motors or cables more than they need, and random tasks. What `verify` says
is held against statics and linear programs of its own (preload_statics.py) at samples of the task. CLEARLOCI_PRELOAD_INPUTS
is the number of random tasks (a few by default; 300 in a long run), CLEARLOCI_PRELOAD_FIRST the first of them."""

import csv
import fractions
import json
import math
import os
import random
import shutil
import unittest

import numpy
from preload_statics import Mechanism, dyad, feasible_depth
from program import SOURCE, InOwnFolder, run

EXAMPLES = SOURCE / "examples"
FIRST = int(os.environ.get("CLEARLOCI_PRELOAD_FIRST", "0"))
SEEDS = range(FIRST, FIRST + int(os.environ.get("CLEARLOCI_PRELOAD_INPUTS", "4")))


class FiveBar:
    """A 5R with one or two motors at its elbows besides those at its base."""

    def __init__(self, rng):
        self.base = round(rng.uniform(0.3, 0.6), 2)
        self.lengths = [round(rng.uniform(0.45, 0.6), 2) for _ in range(4)]
        self.force = [round(rng.uniform(-40, 40)), round(rng.uniform(-100, -20))]
        self.free = rng.choice([["B1"], ["B2"], ["P"], ["B1", "B2"]])
        self.tight = rng.choice([False, True])
        x, y = rng.uniform(0.05, 0.45), rng.uniform(0.4, 0.62)
        half = rng.uniform(0.01, 0.07)
        self.box = [[round(x - half, 3), round(x + half, 3)], [round(y - half, 3), round(y + half, 3)]]
        self.limit = 60 if self.tight else 400
        self.statics = Mechanism(
            5,
            [("A1", 0, 1, "A1"), ("B1", 1, 2, "B1"), ("P", 2, 3, "P"), ("B2", 4, 3, "B2"), ("A2", 0, 4, "A2")],
            ["A1", "A2", *self.free],
            [],
        )

    def text(self):
        def motor(name, clearance):
            effort = f"actuated: {{effort: free, within: [-{self.limit}, {self.limit}]}}, " if name in self.free else ""
            return effort + clearance

        pin, both = "clearance: {radial: 1e-5}", "actuated: true, clearance: {radial: 1e-5, angular: 1e-3}"
        a, b, c, d = self.lengths
        return f"""format: 1
workspace: {{x: [-0.6, 1.2], y: [-1.2, 1.2]}}
points:
  A1: [0, 0]
  A2: [{self.base}, 0]
  P: [x, y]
  B1: {{dyad: [A1, P], lengths: [{a}, {b}], side: left}}
  B2: {{dyad: [A2, P], lengths: [{c}, {d}], side: right}}
links: {{A1B1: {{points: [A1, B1]}}, B1P: {{points: [B1, P]}}, PB2: {{points: [P, B2]}}, B2A2: {{points: [B2, A2]}}}}
joints:
  A1: {{revolute: [ground, A1B1], at: A1, {both}}}
  B1: {{revolute: [A1B1, B1P], at: B1, {motor("B1", pin)}}}
  P: {{revolute: [B1P, PB2], at: P, {motor("P", pin)}}}
  B2: {{revolute: [B2A2, PB2], at: B2, {motor("B2", pin)}}}
  A2: {{revolute: [ground, B2A2], at: A2, {both}}}
end_effector: {{link: PB2, at: P}}
loads: [{{link: PB2, at: P, force: {self.force}}}]
"""

    def reactions(self, at, change=(0, 0)):
        a, b, c, d = self.lengths
        points = {"A1": (0, 0), "A2": (self.base, 0), "P": tuple(at)}
        points["B1"], points["B2"] = dyad((0, 0), at, a, b, 1), dyad((self.base, 0), at, c, d, -1)
        if points["B1"] is None or points["B2"] is None:
            return None
        force = (self.force[0] + change[0], self.force[1] + change[1])
        return self.statics.affine(points, [(3, "P", force)], ["M_" + name for name in self.free])

    pins = ("A1", "B1", "P", "B2", "A2")
    signed = ("M_A1", "M_A2")

    def limits(self):
        return [self.limit] * len(self.free)


class PointOnCables:
    """A point mass on three or four cables, whose tensions have bounds."""

    def __init__(self, rng):
        count = rng.choice([3, 4])
        self.free = [f"K{i + 1}" for i in range(2, count)]
        corners = [(-1, -1), (1, -1), (1, 1), (-1, 1)] if count == 4 else [(0, -1.2), (1.1, 0.9), (-1.1, 0.8)]
        self.anchors = [(round(x + rng.uniform(-0.1, 0.1), 2), round(y + rng.uniform(-0.1, 0.1), 2)) for x, y in corners]
        self.bounds = [4, rng.choice([40, 80])]
        self.force = [round(rng.uniform(-15, 15)), round(rng.uniform(-25, 5))]
        x, y, half = rng.uniform(-0.4, 0.4), rng.uniform(-0.4, 0.4), rng.uniform(0.05, 0.25)
        self.box = [[round(x - half, 3), round(x + half, 3)], [round(y - half, 3), round(y + half, 3)]]
        names = [f"K{i + 1}" for i in range(count)]
        self.statics = Mechanism(2, [], [], [(name, "C" + name, 1, "P") for name in names], points_alone=[1])

    def text(self):
        points = "".join(f"  C{i + 1}: [{x}, {y}]\n" for i, (x, y) in enumerate(self.anchors))
        cables = "".join(
            f"  K{i + 1}: {{cable: [ground, load], at: [C{i + 1}, P], tension: {self.bounds}}}\n"
            for i in range(len(self.anchors))
        )
        return f"""format: 1
workspace: {{x: [-0.9, 0.9], y: [-0.9, 0.9]}}
points:
  P: [x, y]
{points}links: {{load: {{points: [P]}}}}
joints:
{cables}end_effector: {{link: load, at: P}}
loads: [{{link: load, at: P, force: {self.force}}}]
"""

    def reactions(self, at, change=(0, 0)):
        points = {"P": tuple(at), **{f"CK{i + 1}": own for i, own in enumerate(self.anchors)}}
        force = (self.force[0] + change[0], self.force[1] + change[1])
        return self.statics.affine(points, [(1, "P", force)], ["F_" + name for name in self.free])

    def limits(self):
        return [self.bounds[1]] * len(self.free)

    def rows(self, reactions):
        least, most = self.bounds
        return [
            row
            for name, (offset, slope) in reactions.items()
            for row in ((offset - least, slope), (most - offset, -slope))
        ]


def samples(box, count=7):
    return [
        (box[0][0] + (box[0][1] - box[0][0]) * i / (count - 1), box[1][0] + (box[1][1] - box[1][0]) * k / (count - 1))
        for i in range(count)
        for k in range(count)
    ]


class RandomPreloads(InOwnFolder):
    def asked(self, mechanism, more):
        (self.folder / "m.yaml").write_text(mechanism.text(), encoding="utf-8")
        box = mechanism.box
        task = f"format: 1\nbox: {{x: {box[0]}, y: {box[1]}}}\n{more}"
        (self.folder / "t.yaml").write_text(task, encoding="utf-8")
        words = ("verify", "m.yaml", "t.yaml", "--quiet", "-o", "out", "--time-limit", "60")
        process = run(*words, cwd=self.folder)
        self.assertIn(process.returncode, (0, 1, 3), process.stderr)
        return json.loads((self.folder / "out" / "verify.json").read_text(encoding="utf-8"))

    def loads(self, radius):
        return [(0, 0)] + [
            (radius * math.cos(turn * math.pi / 4), radius * math.sin(turn * math.pi / 4)) for turn in range(8) if radius
        ]

    def check_efforts(self, mechanism, efforts_at, least_force, least_couple, radius):
        """The signs of couples are the same at all samples and none is too small, and no pin is unloaded."""
        signs = {}
        for at in samples(mechanism.box):
            for load in self.loads(radius):
                reactions = mechanism.reactions(at, load)
                efforts = efforts_at(at)
                value = {name: offset + slope @ efforts for name, (offset, slope) in reactions.items()}
                for name in mechanism.signed:
                    self.assertGreaterEqual(abs(value[name]), least_couple * (1 - 1e-9), (name, at))
                    self.assertEqual(signs.setdefault(name, value[name] > 0), value[name] > 0, (name, at))
                for pin in mechanism.pins:
                    size = math.hypot(value[f"f_{pin}x"], value[f"f_{pin}y"])
                    self.assertGreaterEqual(size, least_force * (1 - 1e-9), (pin, at))

    def check_refutation(self, mechanism, pattern, names):
        """Multipliers of rows whose offsets and slopes are those of other statics."""
        rows = pattern["refutation"]
        self.assertTrue(rows)
        for row in rows:
            self.assertGreater(row["multiplier"], 0)
            if not row["at"] or row["bound"]:
                continue
            offset, slope = mechanism.reactions(row["at"], row["load"] or (0, 0))[row["reaction"]]
            scale = abs(offset) + numpy.linalg.norm(slope) + 1
            self.assertTrue(numpy.allclose(row["sign"] * slope, row["slope"], atol=1e-8 * scale), row)
            self.assertAlmostEqual(row["sign"] * offset - names["least"], row["offset"], delta=1e-8 * scale)
        left = sum(row["multiplier"] * row["offset"] for row in rows)
        slopes = sum(row["multiplier"] * numpy.array(row["slope"]) for row in rows)
        size = sum(row["multiplier"] * numpy.linalg.norm(row["slope"]) for row in rows)
        self.assertLess(left, 0)
        self.assertLess(numpy.linalg.norm(slopes), 1e-6 * size)

    def test_random_five_bars_keep_to_linear_programs(self):
        seen = {}
        for seed in SEEDS:
            rng = random.Random(seed)
            mechanism = FiveBar(rng)
            if any(mechanism.reactions(at) is None for at in samples(mechanism.box, 3)):
                continue
            force, couple = rng.choice([(0, 0), (0, 0), (2, 0.3)])
            radius = rng.choice([0, 0, 8])
            kind = rng.choice(["constant", "constant", "controlled"])
            more = f"preload: {kind}\n" + (f"min_force: {force}\nmin_couple: {couple}\n" if force else "")
            more += f"loads_within: [{{load: 1, radius: {radius}}}]\n" if radius else ""
            with self.subTest(seed=seed, kind=kind, free=mechanism.free):
                answer = self.asked(mechanism, more)
                verdict = answer["verdict"]
                seen[verdict] = seen.get(verdict, 0) + 1
                preload = answer.get("preload")
                if preload is None:
                    continue
                for pattern in preload["patterns"]:
                    if pattern["verdict"] == "refuted":
                        self.check_refutation(mechanism, pattern, {"least": couple})
                if verdict == "verified" and kind == "constant":
                    efforts = numpy.array([preload["value"][name] for name in mechanism.free])
                    self.check_efforts(mechanism, lambda at, own=efforts: own, force, couple, radius)
                if verdict == "verified" and kind == "controlled":
                    law = self.law(mechanism, preload)
                    self.check_efforts(mechanism, law, force, couple, radius)
                if verdict == "verified":
                    least = self.least_size(mechanism, couple, kind)
                    self.assertGreaterEqual(preload["size"][1] * (1 + 1e-6), least)
        print(f"five-bars: {seen}")

    def law(self, mechanism, preload):
        if preload["law"]:
            text = preload["law"]["expression"].replace("N m", "").replace("N", "").replace(" m)", ")")
            text = text.replace("/m^2", "").replace("/m^3", "").replace("/m", "").replace("^", "**")
            return lambda at: numpy.array([eval(text.replace("*(", "*("), {"x": at[0], "y": at[1], "sin": math.sin})])
        with open(self.folder / "out" / "preload_law.csv", encoding="utf-8") as file:
            table = list(csv.reader(file))
        heads = [head.split(" ")[0].split("[")[0].strip() for head in table[0]]
        cells = [dict(zip(heads, map(float, row))) for row in table[1:]]

        def at_pose(at):
            for cell in cells:
                if cell["x_from"] <= at[0] <= cell["x_to"] and cell["y_from"] <= at[1] <= cell["y_to"]:
                    return numpy.array([cell[name] for name in mechanism.free])
            self.fail(f"no cell of the law holds {at}")

        return at_pose

    def least_size(self, mechanism, couple, kind):
        """No preload of a smaller size has signs that hold at all samples, or at each."""
        best = math.inf
        for first in (1, -1):
            for second in (1, -1):
                signs = {"M_A1": first, "M_A2": second}
                rows = [
                    [(signs[name] * reactions[name][0] - couple, signs[name] * reactions[name][1]) for name in signs]
                    for reactions in (mechanism.reactions(at) for at in samples(mechanism.box, 3))
                ]
                groups = rows if kind == "controlled" else [[row for own in rows for row in own]]
                own = max(self.least_of(group, mechanism) for group in groups)
                best = min(best, own)
        return best * (1 - 1e-3)

    @staticmethod
    def least_of(rows, mechanism):
        low, high = 0.0, 1.0
        limits = mechanism.limits()
        if feasible_depth(rows, [high * limit for limit in limits]) < 0:
            return math.inf
        for _ in range(12):
            middle = 0.5 * (low + high)
            if feasible_depth(rows, [middle * limit for limit in limits]) >= 0:
                high = middle
            else:
                low = middle
        return low

    def test_random_cables_keep_to_linear_programs(self):
        seen = {}
        for seed in SEEDS:
            mechanism = PointOnCables(random.Random(1000 + seed))
            radius = random.Random(2000 + seed).choice([0, 3])
            more = "preload: controlled\n" + (f"loads_within: [{{load: 1, radius: {radius}}}]\n" if radius else "")
            with self.subTest(seed=seed):
                answer = self.asked(mechanism, more)
                verdict = answer["verdict"]
                seen[verdict] = seen.get(verdict, 0) + 1

                def depth(at, loads, own=mechanism):
                    rows = [row for load in loads for row in own.rows(own.reactions(at, load))]
                    return feasible_depth(rows, own.limits())

                loads = self.loads(radius)
                if verdict == "verified":
                    for at in samples(mechanism.box, 4):
                        self.assertGreater(depth(at, loads), 0, at)
                if verdict == "refuted":
                    worst = [row["load"] for own in answer["preload"]["patterns"] for row in own["refutation"]]
                    loads += [tuple(load) for load in worst if load]
                    self.assertLess(depth(answer["witness"]["at"], loads), 1e-9)
        print(f"cables: {seen}")


class Ranges(InOwnFolder):
    """All ranges of one effort, also those that hold as a whole only in small parts."""

    TEXT = """format: 1
workspace: {x: [-0.7, 1.0], y: [-1.1, 1.1]}
points:
  A1: [0, 0]
  A2: [0.44, 0]
  P: [x, y]
  B1: {dyad: [A1, P], lengths: [0.62, 0.55], side: left}
  B2: {dyad: [A2, P], lengths: [0.64, 0.65], side: right}
links: {a: {points: [A1, B1]}, b: {points: [A2, B2]}, c: {points: [B1, P]}, e: {points: [P, B2]}}
joints:
  A1: {revolute: [ground, a], at: A1, actuated: true, clearance: {radial: 1e-5, angular: 1e-3}}
  A2: {revolute: [ground, b], at: A2, actuated: true, clearance: {radial: 1e-5, angular: 1e-3}}
  B1: {revolute: [a, c], at: B1, actuated: {effort: free, within: [-59.8, 59.8]}, clearance: {radial: 1e-5}}
  B2: {revolute: [b, e], at: B2, clearance: {radial: 1e-5}}
  P: {revolute: [c, e], at: P, clearance: {radial: 1e-5}}
end_effector: {link: c, at: P}
loads: [{link: c, at: P, force: [-24.1, -26.6]}]
"""

    def test_all_are_listed(self):
        """Ends by other statics: M_A1 is zero at some pose from -1.682 to 5.171 N m, M_A2 from 11.494 to 19.589 N m."""
        (self.folder / "m.yaml").write_text(self.TEXT, encoding="utf-8")
        (self.folder / "t.yaml").write_text("format: 1\nbox: {x: [-0.07, 0.03], y: [0.14, 0.24]}\n", encoding="utf-8")
        self.run_program("verify", "m.yaml", "t.yaml", "--quiet", "-o", "out")
        preload = json.loads((self.folder / "out" / "verify.json").read_text(encoding="utf-8"))["preload"]
        ends = [end for own in preload["ranges"] for end in (own["from"], own["to"])]
        self.assertEqual(len(ends), 6)
        for (low, high), expected in zip(ends, (-59.8, -1.682, 5.171, 11.494, 19.589, 59.8)):
            self.assertLess(high - low, 0.01)
            self.assertAlmostEqual(low, expected, delta=0.01)


ANTAGONISTIC = SOURCE / "examples" / "studies" / "antagonistic.yaml"
BOX = "format: 1\nbox: {x: [-0.05, 0.15], y: [0.45, 0.6]}\nmin_force: 1\n"


# Random five-bars, and tasks that no effort of theirs cures.
REFUTED = [
    (3, "preload: constant\nmin_force: 2\nmin_couple: 0.3\nloads_within: [{load: 1, radius: 8}]\n"),
    (8, "preload: constant\nloads_within: [{load: 1, radius: 8}]\n"),
]


BAR_ON_FOUR_CABLES = """
format: 1
workspace: {theta: {angle: [80 deg, 100 deg]}}
points: {O: [0, 0], P: [cos(theta), sin(theta)], Q: [-cos(theta), -sin(theta)],
         R1: [9, 1], R2: [9, -1], L1: [-9, 1], L2: [-9, -1]}
links: {bar: {points: [O, P, Q]}}
joints:
  O: {revolute: [ground, bar], at: O, clearance: {radial: 1e-5}}
  K1: {cable: [ground, bar], at: [R1, P], tension: [2, 90]}
  K2: {cable: [ground, bar], at: [R2, Q], tension: [2, 90]}
  K3: {cable: [ground, bar], at: [L1, P], tension: [2, 90]}
  K4: {cable: [ground, bar], at: [L2, Q], tension: [2, 90]}
end_effector: {link: bar, at: P}
loads: [{link: bar, at: P, force: [0, -1]}]
"""


class Certificates(InOwnFolder):
    """What was found, or given, is part of the claim: it is accepted, and rejected with another effort."""

    def certified(self, more):
        (self.folder / "t.yaml").write_text(BOX + more, encoding="utf-8")
        self.run_program("verify", ANTAGONISTIC, "t.yaml", "--certificate", "c.cert", "--quiet", "-o", "out")
        return json.loads((self.folder / "c.cert").read_text(encoding="utf-8"))

    def check(self, certificate, status):
        (self.folder / "c.cert").write_text(json.dumps(certificate), encoding="utf-8")
        self.run_program("check", ANTAGONISTIC, "c.cert", status=status)

    def test_a_found_effort_is_certified_and_others_are_not(self):
        certificate = self.certified("preload: constant\n")
        [[name, _]] = certificate["model"]["set"]
        self.assertEqual(name, "preload_B2")
        self.check(certificate, 0)
        for wrong in ("-3 N m", "5 N m", "0 N m", "200 N m"):
            certificate["model"]["set"] = [[name, wrong]]
            self.check(certificate, 1)

    def test_a_given_effort_is_certified(self):
        certificate = self.certified("preload: {B2: -20}\n")
        self.check(certificate, 0)
        certificate["pose_task"]["points"][1][0] = "1/2"
        self.check(certificate, 1)

    def test_a_law_by_cells_is_certified_and_mutations_are_not(self):
        certificate = self.certified("preload: controlled\nknows_load: true\n")
        cells = certificate["pose_task"]["law"]["cells"]
        self.check(certificate, 0)
        lower, upper, efforts, gains = cells[0]
        for wrong in ("5", "-3", "200"):
            cells[0] = [lower, upper, [[wrong]], gains]
            self.check(certificate, 1)
        cells[0] = [lower, lower, efforts, gains]  # some poses are in no cell
        self.check(certificate, 1)
        cells[0] = [lower, upper, efforts, gains]
        certificate["pose_task"]["loads_within"] = [[0, "40", "0"]]
        self.check(certificate, 1)

    def test_efforts_of_a_law_have_to_join(self):
        """Two cells, each good alone with -20 N m and with 30 N m, between which contact is lost."""
        certificate = self.certified("preload: controlled\nknows_load: true\n")
        certificate["pose_task"]["loads_within"] = [[0, "5", "0"]]
        law = certificate["pose_task"]["law"]

        def of(first, second):
            left, right = [["-1/20", "9/20"], ["1/20", "3/5"]], [["1/20", "9/20"], ["3/20", "3/5"]]
            law["cells"] = [[*left, [[first]], []], [*right, [[second]], []]]
            return certificate

        for efforts in (("-20", "-20"), ("30", "30"), ("-20", "-22")):
            self.check(of(*efforts), 0)
        self.check(of("-20", "30"), 1)

    def test_a_law_of_two_efforts_is_certified(self):
        mechanism = FiveBar(random.Random(5))
        self.assertEqual(len(mechanism.free), 2)
        (self.folder / "m.yaml").write_text(mechanism.text(), encoding="utf-8")
        box = mechanism.box
        task = f"format: 1\nbox: {{x: {box[0]}, y: {box[1]}}}\npreload: controlled\nmin_couple: 20\n"
        (self.folder / "t.yaml").write_text(task, encoding="utf-8")
        self.run_program("verify", "m.yaml", "t.yaml", "--certificate", "c.cert", "--quiet", "-o", "out")
        self.run_program("check", "m.yaml", "c.cert")
        certificate = json.loads((self.folder / "c.cert").read_text(encoding="utf-8"))
        offset, slope = mechanism.reactions([sum(side) / 2 for side in box])["M_A1"]
        turns = fractions.Fraction(-offset / slope[0])  # of the first motor alone, M_A1 is zero in the middle of the task
        for cell in certificate["pose_task"]["law"]["cells"]:
            cell[2] = [[str(turns), "0"]]
        (self.folder / "c.cert").write_text(json.dumps(certificate), encoding="utf-8")
        self.run_program("check", "m.yaml", "c.cert", status=1)

    def test_cells_that_choose_other_cables_are_certified(self):
        for name in ("point", "three_cables"):
            model = EXAMPLES / "cables" / f"{name}.yaml"
            side = "0.6" if name == "point" else "0.1"
            task = f"format: 1\nbox: {{x: [-{side}, {side}], y: [-{side}, {side}]}}\npreload: controlled\n"
            (self.folder / "t.yaml").write_text(task, encoding="utf-8")
            self.run_program("verify", model, "t.yaml", "--certificate", "c.cert", "--quiet", "-o", "out")
            self.run_program("check", model, "c.cert")
        self.run_program(
            "verify", EXAMPLES / "cables" / "point.yaml", EXAMPLES / "cables" / "task_of_point.yaml",
            "--certificate", "c.cert", "--quiet", "-o", "out",
        )  # fmt: skip
        certificate = json.loads((self.folder / "c.cert").read_text(encoding="utf-8"))
        cell = next(cell for cell in certificate["pose_task"]["law"]["cells"] if len(cell) > 4)
        right = cell[4]
        self.expect(certificate, 0, EXAMPLES / "cables" / "point.yaml")
        for wrong in ([right[0], right[0]], right[:1], [*right, "K3"], ["K9", right[1]]):
            cell[4] = wrong
            self.expect(certificate, 1 if len(wrong) == 2 else 2, EXAMPLES / "cables" / "point.yaml")
        cell[4] = right
        cell[2] = [["99", "5"]]
        self.expect(certificate, 1, EXAMPLES / "cables" / "point.yaml")

    def refuted(self, mechanism, more):
        (self.folder / "m.yaml").write_text(mechanism.text(), encoding="utf-8")
        box = mechanism.box
        return self.certificate_of(f"box: {{x: {box[0]}, y: {box[1]}}}\n{more}")

    def refuted_cables(self, more):
        shutil.copy(SOURCE / "examples/cables/three_cables.yaml", self.folder / "m.yaml")
        return self.certificate_of("box: {x: [0, 0.8], y: [0, 0.8]}\n" + more)

    def certificate_of(self, task):
        """Of a task that `verify` refutes."""
        (self.folder / "t.yaml").write_text("format: 1\n" + task, encoding="utf-8")
        self.run_program("verify", "m.yaml", "t.yaml", "--certificate", "c.cert", "--quiet", "-o", "out", status=1)
        return json.loads((self.folder / "c.cert").read_text(encoding="utf-8"))

    def expect_rejected(self, certificate, what, change):
        wrong = json.loads(json.dumps(certificate))
        change(wrong["pose_task"]["refutation"])
        with self.subTest(wrong=what):
            self.expect(wrong, 1)

    def expect(self, certificate, status, model="m.yaml"):
        (self.folder / "c.cert").write_text(json.dumps(certificate), encoding="utf-8")
        return self.run_program("check", model, "c.cert", status=status).stdout

    def mutations(self, certificate):
        """Each with what is wrong: a pattern less, multipliers, signs, poses, ranges."""
        first = certificate["pose_task"]["refutation"]["patterns"][0]
        yield "a pattern is missing", lambda own: own["patterns"].pop()
        yield "multipliers", lambda own: own["patterns"][0]["rows"][0].update(multiplier="1000")
        yield "negative", lambda own: own["patterns"][0]["rows"][0].update(multiplier="-1")
        yield "a row is missing", lambda own: own["patterns"][0]["rows"].pop(0)
        yield "another sign", lambda own: own["patterns"][0]["rows"][0].update(sign=-first["rows"][0]["sign"])
        yield "not of the task", lambda own: own["patterns"][0]["rows"][0].update(at=["9/10", "1/10"])
        yield "a load", lambda own: own["patterns"][0]["rows"][0].update(load=["1000", "0"])
        yield "another reaction", lambda own: own["patterns"][0]["rows"][0].update(reaction="M_P")
        yield "a smaller range", lambda own: own["ranges"][0].__setitem__(0, "0")
        yield "an empty range", lambda own: own["ranges"].__setitem__(0, own["ranges"][0][::-1])
        yield "no effort of the model", lambda own: own["joints"].__setitem__(0, "A1")
        yield "other efforts are chosen", lambda own: own["patterns"][0].update(joints=[])

    def test_forces_hold_between_cells_that_choose_other_cables(self):
        """Two cables pull the pin to the right and two to the left: where others are chosen, its force may turn over."""
        (self.folder / "m.yaml").write_text(BAR_ON_FOUR_CABLES, encoding="utf-8")
        task = "format: 1\nbox: {theta: [85 deg, 95 deg]}\npreload: controlled\nmin_force: 4\n"
        (self.folder / "t.yaml").write_text(task, encoding="utf-8")
        self.run_program("verify", "m.yaml", "t.yaml", "--certificate", "c.cert", "--quiet", "-o", "out")
        certificate = json.loads((self.folder / "c.cert").read_text(encoding="utf-8"))

        def of(to_right, to_left, later_to_right, later_to_left):
            first = [["1"], ["3/2"], [[to_right, to_left, to_left]], [], ["K1", "K3", "K4"]]
            second = [["3/2"], ["2"], [[later_to_right, later_to_right, later_to_left]], [], ["K1", "K2", "K3"]]
            certificate["pose_task"]["law"] = {"joints": ["K1", "K2", "K3"], "cells": [first, second]}
            return certificate

        self.expect(of("50", "5", "40", "5"), 0, "m.yaml")
        self.expect(of("5", "50", "5", "40"), 0, "m.yaml")
        self.expect(of("50", "5", "5", "40"), 1, "m.yaml")

    def test_refutations_are_certified_and_mutations_are_not(self):
        """Multipliers that another program accepts, with statics and intervals of its own."""
        seen = 0
        for seed, more in REFUTED:
            with self.subTest(seed=seed):
                mechanism = FiveBar(random.Random(seed))
                certificate = self.refuted(mechanism, more)
                self.assertIn("no efforts keep the task clear", self.expect(certificate, 0))
                for what, change in self.mutations(certificate):
                    self.expect_rejected(certificate, what, change)
                    seen += 1
        self.assertGreater(seen, 15)

    def test_refutations_with_cables_are_certified_and_mutations_are_not(self):
        """Tensions of which each pattern says which are chosen."""
        certificate = self.refuted_cables("preload: controlled\n")
        self.assertIn("no efforts keep the task clear", self.expect(certificate, 0))
        own = certificate["pose_task"]["refutation"]
        chosen = own["patterns"][0]["joints"]
        other = next(name for name in own["joints"] if name not in chosen)
        changes = {
            "another cable is chosen": lambda own: own["patterns"][0].update(joints=[other]),
            "two are chosen": lambda own: own["patterns"][0]["joints"].append(other),
            "none is chosen": lambda own: own["patterns"][0].update(joints=[]),
            "a smaller range": lambda own: own["ranges"][own["joints"].index(chosen[0])].__setitem__(1, "1"),
            "no cable": lambda own: own["joints"].__setitem__(own["joints"].index(other), "P"),
            "a negative multiplier": lambda own: own["patterns"][0]["rows"][0].update(multiplier="-1"),
            "the other bound": lambda own: own["patterns"][0]["rows"][0].update(sign=-1),
            "not of the task": lambda own: own["patterns"][0]["rows"][0].update(at=["9/10", "1/10"]),
        }
        for what, change in changes.items():
            self.expect_rejected(certificate, what, change)

    def test_one_choice_for_all_poses_is_of_the_cables_that_the_model_holds(self):
        """Which tensions are held matters then."""
        certificate = self.refuted_cables("")
        self.assertIn("no efforts keep the task clear", self.expect(certificate, 0))
        own = certificate["pose_task"]["refutation"]
        self.assertEqual(own["joints"], ["K3"])
        own["joints"], own["ranges"] = ["K3", "K2"], [*own["ranges"], ["5", "60"]]
        own["patterns"][0]["joints"] = ["K2"]
        self.assertIn("not those that the model holds", self.expect(certificate, 1))

    def test_a_task_that_leaves_the_reach_fails_there(self):
        """Not by efforts that exclude each other: there are none."""
        text = (SOURCE / "examples/studies/antagonistic.yaml").read_text(encoding="utf-8")
        (self.folder / "m.yaml").write_text(text, encoding="utf-8")
        (self.folder / "t.yaml").write_text("format: 1\nbox: {x: [-0.3, 0.4], y: [0.3, 0.7]}\npreload: controlled\n", encoding="utf-8")
        answer = json.loads(self.run_program("verify", "m.yaml", "t.yaml", "--json", "--quiet", "-o", "out", status=1).stdout)
        self.assertEqual(answer["verdict"], "refuted")
        self.assertEqual(answer["witness"]["reason"], "the mechanism does not reach it")
        x, y = answer["witness"]["at"]
        self.assertGreater(math.hypot(x - 0.5, y), 1)  # two links of 0.5 from A2


if __name__ == "__main__":
    unittest.main()
