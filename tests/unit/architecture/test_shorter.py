import re

import numpy as np
import pytest

from bbsd.architecture import HolesLeft, architecture_of, designed_text, joint_space, policy
from bbsd.architecture.shorter import TooLargeToProve, shorter
from bbsd.language.loading import load
from bbsd.text import Source
from tests.unit.architecture.designs import random_architecture, shipped, small
from tests.unit.explanation.test_layers import LARGE

WORDY = """
bbsd: 1
name: wordy
environment: {steps: 1, state: {x: 0}}
behaviors:
  lower:  # the one below
    inputs: {near: x > 1, pace: "values(floor(x), 0, 2)"}
    actions: {a: {x: 1}, b: {x: 2}}
    rules:
      - {when: {near: true, pace: [0, 1]}, do: b}
      - {when: {near: false, pace: [0, 1, 2]}, do: a}
      - otherwise: no action
  never:
    inputs: {near: x > 1}
    actions: {a: {x: 1}}
    rules: [otherwise: a]
  # a comment that stays
  upper: {inputs: {near: x > 1}, actions: {a: {x: 2}}, rules: [{when: {near: true}, do: a}, otherwise: no action]}
structure: [upper, lower, never]   # in this order
reward: {right: x}
"""


def loaded(text):
    return load(Source("spec.yaml", text))


def policy_of(text):
    meaning = loaded(text).meaning
    return policy(joint_space(meaning), architecture_of(meaning))


def test_what_does_not_matter_makes_rules_shorter():
    found = shorter(loaded(WORDY))
    assert [(each.behavior, each.before, each.now) for each in found.shortened] == [("lower", 10, 1)]
    assert (found.removed, found.joint_cells) == (("never",), 6)
    assert "    rules:\n      - otherwise: a\n" in found.text
    assert "structure: [upper, lower]   # in this order\n" in found.text


def test_all_else_stays_as_it_was():
    before, after = (text.splitlines() for text in (WORDY, shorter(loaded(WORDY)).text))
    assert [line for line in after if line not in before] == [
        "      - otherwise: a",
        "structure: [upper, lower]   # in this order",
    ]
    assert "  # a comment that stays" in after


def test_it_does_the_same_in_every_joint_cell():
    assert np.array_equal(policy_of(WORDY), policy_of(shorter(loaded(WORDY)).text))


@pytest.mark.parametrize("name", ["abstract", "object_lifting"])
@pytest.mark.parametrize("seed", range(6))
def test_random_designs_become_shorter_and_stay_the_same(name, seed):
    spec = loaded(shipped(name))
    text = designed_text(spec, random_architecture(spec.meaning, seed))
    found = shorter(loaded(text))
    assert np.array_equal(policy_of(text), policy_of(found.text))
    assert all(each.now < each.before for each in found.shortened)
    assert not shorter(loaded(found.text)).is_changed


def test_what_is_short_stays_as_it_is():
    text = shipped("object_lifting_hand")
    found = shorter(loaded(text))
    assert (found.text, found.is_changed) == (text, False)


def test_a_table_becomes_rules_where_they_are_shorter():
    behavior = (
        '  one: {inputs: {fine: "values(floor(x), 0, 9)"}, actions: {a: {x: 1}}, table: "..1......."}\n'
    )
    found = shorter(loaded(small(behavior)))
    assert (found.shortened[0].before, found.shortened[0].now, found.shortened[0].was_table) == (10, 3, True)
    assert "table" not in found.text
    assert re.search(r"when: \{fine: 2\}", found.text)


def test_a_design_is_needed():
    with pytest.raises(HolesLeft):
        shorter(loaded(shipped("object_lifting")))


def test_what_is_too_large_to_prove_is_refused():
    given = LARGE.replace("actions: {go: {x: 1}}", "actions: {go: {x: 1}}, rules: [otherwise: go]")
    given = given.replace("actions: {go: {x: 2}}", "actions: {go: {x: 2}}, rules: [otherwise: go]")
    with pytest.raises(TooLargeToProve, match=r"1,000,000 situations apart, more than 200,000"):
        shorter(loaded(small(given + "structure: [one, two]\n")))


def test_the_proof_finds_a_difference(monkeypatch):
    monkeypatch.setattr(
        "bbsd.architecture.shorter.where_decisions_matter",
        lambda _, design: [np.zeros(len(table), bool) for table in design.tables],
    )
    with pytest.raises(RuntimeError, match="not do the same"):
        shorter(loaded(WORDY))
