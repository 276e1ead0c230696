"""What is said where something that the module needs is missing, and where it is found once installed."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import clearloci

PACKAGE = Path(clearloci.__file__).parent
BUILD = Path(os.environ["CLEARLOCI_BUILD"])


def run(program, **environment):
    # Python looks for modules in the working folder first.
    return subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, env={**os.environ, **environment}, cwd=os.sep
    )


def last_line(program, **environment):
    answer = run(program, **environment)
    assert answer.returncode != 0
    return answer.stderr.strip().splitlines()[-1]


def test_numpy_is_named_where_it_is_missing():
    said = last_line("import sys; sys.modules['numpy'] = None; import clearloci")
    assert said.startswith("ImportError: clearloci needs NumPy") and "python3-numpy" in said


def test_a_missing_or_foreign_extension_is_named(tmp_path):
    package = tmp_path / "clearloci"
    shutil.copytree(PACKAGE, package, ignore=shutil.ignore_patterns("*.so", "__pycache__"))
    said = last_line("import clearloci", PYTHONPATH=str(tmp_path))
    assert "not built" in said and "script/build --python" in said
    (package / "_clearloci.cpython-38-x86_64-linux-gnu.so").write_bytes(b"")
    said = last_line("import clearloci", PYTHONPATH=str(tmp_path))
    assert "_clearloci.cpython-38" in said and "pip install" in said


def test_installed_under_a_home_it_is_found_without_a_path(tmp_path):
    prefix = tmp_path / ".local"
    install = ["cmake", "--install", str(BUILD), "--component", "python", "--prefix", str(prefix)]
    subprocess.run(install, check=True, capture_output=True)
    answer = run("import clearloci; print(clearloci.__file__)", PYTHONPATH="", PYTHONUSERBASE=str(prefix))
    assert answer.stdout.startswith(str(prefix)), answer.stderr
