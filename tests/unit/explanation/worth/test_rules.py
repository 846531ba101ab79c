import numpy as np

from bbsd.explanation.worth.rules import single_rules
from tests.unit.architecture.designs import meaning_of, random_architecture, small

WRITTEN = """
  move:
    inputs:
      side: values(x, 0, 3)
    actions:
      left: {x: 0}
      right: {x: 1}
    rules:
      - when: {side: [0, 1]}
        do: left
      - when: {side: [1, 2]}
        do: right
      - otherwise: no action
"""


def rules_of(behaviors, table=None):
    meaning = meaning_of(small(behaviors) + "structure: [move]\n")
    (module,) = meaning.episode.modules
    given = np.frombuffer(module.table.given, np.uint8) if table is None else np.array(table, np.uint8)
    return single_rules(module, given, meaning.spec.behaviors["move"].rules or ())


def test_the_rules_of_the_spec_are_kept():
    left, right, otherwise = rules_of(WRITTEN)
    assert (left.decision, left.where) == ("left", "side is 0 or 1")
    assert (right.decision, right.where) == ("right", "side is 1 or 2")
    assert (otherwise.decision, otherwise.where, otherwise.acts) == ("no action", "", False)
    assert left.cells.tolist() == [True, True, False, False]
    assert right.cells.tolist() == [False, False, True, False]
    assert left.without.tolist() == [0, 2, 2, 0]
    assert right.without.tolist() == [1, 1, 0, 0]
    assert otherwise.without.tolist() == [1, 1, 2, 0]


def test_without_the_last_rule_nothing_is_done():
    *_, otherwise = rules_of(WRITTEN.replace("otherwise: no action", "otherwise: left"))
    assert otherwise.cells.tolist() == [False, False, False, True]
    assert otherwise.without.tolist() == [1, 1, 2, 0]


def test_rules_that_decide_all_cells_need_no_otherwise():
    rules = rules_of(WRITTEN.replace("[1, 2]", "[1, 2, 3]").replace("      - otherwise: no action\n", ""))
    assert [rule.where for rule in rules] == ["side is 0 or 1", "side is not 0"]


def test_another_table_gets_rules_of_its_own():
    rules = rules_of(WRITTEN, [2, 2, 2, 0])
    assert [(rule.decision, rule.where) for rule in rules] == [("no action", "side is 3"), ("right", "")]
    assert rules[0].without.tolist() == [2, 2, 2, 2]
    assert rules[1].without.tolist() == [0, 0, 0, 0]


def test_every_cell_is_decided_by_one_rule():
    behaviors = WRITTEN.split("    rules:", maxsplit=1)[0]
    meaning = meaning_of(small(behaviors) + "structure: [move]\n")
    for seed in range(20):
        (module,), (table,) = meaning.episode.modules, random_architecture(meaning, seed).tables
        rules = single_rules(module, table)
        assert np.sum([rule.cells for rule in rules], axis=0).tolist() == [1, 1, 1, 1]
        for rule in rules:
            assert (rule.without[~rule.cells] == table[~rule.cells]).all()


def test_too_many_rules_are_not_looked_at(monkeypatch):
    monkeypatch.setattr("bbsd.explanation.worth.rules.MOST_RULES", 2)
    assert rules_of(WRITTEN) == []
    monkeypatch.setattr("bbsd.explanation.worth.rules.MOST_RULES", 3)
    assert len(rules_of(WRITTEN)) == 3
    monkeypatch.setattr("bbsd.explanation.worth.rules.MOST_CELLS", 11)
    assert rules_of(WRITTEN) == []
