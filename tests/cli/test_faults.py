"""What goes wrong around the program: inputs beyond all measure, streams and disks that fail, signals, limits."""

import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import time
import unittest
import xml.etree.ElementTree

from program import FIVE_BAR, FOUR_BAR, PICK_AND_PLACE, PROGRAM, SOURCE, InOwnFolder

CORPUS = SOURCE / "tests" / "corpus" / "input"
EXAMPLES = SOURCE / "examples"
TASK = EXAMPLES / "tasks" / "pick_and_place.yaml"
POSE = ("pose", FIVE_BAR, "--at", "0.25,-0.7")
CONTROL = re.compile(r"[\x00-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e]")


class MissingLibraries(InOwnFolder):
    """What is loaded when it is asked for, and is not there: one line says so, and every other call works."""

    def run_with(self, environment, *words, program=PROGRAM):
        return subprocess.run(
            [program, *map(str, words)],
            cwd=self.folder,
            env={**os.environ, **environment},
            capture_output=True,
            text=True,
        )

    def test_pictures_without_cairo(self):
        (self.folder / "libcairo.so.2").touch()
        broken = {"LD_LIBRARY_PATH": str(self.folder)}
        refused = self.run_with(broken, "loci", FIVE_BAR, "--export", "svg", "-o", "pictures")
        self.assertEqual(refused.returncode, 2, refused.stderr)
        self.assertRegex(refused.stderr, r"\Aclearloci: pictures need the library libcairo\.so\.2[^\n]+\n\Z")
        others = self.run_with(broken, "loci", FIVE_BAR, "--export", "json,csv", "-o", "tables")
        self.assertEqual(others.returncode, 0, others.stderr)

    def test_ranks_without_mpi(self):
        alone = shutil.copy(PROGRAM, self.folder / "clearloci")
        words = ("design", FIVE_BAR, EXAMPLES / "studies" / "link_lengths.yaml")
        refused = self.run_with({"OMPI_COMM_WORLD_SIZE": "2"}, *words, program=alone)
        self.assertEqual(refused.returncode, 2, refused.stderr)
        self.assertRegex(refused.stderr, r"\Aclearloci: MPI cannot be loaded: [^\n]+\n\Z")


