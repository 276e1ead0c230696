"""The four cases of docs/guide/preload.md against linear programs of an independent solver (HiGHS, by SciPy), with statics
of their own (preload_statics.py), and against closed forms. CLEARLOCI_PRELOAD_POSES is the number of random poses of each map
of zones (2000 by default; 100000 in a long run). Each case prints its figures."""

import json
import math
import os
import time
import unittest

import numpy
from preload_statics import Mechanism, dyad
from program import SOURCE, InOwnFolder

try:
    from scipy.optimize import linprog
    from scipy.sparse import coo_matrix
except ImportError:  # a package of its own
    linprog = None

POSES = int(os.environ.get("CLEARLOCI_PRELOAD_POSES", "2000"))
EXAMPLES = SOURCE / "examples"
SIGNS = [(first, second, third) for first in (1, -1) for second in (1, -1) for third in (1, -1)]


def depths(blocks, limits):
    """Of each block of rows offset + slope . v >= 0 the largest d at most 1 for which some v within the limits has offset +
    slope . v >= d |row|: linear programs of HiGHS, many at a time."""
    found = []
    size = len(limits) + 1
    bounds = [*limits, (None, 1)]
    for first in range(0, len(blocks), 4000):
        part = blocks[first : first + 4000]
        sides, values, rows, columns = [], [], [], []
        for i, block in enumerate(part):
            for offset, slope in block:
                width = abs(offset) + sum(abs(own) * max(map(abs, limit)) for own, limit in zip(slope, limits)) or 1.0
                for k, own in enumerate([*slope, -width]):
                    values.append(-own)
                    rows.append(len(sides))
                    columns.append(i * size + k)
                sides.append(offset)
        matrix = coo_matrix((values, (rows, columns)), shape=(len(sides), size * len(part))).tocsr()
        costs = [0.0] * (size - 1) + [-1.0]
        answer = linprog(costs * len(part), A_ub=matrix, b_ub=sides, bounds=bounds * len(part), method="highs")
        if answer.status != 0:
            raise AssertionError(answer.message)
        found.extend(answer.x[size - 1 :: size])
    return numpy.array(found)


def holds(zone, poses):
    """Which poses are inside a zone's polygon with its holes."""
    inside = numpy.zeros(len(poses), dtype=bool)
    x, y = poses[:, 0], poses[:, 1]
    for ring in zone["polygon"]:
        own = numpy.array(ring)
        for (x0, y0), (x1, y1) in zip(own, numpy.roll(own, -1, axis=0)):
            if y0 != y1:
                inside ^= ((y0 > y) != (y1 > y)) & (x < x0 + (y - y0) * (x1 - x0) / (y1 - y0))
    return inside


def distance(zones, pose):
    """From a pose to the next border of a zone."""
    least = math.inf
    for zone in zones:
        for ring in zone["polygon"]:
            start = numpy.array(ring)
            way = numpy.roll(start, -1, axis=0) - start
            length = numpy.maximum((way**2).sum(axis=1), 1e-300)
            along = numpy.clip(((pose - start) * way).sum(axis=1) / length, 0, 1)
            least = min(least, numpy.linalg.norm(start + along[:, None] * way - pose, axis=1).min())
    return least


