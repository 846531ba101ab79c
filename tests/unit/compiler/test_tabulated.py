"""Environments by their tables: the same as the real ones, step by step, and as often as chance has it."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bbsd.compiler import compile_meaning
from bbsd.compiler.tabulated import OUTCOME, STATE, NotTabulated, tabulated
from bbsd.environments.tables import Transition, table_of
from bbsd.evaluation import evaluation_keys, returns_of, trace
from bbsd.evaluation.faults import faulty_meaning, read_fault
from bbsd.evaluation.tracing.scene import starting_values
from bbsd.expression.node_data import TOP_BIT, Slot
from bbsd.kernel.streams import fold, uniform, word_of
from bbsd.solver.random_agents import random_agents
from tests.unit.architecture.designs import meaning_of
from tests.unit.tabular import CLIFF, ICE, LAKE, TAXI, environment_of, walk, with_table


def problem_by_table(text, **options):
    meaning, table = with_table(text)
    return compile_meaning(meaning, table=replace(table, **options), compiled=False)


def fields_of(traced, names):
    return zip(*(traced.values[Slot(name, 0)] for name in names), strict=True)


@pytest.mark.parametrize(
    ("text", "names"),
    [(TAXI, ["row", "column", "passenger", "stand"]), (CLIFF, ["square"]), (ICE, ["square"])],
)
def test_every_step_is_that_of_the_real_environment(text, names):
    problem = problem_by_table(text)
    environment = environment_of(problem.meaning)
    sizes = [field.size for field in problem.meaning.spec.environment.outside.fields]
    agents = random_agents(problem, 5, 8)
    (action,) = problem.meaning.spec.environment.outside.actions
    ended = 0
    for agent in range(len(agents)):
        traced = trace(problem, architecture_of(agents, agent, text), agent, 1)
        environment.reset(seed=0)
        environment.s = int(np.ravel_multi_index([traced.start[Slot(name, 0)] for name in names], sizes))
        actions = traced.values[Slot(action, 0)]
        steps = zip(
            actions,
            fields_of(traced, names),
            traced.values[Slot("earned", 0)],
            traced.rewards["earned"][0],
            strict=True,
        )
        for step, (act, fields, earned, reward) in enumerate(steps, start=1):
            state, real, is_over, _, _ = environment.step(int(act))
            assert list(fields) == list(np.unravel_index(state, sizes))
            assert earned == reward == real
            assert is_over == (step == len(actions)) or step == problem.meaning.spec.environment.steps
        ended += len(actions) < problem.meaning.spec.environment.steps
    assert ended or text is TAXI, "else nothing was seen of the end"


def architecture_of(agents, agent, text):
    """The agent's architecture; the first one of the cliff goes along its edge to the goal."""
    architecture = agents.architecture(agent)
    if text is CLIFF and agent == 0:
        architecture.tables[0][[36, *range(24, 36)]] = [1, *[2] * 11, 3]
    return architecture


def test_all_starts_come_as_often_as_the_environment_has_them():
    problem = problem_by_table(TAXI)
    constants = problem.meaning.constants.vector(1)
    starts = [
        starting_values(problem.meaning, int(key), constants)[STATE] for key in evaluation_keys(3, 3000)
    ]
    states, counts = np.unique(np.array(starts, np.int64), return_counts=True)
    _, table = with_table(TAXI)

    assert set(states) <= set(np.flatnonzero(table.starts))
    assert len(states) == 300
    assert ((counts - 10) ** 2 / 10).sum() < 299 + 5 * np.sqrt(2 * 299)


def test_a_slippery_lake_returns_as_much_as_the_real_one():
    problem = problem_by_table(LAKE)
    environment = environment_of(problem.meaning)
    agents = random_agents(problem, 1, 300)
    best = int(returns_of(problem, agents, evaluation_keys(0, 20), 1).mean(axis=1).argmax())
    table = agents.architecture(best).tables[0]
    ours = returns_of(problem, agents[np.array([best])], evaluation_keys(1, 1500), 1)[0]
    theirs = np.array([played(environment, table, seed) for seed in range(1500)])

    deviation = np.sqrt((ours.var() + theirs.var()) / 1500)
    assert 0.02 < ours.mean() < 0.98, "else the test shows nothing"
    assert abs(ours.mean() - theirs.mean()) < 4 * deviation


def played(environment, table, seed):
    state, _ = environment.reset(seed=seed)
    earned, way = 0.0, 0
    for _ in range(40):
        way = way if table[state] == 0 else int(table[state]) - 1
        state, reward, is_over, _, _ = environment.step(way)
        earned += reward
        if is_over:
            break
    return earned


FLIP = """
bbsd: 1
name: flip
environment:
  gymnasium: Flip-v0
  steps: 1
  observation: {side: COUNT}
  action: throw
  state: {throw: 0}
behaviors: {always: {actions: {throw: {throw: 0}}, rules: [{otherwise: throw}]}}
structure: [always]
reward: {side: side}
"""


