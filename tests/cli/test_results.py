"""What the commands print and write: valid, complete, and the same bytes from run to run."""

import csv
import json
import math
import re
import unittest

import four_bar
from program import FIVE_BAR, FOUR_BAR, PICK_AND_PLACE, SOURCE, InOwnFolder


def without_timing(text):
    """loci.json's text with the seconds taken out; everything else is to be the same bytes."""
    return re.sub(r'"timing": \{[^}]*\}', '"timing": {}', text)


class Loci(InOwnFolder):
    def test_default_files(self):
        process = self.run_program("loci", FIVE_BAR)
        folder = self.folder / "out" / "five_bar"
        self.assertEqual(
            sorted(path.name for path in folder.iterdir()), ["loci.csv", "loci.json", "loci.png", "loci.svg"]
        )
        self.assertEqual(process.stderr, "", "no progress bar where standard error is no terminal")
        self.assertIn("contact", process.stdout)
        with open(folder / "loci.csv", newline="") as file:
            self.assertGreater(len(list(csv.reader(file))), 50)

    def test_json_is_the_file(self):
        process = self.run_program("loci", FIVE_BAR, "--json", "-o", "here")
        written = (self.folder / "here" / "loci.json").read_text(encoding="utf-8")
        self.assertEqual(process.stdout, written)
        result = json.loads(written)
        self.assertEqual(result["format"], 1)
        self.assertTrue(result["complete"])
        self.assertEqual(result["parameters"], {"L": "1/2", "d": "1/2"})
        self.assertEqual(result["coordinates"], ["x", "y"])
        self.assertEqual(list(result["timing"]), ["symbolic", "elimination", "tracing"])
        for curve in result["curves"]:
            self.assertTrue(curve["arcs"], curve["id"])
            for arc in curve["arcs"]:
                self.assertGreaterEqual(len(arc["points"]), 2)

    def test_the_papers_circles(self):
        result = json.loads(self.run_program("loci", FIVE_BAR, "--json", "--working-mode", "all").stdout)
        lost = {}
        for curve in result["curves"]:
            if curve["kind"] == "contact-loss":
                circle = curve["closed_form"]["circle"]
                for vanishing in curve["vanishing"]:
                    if vanishing["quantity"] == "f":
                        lost.setdefault(vanishing["joint"], set()).add((*circle["centre"], circle["radius"]))
        leg_1 = {("1/2", "1/2", "1/2"), ("1/2", "-1/2", "1/2")}
        leg_2 = {("0", "1/2", "1/2"), ("0", "-1/2", "1/2")}
        self.assertEqual(lost, {"A1": leg_1, "B1": leg_1, "P": leg_1, "B2": leg_2, "A2": leg_2})

    def test_same_bytes_from_run_to_run(self):
        options = ("--export", "svg,pdf,png,csv,dxf,geojson,vtk", "--working-mode", "all")
        untimed = lambda name, data: without_timing(data.decode()) if name == "loci.json" else data
        names, _ = self.written_twice("loci", FIVE_BAR, *options, but_for=untimed)
        self.assertGreater(len(names), 7)

    def test_overrides(self):
        result = json.loads(self.run_program("loci", FIVE_BAR, "--json", "--set", "L=0.4", "--set", "d=1/3").stdout)
        self.assertEqual(result["parameters"], {"L": "2/5", "d": "1/3"})

    def test_every_command_prints_the_parameters(self):
        spring = self.model(lambda text: text.replace("  d: L ", "  d: L\n  k: 2 N/mm "))
        line = "\nL = 0.4, d = 0.4, k = 3000 N/m\n"
        override = ("--set", "L=0.4", "--set", "k=3")
        task = SOURCE / "examples" / "tasks" / "pick_and_place.yaml"
        for words in (
            ("loci", spring),
            ("zones", spring),
            ("pose", spring, "--at", "0.25,-0.6"),
            ("pose", spring, "--at", "0.25,-0.6", "--working-mode", "all"),
            ("validate", spring, "--grid", "20x20"),
            ("error", spring, "--grid", "20x20"),
            ("verify", spring, task),
        ):
            process = self.run_program(*words, *override, status=1 if words[0] == "verify" else 0)
            self.assertIn(line, "\n" + process.stdout, words)
            self.assertEqual(process.stdout.count(line.strip()), 1, words)
            told = json.loads(
                self.run_program(*words, *override, "--json", status=process.returncode).stdout
            )["parameters"]
            self.assertEqual(told, {"L": "2/5", "d": "2/5", "k": "3000 N/m"}, words)
        motion = self.run_program("trajectory", *PICK_AND_PLACE).stdout
        self.assertRegex(motion.splitlines()[1], r"^\w+ = [^,]+(, \w+ = .+)*$")

    def test_chosen_joint_and_quantity(self):
        result = json.loads(self.run_program("loci", FIVE_BAR, "--json", "--joint", "B2", "--quantity", "f").stdout)
        reactions = [curve for curve in result["curves"] if curve["vanishing"]]
        self.assertEqual({curve["closed_form"]["circle"]["centre"][0] for curve in reactions}, {"0"})
        for curve in reactions:  # which may bear the reactions of other joints too
            self.assertIn({"joint": "B2", "quantity": "f"}, curve["vanishing"])

    def test_quiet(self):
        process = self.run_program("loci", FIVE_BAR, "--quiet")
        self.assertEqual((process.stdout, process.stderr), ("", ""))
        self.assertTrue((self.folder / "out" / "five_bar" / "loci.svg").exists())

    def test_a_time_limit_is_kept(self):
        process = self.run_program("loci", FIVE_BAR, "--time-limit", "1e-6", "-o", "here", status=3)
        self.assertRegex(process.stderr, r"\Aclearloci: [^\n]*time limit[^\n]*\n\Z")
        result = json.loads((self.folder / "here" / "loci.json").read_text(encoding="utf-8"))
        self.assertFalse(result["complete"])


