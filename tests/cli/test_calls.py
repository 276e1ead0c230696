"""Wrong calls and wrong inputs: one line on standard error that says what and how to mend it, and the right status."""

import re
import unittest

from program import FIVE_BAR, FOUR_BAR, PICK_AND_PLACE, InOwnFolder


class WrongCalls(InOwnFolder):
    def complaint(self, *words):
        process = self.run_program(*words, status=2)
        self.assertEqual(process.stdout, "", words)
        self.assertRegex(process.stderr, r"\Aclearloci: [^\n]+\n\Z", words)
        self.assertEqual(list(self.folder.glob("out/*")), [], f"{words}: a failed call leaves nothing behind")
        return process.stderr

    def test_no_command(self):
        self.assertIn("--help", self.complaint())

    def test_unknown_command(self):
        message = self.complaint("locus", FIVE_BAR)
        self.assertIn("unknown command 'locus'", message)
        self.assertIn("loci, equations, validate, pose", message)

    def test_no_model(self):
        for command in ("loci", "equations", "validate", "pose", "error", "zones", "verify", "trajectory"):
            self.assertIn("MODEL", self.complaint(command))

    def test_view_without_a_model_has_no_parameters(self):
        self.assertIn("--set", self.complaint("view", "--set", "L=1"))

    def test_mechanisms_that_a_command_is_not_for(self):
        examples = FIVE_BAR.parent
        for command in ("loci", "zones", "validate", "error"):
            self.assertIn("this workspace has 6", self.complaint(command, examples / "gough_stewart_poses.yaml"))
        for name in ("stl", "vtk", "dxf"):
            self.assertIn(f"--export: unknown format '{name}'", self.complaint("zones", FOUR_BAR, "--export", name))
        self.assertIn("--slice: ", self.complaint("error", examples / "three_upu.yaml", "--slice", "z=7"))
        self.assertIn("--slice: ", self.complaint("error", examples / "three_upu.yaml", "--slice", "w=0.1"))
        self.assertIn("--grid: ", self.complaint("error", examples / "three_upu.yaml", "--grid", "40x40"))
        self.assertIn("--grid: ", self.complaint("validate", FOUR_BAR, "--grid", "40x40"))
        self.assertIn("unknown format 'geojson'", self.complaint("zones", FOUR_BAR, "--export", "geojson"))
        self.assertIn("unknown format 'vtk'", self.complaint("zones", FIVE_BAR, "--export", "vtk"))
        # By cells over two lengths: tensions have bounds.
        hanging = examples / "cables" / "hanging.yaml"
        self.assertIn("unknown format 'geojson'", self.complaint("zones", hanging, "--export", "geojson"))
        self.assertIn("choose from json, svg, png, pdf, vtk", self.complaint("zones", hanging, "--export", "html"))
        self.assertIn("dxf does not hold loci over 3 free coordinates",
                      self.complaint("loci", examples / "three_upu.yaml", "--export", "dxf"))
        self.assertIn("stl does not hold loci over 2 free coordinates", self.complaint("loci", FIVE_BAR, "--export", "stl"))
        self.assertIn("--mesh-size", self.complaint("loci", examples / "three_upu.yaml", "--mesh-size", "0.4"))

    def test_what_has_no_meaning_in_space(self):
        examples = FIVE_BAR.parent
        platform = examples / "gough_stewart_slice.yaml"
        self.assertIn("--working-mode", self.complaint("pose", platform, "--at", "0.1,0.1", "--working-mode", "left"))
        (self.folder / "task.yaml").write_text(
            "format: 1\nbox: {x: [0, 0.1], y: [0, 0.1]}\nloads_from: [[1, 0], [0, 1]]\n", encoding="utf-8"
        )
        self.assertIn("task.yaml:3:", self.complaint("verify", platform, "task.yaml"))

    def test_wrong_tasks(self):
        self.assertIn("TASK", self.complaint("verify", FIVE_BAR))
        self.assertIn("no such file", self.complaint("verify", FIVE_BAR, "none.yaml"))
        (self.folder / "task.yaml").write_text("format: 1\nbox: {x: [0, 9], y: [-0.8, -0.6]}\n", encoding="utf-8")
        self.assertIn("task.yaml:2:6: the box leaves", self.complaint("verify", FIVE_BAR, "task.yaml"))
        (self.folder / "task.yaml").write_text("format: 1\npath: [[0, -0.7], [0.1, -0.7]]\n", encoding="utf-8")
        self.assertIn("nearest, best", self.complaint("verify", FIVE_BAR, "task.yaml", "--fit", "first"))
        self.assertIn("one working mode", self.complaint("verify", FIVE_BAR, "task.yaml", "--working-mode", "all"))

    def test_unknown_option(self):
        self.assertIn("--frobnicate", self.complaint("loci", FIVE_BAR, "--frobnicate"))

    def test_a_second_model(self):
        self.assertIn("other.yaml", self.complaint("loci", FIVE_BAR, "other.yaml"))

    def test_missing_file(self):
        self.assertIn("nowhere.yaml", self.complaint("loci", "nowhere.yaml"))

    def test_a_folder_for_a_file(self):
        self.complaint("loci", self.folder)

    def test_unknown_joint_lists_those_there_are(self):
        self.assertIn("A1, B1, P, B2, A2", self.complaint("loci", FIVE_BAR, "--joint", "A7"))

    def test_unknown_quantity(self):
        self.assertIn("choose from f, N, T, M, F", self.complaint("loci", FIVE_BAR, "--quantity", "f,Q"))

    def test_unknown_export_format(self):
        message = self.complaint("loci", FIVE_BAR, "--export", "svg,jpeg")
        self.assertIn("'jpeg'", message)
        self.assertIn("geojson", message)

    def test_unknown_language(self):
        self.assertIn("matlab", self.complaint("equations", FIVE_BAR, "--language", "fortran"))

    def test_unknown_engine(self):
        self.assertIn("adaptive", self.complaint("loci", FIVE_BAR, "--engine", "steam"))

    def test_working_mode_names_the_dyads(self):
        message = self.complaint("loci", FIVE_BAR, "--working-mode", "left")
        self.assertIn("B1,B2", message)
        self.assertIn("2 dyads", message)
        self.complaint("loci", FIVE_BAR, "--working-mode", "left,up")

    def test_set(self):
        for wrong in ("L", "L=", "=1", "L=1/0", "L=abc", "Lambda=1", "L=-1"):
            self.complaint("loci", FIVE_BAR, "--set", wrong)
        self.assertIn("'L' is given twice", self.complaint("loci", FIVE_BAR, "--set", "L=0.4", "--set", "L=0.5"))

    def test_numbers(self):
        for option in ("--min-force", "--min-couple", "--tolerance", "--time-limit"):
            for wrong in ("0", "-1", "much", "1/0", ""):
                self.complaint("loci", FIVE_BAR, f"{option}={wrong}")

    def test_pose(self):
        self.assertIn("x,y", self.complaint("pose", FIVE_BAR, "--at", "0.25"))
        self.complaint("pose", FIVE_BAR, "--at", "0.25,-0.7,1")
        self.complaint("pose", FIVE_BAR, "--at", "0.25,north")
        self.assertIn("--at", self.complaint("pose", FIVE_BAR))
        self.assertIn("out of reach", self.complaint("pose", FIVE_BAR, "--at", "7,7"))

    def test_grid(self):
        for wrong in ("400", "0x10", "axb", "-4x4", "1x1"):
            self.assertIn("--grid", self.complaint("validate", FIVE_BAR, f"--grid={wrong}"))

    def test_error(self):
        self.assertIn("vtk", self.complaint("error", FIVE_BAR, "--export", "jpeg"))
        self.assertIn("--grid", self.complaint("error", FIVE_BAR, "--grid", "many"))
        bare = self.model(lambda text: re.sub(r", +clearance: \{[^}]*\}", "", text))
        self.assertIn("no joint has a clearance", self.complaint("error", bare))

    def test_trajectory(self):
        model, path = PICK_AND_PLACE
        self.assertIn("PATH", self.complaint("trajectory", model))
        self.assertIn("nowhere.yaml", self.complaint("trajectory", model, "nowhere.yaml"))
        for wrong in ("1", "2:1:0.1", "0:1:0.1", "1:2:0", "1:2:1e-9", "a:b:c"):
            self.assertIn("--periods", self.complaint("trajectory", model, path, "--periods", wrong))
        self.assertIn("--period", self.complaint("trajectory", model, path, "--period", "0"))
        self.assertIn("--samples", self.complaint("trajectory", model, path, "--samples", "3"))
        self.assertIn("svg", self.complaint("trajectory", model, path, "--export", "vtk"))
        text = path.read_text(encoding="utf-8")
        for wrong, says in (
            (text.replace("-0.82", "-1.82"), "leaves the workspace"),
            (text.replace("corner: 0.025", "corner: 0.03", 1), "does not fit"),
            (text.replace(", corner: 0.025", "", 1), "sharp corner"),
        ):
            (self.folder / "wrong.yaml").write_text(wrong, encoding="utf-8")
            message = self.complaint("trajectory", model, "wrong.yaml")
            self.assertIn("wrong.yaml", message)
            self.assertIn(says, message)

    def test_output_that_cannot_be_written(self):
        (self.folder / "taken").write_text("a file, not a folder")
        self.complaint("loci", FIVE_BAR, "-o", "taken")

    def test_wrong_file_names_line_and_column(self):
        path = self.model(lambda text: text.replace("lengths: [L, L], side: right", "lengths: [L, -L], side: right"))
        self.assertRegex(self.complaint("loci", path), r"model\.yaml:\d+:\d+: .+; .+")
        path = self.model(lambda text: text.replace("side: left", "side: up"))
        self.assertRegex(self.complaint("pose", path, "--at", "0.25,-0.7"), r"model\.yaml:\d+:\d+: .+; .+")

    def test_full_disk(self):
        import subprocess

        from program import PROGRAM

        with open("/dev/full", "w") as full:
            process = subprocess.run(
                [PROGRAM, "pose", FIVE_BAR, "--at", "0.25,-0.7"], stdout=full, stderr=subprocess.PIPE, text=True
            )
        self.assertEqual(process.returncode, 2)
        self.assertIn("standard output", process.stderr)


class Help(InOwnFolder):
    def test_every_command_has_an_example(self):
        self.assertIn("Exit status", self.run_program("--help").stdout)
        for command in ("loci", "equations", "validate", "pose", "error", "zones", "verify", "trajectory"):
            process = self.run_program(command, "--help")
            self.assertIn(f"Example: clearloci {command} ", process.stdout)
            self.assertEqual(process.stderr, "")

    def test_version(self):
        self.assertRegex(self.run_program("--version").stdout, r"\Aclearloci \d+\.\d+\.\d+\n\Z")


if __name__ == "__main__":
    unittest.main()