@unittest.skipIf(linprog is None, "without SciPy (python3-scipy)")
class Zones(InOwnFolder):
    def zones_of(self, file):
        self.run_program("zones", EXAMPLES / file, "--quiet", "-o", "out")
        answer = json.loads((self.folder / "out" / "zones.json").read_text(encoding="utf-8"))
        self.assertTrue(answer["complete"])
        return answer

    @staticmethod
    def random_poses(answer, seed):
        lower, upper = numpy.array(answer["box"]).T
        return numpy.random.default_rng(seed).uniform(lower, upper, (POSES, 2))

    def expect_agreement(self, name, answer, poses, told, solved):
        """That what zones tell is what is solved at every pose that is farther from a border than the polygons' tolerance."""
        unlike = [i for i in range(len(poses)) if told[i] is not None and told[i] != solved[i]]
        far = [i for i in unlike if distance(answer["zones"], poses[i]) > 2 * answer["tolerance"]]
        self.assertFalse(far, [(tuple(poses[i]), told[i], solved[i]) for i in far[:3]])
        inside = sum(own is not None for own in told)
        self.assertGreater(inside, 0.3 * len(poses))
        print(f"{name}: {inside} poses in zones, 0 contradictions, {len(unlike)} nearer to a border than two tolerances")

    def test_a_third_leg_has_the_patterns_of_linear_programs(self):
        start = time.monotonic()
        answer = self.zones_of("studies/third_leg.yaml")
        limit, force = 40, (30, -100)
        bases = {"1": ((0, 0), 0.45, 0.5, -1), "2": ((0.5, 0), 0.45, 0.5, 1), "3": ((0.2, 0.9), 0.4, 0.55, 1)}
        statics = Mechanism(
            7,
            [(f"A{i}", 0, 2 * i - 1, f"A{i}") for i in (1, 2, 3)]
            + [(f"B{i}", 2 * i - 1, 2 * i, f"B{i}") for i in (1, 2, 3)]
            + [("P", 2, 4, "P"), ("Q", 6, 4, "P")],
            ["A1", "A2", "A3"],
            [],
        )
        modes = {"left": 1, "right": -1}
        zones = [own for own in answer["zones"] if own["working_mode"] == {"B1": "right", "B2": "left", "B3": "left"}]
        self.assertTrue(all(modes[own["working_mode"][f"B{i}"]] == bases[str(i)][3] for own in zones for i in (1, 2, 3)))
        poses = self.random_poses(answer, 1)
        told = [None] * len(poses)
        for zone in zones:
            efforts = zone["preload"]["efforts"]["A3"]["ranges"]
            patterns = {tuple(own["signs"][name]["M"] for name in ("A1", "A2", "A3")) for own in efforts}
            for i in numpy.flatnonzero(holds(zone, poses)):
                told[i] = patterns
        blocks, of_pose = [], []
        for i, at in enumerate(poses):
            points = {"P": tuple(at)}
            for k, (base, first, second, side) in bases.items():
                points["A" + k] = base
                points["B" + k] = dyad(base, at, first, second, side)
            if told[i] is None or any(own is None for own in points.values()):
                continue
            reactions = statics.affine(points, [(4, "P", force)], ["M_A3"])
            for signs in SIGNS:
                own = [reactions[f"M_A{k + 1}"] for k in range(3)]
                blocks.append([(s * offset, s * slope) for s, (offset, slope) in zip(signs, own)])
            of_pose.append(i)
        depth = depths(blocks, [(-limit, limit)]).reshape(-1, len(SIGNS))
        solved = [None] * len(poses)
        for i, own in zip(of_pose, depth):
            solved[i] = {signs for signs, deep in zip(SIGNS, own) if deep > 1e-9}
        self.expect_agreement("5R with a third leg", answer, poses, told, solved)
        print(f"  {len(blocks)} linear programs, {time.monotonic() - start:.0f} s")

    def cables(self, file, anchors, ends, force, bounds, seed):
        """A zone is feasible where a linear program over all tensions is. The mechanism has a moment if `ends` are apart."""
        answer = self.zones_of(file)
        poses = self.random_poses(answer, seed)
        told = [None] * len(poses)
        for zone in answer["zones"]:
            for i in numpy.flatnonzero(holds(zone, poses)):
                told[i] = zone["preload"]["feasible"]
        solved = [None] * len(poses)
        least, most = bounds
        names = range(len(anchors))
        apart = any(end != (0, 0) for end in ends)
        answers = []
        for i in numpy.flatnonzero([own is not None for own in told]):
            columns = []
            for k in names:
                way = numpy.array(anchors[k]) - poses[i] - ends[k]
                way = way / numpy.linalg.norm(way)
                columns.append([*way, ends[k][0] * way[1] - ends[k][1] * way[0]][: 3 if apart else 2])
            solved_here = linprog(
                numpy.zeros(len(anchors)),
                A_eq=numpy.array(columns).T,
                b_eq=[-force[0], -force[1], 0][: 3 if apart else 2],
                bounds=[(least, most)] * len(anchors),
                method="highs",
            )
            self.assertIn(solved_here.status, (0, 2))
            solved[i] = solved_here.status == 0
            answers.append(solved[i])
        self.assertIn(True, answers)
        self.assertIn(False, answers)
        self.expect_agreement(file, answer, poses, told, solved)
        return answer, poses, told

    def test_three_cables_on_a_point(self):
        """Closed form: tensions are a solution plus c times lambda_i l_i, with the barycentric coordinates lambda and the
        lengths l, so that each bound of a tension is one of c."""
        anchors, weight = [(-1, 1), (1, 1.2), (0.2, -1)], 2 * 9.81
        bounds = [(5, 60), (5, 60), (5, 40)]
        answer = self.zones_of("cables/three_cables.yaml")
        poses = self.random_poses(answer, 2)
        told, solved, programs = [None] * len(poses), [None] * len(poses), [None] * len(poses)
        for zone in answer["zones"]:
            for i in numpy.flatnonzero(holds(zone, poses)):
                told[i] = zone["preload"]["feasible"]
        for i in numpy.flatnonzero([own is not None for own in told]):
            ways = numpy.array(anchors) - poses[i]
            lengths = numpy.linalg.norm(ways, axis=1)
            share = numpy.linalg.solve(numpy.vstack([numpy.array(anchors).T, numpy.ones(3)]), [*poses[i], 1.0])
            null = share * lengths
            # One solution: the point hangs on two cables, whose tensions are a quotient of two-by-two determinants.
            across = (ways[0][0] * ways[1][1] - ways[0][1] * ways[1][0]) / (lengths[0] * lengths[1])
            hanging = numpy.array(
                [-ways[1][0] * weight / lengths[1] / across, ways[0][0] * weight / lengths[0] / across, 0.0]
            )
            low, high = -math.inf, math.inf
            for (least, most), start, slope in zip(bounds, hanging, null):
                ends = sorted([(least - start) / slope, (most - start) / slope])
                low, high = max(low, ends[0]), min(high, ends[1])
            solved[i] = low < high
            program = linprog(
                [0, 0, 0], A_eq=(ways / lengths[:, None]).T, b_eq=[0, weight], bounds=bounds, method="highs"
            )
            programs[i] = program.status == 0
        self.expect_agreement("three cables, closed form", answer, poses, told, solved)
        self.expect_agreement("three cables, linear programs", answer, poses, told, programs)

    def test_four_cables_on_a_point(self):
        anchors = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
        self.cables("cables/point.yaml", anchors, [(0, 0)] * 4, (0, -2 * 9.81), (5, 100), 3)

    def test_four_cables_on_a_platform(self):
        anchors = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
        c, s = math.cos(math.radians(5)), math.sin(math.radians(5))
        ends = [(c * x - s * y, s * x + c * y) for x, y in [(-0.2, 0.1), (0.2, 0.1), (0.2, -0.1), (-0.2, -0.1)]]
        self.cables("cables/platform_slice.yaml", anchors, ends, (0, -20), (5, 60), 4)


