import numpy as np
import pytest

from bbsd.architecture import Architecture
from bbsd.explanation import explain_architecture, explanation_text
from tests.unit.architecture.designs import SHIPPED, meaning_of, random_architecture, shipped, small
from tests.unit.explanation.test_layers import LARGE, UPPER_NEAR


def text_of(behaviors, tables, structure):
    tables = tuple(np.array(table, np.uint8) for table in tables)
    return explanation_text(
        explain_architecture(meaning_of(small(behaviors)), Architecture(tables, np.array(structure)))
    )


def random_text(name, seed):
    meaning = meaning_of(shipped(name))
    return explanation_text(explain_architecture(meaning, random_architecture(meaning, seed)))


def test_the_hand_made_design(golden):
    golden("explanation/object_lifting_hand.txt", random_text("object_lifting_hand", 0))


def test_a_random_design_of_the_lifting_task(golden):
    golden("explanation/object_lifting_random.txt", random_text("object_lifting", 3))


def test_a_random_design_of_the_abstract_problem(golden):
    golden("explanation/abstract_random.txt", random_text("abstract", 3))


@pytest.mark.parametrize("name", SHIPPED)
@pytest.mark.parametrize("seed", range(3))
def test_lines_fit_into_80_columns(name, seed):
    lines = random_text(name, seed).splitlines()
    assert max(map(len, lines)) <= 80
    assert lines == [line.rstrip() for line in lines]


def test_rules_of_several_actions_are_read_in_order():
    lines = text_of(UPPER_NEAR, [[0, 0, 2, 0, 1, 1], [0, 0]], [0]).splitlines()
    assert lines[3:6] == [
        "1  lower  a where near and pace is not 0",
        "          else b where pace is 2",
        "          else no action",
    ]


@pytest.mark.parametrize(
    ("table", "words"),
    [
        ([1, 1], "always a"),
        ([0, 0], "does nothing"),
        ([0, 1], "a where near"),
        ([1, 0], "a where not near"),
    ],
)
def test_rules_of_one_action_are_a_sentence(table, words):
    assert f"upper  {words}\n" in text_of(UPPER_NEAR, [[0] * 6, table], [1])


def test_exceptions_are_said_as_such():
    assert "a except where near and pace is 2\n" in text_of(UPPER_NEAR, [[1, 1, 1, 1, 1, 0], [0, 0]], [0])


@pytest.mark.parametrize(
    ("lower", "upper", "words"),
    [
        ([1] * 6, [1, 1], "Never controls: upper above always does."),
        ([1] * 6, [0, 1], "Overruled by upper where near."),
        ([1] * 6, [1, 0], "Controls only where near; otherwise overruled by upper."),
    ],
)
def test_what_never_happens_is_said(lower, upper, words):
    assert words in text_of(UPPER_NEAR, [lower, upper], [0, 1])


def test_who_controls_is_counted():
    text = " ".join(text_of(UPPER_NEAR, [[1, 1, 0, 0, 0, 0], [0, 1]], [0, 1]).split())
    assert (
        "Of the 6 situations that the behaviors can tell apart, upper controls 3, lower 2 and nobody 1."
        in text
    )
    assert "Nobody controls where not near and pace is 2 What it could do without" in text


@pytest.mark.parametrize(
    ("table", "words"), [([1, 1], "upper always controls."), ([0, 0], "Nobody ever controls.")]
)
def test_what_is_always_so_is_not_counted(table, words):
    assert words in text_of(UPPER_NEAR, [[0] * 6, table], [1])


def test_a_space_that_is_too_large_is_said_to_be():
    text = text_of(LARGE, [[1] * 1000, [1] * 1000], [0, 1])
    assert "The behaviors can tell about 10^6 situations apart" in text


def test_behaviors_outside_the_structure_are_said_to_be():
    assert "\nlower is not in the structure.\n" in text_of(UPPER_NEAR, [[1] * 6, [0, 1]], [1])


def test_what_steers_a_terminal_is_written_out():
    meaning = meaning_of(
        shipped("object_lifting_hand").replace("name: object-lifting-by-hand", 'name: "a\\eb"')
    )
    assert explanation_text(explain_architecture(meaning, random_architecture(meaning, 0))).startswith(
        "a\\x1bb: 5 layers"
    )


def test_what_a_behavior_expects_is_said_last():
    expecting = UPPER_NEAR.replace("upper: {", "upper: {expects: 'x  >\n    before(x)', ", 1)
    assert expecting != UPPER_NEAR
    lines = text_of(expecting, [[0] * 6, [1, 1]], [1]).splitlines()
    assert lines[3:5] == ["1  upper  always a", "          Expects afterwards: x > before(x)"]