class Complaints(InOwnFolder):
    """One line that fits on a screen and holds no control byte."""

    def complaint(self, *words, status=2):
        process = self.run_program(*words, status=status)
        self.assertRegex(process.stderr, r"\Aclearloci: [^\n]+\n\Z", words)
        self.assertLess(len(process.stderr), 1200, words)
        self.assertNotRegex(process.stderr, CONTROL, words)
        return process.stderr

    def test_corpus(self):
        self.assertIn("nearer to 0", self.complaint("loci", CORPUS / "11-param-doubling.yaml"))
        self.complaint("loci", CORPUS / "22-mul-many-pow.yaml")
        self.assertIn("unknown key 'kkk", self.complaint("loci", CORPUS / "13-longest-key.yaml"))
        self.assertIn("larger than 1e15", self.complaint("loci", CORPUS / "31-verify-sigfpe.yaml"))
        self.assertIn("period", self.complaint("trajectory", PICK_AND_PLACE[0], CORPUS / "30-trajectory-nan.yaml"))
        self.assertIn("larger than 1e15", self.complaint("trajectory", FIVE_BAR, CORPUS / "49-trajectory-far-point-hang.yaml"))

    def test_huge_and_tiny_numbers_are_refused_where_they_enter(self):
        model, path = PICK_AND_PLACE
        for huge in ("1e309", "-1e309", "10^400", "1e16", "10^99999", "1e-40", "nan", "inf", "-inf", "1e99999"):
            self.complaint("pose", FIVE_BAR, f"--at={huge},0")
            self.complaint("loci", FIVE_BAR, "--set", f"L={huge}")
            self.complaint("loci", FIVE_BAR, f"--tolerance={huge}")
            self.complaint("loci", FIVE_BAR, f"--min-force={huge}")
            self.complaint("loci", FIVE_BAR, f"--time-limit={huge}")
            self.complaint("trajectory", model, path, f"--period={huge}")
            self.complaint("trajectory", model, path, f"--periods=1:{huge}:1")
            box = self.model(lambda text: text.replace("x: [-0.5, 1.0]", f"x: [-0.5, {huge}]"))
            self.complaint("loci", box)
            point = self.model(lambda text: text.replace("P:  [x, y]", f"P: [x + ({huge}), y]"))
            self.complaint("loci", point)
            (self.folder / "task.yaml").write_text(f"format: 1\ncircle: {{centre: [0.2, -0.7], radius: {huge}}}\n")
            self.complaint("verify", FIVE_BAR, "task.yaml")

    def test_tolerances_finer_than_doubles(self):
        for command in (("loci", FIVE_BAR), ("zones", FIVE_BAR), ("verify", FIVE_BAR, TASK)):
            self.assertIn("--tolerance", self.complaint(*command, "--tolerance", "1e-30"))

    def test_powers_that_grow_beyond_memory(self):
        model = self.model(lambda text: text.replace("P:  [x, y]", "P: [(((x + y + 1)^8)^8)^8, y]"))
        self.assertIn("degree", self.complaint("loci", model))

    def test_endless_and_odd_files(self):
        self.assertIn("4 MB", self.complaint("loci", "/dev/zero"))
        self.assertIn("4 MB", self.complaint("verify", FIVE_BAR, "/dev/zero"))
        self.assertIn("empty", self.complaint("loci", "/dev/null"))
        (self.folder / "large.yaml").write_bytes(b"#" * (5 << 20))
        self.complaint("loci", "large.yaml")
        (self.folder / "deep.yaml").write_text("a: " + "[" * 100000)
        self.complaint("loci", "deep.yaml")
        (self.folder / "bytes.yaml").write_bytes(bytes(range(256)) * 20)
        self.complaint("loci", "bytes.yaml")

    def test_texts_of_files_and_calls_in_messages(self):
        nasty = "\x1b]0;t\x07\x1b[31m\u202e\x9b" + "x" * 100000
        model = self.model(lambda text: text.replace("force: [0, -100]", f"force: [0, {json.dumps(nasty)}]"))
        self.complaint("loci", model)
        model = self.model(lambda text: text.replace("side: left", f"side: {json.dumps(nasty)}"))
        self.complaint("loci", model)
        for words in (("loci", FIVE_BAR, "--joint", nasty), ("loci", FIVE_BAR, "--engine", nasty),
                      ("loci", FIVE_BAR, "--" + nasty), (nasty,), ("loci", nasty), ("loci", FIVE_BAR, "--set", nasty),
                      ("pose", FIVE_BAR, "--at", nasty), ("equations", FIVE_BAR, "--language", nasty)):
            self.complaint(*words)
        model = self.model(lambda text: text.replace("L:", "L" * 65 + ":").replace("L,", "L" * 65 + ","))
        self.assertIn("too long", self.complaint("loci", model))

    def test_given_efforts_are_named_as_they_were_given(self):
        cables = EXAMPLES / "cables" / "point.yaml"
        for word, told in {
            "K3=": "--preload: 'K3=' is not joint=value; write e.g. --preload ",
            "K1=5,K2=5": "--preload: 'K1=5,K2=5' is not joint=value; ",
            "K3=nan": "--preload K3=nan: the effort of joint K3: 'nan' ",
            "K3=x": "--at: the pose is beyond the limit of the tension of cable K3 at 5 N; ",  # x is at most 0.9
        }.items():
            with self.subTest(word):
                told_now = self.complaint("pose", cables, "--at", "0.2,-0.1", "--preload", word)
                self.assertIn(f"clearloci: {told}", told_now)

    def test_grids_beyond_memory_are_said_to_be(self):
        self.assertIn("GB", self.complaint("error", FIVE_BAR, "--grid", "20000x20000"))
        self.assertIn("GB", self.complaint("validate", FIVE_BAR, "--grid", "20000x20000"))
        self.assertIn("GB", self.complaint("trajectory", *PICK_AND_PLACE, "--samples", "10000000"))
        self.assertIn("GB", self.complaint("trajectory", *PICK_AND_PLACE, "--periods", "1:100:0.001"))