@given(st.lists(st.integers(1, 9), min_size=1, max_size=9), st.integers(0, 99))
def test_an_outcome_is_the_first_whose_cumulative_probability_is_greater_than_the_number_drawn(weights, seed):
    chances = np.array(weights) / sum(weights)
    count = len(weights)
    outcomes = {Transition(side, 0.0, False): chance for side, chance in enumerate(chances.tolist())}
    table = table_of([[outcomes]] * count, [1.0, *[0.0] * (count - 1)])
    meaning = tabulated(meaning_of(FLIP.replace("COUNT", str(count))), table)
    problem = compile_meaning(meaning, compiled=False)
    agent = random_agents(problem, 0, 1)
    keys = evaluation_keys(seed, 4)
    sides = returns_of(problem, agent, keys, 1)[0]

    assert sides.tolist() == [expected_side(chances, int(key)) for key in keys]


def expected_side(chances, key):
    drawn = uniform(key, fold(OUTCOME | TOP_BIT, word_of(1)), 0.0, 1.0)
    return float(np.argmax(np.cumsum(chances) > drawn)) if len(chances) > 1 else 0.0


def test_traces_do_not_show_the_state_of_the_table():
    problem = problem_by_table(LAKE)
    traced = trace(problem, random_agents(problem, 0, 1).architecture(0), 1, 1)

    assert {slot.name for slot in traced.values} == {"way", "square", "earned", "place"}
    assert {slot.name for slot in traced.start} == {"way", "square", "earned", "place"}
    assert STATE not in problem.checked_slots


def test_an_environment_may_end_after_a_number_of_steps():
    problem = problem_by_table(CLIFF, most_steps=7)
    traced = trace(problem, random_agents(problem, 0, 1).architecture(0), 1, 1)

    assert len(traced.steps) == 7


def test_a_problem_by_a_table_stays_one_with_another_meaning_and_has_no_stepper():
    meaning, table = with_table(LAKE)
    problem = compile_meaning(meaning, table=table, stepper=lambda: None, compiled=False)
    again = problem.with_meaning(meaning)

    assert problem.stepper is None
    assert not again.meaning.episode.outside
    assert again.table is table
    assert problem.with_meaning(problem.meaning).meaning is problem.meaning


@pytest.mark.parametrize("kind", ["noise(0.5)", "frozen@5", "lost", "silent", "stuck@5", "dead"])
def test_faults_are_of_a_problem_by_a_table_too(kind):
    part = {"silent": "behavior=walk", "stuck@5": "behavior=walk", "dead": "robot=0"}.get(kind, "sensor=seen")
    perceived = 'sensors: {seen: square, place: "values(round(seen), 0, 15)"}'
    text = LAKE.replace('sensors: {place: "values(square, 0, 16 - 1)"}', perceived)
    assert perceived in text
    meaning, table = with_table(text)
    problem = compile_meaning(meaning, table=table, compiled=False)
    faulty = problem.with_meaning(
        faulty_meaning(problem.meaning, read_fault(f"{part}:{kind}", problem.meaning))
    )
    agent, keys = random_agents(problem, 3, 20), evaluation_keys(1, 10)

    assert not faulty.meaning.episode.outside
    assert np.isfinite(returns_of(faulty, agent, keys, 1)).all()


def test_nothing_is_stepped_in_python():
    meaning, table = with_table(TAXI)
    by_table = tabulated(meaning, table)

    assert meaning.episode.outside
    assert not by_table.episode.outside
    assert not by_table.episode.sent
    assert not any(node.operation == "outside" for node in by_table.episode.nodes)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        (
            (("state: {way: 0}", "state: {way: 4}"),),
            "way might be something else than a whole number from 0 to 3",
        ),
        ((("{way: 3}", "{way: 0.5}"),), "way might be something else"),
        ((("{way: 3}", "{way: square % 4}"),), "way might be something else"),
        (
            (("state: {way: 0}", "state: {way: 0}\n  dynamics: {way: way + 1}"),),
            "way might be something else",
        ),
        ((("square: 16", "square: 12"), ("0, 16 - 1", "0, 11")), "has not the 16 states of the table"),
        ((("action: way", "action: [way, other]"), ("{way: 0}", "{way: 0, other: 1}")), "takes one action"),
        (
            (
                ("gymnasium: FrozenLake-v1", "pettingzoo: ice.lake_v1\n  robots: 2"),
                ("{square: 16}", "[square]"),
                ("values(square, 0, 16 - 1)", "cut(square, 8)"),
            ),
            "of one robot's environment",
        ),
    ],
)
def test_what_does_not_fit_a_table_is_said(changes, words):
    text = walk("FrozenLake-v1", 16)
    _, table = with_table(text)
    for old, new in changes:
        assert old in text
        text = text.replace(old, new, 1)
    with pytest.raises(NotTabulated, match=words):
        tabulated(meaning_of(text), table)


def test_an_action_may_be_reset_by_dynamics_and_be_a_constant():
    text = LAKE.replace("name: walk", "name: walk\nconstants: {up: 3}", 1).replace("{way: 3}", "{way: up}")
    text = text.replace("state: {way: 0}", "state: {way: 0}\n  dynamics: {way: 1 if square > 5 else 2}")
    meaning, table = with_table(text)
    assert not tabulated(meaning, table).episode.outside