@unittest.skipIf(linprog is None, "without SciPy (python3-scipy)")
class FourMotors(InOwnFolder):
    """The 4-RRR with four motors over (x, y, phi), under 20 N in any direction."""

    TASK = (
        "format: 1\nbox: {x: [-0.02, 0.02], y: [-0.02, 0.02], phi: [-2 deg, 2 deg]}\n"
        "loads_within: [{load: 1, radius: 20}]\n"
    )
    BASES = [(-0.7, -0.6), (0.7, -0.6), (0.7, 0.6), (-0.7, 0.6)]

    def lines(self, at):
        """Couples of the other motors: of 10 N downwards, of 1 N m of A4, and of 1 N along x and y."""
        x, y, phi = at
        points = {"P": (x, y)}
        for k, base in enumerate(self.BASES):
            turn = phi + math.radians([225, 315, 45, 135][k])
            end = (x + 0.15 * math.cos(turn), y + 0.15 * math.sin(turn))
            points[f"A{k + 1}"], points[f"C{k + 1}"] = base, end
            points[f"B{k + 1}"] = dyad(base, end, 0.55, 0.55, 1)
        legs = range(1, 5)
        statics = Mechanism(
            10,
            [(f"A{k}", 0, 2 * k - 1, f"A{k}") for k in legs]
            + [(f"B{k}", 2 * k - 1, 2 * k, f"B{k}") for k in legs]
            + [(f"C{k}", 2 * k, 9, f"C{k}") for k in legs],
            [f"A{k}" for k in legs],
            [],
        )
        found = [statics.affine(points, [(9, "P", own)], ["M_A4"]) for own in ((0, -10), (1, 0), (0, 1))]
        return [
            [found[0][f"M_A{k}"][0], found[0][f"M_A{k}"][1][0], found[1][f"M_A{k}"][0], found[2][f"M_A{k}"][0]]
            for k in (1, 2, 3)
        ]

    def least_of_programs(self, poses, signs):
        rows, sides = [], []
        for at in poses:
            for sign, (offset, slope, along_x, along_y) in zip(signs, self.lines(at)):
                # sign (offset + slope e) >= 20 |(along_x, along_y)|, for e = first - second
                rows.append([-sign * slope, sign * slope])
                sides.append(sign * offset - 20 * math.hypot(along_x, along_y))
        answer = linprog([1, 1], A_ub=rows, b_ub=sides, bounds=[(0, None)] * 2, method="highs")
        return answer.fun if answer.status == 0 else math.inf

    def expect_free(self, effort, patterns):
        """At random poses of the task the couples keep the signs of one pattern, and have efforts by a linear program each."""
        count = POSES if POSES > 2000 else 400
        span = numpy.array([0.02, 0.02, math.radians(2)])
        blocks, kept = [], set(patterns)
        for at in numpy.random.default_rng(5).uniform(-span, span, (count, 3)):
            rows = []
            for offset, slope, along_x, along_y in self.lines(at):
                rows.append((offset, slope, 20 * math.hypot(along_x, along_y)))
            kept &= {
                signs
                for signs in patterns
                if all(s * (offset + slope * effort) > push for s, (offset, slope, push) in zip(signs, rows))
            }
            blocks += [[(s * o - push, [s * b]) for s, (o, b, push) in zip(signs, rows)] for signs in patterns]
        self.assertEqual(len(kept), 1)
        deep = depths(blocks, [(-1000, 1000)]).reshape(-1, len(patterns))
        self.assertTrue((deep[:, patterns.index(kept.pop())] > 0).all())
        print(f"4-RRR: free at {count} random poses with {effort:.4f} N m, {len(blocks)} linear programs")

    def test_the_least_preload_is_that_of_linear_programs(self):
        (self.folder / "t.yaml").write_text(self.TASK, encoding="utf-8")
        start = time.monotonic()
        self.run_program("verify", EXAMPLES / "studies" / "four_rrr.yaml", "t.yaml", "--quiet", "-o", "out")
        took = time.monotonic() - start
        preload = json.loads((self.folder / "out" / "verify.json").read_text(encoding="utf-8"))["preload"]
        steps = [-1, -0.5, 0, 0.5, 1]
        poses = [(0.02 * a, 0.02 * b, math.radians(2) * c) for a in steps for b in steps for c in steps]
        patterns = {signs: self.least_of_programs(poses, signs) for signs in SIGNS}
        best = min(patterns.values())
        least, most = preload["size"]
        self.assertLessEqual(most, 1.01 * least)
        self.assertGreaterEqual(most, best * (1 - 1e-6))
        self.assertLessEqual(least, best * 1.01)
        for pattern in preload["patterns"]:
            told = [pattern["signs"].get(f"M_A{k}") for k in (1, 2, 3)]  # of some one sign is enough to refute it
            own = min(size for signs, size in patterns.items() if all(b in (None, a) for a, b in zip(signs, told)))
            if pattern["verdict"] == "verified":
                self.assertGreaterEqual(pattern["size"][1], own * (1 - 1e-6))
            if pattern["verdict"] == "refuted":
                self.assertEqual(own, math.inf)
        self.expect_free(preload["value"]["A4"], SIGNS)
        print(f"4-RRR: least preload between {least:.4f} and {most:.4f} N m, linear programs {best:.4f}, {took:.1f} s")