class Outputs(InOwnFolder):
    """What is written replaces no input, nothing that is no file, and comes whole."""

    def refused(self, *words):
        process = self.run_program(*words, status=2)
        self.assertRegex(process.stderr, r"\Aclearloci: [^\n]+\n\Z", words)

    def test_no_input_is_replaced(self):
        model = self.model()
        text = model.read_bytes()
        task = self.folder / "task.yaml"
        task.write_bytes(TASK.read_bytes())
        (self.folder / "link").symlink_to("model.yaml")
        for name in ("model.yaml", "link", "./link"):
            self.refused("loci", model, "--certificate", name, "-o", "out")
            self.refused("zones", model, "--certificate", name, "-o", "out")
        self.refused("verify", model, task, "--certificate", "task.yaml", "-o", "out")
        self.refused("loci", model, "--certificate", "out/loci.json", "-o", "out")
        self.assertEqual(model.read_bytes(), text)
        self.assertEqual(task.read_bytes(), TASK.read_bytes())
        named = self.model(name="loci.json")
        self.refused("loci", named, "-o", ".")
        self.assertEqual(named.read_bytes(), text)
        self.assertEqual([path for path in (self.folder / "out").iterdir()], [], "all files or none")

    def test_what_is_no_file_is_not_replaced(self):
        os.mkfifo(self.folder / "pipe")
        (self.folder / "link").symlink_to("elsewhere")
        self.refused("loci", FIVE_BAR, "--certificate", "pipe")
        self.refused("loci", FIVE_BAR, "--certificate", "/dev/null")
        self.run_program("loci", FIVE_BAR, "--certificate", "link")
        self.assertTrue((self.folder / "link").is_symlink())
        self.assertTrue((self.folder / "elsewhere").is_file())

    def test_out_of_memory_is_one_line(self):
        for megabytes in (150, 250, 350, 500):
            process = subprocess.run(["sh", "-c", f'ulimit -v {megabytes * 1024}; exec "$@"', "sh", PROGRAM, "loci", FIVE_BAR, "-o", "out"],
                                     cwd=self.folder, capture_output=True, text=True)
            if process.returncode in (0, 127):  # enough, or too little to load libraries
                continue
            self.assertEqual(process.returncode, 3, process.stderr)
            self.assertRegex(process.stderr, r"\Aclearloci: [^\n]+\n\Z")


class Names(InOwnFolder):
    def test_a_name_breaks_neither_terminal_nor_files(self):
        for name in ("01-name-newline-code-injection", "02-name-c-comment-escape", "04-name-escape-sequences"):
            model = CORPUS / f"{name}.yaml"
            process = self.run_program("loci", model, "-o", "out", "--export",
                                       "svg,png,pdf,csv,dxf,dxf-r12,geojson,vtk")
            self.assertNotRegex(process.stdout, CONTROL)
            self.assertNotIn("\x1b", (self.folder / "out" / "loci.csv").read_text(encoding="utf-8"))
            for file in (self.folder / "out").glob("*.svg"):
                xml.etree.ElementTree.parse(file)
            json.loads((self.folder / "out" / "loci.json").read_text(encoding="utf-8"))
            for words in (("pose", model, "--at", "0.25,-0.7"), ("validate", model, "--grid", "10x10"),
                          ("error", model, "--grid", "10x10", "--zones"), ("zones", model), ("verify", model, TASK)):
                self.assertNotRegex(self.run_program(*words).stdout, CONTROL, words)

    def test_a_long_name_is_shortened(self):
        model = self.model(lambda text: re.sub(r"name: .*", "name: " + "n" * 100000, text))
        self.assertLess(len(self.run_program("pose", model, "--at", "0.25,-0.7").stdout), 10000)

    def test_models_with_odd_file_names_write_into_out(self):
        for name in ("...yaml", "..yaml", ".yaml", "a\nb.yaml", "-.yaml", "é.yaml", "x..", "..x", ". .yaml"):
            with self.subTest(name=name):
                model = self.model(name=name)
                self.run_program("pose", model, "--at", "0.25,-0.7")
                self.run_program("loci", model)
                model.unlink()
                self.assertEqual([path.name for path in self.folder.iterdir()], ["out"], name)
                inside = list((self.folder / "out").iterdir())
                self.assertTrue(all(path.is_dir() for path in inside), inside)
                subprocess.run(["rm", "-r", self.folder / "out"], check=True)


