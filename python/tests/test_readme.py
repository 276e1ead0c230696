"""The README's example of the module runs as it is printed there."""

import re
import shutil

from conftest import EXAMPLES, SOURCE


def test_example_runs(tmp_path, monkeypatch):
    readme = (SOURCE / "README.md").read_text(encoding="utf-8")
    (program,) = re.findall(r"^```python\n(.*?)^```$", readme, re.MULTILINE | re.DOTALL)
    assert "m.loci" in program and "m.validate" in program
    shutil.copytree(EXAMPLES, tmp_path / "examples")
    study = tmp_path / "examples/studies/link_lengths.yaml"  # the same on a coarser grid: 2501 designs take seconds
    study.write_text(study.read_text(encoding="utf-8").replace("grid: [41, 61]", "grid: [9, 13]"), encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    names = {}
    exec(compile(program, "README.md", "exec"), names)
    assert names["loci"].curves and (tmp_path / "out" / "error.json").exists()
