"""The examples of the module in the documentation run as they are printed there."""

import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest
from conftest import EXAMPLES, SOURCE


@pytest.mark.parametrize("page,file", [("README.md", "out/error.json"), ("docs/reference/python.md", "out/loci/loci.csv")])
def test_example_runs(page, file, tmp_path, monkeypatch):
    text = (SOURCE / page).read_text(encoding="utf-8")
    (program,) = re.findall(r"^```python\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
    shutil.copytree(EXAMPLES, tmp_path / "examples")
    monkeypatch.chdir(tmp_path)
    names = {}
    exec(compile(program, page, "exec"), names)
    assert names["loci"].curves and (tmp_path / file).exists()


def test_the_steps_to_the_module_work(tmp_path):
    """In a clone without anything but the build that is being tested, and in a home without anything."""
    build = Path(os.environ["CLEARLOCI_BUILD"])
    for name in ("pyproject.toml", "setup.py", "CMakeLists.txt", "README.md", "python"):
        (tmp_path / name).symlink_to(SOURCE / name)
    (tmp_path / "build").mkdir()
    (tmp_path / "build" / "release").symlink_to(build)
    left_out = ("PYTHONPATH", "PYTHONUSERBASE", "CLEARLOCI_BUILD", "VIRTUAL_ENV")
    environment = {name: value for name, value in os.environ.items() if name not in left_out}
    environment |= {"HOME": str(tmp_path), "PIP_NO_INDEX": "1", "PIP_DISABLE_PIP_VERSION_CHECK": "1"}
    text = (SOURCE / "docs" / "reference" / "python.md").read_text(encoding="utf-8")
    commands = [line for block in re.findall(r"^```sh\n(.*?)^```$", text, re.M | re.S) for line in block.splitlines()]
    assert commands[0] == "script/build --python"  # the build that is being tested is that already
    for command in commands[1:]:
        answer = subprocess.run(
            ["sh", "-c", command], cwd=tmp_path, env=environment, capture_output=True, text=True
        )
        assert answer.returncode == 0, f"{command}\n{answer.stdout}{answer.stderr}"
        if "print(" in command:
            assert re.fullmatch(r"[0-9.]+\n", answer.stdout), answer.stdout
