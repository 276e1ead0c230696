"""What the program prints and writes of an answer, asked for from Python."""

import json
import pickle

import clearloci as cl
import pytest
from conftest import EXAMPLES


@pytest.fixture(scope="module")
def four_bar():
    return cl.read(EXAMPLES / "four_bar.yaml")


def test_loci_are_validated(four_bar):
    answer = four_bar.validate([300])
    assert answer and answer.validated and answer.contradicted == 0 and answer.confirmed > 300
    assert answer.grid == [300] and not answer.contradicted_edges
    assert json.loads(answer.json())["held"] == answer.confirmed
    assert all(own["contradicted"] == 0 for own in answer.reactions)
    assert "300 nodes" in answer.table()
    with pytest.raises(cl.InputError):
        four_bar.validate([300, 300])


def test_poses_of_all_modes(five_bar):
    poses = five_bar.pose((0.25, -0.7), working_mode="all")
    assert len({tuple(pose.working_mode.items()) for pose in poses}) == len(poses) == 4
    own = five_bar.pose((0.25, -0.7))
    assert own.reactions in [pose.reactions for pose in poses]
    assert json.loads(own.json())["at"] == [0.25, -0.7]
    assert "0.25" in own.table()


def test_answers_are_written(tmp_path, five_bar, four_bar):
    errors = five_bar.errors((20, 30))
    names = {path.rsplit("/", 1)[-1] for path in errors.export(tmp_path / "map", ["csv", "vtk"])}
    assert names == {"error.json", "error.csv", "error.vti"}
    with pytest.raises(cl.InputError):
        errors.export(tmp_path, ["dxf"])
    over_one = four_bar.errors(36)
    assert any(path.endswith("error.csv") for path in over_one.export(tmp_path / "one", ["csv"]))
    zones = four_bar.zones()
    again = pickle.loads(pickle.dumps(zones))
    assert again.json() == zones.json() and len(again) == len(zones)
    assert any(path.endswith("zones.svg") for path in again.export(tmp_path / "zones", ["svg"]))


def test_errors_over_volumes():
    volume = cl.read(EXAMPLES / "three_upu.yaml").errors((3, 4, 5))
    assert volume.fields["dp"].shape == (5, 4, 3)
    assert [len(own) for own in volume.axes.values()] == [3, 4, 5]
    assert volume.units["dp"] == "m" and volume.reachable > 0
