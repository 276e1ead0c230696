import math
import pickle

import clearloci as cl
import numpy as np
import pytest
from conftest import EXAMPLES


def upu_forces(place):
    """Forces along the legs of the 3-UPU, which moves without turning."""
    feet = np.array([[0.5, -0.25, -0.25], [0, 0.43, -0.43], [0, 0, 0]])
    tips = np.array([[0.2, -0.1, -0.1], [0, 0.17, -0.17], [0, 0, 0]])
    legs = np.asarray(place)[:, None] + tips - feet
    return np.linalg.solve(legs / np.linalg.norm(legs, axis=0), -np.array([50, 20, -200]))


@pytest.fixture(scope="module")
def upu():
    return cl.read(EXAMPLES / "three_upu.yaml")


def test_zones_of_volumes_are_those_of_statics(upu):
    zones = upu.zones(cells=6000)
    assert zones.complete and zones.modes[0].labels.shape == (64, 64, 64)
    assert zones[0].at_least == max(zone.at_least for zone in zones)
    total = zones.modes[0].in_doubt + zones.modes[0].outside + sum(zone.at_least for zone in zones)
    assert total == pytest.approx(np.prod(np.diff(zones.box)))
    for zone in zones:
        forces = upu_forces(zone.sample)
        assert [zone.signs[f"F_S{leg}"] for leg in (1, 2, 3)] == list(np.sign(forces))
        assert zone.at_least <= zone.at_most and zone.ball[1] > 0
        assert all(face.shape[1] == 3 for face in zone.faces)
    # The volume indexed by z, y, x.
    lower, upper = np.array(zones.box).T
    widths, labels = (upper - lower) / 64, zones.modes[0].labels
    for z, y, x in np.argwhere(labels > 0)[::20011]:
        place = lower + (np.array([x, y, z]) + 0.5) * widths
        zone = zones[labels[z, y, x] - 1]
        assert [zone.signs[f"F_S{leg}"] for leg in (1, 2, 3)] == list(np.sign(upu_forces(place)))
    assert pickle.loads(pickle.dumps(zones)).modes[0].labels.shape == (64, 64, 64)


def test_intervals_have_ends():
    zones = cl.read(EXAMPLES / "four_bar.yaml").zones()
    assert len(zones) == 5 and sum(zone.at_least for zone in zones) == pytest.approx(2 * math.pi)
    assert all(zone.ends and zone.ball is None for zone in zones)
    assert zones.by_cells and zones._repr_svg_().startswith("<?xml")
    with pytest.raises(ValueError):
        zones[0].contains((0, 0))


def test_zones_by_cells_bound_those_between_curves(five_bar):
    faces, cells = five_bar.zones(), five_bar.zones(cells=20000, by_cells=True)
    assert not faces.by_cells and cells.by_cells
    assert cells[0].at_least <= faces[0].size <= cells[0].at_most
    assert faces[0].at_least <= faces[0].area <= faces[0].at_most


def test_tasks_of_poses(upu):
    centre, radius = upu.zones(cells=6000)[0].ball
    lower, upper = np.array(centre) - radius / 4, np.array(centre) + radius / 4
    box = {"box": {name: list(ends) for name, *ends in zip("xyz", lower, upper)}}
    answer = upu.verify(box)
    assert answer and answer.margin > 0 and answer.witness is None
    proven = {own["reaction"]: own["proven"] for own in answer.least}
    for corner in np.ndindex(2, 2, 2):
        place = lower + (upper - lower) * np.array(corner)
        for leg, force in enumerate(upu_forces(place), 1):
            assert 0 < proven[f"F_S{leg}"] <= abs(force) * (1 + 1e-12)
    path = np.array([[-0.3, -0.3, 0.35], [0.35, 0.3, 0.85]])
    assert not np.array_equal(np.sign(upu_forces(path[0])), np.sign(upu_forces(path[1])))
    refuted = upu.verify(path)
    assert refuted.verdict == "refuted" and not refuted
    assert refuted.witness["kind"] in ("vanishing", "singular")
    with pytest.raises(cl.InputError):
        upu.verify({"box": {"x": [0, 1]}})
