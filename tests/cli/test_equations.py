"""The printed equations of mechanisms with groups, run as programs: they close and balance as the program's poses do."""

import json
import shutil
import subprocess
import unittest

from program import SOURCE, InOwnFolder

GROUPS = {"three_rpr_legs": [0.72, 0.8, 0.66], "stephenson_outside": [2.15]}


def solved(matrix, right):
    """By Gauss's elimination with pivots."""
    rows = [list(row) + [value] for row, value in zip(matrix, right)]
    for k in range(len(rows)):
        pivot = max(range(k, len(rows)), key=lambda i: abs(rows[i][k]))
        rows[k], rows[pivot] = rows[pivot], rows[k]
        for i in range(len(rows)):
            if i != k:
                factor = rows[i][k] / rows[k][k]
                rows[i] = [a - factor * b for a, b in zip(rows[i], rows[k])]
    return [row[-1] / row[k] for k, row in enumerate(rows)]


class Groups(InOwnFolder):
    def pose(self, example, pose):
        at = ",".join(repr(value) for value in pose)
        return json.loads(self.run_program("pose", SOURCE / "examples" / f"{example}.yaml", "--at", at, "--json").stdout)

    def equations(self, example, *options):
        return self.run_program("equations", SOURCE / "examples" / f"{example}.yaml", *options).stdout

    def unknowns(self, example, pose):
        """The pose's coordinates, then those of the groups' points, by their names in the sheet."""
        places = self.pose(example, pose)["posture"]
        sheet = json.loads(self.equations(example, "--json"))
        values = list(pose)
        for name in sheet["coordinates"][len(pose):]:
            values.append(places[name[1:]]["xyz".index(name[0])])
        return sheet, values

    def test_close_and_balance(self):
        for example, pose in GROUPS.items():
            with self.subTest(example):
                sheet, values = self.unknowns(example, pose)
                self.assertEqual(len(sheet["closing"]), len(values) - len(pose))
                written = {}
                exec(self.equations(example, "--language", "python"), written)
                for residual in written["closing"](*values):
                    self.assertLess(abs(residual), 1e-9)
                forces = dict(zip(written["UNKNOWNS"], solved(*written["newton_euler"](*values))))
                compared = 0
                for joint, own in self.pose(example, pose)["reactions"].items():
                    for axis in "xy":
                        if "f" + axis in own:
                            value = own["f" + axis]
                            self.assertAlmostEqual(forces[f"f{joint}{axis}"], value, delta=1e-6 * max(1, abs(value)))
                            compared += 1
                self.assertGreater(compared, 6)

    @unittest.skipUnless(shutil.which("cc"), "no C compiler")
    def test_c_closes(self):
        example, pose = "three_rpr_legs", GROUPS["three_rpr_legs"]
        sheet, values = self.unknowns(example, pose)
        code = self.equations(example, "--language", "c")
        count = len(sheet["closing"])
        arguments = ", ".join(repr(value) for value in values)
        (self.folder / "sheet.c").write_text(
            code + f"\n#include <stdio.h>\nint main(void) {{\n  double g[{count}];\n  closing({arguments}, g);\n"
            + f'  for (int i = 0; i < {count}; ++i) printf("%.17g\\n", g[i]);\n  return 0;\n}}\n', encoding="utf-8")
        subprocess.run(["cc", "-o", "sheet", "sheet.c", "-lm"], cwd=self.folder, check=True)
        printed = subprocess.run([self.folder / "sheet"], check=True, capture_output=True, text=True).stdout.split()
        self.assertEqual(len(printed), count)
        for residual in printed:
            self.assertLess(abs(float(residual)), 1e-9)


if __name__ == "__main__":
    unittest.main()