class LimitsOfZones(InOwnFolder):
    def test_where_the_ends_of_a_spring_meet_is_named(self):
        model = self.folder / "pull.yaml"
        model.write_text("""\
format: 1
workspace: {s: [-0.5, 0.5]}
points: {O: [0, 0], R: [s, 0]}
links: {block: {points: [R]}}
joints: {Z: {prismatic: [ground, block], at: R, axis: [1, 0], actuated: true, clearance: {axial: 1e-4}}}
springs: [{name: Pull, links: [ground, block], at: [O, R], stiffness: 100, free_length: 0.1}]
end_effector: {link: block, at: R}
loads: [{link: block, at: R, force: [-5, 0]}]
""", encoding="utf-8")
        words = "spring Pull, whose ends O and R meet"
        process = self.run_program("zones", model)
        self.assertEqual(process.stdout.count("workspace boundary, limit of the " + words), 2)
        ends = [end for zone in json.loads(self.run_program("zones", model, "--json").stdout)["zones"] for end in zone["ends"]]
        self.assertEqual({end["kind"] for end in ends if "limit" in end}, {"workspace-boundary"})
        self.assertEqual([end["limit"] for end in ends if "limit" in end], [words, words])
        # 100 N/m (0.1 m - s) = 5 N at s = 0.05 m, and on the other side at -0.15 m.
        self.assertEqual({round(end["at"], 6) for end in ends if "limit" not in end}, {0.05, -0.15})


