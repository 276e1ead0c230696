"""Arguments are named in signatures, and wrong ones are told in Python's words."""

import inspect
import json
import math
from concurrent.futures import ThreadPoolExecutor
from decimal import Decimal
from fractions import Fraction

import clearloci as cl
import numpy as np
import pytest
from conftest import EXAMPLES

QUESTIONS = ("loci", "zones", "verify", "validate", "pose", "reactions", "errors",
             "trajectory")  # fmt: skip


@pytest.mark.parametrize("name", QUESTIONS)
def test_every_argument_has_a_name_and_a_type(name):
    signature = inspect.signature(getattr(cl.Model, name))
    for parameter in list(signature.parameters.values())[1:]:
        assert parameter.kind is not inspect.Parameter.VAR_KEYWORD
        assert parameter.annotation is not inspect.Parameter.empty, parameter
    assert signature.return_annotation is not inspect.Signature.empty
    assert len(getattr(cl.Model, name).__doc__) > 60


WRONG = [
    ("loci", {"tolerance": "x"}),
    ("loci", {"tolerance": math.nan}),
    ("loci", {"tolerance": -1}),
    ("loci", {"tolerance": True}),
    ("loci", {"min_force": math.inf}),
    ("loci", {"min_force": 0}),
    ("loci", {"min_force": "5 apples"}),
    ("loci", {"min_couple": 10**400}),
    ("loci", {"time_limit": -1}),
    ("loci", {"time_limit": [1]}),
    ("loci", {"engine": 3}),
    ("loci", {"engine": "fast"}),
    ("loci", {"joint": 7}),
    ("loci", {"joint": "Z9"}),
    ("loci", {"quantity": ["q"]}),
    ("loci", {"min_force": "1e-999999999"}),
    ("loci", {"min_force": Decimal("1e-999999999")}),
    ("pose", {"at": np.array([1 + 2j, 0])}),
    ("loci", {"mesh_size": None, "working_mode": {"B1": "right"}}),
    ("loci", {"working_mode": 3}),
    ("loci", {"working_mode": [1, 5]}),
    ("loci", {"working_mode": "left"}),
    ("pose", {"at": (0.25,)}),
    ("pose", {"at": (0.25, math.nan)}),
    ("pose", {"at": (10**400, 0)}),
    ("pose", {"at": "0.25,-0.7"}),
    ("pose", {"at": {"x": 0.25}}),
    ("pose", {"at": {"x": 0.25, "z": 0}}),
    ("pose", {"at": ("a", "b")}),
    ("pose", {"at": None}),
    ("reactions", {"poses": [[1, 2, 3]]}),
    ("reactions", {"poses": "here"}),
    ("reactions", {"poses": [[0.1, -0.7]], "working_mode": "all"}),
    ("errors", {"grid": (0, 3)}),
    ("errors", {"grid": (10**30, 3)}),
    ("errors", {"grid": 5}),
    ("errors", {"grid": (2.5, 3)}),
    ("errors", {"grid": (4, 4, 4)}),
    ("validate", {"grid": "12"}),
    ("validate", {"grid": [-4, 4]}),
    ("verify", {"task": 3}),
    ("verify", {"task": {"box": {"x": [math.nan, 1]}}}),
    ("verify", {"task": {"box": {"x": [0, 1]}, "margin": 1j}}),
    ("verify", {"task": {"box": {"x": [0, object()]}}}),
    ("verify", {"task": {"box": object()}}),
    ("verify", {"task": {"box": {"x": [0.1, 0.2], "y": [-0.7, -0.6]}}, "fit": "most"}),
    ("verify", {"task": "no_such_file.yaml"}),
    ("trajectory", {"path": 3}),
    ("trajectory", {"path": "no.yaml", "period": math.nan}),
    ("trajectory", {"path": "no.yaml", "samples": 2}),
    ("trajectory", {"path": "no.yaml", "periods": [1, "x"]}),
    ("trajectory", {"path": "no.yaml", "periods": 1.0}),
    ("with_parameters", {"L": [1]}),
    ("with_parameters", {"L": "1/0"}),
    ("with_parameters", {"L": math.nan}),
    ("with_parameters", {"nothing": 1}),
    ("errors", {"grid": 2**40}),
]


@pytest.mark.parametrize("name,given", WRONG, ids=lambda value: str(value)[:50])
def test_wrong_arguments_are_told_in_words_of_python(five_bar, name, given):
    with pytest.raises((TypeError, ValueError)) as caught:
        getattr(five_bar, name)(**given)
    said = str(caught.value)
    assert said and "--" not in said and "std::" not in said and "_clearloci" not in said, said
    if not isinstance(caught.value, cl.InputError):
        assert any(str(argument) in said for argument in (*given, "task")), said


@pytest.mark.parametrize("wrong", [3, None, b"x"])
def test_texts_are_texts(wrong):
    with pytest.raises(TypeError):
        cl.parse(wrong)
    if wrong != b"x":
        with pytest.raises(TypeError):
            cl.read(wrong)
    with pytest.raises(TypeError):
        cl.Model(wrong)
    with pytest.raises(TypeError):
        cl.design(wrong, {})


