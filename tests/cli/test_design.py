"""Studies as their user meets them: the same bytes from any number of threads, and nothing lost by kill -9."""

import csv
import json
import os
import random
import shutil
import signal
import subprocess
import time
import unittest

from program import BUILD, FIVE_BAR, PROGRAM, SOURCE, InOwnFolder

STUDIES = SOURCE / "examples" / "studies"

STUDY = """format: 1
vary: {L: [0.3, 0.7], d: [0.3, 0.7]}
keep: [L + d <= 1.3]
task: {box: {x: [0.1, 0.4], y: [-0.7, -0.5]}}
goal: {maximise: margin}
method: {grid: [%d, %d]}
"""


class Design(InOwnFolder):
    def study(self, side, name="study.yaml"):
        path = self.folder / name
        path.write_text(STUDY % (side, side), encoding="utf-8")
        return path

    def test_files_agree(self):
        process = self.run_program("design", FIVE_BAR, self.study(12), "-o", "here")
        self.assertIn("feasible", process.stdout)
        result = json.loads((self.folder / "here" / "designs.json").read_text(encoding="utf-8"))
        with open(self.folder / "here" / "designs.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), 144)
        self.assertEqual(sum(result["counts"].values()), 144)
        for status, many in result["counts"].items():
            self.assertEqual(sum(row["status"] == status for row in rows), many)
        self.assertEqual(result["designs"]["status"], [row["status"] for row in rows])
        best = max((float(row["margin"]) for row in rows if row["status"] == "feasible"))
        self.assertEqual(result["best"]["figures"]["margin"], best)
        for name in ("designs.svg", "designs.png"):
            self.assertGreater((self.folder / "here" / name).stat().st_size, 5000)

    def design(self, model, study, folder):
        """A shipped study as a user runs it: what it prints, designs.json and the page."""
        process = self.run_program("design", model, STUDIES / study, "-o", folder)
        self.assertIn("report.html", process.stdout)
        result = json.loads((self.folder / folder / "designs.json").read_text(encoding="utf-8"))
        return process.stdout, result, (self.folder / folder / "report.html").read_text(encoding="utf-8")

    def assert_page(self, page, *words):
        for heading in ("What was varied", "What was required", "What is feasible", "Why the rest fails",
                        "Recommended design, and its proof"):
            self.assertIn(f"<h2>{heading}</h2>", page)
        for own in words:
            self.assertIn(own, page)
        self.assertNotIn("<script", page)
        self.assertNotIn("http", page.replace("http-equiv", ""))
        self.assertGreater(page.count("data:image/svg+xml;base64,"), 0)

    def test_link_lengths(self):
        told, result, page = self.design(FIVE_BAR, "link_lengths.yaml", "lengths")
        self.assertIn("verify: VERIFIED", told)
        self.assertEqual(result["counts"]["undecided"], 0)
        self.assert_page(page, "VERIFIED", "out of reach", "2*L + d")
        self.assertGreater(result["best"]["figures"]["margin"], 0.33)

    def test_three_rrr_base(self):
        told, result, page = self.design(STUDIES / "three_rrr.yaml", "three_rrr_base.yaml", "base")
        self.assertIn("verify: VERIFIED", told)
        self.assert_page(page, "VERIFIED")
        self.assertAlmostEqual(result["best"]["parameters"]["R"], 0.724, delta=0.01)

    def test_clearance_budget(self):
        """Of the front none may be larger, and what it says is what verify says."""
        told, result, page = self.design(STUDIES / "clearances.yaml", "clearance_budget.yaml", "budget")
        self.assertIn("verify: VERIFIED", told)
        self.assert_page(page, "What can be traded", "pose_error")
        front = [(own["parameters"]["rho"], own["parameters"]["delta"]) for own in result["front"]]
        self.assertGreater(len(front), 5)
        for rho, delta in front:
            self.assertFalse(any(r > rho and d >= delta or r >= rho and d > delta for r, d in front))
        task = self.folder / "task.yaml"
        path = "path: [[0, -0.7], [0, -0.675], [0.5, -0.675], [0.5, -0.7]]"
        task.write_text(f"format: 1\n{path}\nmargin: 0.01\npose_error: 50e-6\n", encoding="utf-8")
        self.assertEqual(
            sorted(own["index"] for own in result["front"]),
            sorted(int(file.stem) for file in (self.folder / "budget" / "front").glob("*.yaml")),
        )
        rho, delta = front[len(front) // 2]
        for more, status in ((1.0, 0), (1.1, 1)):
            words = ["--set", f"rho={rho * more!r}", "--set", f"delta={delta * more!r}"]
            process = self.run_program("verify", STUDIES / "clearances.yaml", task, *words, "-o", "v", status=status)
            self.assertIn("pose error    at most" if status == 0 else "displace the end effector by", process.stdout)

    def test_the_anchor_of_the_softest_spring(self):
        _, result, _ = self.design(STUDIES / "preloaded.yaml", "spring_anchor.yaml", "anchor")
        bound, best = result["best_goal"]
        self.assertEqual(best, result["best"]["parameters"]["k"])
        self.assertLess(best, 22.43, "softer than with the anchor of the file")
        self.assertLess(best - bound, 2 * 200 / 256)
        self.assertLess(best, 15.95 + 200 / 256, "15.95 with the anchor at 1: separate statics at 41 x 41 poses")
        box = "format: 1\nbox: {x: [-0.05, 0.15], y: [0.45, 0.6]}\n"
        (self.folder / "task.yaml").write_text(box, encoding="utf-8")
        for hx in (0.5, 0.6, 0.75, 0.9, 0.94, 1):
            words = ("--set", f"hx={hx}", "--set", f"k={bound * 0.999}", "--quiet", "-o", "out")
            self.run_program("verify", STUDIES / "preloaded.yaml", "task.yaml", *words, status=1)

    def test_softest_spring(self):
        told, result, page = self.design(STUDIES / "preloaded.yaml", "softest_spring.yaml", "spring")
        self.assertIn("k verifies from [22.43627377098", told)
        self.assert_page(page, "22.43627377098", "22.5", "contact lost in A1, B1, P")
        self.assertEqual(len(result["ranges"]), 1)

    def test_proven_lengths(self):
        _, result, page = self.design(FIVE_BAR, "proven_lengths.yaml", "proof")
        self.assert_page(page, "every such design is proven")
        self.assertGreater(result["shares"]["feasible"], 0.5)

    def test_same_bytes_whatever_the_threads(self):
        study = self.study(10)
        for threads in (1, 4):
            self.run_program("design", FIVE_BAR, study, "-o", f"by{threads}", "--threads", threads, "--quiet")
        for name in ("designs.csv", "designs.json", "designs.svg", "report.html"):
            self.assertEqual((self.folder / "by1" / name).read_bytes(), (self.folder / "by4" / name).read_bytes())

    def test_nothing_is_lost_by_kill(self):
        """Killed at ten random moments, then left to end."""
        study = self.study(40)
        self.run_program("design", FIVE_BAR, study, "-o", "whole", "--quiet")
        moments = random.Random(16)
        words = [PROGRAM, "design", FIVE_BAR, study, "-o", self.folder / "killed", "--quiet", "--resume"]
        table = self.folder / "killed" / "designs.table"
        kept = b""
        for _ in range(10):
            process = subprocess.Popen(words, cwd=self.folder, stderr=subprocess.DEVNULL)
            time.sleep(moments.uniform(0.02, 0.5))
            process.kill()
            process.wait()
            now = table.read_bytes() if table.exists() else b""
            whole_lines = kept[: kept.rfind(b"\n") + 1]
            # In the order in which designs were done, until the study is finished.
            self.assertLessEqual(set(whole_lines.splitlines()), set(now.splitlines()), "what was written stays")
            kept = now
        self.run_program("design", FIVE_BAR, study, "-o", "killed", "--quiet", "--resume")
        for name in ("designs.csv", "designs.json"):
            self.assertEqual((self.folder / "whole" / name).read_bytes(), (self.folder / "killed" / name).read_bytes())

    def test_another_study_is_not_gone_on_with(self):
        self.run_program("design", FIVE_BAR, self.study(4), "-o", "here", "--quiet")
        process = self.run_program("design", FIVE_BAR, self.study(5), "-o", "here", "--resume", status=2)
        self.assertIn("another study", process.stderr)

    def test_a_time_limit_keeps_what_is_done(self):
        study = self.study(200)
        self.run_program("design", FIVE_BAR, study, "-o", "here", "--quiet", "--time-limit", 1, status=3)
        result = json.loads((self.folder / "here" / "designs.json").read_text(encoding="utf-8"))
        self.assertFalse(result["complete"])
        self.assertGreater(len(result["designs"]["index"]), 0)


MODULE = BUILD / "studies" / "clearloci_mpi.so"


@unittest.skipUnless(shutil.which("mpirun") and MODULE.exists(), "MPI is not installed, or the build is without it")
class Ranks(InOwnFolder):
    """Three ranks on one machine: the bytes of one process; a rank that is killed ends the run, and it goes on."""

    ENVIRONMENT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}

    def words(self, side, folder):
        study = self.folder / "study.yaml"
        study.write_text(STUDY % (side, side), encoding="utf-8")
        return ["mpirun", "-n", "3", "--oversubscribe", PROGRAM, "design", FIVE_BAR, study, "-o", folder, "--quiet"]

    def run_ranks(self, *words):
        return subprocess.run(
            [str(word) for word in words], cwd=self.folder, env=self.ENVIRONMENT, capture_output=True, text=True
        )

    def test_three_ranks_write_the_bytes_of_one_process(self):
        process = self.run_ranks(*self.words(20, "ranks"))
        self.assertEqual(process.returncode, 0, process.stderr)
        self.run_program("design", FIVE_BAR, self.folder / "study.yaml", "-o", "alone", "--quiet")
        for name in ("designs.csv", "designs.json"):
            self.assertEqual((self.folder / "ranks" / name).read_bytes(), (self.folder / "alone" / name).read_bytes())

    def test_a_killed_rank_ends_the_run_and_resume_goes_on(self):
        words = self.words(120, "ranks")
        process = subprocess.Popen(
            [str(word) for word in words], cwd=self.folder, env=self.ENVIRONMENT, stderr=subprocess.PIPE, text=True
        )
        table = self.folder / "ranks" / "designs.table"
        for _ in range(600):
            if process.poll() is not None or (table.exists() and table.stat().st_size > 20000):
                break
            time.sleep(0.05)
        children = subprocess.run(["ps", "--ppid", str(process.pid), "-o", "pid="], capture_output=True, text=True)
        ranks = [int(word) for word in children.stdout.split()]
        if process.poll() is None and ranks:
            os.kill(ranks[-1], signal.SIGKILL)
            _, complaint = process.communicate(timeout=60)
            self.assertNotEqual(process.returncode, 0, complaint)
        else:
            self.skipTest("the ranks were done, or refused, before one could be killed")
        kept = table.read_bytes()
        again = self.run_ranks(*words, "--resume")
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertLessEqual(set(kept[: kept.rfind(b"\n") + 1].splitlines()), set(table.read_bytes().splitlines()))
        self.run_program("design", FIVE_BAR, self.folder / "study.yaml", "-o", "alone", "--quiet")
        self.assertEqual(
            (self.folder / "ranks" / "designs.csv").read_bytes(), (self.folder / "alone" / "designs.csv").read_bytes()
        )


if __name__ == "__main__":
    unittest.main()