class Equations(InOwnFolder):
    def test_json(self):
        sheet = json.loads(self.run_program("equations", FIVE_BAR, "--json").stdout)
        self.assertEqual(
            sheet["unknowns"],
            "fA1x fA1y fB1x fB1y fPx fPy fB2x fB2y fA2x fA2y MA1 MA2".split(),
        )
        self.assertEqual([len(row) for row in sheet["matrix"]], [12] * 12)
        self.assertEqual(len(sheet["loads"]), 12)
        self.assertEqual(list(sheet["numerators"]), sheet["unknowns"])
        self.assertIsInstance(sheet["determinant"], str)
        for numerator in sheet["numerators"].values():
            self.assertEqual(set(numerator), {"expression", "factors"})
            for factor in numerator["factors"]:
                self.assertTrue({"expression", "multiplicity", "cause", "implicit"} <= set(factor))
        # Paper (29): |A_MA1| = 100 (x - xB2) (y xB1 - yB1 x).
        self.assertEqual(sum(f["multiplicity"] for f in sheet["numerators"]["MA1"]["factors"]), 2)

    def test_every_language(self):
        for language in ("text", "latex", "c", "python", "matlab"):
            for extra in ((), ("--symbolic",)):
                self.assertIn(
                    "B2", self.run_program("equations", FIVE_BAR, "--language", language, *extra).stdout, language
                )

    def test_written_where_asked(self):
        self.run_program("equations", FIVE_BAR, "--language", "latex,python", "-o", "there", "--quiet")
        self.assertEqual(
            sorted(path.name for path in (self.folder / "there").iterdir()), ["equations.py", "equations.tex"]
        )

    def test_python_text_is_python(self):
        compile(self.run_program("equations", FIVE_BAR, "--language", "python").stdout, "equations.py", "exec")


class Pose(InOwnFolder):
    def test_balance(self):
        pose = json.loads(self.run_program("pose", FIVE_BAR, "--at", "0.25,-0.7", "--json").stdout)
        self.assertEqual(pose["at"], [0.25, -0.7])
        reactions = pose["reactions"]
        for component, load in (("fx", 0.0), ("fy", -100.0)):
            ground = reactions["A1"][component] + reactions["A2"][component]
            self.assertAlmostEqual(ground + load, 0, delta=1e-9)
        # The paper's mode, mirrored about x = 1/4 here: the legs bear the same.
        self.assertAlmostEqual(reactions["A1"]["fy"], 50, delta=1e-9)
        for point, (x, y) in pose["posture"].items():
            self.assertTrue(abs(x) < 2 and abs(y) < 2, point)
        self.assertEqual(set(reactions["B1"]), {"fx", "fy"})
        self.assertGreater(pose["condition"], 1)

    def test_working_mode(self):
        sides = [
            json.loads(self.run_program("pose", FIVE_BAR, "--at", "1/4,-7/10", "--working-mode", mode, "--json").stdout)
            for mode in ("left,left", "right,left")
        ]
        self.assertNotEqual(sides[0]["posture"]["B1"], sides[1]["posture"]["B1"])
        self.assertEqual(sides[0]["posture"]["B2"], sides[1]["posture"]["B2"])

    def test_table(self):
        text = self.run_program("pose", FIVE_BAR, "--at", "-0.1,-0.5").stdout
        self.assertIn("fx [N]", text)
        self.assertNotIn("-0 ", text)


