from dataclasses import fields, replace
from itertools import pairwise

import numpy as np
import pytest

from bbsd.architecture import Architecture
from bbsd.evaluation import agents_of, evaluation_key, evaluation_keys, interval, returns_of, trace
from bbsd.explanation.worth import Appraisal
from tests.unit.architecture.designs import random_architecture
from tests.unit.compiler.twins import CORRIDOR_INSIDE, CORRIDOR_OUTSIDE, Corridor
from tests.unit.explanation.worth.planted import appraisal_of, needed, planted
from tests.unit.problems import RICH, problem_of

EPISODES = 30


@pytest.fixture(scope="module")
def appraisal():
    problem = problem_of(RICH)
    return Appraisal(problem, random_architecture(problem.meaning, 2), evaluation_key(0), EPISODES, 1)


@pytest.fixture(scope="module")
def worth(appraisal):
    return appraisal.worth()


def changed(appraisal, **parts):
    design = appraisal.architecture
    other = Architecture(parts.get("tables", design.tables), parts.get("structure", design.structure))
    keys = evaluation_keys(0, EPISODES)
    one, another = (returns_of(appraisal.problem, agents_of([each]), keys, 1)[0] for each in (design, other))
    return interval(another - one)


def test_what_all_earned_is_the_return(worth, appraisal):
    earned = [*(each.earned for each in worth.behaviors), worth.nobody]
    assert list(worth.nobody) == ["near", "level"]
    assert sum(sum(terms.values()) for terms in earned) == pytest.approx(worth.returns.mean, abs=1e-9)
    assert worth.returns.count == EPISODES


def test_a_behavior_is_dropped_with_its_layer(worth, appraisal):
    for each in worth.behaviors:
        kept = [layer for layer in appraisal.layers if appraisal.problem.names[layer] != each.behavior]
        assert each.dropped == changed(appraisal, structure=np.array(kept))


def test_a_rule_is_dropped_from_the_table(worth, appraisal):
    for each in worth.behaviors:
        behavior = appraisal.problem.names.index(each.behavior)
        assert len(each.rules) == len(appraisal.rules[behavior])
        for rule, single in zip(each.rules, appraisal.rules[behavior], strict=True):
            tables = list(appraisal.architecture.tables)
            tables[behavior] = single.without
            if rule.dropped is None:
                assert (single.without == appraisal.architecture.tables[behavior]).all()
            else:
                assert rule.dropped == changed(appraisal, tables=tuple(tables))


def test_the_time_is_divided_as_traces_say(worth, appraisal):
    traces = [trace(appraisal.problem, appraisal.architecture, int(key), 1) for key in appraisal.keys]
    robot_steps = 3 * sum(len(each.steps) for each in traces)
    for each in worth.behaviors:
        behavior = appraisal.problem.names.index(each.behavior)
        excited, activated, controls = 0, 0, 0
        for traced in traces:
            decisions = traced.decisions
            excited += int(decisions.excited[..., behavior].sum())
            activated += int((decisions.excited & (decisions.wishes > 0))[..., behavior].sum())
            controls += int((decisions.controlling == behavior).sum())
        assert each.excited == pytest.approx(excited / robot_steps)
        assert each.activated == pytest.approx(activated / robot_steps)
        assert each.control == pytest.approx(controls / robot_steps)
        assert each.suppressed == pytest.approx((activated - controls) / robot_steps)
        by_rule = sum(rule.control for rule in each.rules)
        assert by_rule == pytest.approx(each.control)
    assert worth.nobody_control == pytest.approx(1 - sum(each.control for each in worth.behaviors))


def test_who_is_excited_and_has_no_action_leaves_control_to_others():
    worth = appraisal_of(planted(), episodes=20).worth()
    _, grab, work = worth.behaviors
    assert grab.excited == work.excited == work.activated == 1.0
    assert 0.3 < grab.control < 0.7
    assert grab.activated == pytest.approx(grab.control)
    assert work.suppressed == pytest.approx(grab.control)
    assert sum(rule.control for rule in work.rules) == pytest.approx(1 - grab.control)
    assert work.rules[1].control == 0


def test_neighbors_are_exchanged(worth, appraisal):
    assert len(worth.swaps) == len(appraisal.layers) - 1
    for swap, (lower, upper) in zip(worth.swaps, pairwise(worth.behaviors[::-1]), strict=True):
        assert (swap.upper, swap.lower) == (upper.behavior, lower.behavior)
        assert swap.change == changed(appraisal, structure=appraisal.architecture.structure[::-1])


def test_random_tables_have_episodes_of_their_own():
    appraisal = appraisal_of(planted(), episodes=50)
    worth = appraisal.worth()
    assert worth.random_tables == 25
    for each in worth.behaviors:
        assert each.random.count == 25
    guard, grab, _ = worth.behaviors
    assert guard.random.mean == guard.random.sd == 0  # never excited, whatever its table is
    assert 0 < grab.random.mean < grab.dropped.mean  # a random table takes less often


def test_behaviors_that_no_layer_has_are_listed(worth, appraisal):
    used = {each.behavior for each in worth.behaviors}
    assert set(worth.left_out) == {*appraisal.problem.names} - used


def test_the_same_seed_gives_the_same_worth_and_progress_is_told(worth, appraisal):
    told = []
    again = Appraisal(appraisal.problem, appraisal.architecture, appraisal.key, EPISODES, 1)
    assert again.worth(lambda *parts: told.append(parts)) == worth
    total = len(appraisal.layers) + 5
    assert told == [(part, total) for part in range(1, total + 1)]


def test_a_frame_has_a_row_for_each_behavior_and_rule(worth):
    pytest.importorskip("pandas")
    table = worth.to_frame()
    assert list(table.columns) == ["layer", "behavior", "rule", "control", "earned", "dropped", "low", "high"]
    assert len(table) == sum(1 + len(each.rules) for each in worth.behaviors)
    behaviors = table[table["rule"] == ""]
    assert behaviors["dropped"].tolist() == [each.dropped.mean for each in worth.behaviors]
    assert behaviors["earned"].sum() + sum(worth.nobody.values()) == pytest.approx(worth.returns.mean)
    assert (
        repr(worth)
        == f"<Worth of rich: {len(worth.behaviors)} behaviors, mean return {worth.returns.mean:.6g}>"
    )


def test_a_part_without_which_rewards_are_not_finite():
    worth = appraisal_of(needed(), episodes=50).worth()
    _, grab, work = worth.behaviors
    assert np.isnan(work.dropped.mean)
    assert np.isnan(work.random.mean)
    assert np.isnan(work.rules[2].dropped.mean)
    assert np.isfinite([grab.dropped.mean, grab.random.mean, work.rules[0].dropped.mean]).all()
    assert not [
        finding for finding in worth.findings if "work" in finding.subjects and finding.kind == "idle"
    ]


def test_a_design_in_a_world_stepped_in_python_is_worth_what_it_is_in_the_same_world_in_the_language():
    inside = problem_of(CORRIDOR_INSIDE, lanes=4)
    stepped = replace(problem_of(CORRIDOR_OUTSIDE, lanes=4), stepper=Corridor)
    one, other = (
        Appraisal(problem, random_architecture(problem.meaning, 5), evaluation_key(0), 12, 1).worth()
        for problem in (inside, stepped)
    )
    assert one.returns.sd > 0
    for field in fields(one):  # state that only one of them has makes robots alike
        if field.name not in ("alike", "findings"):
            assert getattr(one, field.name) == getattr(other, field.name), field.name
    assert [pair.same_action for pair in one.alike] == [pair.same_action for pair in other.alike]