class Antagonistic(InOwnFolder):
    """The five-bar with a motor of free effort: ranges against values that were tried by hand."""

    def asked(self, task):
        words = ("verify", EXAMPLES / "studies" / "antagonistic.yaml", EXAMPLES / "tasks" / task)
        self.run_program(*words, "--quiet", "-o", "out")
        return json.loads((self.folder / "out" / "verify.json").read_text(encoding="utf-8"))["preload"]

    @staticmethod
    def verdict(ranges, effort):
        """Of one effort: whether a range holds it, whether all lie beside it for certain."""
        for own in ranges:
            lower, upper = own["from"], own["to"]
            if lower[1] <= effort <= upper[0]:
                return True
            if lower[0] <= effort <= upper[1]:
                return None
        return False

    def test_ranges_of_a_box_and_of_a_path(self):
        preload = self.asked("preload.yaml")
        for effort in (-60, -40, -20, -10, 20, 40, 60):
            self.assertIs(self.verdict(preload["ranges"], effort), True, effort)
        for effort in (-5, 0, 5, 10, 100):
            self.assertIs(self.verdict(preload["ranges"], effort), False, effort)
        ends = [end for own in preload["ranges"] for end in (own["from"], own["to"])]
        near = [end for end in ends if max(map(abs, end)) < 1000]
        self.assertEqual(len(near), 4)
        for low, high in near:
            self.assertLess(high - low, 0.1)
        self.assertLess(preload["size"][1] - preload["size"][0], 0.1)
        print(f"five-bar: ends {near}, smallest size {preload['size']}")
        path = self.asked("pick_and_place.yaml")
        self.assertEqual(path["size"], [0, 0])
        for effort in (-40, -20):
            self.assertIs(self.verdict(path["ranges"], effort), False, effort)


if __name__ == "__main__":
    unittest.main()