@pytest.mark.parametrize("given", [{"period": 1e-300}, {"min_force": 1e-300}, {"periods": [1e-300, 1]}])
def test_numbers_too_small_to_occur_are_refused(given):
    model = cl.read(EXAMPLES / "pick_and_place" / "manipulator.yaml")
    with pytest.raises(ValueError, match="nearer to 0 than 1e-30"):
        model.trajectory(EXAMPLES / "pick_and_place" / "path.yaml", **given)


@pytest.mark.parametrize(
    "given",
    [{"executor": 5}, {"executor": ThreadPoolExecutor, "table": "t"}, {"resume": True}, {"threads": 2000}, {"threads": 10**9}],
)
def test_wrong_arguments_of_studies(five_bar, given):
    task = {"box": {"x": [0.2, 0.3], "y": [-0.8, -0.7]}}
    study = {"vary": {"L": [0.4, 0.6]}, "task": task, "goal": {"maximise": "margin"}, "method": {"grid": [3]}}
    with pytest.raises((TypeError, ValueError), match=next(iter(given)) if "table" not in given else "table"):
        cl.design(five_bar, study, **given)


@pytest.mark.parametrize("study", ["missing.yaml", "", {"vary": {"L": [0.4, 1j]}}, {"vary": {"L": [0.4, math.nan]}}])
def test_wrong_studies(five_bar, study):
    with pytest.raises(ValueError, match="study"):
        cl.design(five_bar, study)


def test_working_modes_in_every_form(five_bar):
    forms = ["left,right", ["left", "right"], [1, -1], five_bar.working_mode | {"B1": "left", "B2": "right"}]
    poses = [five_bar.pose({"y": -0.7, "x": 0.25}, working_mode=form) for form in forms]
    assert all(pose.working_mode == {"B1": "left", "B2": "right"} for pose in poses)
    assert all(pose.reactions == poses[0].reactions for pose in poses)


def test_numbers_are_taken_as_they_are_written(five_bar):
    margins = [five_bar.loci(min_force=number) for number in (2.5, "5/2", Fraction(5, 2), "2.5", np.float64(2.5))]
    assert len({loci.json().split('"timing"')[0] for loci in margins}) == 1
    assert five_bar.with_parameters(L=np.float64(0.45)).exact_parameters["L"] == "9/20"


def test_a_pose_out_of_reach_has_no_numbers(five_bar):
    pose = five_bar.pose((5, 5))
    assert not pose and "B1" in pose.unreachable and "x = 5 is outside its range from -0.5 to 1, in m" in pose.unreachable
    assert "range" not in five_bar.pose((0.9, 0.9)).unreachable
    assert pose.determinant is None and pose.condition is None and pose.singular is None and pose.worst is None
    assert pose.error is None and pose.reactions == {} and pose.points == {}
    with pytest.raises(ValueError, match="out of reach"):
        pose.json()
    limited = cl.parse(five_bar.text + "limits: [{distance: [A1, P], within: [0.31, 0.92]}]\n").pose((0.2, 0.1))
    assert not limited and "limit" in limited.unreachable and limited.determinant is None


def test_every_answer_is_written(five_bar, tmp_path):
    task = {"box": {"x": [0.2, 0.3], "y": [-0.8, -0.7]}}
    four_bar = cl.read(EXAMPLES / "four_bar.yaml")
    study = {"vary": {"L": [0.4, 0.6]}, "task": task, "goal": {"maximise": "margin"}, "method": {"grid": [3]}}
    answers = {
        "pose": five_bar.pose((0.25, -0.7)),
        "validation": four_bar.validate([200]),
        "verify": four_bar.verify({"box": {"theta": ["40 deg", "60 deg"]}}),
        "loci": five_bar.loci(),
        "zones": five_bar.zones(),
        "designs": cl.design(five_bar, study),
    }
    for name, answer in answers.items():
        files = answer.export(tmp_path / name)
        assert any(f"/{name}." in file for file in files), files
        with pytest.raises(ValueError):
            answer.export(tmp_path / name, ["xyz"])
    assert json.loads((tmp_path / "pose" / "pose.json").read_text())["at"] == [0.25, -0.7]
    assert (tmp_path / "pose" / "pose.txt").read_text() == answers["pose"].table()
    assert (tmp_path / "designs" / "best.yaml").exists()
    assert len((tmp_path / "designs" / "designs.csv").read_text().splitlines()) == 4


def test_what_is_open_is_told(five_bar):
    task = {"box": {"x": [0.1, 0.4], "y": [-0.8, -0.6]}, "loads_from": [[-20, -100], [20, -100]]}
    answer = five_bar.verify(task, time_limit=1e-9)
    assert answer.verdict == "undecided" and answer.open["reason"] == "time"
    assert five_bar.verify({"box": {"x": [0.2, 0.3], "y": [-0.8, -0.7]}}).open is None


def test_help_teaches():
    for words in ("working_mode", "m.pose(", "InputError", "SI units"):
        assert words in cl.Model.__doc__
    assert "cl.read(" in cl.__doc__
    assert cl.InputError.__module__ == cl.LimitReached.__module__ == "clearloci"
