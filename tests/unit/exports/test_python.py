import numpy as np
import pytest

from bbsd.architecture import joint_space
from bbsd.architecture.deciding import policy_at
from bbsd.exports.exported import Options
from bbsd.exports.python import write
from bbsd.exports.verification.comparing import cells_to_compare
from bbsd.exports.verification.interpreters import run_cpython, run_micropython
from tests.unit.exports.designs import ODD_NAME, ODD_WORDS, SHIPPED, answers, drawn, hand_made, written


def module(text):
    names = {}
    exec(text, names)
    return names


def only_text(exported):
    (text,) = write(exported, Options()).values()
    return text


@pytest.mark.parametrize("run", [run_cpython, run_micropython])
@pytest.mark.parametrize("name", ["mobile_robot", *SHIPPED])
def test_a_module_decides_in_all_joint_cells_as_the_design(run, name):
    exported = drawn(name, 1) if name == "mobile_robot" else hand_made(name)
    cells = cells_to_compare(exported)
    expected = policy_at(joint_space(exported.meaning), exported.architecture, cells)
    found = answers(run, exported, write(exported, Options()), cells)
    assert found.tolist() == expected.tolist()
    assert len(np.unique(found)) > 1


@pytest.mark.parametrize("run", [run_cpython, run_micropython])
def test_whatever_things_are_called_it_is_a_module(run):
    exported = written(ODD_WORDS, name=ODD_NAME)
    cells = cells_to_compare(exported)
    expected = policy_at(joint_space(exported.meaning), exported.architecture, cells)
    assert answers(run, exported, write(exported, Options()), cells).tolist() == expected.tolist()


def test_it_says_what_an_action_is_and_which_design_it_was():
    exported = hand_made("object_lifting_hand")
    names = module(only_text(exported))
    number = names["command"](pace=5, reached=False, place=names["PLACE_MIDDLE"], tilted=True)
    assert names["ACTIONS"][number] == ("do_not_go_fast", "cap", {"speed": "min(speed, top_speed)"})
    assert names["DIGEST"] == exported.controller.digest


@pytest.mark.parametrize("cells", [(6, 0, 0, 0), (-1, 0, 0, 0), (0, 0, 3, 1)])
def test_a_cell_that_does_not_exist_is_refused(cells):
    with pytest.raises(ValueError, match="there is no cell"):
        module(only_text(hand_made("object_lifting_hand")))["command"](*cells)
