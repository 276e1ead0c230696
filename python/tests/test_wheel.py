"""`pip install .` makes a module that answers."""

import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def test_a_wheel_is_built_and_installed(tmp_path):
    pip = [sys.executable, "-m", "pip", "-q", "--disable-pip-version-check"]
    # The module that the tests run with is packed, rather than built a second time.
    environment = os.environ | {"PIP_NO_INDEX": "1", "PIP_ROOT_USER_ACTION": "ignore"}
    assert "CLEARLOCI_BUILD" in environment
    # From a copy of what it takes: pip leaves folders behind.
    source = tmp_path / "source"
    source.mkdir()
    for name in ("pyproject.toml", "setup.py", "CMakeLists.txt", "README.md", "python"):
        (source / name).symlink_to(ROOT / name)
    subprocess.run(
        [*pip, "wheel", "--no-build-isolation", "--no-deps", "-w", str(tmp_path / "wheels"), str(source)],
        check=True,
        env=environment,
    )
    (wheel,) = (tmp_path / "wheels").glob("clearloci-*.whl")
    site = tmp_path / "site"
    subprocess.run([*pip, "install", "--no-deps", "--target", str(site), str(wheel)], check=True, env=environment)
    asked = (
        "import clearloci as cl; assert cl.__file__.startswith(%r), cl.__file__; "
        "print(len(cl.read(%r).loci().curves) > 0)" % (str(site), str(ROOT / "examples" / "five_bar.yaml"))
    )
    answer = subprocess.run(
        [sys.executable, "-c", asked],
        env=environment | {"PYTHONPATH": str(site)},
        capture_output=True,
        text=True,
        check=True,
        cwd=tmp_path,
    )
    assert answer.stdout == "True\n"
