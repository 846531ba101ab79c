from math import prod

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bbsd.architecture.rules import rules_of
from bbsd.expression.scope import Findings
from bbsd.language.meaning.tables.rules import table_of_rules
from bbsd.language.meaning.tables.table import OPEN_CELL
from bbsd.language.models import Behavior
from bbsd.text import Source, read
from bbsd.text.writing.writer import write

TRUTH = ("false", "true")
CUT = ("below 2", "2 to 5", "5 to 2 * top", "from 2 * top")
VALUES = ("-1", "0", "1", "2")
NAMED = ("lowest", "highest", "middle")
MISLEADING = ("below 5", "5 to 5", "from 5")  # named like a cut's, but no range of them would be clear
PARTITIONS = (TRUTH, CUT, VALUES, NAMED, MISLEADING, ("no", "1.5", "~"), ("below 2", "from 2"))
ACTIONS = ("left", "right")


def parsed(rules):
    """Rules as they are after they were written to a file and read."""
    document = read(Source("rules.yaml", write({"rules": rules})))
    assert not document.diagnoses
    return Behavior.model_validate({"actions": {}, **document.data}).rules


def decided(rules, inputs):
    findings = Findings()
    table = table_of_rules(rules, inputs, ACTIONS, (), findings)
    assert not findings.mistakes
    return np.frombuffer(table.given, np.uint8)


@st.composite
def inputs_and_tables(draw):
    partitions = draw(st.lists(st.sampled_from(PARTITIONS), max_size=3))
    inputs = {f"input_{place}": cells for place, cells in enumerate(partitions)}
    size = prod(map(len, partitions))
    cells = draw(st.lists(st.integers(0, len(ACTIONS)), min_size=size, max_size=size))
    return inputs, np.array(cells, np.uint8)


@given(inputs_and_tables())
def test_the_rules_give_back_the_table(case):
    inputs, table = case
    assert np.array_equal(decided(parsed(rules_of(table, inputs, ACTIONS)), inputs), table)


@st.composite
def half_made(draw):
    """Inputs, rules of which some may leave cells open, and a table that agrees with them."""
    inputs, table = draw(inputs_and_tables())
    word = st.sampled_from([*ACTIONS, "no action", "open"])
    rules = []
    for _ in range(draw(st.integers(0, 4))):
        named = draw(st.sets(st.sampled_from([*inputs]))) if inputs else ()
        when = {name: [draw(st.sampled_from(inputs[name]))] for name in sorted(named)}
        rules.append({"when": when, "do": draw(word)} if when else {"otherwise": draw(word)})
    given_rules = parsed(rules)
    cells = np.frombuffer(table_of_rules(given_rules, inputs, ACTIONS, (), Findings()).given, np.uint8)
    return inputs, given_rules, np.where(cells == OPEN_CELL, table, cells), (cells == OPEN_CELL).any()


@given(half_made())
def test_given_rules_are_kept_and_only_what_they_leave_open_is_filled(case):
    inputs, given_rules, table, is_open = case
    if is_open:
        rules = parsed(rules_of(table, inputs, ACTIONS, given_rules))
        found = np.frombuffer(table_of_rules(rules, inputs, ACTIONS, (), Findings()).given, np.uint8)
        assert np.array_equal(found, table)
        kept = [
            rule
            for rule in given_rules
            if "open" not in (getattr(rule, "do", ""), getattr(rule, "otherwise", ""))
        ]
        remaining = iter(rules)
        assert all(rule in remaining for rule in kept)


def test_designed_rules_stand_where_the_open_one_stood():
    given_rules = parsed(
        [
            {"when": {"near": True}, "do": "left"},
            {"when": {"pace": 1}, "do": "open"},
            {"otherwise": "no action"},
        ]
    )
    inputs = {"near": TRUTH, "pace": VALUES}
    table = np.array([0, 0, 2, 0, 1, 1, 1, 1], np.uint8)
    assert rules_of(table, inputs, ACTIONS, given_rules) == [
        {"when": {"near": True}, "do": "left"},
        {"when": {"pace": 1}, "do": "right"},
        {"otherwise": "no action"},
    ]


def test_rules_say_what_a_designer_would_say():
    inputs = {"place": NAMED, "tilted": TRUTH}
    assert rules_of(np.array([0, 1, 0, 0, 0, 0], np.uint8), inputs, ["faster"]) == [
        {"when": {"place": "lowest", "tilted": True}, "do": "faster"},
        {"otherwise": "no action"},
    ]


@pytest.mark.parametrize(
    ("cells", "words"),
    [
        ([1, 1, 0, 0], "below 5"),
        ([0, 1, 1, 0], "2 to 2 * top"),
        ([0, 0, 1, 1], "from 5"),
        ([0, 1, 0, 0], "2 to 5"),
        ([1, 0, 0, 1], ["below 2", "from 2 * top"]),
    ],
)
def test_neighboring_cells_of_a_cut_are_one_range(cells, words):
    rules = rules_of(np.array(cells, np.uint8), {"tilt": CUT}, ["act"])
    assert rules[0] == {"when": {"tilt": words}, "do": "act"}


def test_numbers_are_numbers_and_several_cells_a_list():
    rules = rules_of(np.array([1, 0, 1, 0], np.uint8), {"pace": VALUES}, ["act"])
    assert rules[0] == {"when": {"pace": [-1, 1]}, "do": "act"}


def test_inputs_that_do_not_matter_are_left_out():
    rules = rules_of(np.array([0, 0, 1, 1, 0, 0], np.uint8), {"place": NAMED, "tilted": TRUTH}, ["act"])
    assert rules[0] == {"when": {"place": "highest"}, "do": "act"}


@pytest.mark.parametrize(("cells", "word"), [([0, 1], "no action"), ([1, 1], "act"), ([0, 0], "no action")])
def test_the_most_common_decision_comes_last_and_of_equals_no_action(cells, word):
    assert rules_of(np.array(cells, np.uint8), {"tilted": TRUTH}, ["act"])[-1] == {"otherwise": word}


def test_a_table_of_one_cell_is_one_rule():
    assert rules_of(np.array([1], np.uint8), {}, ["push"]) == [{"otherwise": "push"}]


def test_rules_with_too_many_words_are_none():
    table, inputs = np.array([1, 0, 1, 0], np.uint8), {"pace": VALUES}
    assert rules_of(table, inputs, ["act"], most_words=3) == rules_of(table, inputs, ["act"])
    assert rules_of(table, inputs, ["act"], most_words=2) is None
