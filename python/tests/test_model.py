import pickle
from concurrent.futures import ThreadPoolExecutor

import clearloci as cl
import pytest


def test_a_model_says_what_its_file_says(five_bar):
    assert five_bar.parameters["L"] == 0.5
    assert five_bar.exact_parameters["L"] == "1/2"
    assert list(five_bar.coordinates) == ["x", "y"]
    assert five_bar.working_mode == {"B1": "right", "B2": "left"}
    assert "P" in five_bar.joints


def test_new_values_give_another_model(five_bar):
    longer = five_bar.with_parameters(L="0.55")
    assert longer.parameters["L"] == 0.55
    assert five_bar.parameters["L"] == 0.5
    assert longer.with_parameters(d="1/3").parameters["L"] == 0.55


def test_new_values_give_what_a_fresh_file_gives(five_bar):
    member = five_bar.with_parameters(L="9/20").loci()
    fresh = cl.parse(five_bar.text.replace("L: 1/2", "L: 9/20").replace("L: 0.5", "L: 9/20")).loci()
    assert [c.implicit for c in member.curves] == [c.implicit for c in fresh.curves]


def test_wrong_input_says_where_and_what():
    with pytest.raises(cl.InputError) as caught:
        cl.parse("format: 1\nname: nothing\nlinks: 3\n", "wrong.yaml")
    assert isinstance(caught.value, ValueError)
    assert caught.value.file == "wrong.yaml"
    assert caught.value.line > 0
    assert caught.value.what and caught.value.mend
    assert str(caught.value).startswith("wrong.yaml:")


@pytest.mark.parametrize(
    "options",
    [{"engine": "fast"}, {"quantity": "q"}, {"working_mode": "up,down"}, {"working_mode": "left"}, {"joint": "Z9"}],
)
def test_wrong_options_are_input_errors(five_bar, options):
    with pytest.raises(cl.InputError):
        five_bar.loci(**options)


def test_unknown_options_are_type_errors(five_bar):
    with pytest.raises(TypeError):
        five_bar.loci(colour="red")


def test_models_pickle_with_their_values(five_bar):
    again = pickle.loads(pickle.dumps(five_bar.with_parameters(L="0.45")))
    assert again.parameters["L"] == 0.45
    assert again.name == five_bar.name


def test_a_model_may_be_asked_from_several_threads(five_bar):
    with ThreadPoolExecutor(4) as pool:
        numbers = list(pool.map(lambda _: len(five_bar.with_parameters(L="0.52").loci().curves), range(8)))
    assert len(set(numbers)) == 1