class PoseError(InOwnFolder):
    def pose(self, at, *words):
        return json.loads(self.run_program("pose", FIVE_BAR, "--at", at, "--json", *words).stdout)

    def test_take_up_and_pose_error(self):
        pose = self.pose("0.25,-0.7")
        self.assertEqual(list(pose["take_up"]), ["A1", "B1", "P", "B2", "A2"])
        self.assertEqual(set(pose["take_up"]["A1"]), {"dx", "dy", "beta", "dtheta"})
        self.assertEqual(set(pose["take_up"]["B1"]), {"dx", "dy", "beta"})
        self.assertEqual(set(pose["pose_error"]), {"dalpha", "dx", "dy"})
        self.assertLess(pose["pose_error"]["dy"], 0)
        for key in ("dalpha", "dx", "dy"):
            self.assertLessEqual(abs(pose["pose_error"][key]), pose["worst_case"][key] * (1 + 1e-9))
        self.assertNotIn("iterated", pose)

    def test_iterated(self):
        iterated = self.pose("0.25,-0.7", "--iterate")["iterated"]
        self.assertLess(iterated["residual"], 1e-12)
        linear = self.pose("0.25,-0.7")["pose_error"]
        for key, value in linear.items():
            self.assertAlmostEqual(iterated["pose_error"][key] - value, iterated["beyond_linear"][key], delta=1e-15)

    def test_iterated_in_space(self):
        model = SOURCE / "examples" / "gough_stewart_poses.yaml"
        words = ("pose", model, "--at", "0.02,-0.03,0.5,0.1,0,0", "--iterate")
        pose = json.loads(self.run_program(*words, "--json").stdout)
        iterated = pose["iterated"]
        self.assertLess(iterated["residual"], 1e-12)
        self.assertEqual(len(pose["pose_error"]), 6)
        for key, value in pose["pose_error"].items():
            self.assertAlmostEqual(iterated["pose_error"][key] - value, iterated["beyond_linear"][key], delta=1e-15)
        self.assertIn("iterated", self.run_program(*words).stdout)

    def test_undefined_where_a_couple_alone_vanishes(self):
        # The pins bear 12 N; only the couple of the motor at A is zero.
        model = SOURCE / "tests" / "corpus" / "loci" / "scara.yaml"
        pose = json.loads(self.run_program("pose", model, "--at", "0,0.06", "--json").stdout)
        self.assertEqual(pose["vanishing"], [{"joint": "A", "quantity": "M"}])
        self.assertIsNone(pose["pose_error"])
        self.assertIsNotNone(pose["take_up"]["A"]["beta"])
        process = self.run_program("pose", model, "--at", "0,0.06")
        self.assertIn("undefined under the load: M = 0 at A\n", process.stdout)
        self.assertNotIn("contact is lost", process.stdout)

    def test_undefined_on_a_locus(self):
        # PB2 is vertical here: leg 1 bears nothing.
        pose = self.pose("0.8,-0.1")
        self.assertEqual(pose["undefined_take_up"], ["A1", "B1", "P"])
        self.assertIsNone(pose["pose_error"])
        self.assertIsNone(pose["take_up"]["P"]["beta"])
        process = self.run_program("pose", FIVE_BAR, "--at", "0.8,-0.1")
        self.assertIn("contact is lost at A1, B1, P; M = 0 at A1", process.stdout)
        lost = [(one["joint"], one["quantity"]) for one in pose["vanishing"]]
        self.assertEqual(lost, [("A1", "f"), ("A1", "M"), ("B1", "f"), ("P", "f")])
        self.assertFalse(pose["singular"])
        process = self.run_program("pose", FIVE_BAR, "--at", "0.8,-0.1", "--iterate", status=2)
        self.assertIn("undefined", process.stderr)

    def test_without_clearances(self):
        bare = self.model(lambda text: re.sub(r", +clearance: \{[^}]*\}", "", text))
        pose = json.loads(self.run_program("pose", bare, "--at", "0.25,-0.7", "--json").stdout)
        self.assertEqual(pose["take_up"], {})
        self.assertEqual(pose["pose_error"], {"dalpha": 0, "dx": 0, "dy": 0})