class Streams(InOwnFolder):
    def start(self, words, **streams):
        streams.setdefault("stderr", subprocess.PIPE)
        return subprocess.run([PROGRAM, *map(str, words)], cwd=self.folder, timeout=60, **streams)

    CALLS = (POSE, ("loci", FIVE_BAR, "--json"), ("equations", FIVE_BAR), ("zones", FIVE_BAR), ("--help",),
             ("loci", "--help"), ("--version",), ("validate", FIVE_BAR, "--grid", "5x5"))

    def test_full_standard_output(self):
        for words in self.CALLS:
            with open("/dev/full", "wb") as full:
                process = self.start(words, stdout=full)
            self.assertEqual(process.returncode, 2, words)
            self.assertRegex(process.stderr.decode(), r"\Aclearloci: standard output[^\n]*\n\Z", words)

    def test_closed_standard_output(self):
        for words in self.CALLS:
            process = self.start(words, preexec_fn=lambda: os.close(1))
            self.assertEqual(process.returncode, 2, words)
            self.assertRegex(process.stderr.decode(), r"\Aclearloci: standard output[^\n]*\n\Z", words)

    def test_full_and_closed_standard_error(self):
        with open("/dev/full", "wb") as full:
            self.assertEqual(self.start(("loci", "nowhere"), stderr=full).returncode, 2)
            self.assertEqual(self.start(POSE, stdout=full, stderr=full).returncode, 2)
        self.assertEqual(self.start(("loci", "nowhere"), stderr=None, preexec_fn=lambda: os.close(2)).returncode, 2)
        for close in ((0,), (0, 1), (0, 1, 2), (1, 2)):
            process = self.start(("loci", FIVE_BAR, "-o", "out"), stderr=None if 2 in close else subprocess.PIPE,
                                 stdout=None if 1 in close else subprocess.PIPE,
                                 preexec_fn=lambda close=close: [os.close(one) for one in close])
            self.assertEqual(process.returncode, 2 if 1 in close else 0, close)
            json.loads((self.folder / "out" / "loci.json").read_text())

    def test_a_reader_that_goes(self):
        reading, writing = os.pipe()
        os.close(reading)
        process = self.start(("loci", FIVE_BAR, "--json"), stdout=writing, restore_signals=True)
        self.assertEqual(process.returncode, -signal.SIGPIPE)
        ignored = self.start(("loci", FIVE_BAR, "--json"), stdout=writing, restore_signals=False)
        os.close(writing)
        self.assertEqual(ignored.returncode, 2)
        self.assertEqual(len(ignored.stderr.decode().splitlines()), 1)


