import pickle

import numpy as np
import pytest

import clearloci as cl
from conftest import EXAMPLES


def test_a_pose_has_reactions_and_an_error(five_bar):
    pose = five_bar.pose((0.25, -0.7))
    assert pose.unreachable is None and not pose.singular and not pose.undefined
    assert np.hypot(*pose.error["displacement"]) <= pose.worst["distance"]
    assert pose.pose_error is pose.error
    assert five_bar.pose((5, 5)).unreachable


def test_reactions_are_vectorised(five_bar):
    poses = np.array([[0.25, -0.7], [0.3, -0.6], [5.0, 5.0]])
    all_at_once = five_bar.reactions(poses)
    one = five_bar.pose(poses[0]).reactions
    assert all_at_once["MA1"][0] == pytest.approx(one["A1"]["M"], rel=1e-9)
    assert all_at_once["fA1x"][0] == pytest.approx(one["A1"]["fx"], rel=1e-9)
    assert all(np.isnan(values[2]) and values.shape == (3,) for values in all_at_once.values())


def test_error_maps_are_arrays(five_bar):
    errors = five_bar.errors((20, 30))
    assert errors.dx.shape == (30, 20)
    assert np.isnan(errors.dx).any() and np.isfinite(errors.dx).any()
    inside = np.isfinite(errors.dp)
    assert np.all(errors.dp[inside] <= errors.worst_dp[inside] * (1 + 1e-9))
    j, i = np.argwhere(inside)[0]
    pose = five_bar.pose((errors.x[i], errors.y[j]))
    assert errors.dx[j, i] == pytest.approx(pose.error["displacement"][0], rel=1e-9)
    assert pickle.loads(pickle.dumps(errors)).dx.shape == (30, 20)


def test_answers_print_in_a_few_lines(five_bar):
    four_bar = cl.read(EXAMPLES / "four_bar.yaml")
    for answer in (five_bar.errors((20, 30)), five_bar.validate([40, 40]), four_bar.errors(90)):
        assert repr(answer).startswith(type(answer).__name__ + "(")
        assert len(repr(answer)) < 500


def test_a_single_coordinate_has_jumps():
    errors = cl.read(EXAMPLES / "four_bar.yaml").errors(90)
    assert len(errors.samples["dx"]) >= 90
    assert errors.units["dx"] == "m"
    for event in errors.events:
        assert event["vanishing"] or event["kind"] in ("workspace-boundary", "direct-singularity", "no-limit")


def test_errors_zone_by_zone(five_bar):
    errors = five_bar.errors((20, 30), worst_case=False, zones=True)
    inside = np.concatenate(list(errors.zones.values()))
    assert len(set(inside)) == len(inside) > 0
    assert np.isfinite(errors.dp.ravel()[inside]).all()
    assert five_bar.errors((20, 30)).zones == {}
    with pytest.raises(ValueError):
        errors.samples


def test_a_motion_has_samples_and_losses(tmp_path):
    folder = EXAMPLES / "pick_and_place"
    motion = cl.read(folder / "manipulator.yaml").trajectory(folder / "path.yaml", periods=[1.0, 2.0], samples=200)
    assert motion.samples["time"][0] == 0 and motion.samples["time"][-1] == pytest.approx(motion.period)
    assert motion.sweep["dx"].shape == (2, len(motion.sweep["distance"]))
    assert all(0 <= loss["time"] <= motion.period for loss in motion.losses)
    with pytest.raises(cl.InputError):
        cl.read(folder / "manipulator.yaml").trajectory(tmp_path / "nothing.yaml")


def test_plots_of_errors_and_motions(five_bar):
    plt = pytest.importorskip("matplotlib.pyplot")
    ax = five_bar.errors((20, 30)).plot("dx")
    assert ax.collections
    assert cl.read(EXAMPLES / "four_bar.yaml").errors(36).plot("dx").lines
    plt.close("all")