class Error(InOwnFolder):
    def test_files(self):
        formats = ("--export", "png,svg,pdf,csv,vtk", "--grid", "40x60")
        names, printed = self.written_twice("error", FIVE_BAR, *formats)
        self.assertIn("error in x", printed)
        self.assertEqual(len(names), 8 * 3 + 3)
        with open(self.folder / "first" / "error.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        result = json.loads((self.folder / "first" / "error.json").read_text(encoding="utf-8"))
        self.assertEqual(result["grid"], [40, 60])
        self.assertEqual(len(rows), result["modes"][0]["reachable"])
        for row in rows:
            for name in ("dx", "dy", "dalpha"):
                self.assertLessEqual(abs(float(row[name])), float(row["worst_" + name]) * (1 + 1e-9))
            self.assertLessEqual(float(row["dp"]), float(row["worst_dp"]) * (1 + 1e-9))
        # The row of a pose is what `pose` says there.
        row = rows[len(rows) // 2]
        pose = json.loads(self.run_program("pose", FIVE_BAR, "--at", f"{row['x']},{row['y']}", "--json").stdout)
        self.assertAlmostEqual(float(row["dx"]), pose["pose_error"]["dx"], delta=1e-12)
        self.assertAlmostEqual(float(row["worst_dalpha"]), pose["worst_case"]["dalpha"], delta=1e-12)

    def test_verify_says_yes_no_and_why(self):
        (self.folder / "good.yaml").write_text("format: 1\nbox: {x: [0.2, 0.3], y: [-0.7, -0.6]}\n", encoding="utf-8")
        (self.folder / "bad.yaml").write_text("format: 1\nbox: {x: [0.2, 0.3], y: [-0.7, 0.6]}\n", encoding="utf-8")
        good = json.loads(self.run_program("verify", FIVE_BAR, "good.yaml", "--json").stdout)
        self.assertTrue(good["verified"])
        self.assertEqual(good["zone"], "z1")
        self.assertLess(good["margin"], good["nearest"]["distance"])
        bad = json.loads(self.run_program("verify", FIVE_BAR, "bad.yaml", "--json", status=1).stdout)
        self.assertFalse(bad["verified"])
        self.assertTrue(0.2 <= bad["witness"]["at"][0] <= 0.3)
        self.assertIn("direct singularity", bad["witness"]["reason"])
        for name in ("verify.json", "verify.svg", "verify.png"):
            self.assertTrue((self.folder / "out" / "five_bar" / name).exists(), name)
        moved = json.loads(self.run_program("verify", FIVE_BAR, "good.yaml", "--fit", "best", "--json").stdout)
        self.assertGreater(moved["margin"], good["margin"])

    def test_tasks_are_placed_and_hold_for_all_designs_over_any_coordinates(self):
        (self.folder / "crank.yaml").write_text("format: 1\nbox: {theta: [55 deg, 65 deg]}\nmargin: 1 deg\n", encoding="utf-8")
        options = ["-o", self.folder / "crank", "--json"]
        moved = json.loads(self.run_program("verify", FOUR_BAR, "crank.yaml", "--fit", *options).stdout)
        self.assertNotIn("by", moved)
        self.assertNotEqual(moved["moved_by"], [0])
        again = json.loads(self.run_program("verify", FOUR_BAR, self.folder / "crank" / "moved.yaml", *options).stdout)
        self.assertEqual((again["task"], again["angle_margin"]), (moved["task"], moved["angle_margin"]))
        (self.folder / "platform.yaml").write_text(
            "format: 1\nbox: {x: [-0.01, 0.01], y: 0, z: 0.5, alpha: 0, beta: 0, gamma: 0}\ntolerances: {plate: 0.05}\n"
            "min_force: 189\n", encoding="utf-8")
        model = SOURCE / "examples" / "gough_stewart_poses.yaml"
        refuted = json.loads(self.run_program("verify", model, "platform.yaml", "--json", status=1).stdout)
        self.assertLessEqual(abs(refuted["witness"]["design"]["plate"] - 0.3), 0.05)

    def test_error_sizes_zone_by_zone(self):
        options = ["--grid", "150x200", "--export", "csv", "--zones", "--json", "-o", self.folder / "zoned"]
        mode = json.loads(self.run_program("error", FIVE_BAR, *options).stdout)["modes"][0]
        zones = json.loads(self.run_program("zones", FIVE_BAR, "--json", "-o", self.folder / "zoned").stdout)["zones"]
        self.assertEqual([z["id"] for z in mode["zones"]], [z["id"] for z in zones])
        self.assertEqual(sum(z["cells"] for z in mode["zones"]), mode["reachable"])
        cell = 1.5 / 150 * 2 / 200
        for counted, zone in zip(mode["zones"], zones):
            self.assertAlmostEqual(counted["cells"] * cell, zone["area"], delta=0.02)
        largest = [z["fields"]["worst_dp"]["largest"] for z in mode["zones"] if z["cells"]]
        self.assertEqual(max(largest), mode["fields"]["worst_dp"]["largest"])

    def test_all_working_modes(self):
        options = ("--working-mode", "all", "--grid", "20x20", "--no-loci", "--no-worst-case", "--json")
        result = json.loads(self.run_program("error", FIVE_BAR, *options).stdout)
        self.assertEqual(len(result["modes"]), 4)
        self.assertEqual(set(result["modes"][0]["fields"]), {"dx", "dy", "dalpha", "dp"})
        self.assertEqual(len(list((self.folder / "out" / "five_bar").glob("error-dx-*.png"))), 4)


class ErrorOverOneCoordinate(InOwnFolder):
    def setUp(self):
        super().setUp()
        result = json.loads(self.run_program("error", FOUR_BAR, "--grid", "100", "--json").stdout)
        self.mode = result["modes"][0]

    def test_agrees_with_the_mechanism_closed_by_hand(self):
        samples = self.mode["samples"]
        compared = 0
        for i, theta in enumerate(samples["theta"]):
            if samples["dx"][i] is None:
                continue
            *forces, couple = four_bar.reactions(theta)
            for joint, force in zip("ABCD", forces):
                self.assertAlmostEqual(samples[f"f{joint}x"][i], force.real, delta=1e-7)
                self.assertAlmostEqual(samples[f"f{joint}y"][i], force.imag, delta=1e-7)
            self.assertAlmostEqual(samples["MA"][i], couple, delta=1e-7)
            self.assertAlmostEqual(samples["theta_A"][i], -math.copysign(four_bar.ANGULAR, couple), delta=1e-15)
            error = four_bar.pose_error(theta)
            self.assertAlmostEqual(samples["dx"][i], error.real, delta=1e-6 * 0.5)
            self.assertAlmostEqual(samples["dy"][i], error.imag, delta=1e-6 * 0.5)
            compared += 1
        self.assertGreater(compared, 95)

    def test_jumps_where_the_rocker_is_upright(self):
        # There the rocker bears the load alone, and the force in the coupler changes its sign.
        self.assertEqual(len(self.mode["jumps"]), 4)
        upright = [jump for jump in self.mode["jumps"] if jump["kind"] == "contact-loss"]
        self.assertEqual(len(upright), 2)
        for jump in upright:
            theta = jump["at"][0]
            b = four_bar.CRANK * complex(math.cos(theta), math.sin(theta))
            self.assertAlmostEqual(abs(complex(four_bar.BASE, four_bar.ROCKER) - b), four_bar.COUPLER, delta=1e-12)
            step = 1e-6
            across = four_bar.pose_error(theta + step) - four_bar.pose_error(theta - step)
            self.assertAlmostEqual(jump["dx"], across.real, delta=1e-6)
            self.assertEqual(jump["dy"], 0)
        # Where crank and coupler are in line the drive's play moves the crank alone.
        for jump in self.mode["jumps"]:
            if jump["kind"] == "backlash":
                self.assertEqual([jump["dx"], jump["dy"], jump["dalpha"]], [0, 0, 0])

    def test_files(self):
        names, _ = self.written_twice("error", FOUR_BAR, "--export", "png,svg,pdf,csv")
        plots = ("error", "reactions", "take-up")
        wanted = ["error.json", "error.csv"] + [f"{plot}.{kind}" for plot in plots for kind in ("png", "svg", "pdf")]
        self.assertEqual(names, sorted(wanted))

    def test_what_has_no_meaning(self):
        for options, word in ((("--grid", "20x20"), "steps"), (("--slice", "theta=1"), "slices"), (("--export", "vtk"), "vtk")):
            process = self.run_program("error", FOUR_BAR, *options, status=2)
            self.assertIn(word, process.stderr)
            self.assertEqual(process.stderr.count("\n"), 1)


class Trajectory(InOwnFolder):
    def test_files(self):
        options = ("--periods", "0.6:2.4:0.3", "--samples", "400", "--export", "png,svg,pdf,csv")
        names, printed = self.written_twice("trajectory", *PICK_AND_PLACE, *options)
        self.assertIn("free above", printed)
        self.assertEqual(len(names), 9 * 3 + 3)
        with open(self.folder / "first" / "trajectory.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertGreater(len(rows), 400)
        for row in rows:
            self.assertAlmostEqual(float(row["actual_px"]), float(row["px"]) + float(row["dx"]), delta=1e-15)
        with open(self.folder / "first" / "periods.csv", newline="") as file:
            self.assertEqual(len(list(csv.DictReader(file))), 7 * len(rows))

    def test_json(self):
        result = json.loads(self.run_program("trajectory", *PICK_AND_PLACE, "--json", "--period", "1").stdout)
        self.assertEqual(result["period"], 1)
        self.assertEqual([stage["carried"] for stage in result["stages"]], [10, 0])
        self.assertTrue(all(2 < stage["critical_period"] < 2.4 for stage in result["stages"]))
        self.assertEqual(set(map(len, result["samples"].values())), {len(result["samples"]["time"])})
        self.assertEqual({loss["kind"] for loss in result["contact_losses"]}, {"zero", "jump"})
        slow = json.loads(self.run_program("trajectory", *PICK_AND_PLACE, "--json", "--period", "2.5").stdout)
        self.assertEqual(slow["contact_losses"], [])

    def test_slow_cycles_are_poses_at_rest(self):
        result = json.loads(self.run_program("trajectory", *PICK_AND_PLACE, "--json", "--period", "1e5").stdout)
        samples = result["samples"]
        k = max(i for i, stage in enumerate(samples["stage"]) if stage == 2) - 100
        at = f"{samples['px'][k]!r},{samples['py'][k]!r}"
        pose = json.loads(self.run_program("pose", PICK_AND_PLACE[0], "--at", at, "--json").stdout)
        self.assertAlmostEqual(samples["dx"][k], pose["pose_error"]["dx"], delta=1e-9)
        self.assertAlmostEqual(samples["dy"][k], pose["pose_error"]["dy"], delta=1e-9)
        self.assertAlmostEqual(samples["MA1"][k], pose["reactions"]["A1"]["M"], delta=1e-6)
        self.assertAlmostEqual(samples["beta_P"][k], pose["take_up"]["P"]["beta"], delta=1e-6)


class Platform(InOwnFolder):
    """A slice of a spatial mechanism under every command that takes one."""

    SLICE = FIVE_BAR.parent / "gough_stewart_slice.yaml"
    COMPONENTS = {"dx", "dy", "dz", "dalpha_x", "dalpha_y", "dalpha_z"}

    def json(self, *words, status=0):
        return json.loads(self.run_program(*words, "--json", status=status).stdout)

    def test_pose(self):
        pose = self.json("pose", self.SLICE, "--at", "-0.3,-0.2")
        self.assertEqual(len(pose["take_up"]), 18)
        self.assertEqual(set(pose["take_up"]["S1"]), {"axial"})
        self.assertEqual(set(pose["pose_error"]), self.COMPONENTS)
        self.assertEqual(set(pose["worst_case"]), self.COMPONENTS | {"dp", "dalpha"})
        for name in ("U1", "B1"):
            take_up, force = pose["take_up"][name], pose["reactions"][name]
            way = [take_up["d" + axis] for axis in "xyz"]
            self.assertAlmostEqual(math.hypot(*way), 10e-6, delta=1e-15)
            size = math.hypot(*(force["f" + axis] for axis in "xyz"))
            for axis, part in zip("xyz", way):
                self.assertAlmostEqual(part, -10e-6 * force["f" + axis] / size, delta=1e-15)
        self.assertEqual(pose["take_up"]["S1"]["axial"], -math.copysign(5e-6, pose["reactions"]["S1"]["F"]))
        for key in self.COMPONENTS:
            self.assertLessEqual(abs(pose["pose_error"][key]), pose["worst_case"][key] * (1 + 1e-9))
        text = self.run_program("pose", self.SLICE, "--at", "-0.3,-0.2").stdout
        self.assertIn("dalpha_z [deg]", text)
        self.assertNotIn("-0 ", text)

    def test_trajectory(self):
        (self.folder / "path.yaml").write_text(
            "format: 1\npath: {closed: true, waypoints: [[-0.3, -0.2], {at: [-0.2, -0.1], stop: true}]}\n"
            "motion: cycloidal\nperiod: 0.5\n",
            encoding="utf-8",
        )
        result = self.json("trajectory", self.SLICE, "path.yaml", "--samples", "50", "--periods", "0.5:1:0.25",
                           "--export", "csv,png", "-o", "made")
        samples = result["samples"]
        # The first instant is the pose at rest: the links of this slice weigh nothing.
        pose = self.json("pose", self.SLICE, "--at", "-0.3,-0.2")
        for leg in range(1, 7):
            self.assertAlmostEqual(samples[f"FS{leg}"][0], pose["reactions"][f"S{leg}"]["F"], delta=1e-7)
        for axis in "xyz":
            self.assertAlmostEqual(samples["d" + axis][0], pose["pose_error"]["d" + axis], delta=1e-15)
            self.assertAlmostEqual(samples["dalpha" + axis][0], pose["pose_error"]["dalpha_" + axis], delta=1e-14)
        self.assertTrue((self.folder / "made" / "trajectory-path-xz.png").exists())
        self.assertTrue((self.folder / "made" / "periods-dz.png").exists())

    def test_validate(self):
        verdict = self.json("validate", self.SLICE, "--grid", "50x50")
        self.assertTrue(verdict["validated"])
        self.assertEqual(verdict["undecided"], 0)
        self.assertGreater(verdict["held"], 200000)
        self.assertIn({"joint": "S1", "quantity": "F"}, [tally["reaction"] for tally in verdict["reactions"]])

    def test_zones_and_verify(self):
        zones = self.json("zones", self.SLICE, "--joint", "S1", "--joint", "S4")["zones"]
        self.assertAlmostEqual(sum(zone["area"] for zone in zones), 0.64, delta=1e-6)
        task = FIVE_BAR.parent / "tasks" / "platform.yaml"
        self.assertTrue(self.json("verify", self.SLICE, task)["verified"])
        (self.folder / "task.yaml").write_text("format: 1\nbox: {x: [0, 0.3], y: [0, 0.1]}\n", encoding="utf-8")
        self.assertFalse(self.json("verify", self.SLICE, "task.yaml", status=1)["verified"])

    def test_error(self):
        words = ("--grid", "12x10", "--export", "csv,vtk,png", "-o", "made")
        errors = self.json("error", self.SLICE, *words)["modes"][0]
        wanted = self.COMPONENTS | {"dp"}
        self.assertEqual(set(errors["fields"]), wanted | {"worst_" + name for name in wanted})
        self.assertEqual(errors["reachable"], 120)
        names = {path.name for path in (self.folder / "made").iterdir()}
        pictures = {f"error-{name.replace('_', '-')}.png" for name in errors["fields"]}
        self.assertEqual(names, pictures | {"error.json", "error.csv", "error.vti"})


class Validate(InOwnFolder):
    def test_the_shipped_example_holds(self):
        verdict = json.loads(self.run_program("validate", FIVE_BAR, "--grid", "60x60", "--json").stdout)
        self.assertTrue(verdict["validated"])
        self.assertEqual(verdict["disputed"], 0)
        self.assertGreater(verdict["held"], 1000)
        self.assertEqual(verdict["disputed_edges"], [])
        checked = {(tally["reaction"]["joint"], tally["reaction"]["quantity"]) for tally in verdict["reactions"]}
        self.assertEqual(len(checked), 12)

    def test_table(self):
        text = self.run_program("validate", FIVE_BAR, "--grid", "30x40").stdout
        self.assertIn("0 contradicted", text)
        self.assertIn("M_A1", text)


if __name__ == "__main__":
    unittest.main()