class Signals(InOwnFolder):
    def test_no_temporary_is_left(self):
        words = ["error", FIVE_BAR, "--grid", "300x300", "--no-loci", "--no-worst-case", "--export", "csv,vtk", "-o", "out"]
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            caught = 0
            for _ in range(5):
                process = subprocess.Popen([PROGRAM, *map(str, words)], cwd=self.folder, stdout=subprocess.DEVNULL)
                out = self.folder / "out"
                end = time.monotonic() + 30
                while process.poll() is None and time.monotonic() < end and not (out.is_dir() and any(out.iterdir())):
                    time.sleep(0.0005)
                process.send_signal(number)
                if process.wait(30) == -number:
                    caught += 1
                self.assertIn(process.returncode, (0, -number))
                self.assertEqual([path.name for path in out.glob(".*")], [])
                subprocess.run(["rm", "-rf", out], check=True)
            self.assertGreater(caught, 0)

    def test_ignored_signals_stay_ignored(self):
        process = subprocess.Popen([PROGRAM, *map(str, POSE)], cwd=self.folder, stdout=subprocess.DEVNULL,
                                   preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        process.send_signal(signal.SIGHUP)
        self.assertIn(process.wait(30), (0, -signal.SIGHUP))  # either before or after the program began


class TimeLimits(InOwnFolder):
    """The clock of a machine under load: what is tested is that the call ends long before its work would."""

    def limited(self, *words, limit, file=None):
        start = time.monotonic()
        process = self.run_program(*words, "--time-limit", limit, "-o", "out", status=3)
        self.assertLess(time.monotonic() - start, 2 * float(limit) + 8, words)
        self.assertRegex(process.stderr, r"\Aclearloci: [^\n]*time limit[^\n]*\n\Z", words)
        if file:
            result = json.loads((self.folder / "out" / file).read_text())
            self.assertFalse(result["complete"], words)
        self.assertEqual(list((self.folder / "out").glob(".*")) if (self.folder / "out").is_dir() else [], [])
        subprocess.run(["rm", "-rf", self.folder / "out"], check=True)
        return process

    def test_a_certificate_of_nothing_is_not_written(self):
        for model in ("klann_leg.yaml", "five_bar_weights.yaml"):
            words = ("loci", EXAMPLES / model, "--certificate", "t.cert", "--time-limit", "0.001", "-o", "out")
            process = self.run_program(*words, status=3)
            self.assertIn("t.cert is not written: nothing was proven", process.stderr)
            self.assertFalse((self.folder / "t.cert").exists())

    def verify_limited(self, limit):
        """A task that is not decided in time is an answer, `undecided`, that says what stays open and why."""
        start = time.monotonic()
        process = self.run_program("verify", FIVE_BAR, TASK, "--time-limit", limit, "-o", "out", status=3)
        self.assertLess(time.monotonic() - start, 2 * float(limit) + 8)
        result = json.loads((self.folder / "out" / "verify.json").read_text())
        if "complete" in result:  # the watch ended the call: a line says so
            self.assertFalse(result["complete"])
            self.assertIn("time limit", process.stderr)
        else:
            self.assertIn("time limit", result["open"]["reason"])
        self.assertEqual((result["verdict"], result["verified"]), ("undecided", False))
        subprocess.run(["rm", "-rf", self.folder / "out"], check=True)

    def test_every_command_at_once(self):
        for limit in ("0.000001", "0.001"):
            self.limited("loci", EXAMPLES / "gough_stewart.yaml", limit=limit, file="loci.json")
            self.limited("loci", EXAMPLES / "five_bar_weights.yaml", limit=limit, file="loci.json")
            self.limited("error", FIVE_BAR, "--grid", "10x10", limit=limit, file="error.json")
            self.limited("error", FOUR_BAR, limit=limit, file="error.json")
            self.limited("zones", FIVE_BAR, limit=limit, file="zones.json")
            self.verify_limited(limit)
            self.limited("validate", FIVE_BAR, limit=limit, file="validation.json")

    def test_what_asks_nobody(self):
        self.limited("loci", EXAMPLES / "five_bar_weights.yaml", "--engine", "exact", limit="1", file="loci.json")
        self.limited("equations", EXAMPLES / "three_ruu_slice.yaml", limit="0.3", file="equations.json")
        self.limited("equations", EXAMPLES / "three_rrr.yaml", "--symbolic", "--language", "text,latex,c,python",
                     limit="1")
        self.limited("error", FIVE_BAR, "--grid", "4000x4000", limit="0.5")
        self.limited("trajectory", *PICK_AND_PLACE, "--periods", "0.5:3:0.0005", limit="0.5")
        self.limited("validate", FIVE_BAR, "--grid", "3000x3000", limit="1", file="validation.json")

    def test_json_is_marked_too(self):
        process = self.limited("error", FIVE_BAR, "--grid", "4000x4000", "--no-loci", "--json", limit="0.2")
        self.assertFalse(json.loads(process.stdout)["complete"])

    def test_a_limit_that_is_not_reached_changes_nothing(self):
        for words in (POSE, ("equations", FIVE_BAR), ("zones", FIVE_BAR), ("error", FIVE_BAR, "--grid", "20x20"),
                      ("loci", FIVE_BAR, "--engine", "exact"), ("trajectory", *PICK_AND_PLACE),
                      ("verify", FIVE_BAR, TASK), ("validate", FIVE_BAR, "--grid", "20x20")):
            plain = self.run_program(*words, "-o", "out").stdout
            self.assertEqual(self.run_program(*words, "-o", "out", "--time-limit", "500").stdout, plain)


if __name__ == "__main__":
    unittest.main()
