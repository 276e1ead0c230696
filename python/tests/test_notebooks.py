"""Runs every code cell of the notebooks, in order, in the folder of the notebook."""

import json
import os

import pytest
from conftest import EXAMPLES

NOTEBOOKS = sorted((EXAMPLES / "notebooks").glob("*.ipynb"))


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebook(path, monkeypatch):
    plt = pytest.importorskip("matplotlib.pyplot")
    monkeypatch.chdir(path.parent)
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    names = {}
    for cell in cells:
        if cell["cell_type"] == "code":
            exec(compile("".join(cell["source"]), os.fspath(path), "exec"), names)
    plt.close("all")


def test_there_are_notebooks():
    assert len(NOTEBOOKS) >= 2
