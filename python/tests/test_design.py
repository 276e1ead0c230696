"""Studies in Python: the same designs by threads, by processes, and by Dask."""

from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor

import clearloci as cl
import numpy as np
import pytest

STUDY = {
    "vary": {"L": [0.3, 0.7], "d": [0.3, 0.7]},
    "task": {"box": {"x": [0.1, 0.4], "y": [-0.7, -0.5]}},
    "goal": {"maximise": "margin"},
    "method": {"grid": [9, 8]},
}


def same(a, b):
    assert a.columns.keys() == b.columns.keys()
    for name in a.columns:
        if isinstance(a.columns[name], list):
            assert a.columns[name] == b.columns[name]
        else:
            np.testing.assert_array_equal(a.columns[name], b.columns[name])
    assert (a.best, a.front, a.complete) == (b.best, b.front, b.complete)


@pytest.fixture(scope="module")
def designs(five_bar):
    return cl.design(five_bar, STUDY)


def test_the_best_is_verified(five_bar, designs):
    assert len(designs) == 72 and designs.complete
    assert designs.columns["margin"][designs.feasible].max() == designs.columns["margin"][designs.best]
    answer = designs.best_design.verify(STUDY["task"])
    assert answer and answer.margin == pytest.approx(designs.columns["margin"][designs.best], rel=3e-3)


@pytest.mark.parametrize("pool", [ThreadPoolExecutor, ProcessPoolExecutor])
def test_any_executor_says_the_same(five_bar, designs, pool):
    with pool(max_workers=2) as executor:
        same(cl.design(five_bar, STUDY, executor=executor, chunk=25), designs)


def test_dask_says_the_same(five_bar, designs):
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(n_workers=1, threads_per_worker=1, processes=False, dashboard_address=None) as cluster:
        with distributed.Client(cluster) as client:
            same(cl.design(five_bar, STUDY, executor=client.get_executor(), chunk=40), designs)


def test_a_proof_over_one_parameter_has_ranges(five_bar):
    study = {"vary": {"L": [0.3, 0.9]}, "task": STUDY["task"], "goal": {"minimise": "L"}, "method": {"prove": "1/65536"}}
    answer = cl.design(five_bar, study)
    begin, end, below, _ = answer.ranges[0]
    assert begin[0] <= begin[1] < end[0] <= end[1] and below == "workspace"
    assert begin[1] <= answer.best_design.parameters["L"] <= end[0]
    assert answer.best_design.verify(STUDY["task"])


def test_a_task_may_bound_the_pose_error(five_bar):
    task = dict(STUDY["task"], pose_error=0.1)
    answer = five_bar.verify(task)
    assert answer and 0 < answer.pose_error < 0.1
    refuted = five_bar.verify(dict(task, pose_error=answer.pose_error * 0.95))
    assert refuted.verdict == "refuted" and refuted.witness["kind"] == "displaced"
    assert refuted.witness["size"] > answer.pose_error * 0.95


def test_tolerances_have_a_witness(five_bar):
    task = dict(STUDY["task"], tolerances={"L": 0.12})
    answer = five_bar.verify(task)
    assert not answer and answer.witness["design"]["L"] < 0.5
    with pytest.raises(cl.InputError):
        five_bar.verify(dict(task, tolerances={"q": 1}))
