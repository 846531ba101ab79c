"""Exact returns by tables: worked by hand, by recursion over all that may happen, and beside sampled episodes."""

from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bbsd.architecture import Architecture
from bbsd.compiler import compile_meaning
from bbsd.environments.tables import Transition, table_of
from bbsd.evaluation import NotEnumerable, agents_of, evaluation_keys, returns_of
from bbsd.evaluation.exact.single_steps import steps_of
from bbsd.evaluation.exact.tables import exact_evaluation, optimum_by_table
from bbsd.solver.random_agents import random_agents
from tests.unit.architecture.designs import meaning_of
from tests.unit.tabular import LAKE, TAXI, with_table

MADE_UP = """
bbsd: 1
name: made-up
environment:
  gymnasium: MadeUp-v0
  steps: STEPS
  observation: {at: STATES}
  action: way
  state: {way: 0}
behaviors:
  go:
    inputs: [at]
    actions: {left: {way: 0}, right: {way: 1}}
reward: {earned: earned, further: "-1 if at == 0 else 0"}
"""


def made_up(states, steps, text=MADE_UP):
    return meaning_of(text.replace("STATES", str(states)).replace("STEPS", str(steps)))


def design(*choices):
    """A design of one behavior: 0 is No Action, 1 left, 2 right, in each state."""
    return Architecture((np.array(choices, np.uint8),), np.array([0]))


# Three states. 0: left stays, earning 1; right goes to 1, or with 1/4 to 2. 1: left to 0 for 2; right ends for 6.
# 2: both stay for nothing.
ROWS = [
    [{Transition(0, 1.0, False): 1.0}, {Transition(1, 0.0, False): 0.75, Transition(2, 0.0, False): 0.25}],
    [{Transition(0, 2.0, False): 1.0}, {Transition(1, 6.0, True): 1.0}],
    [{Transition(2, 0.0, False): 1.0}, {Transition(2, 0.0, False): 1.0}],
]
TABLE = table_of(ROWS, [0.5, 0.5, 0.0])


def evaluated(choices, steps, table=TABLE, text=MADE_UP):
    problem = compile_meaning(made_up(table.n_states, steps, text), table=table, compiled=False)
    return exact_evaluation(problem, table, design(*choices), 1)


def test_three_states_by_hand():
    # Right everywhere, two steps. From 0: 0, then 6 (3/4) or 0 (1/4): 4.5. From 1: 6 at once.
    found = evaluated([2, 2, 2], 2)

    assert found.exact
    assert found.mean == pytest.approx((4.5 + 6) / 2)
    assert found.sd == pytest.approx(np.sqrt(36 * 7 / 8 - (10.5 / 2) ** 2))
    assert found.steps == pytest.approx((2 + 1) / 2)
    assert found.reward_terms == {"earned": pytest.approx(10.5 / 2), "further": 0.0}
    assert found.control_share == {"go": pytest.approx(1.0), "nobody": 0.0}


def test_own_terms_and_who_controls_by_hand():
    # No Action in 0: the command is still 0, left, for 1; left in 1 goes to 0. From 0: 1 + 1. From 1: 2 + 1.
    found = evaluated([0, 1, 1], 2)

    assert found.reward_terms["earned"] == pytest.approx(5 / 2)
    # One less in each step that leads to 0.
    assert found.reward_terms["further"] == pytest.approx(-2)
    assert found.mean == pytest.approx(1 / 2)
    assert found.control_share == {"go": pytest.approx(1 / 4), "nobody": pytest.approx(3 / 4)}


def test_a_command_that_stays_where_nobody_controls_is_part_of_the_state():
    # From 1 left; in 0 nobody controls. So in 0 it goes on to the left, and with a right before it would go right.
    right_first = "state: {way: 1}"
    found = evaluated([0, 0, 0], 2, text=MADE_UP.replace("state: {way: 0}", right_first))

    assert found.reward_terms["earned"] == pytest.approx((4.5 + 6) / 2)
    assert evaluated([0, 0, 0], 2).reward_terms["earned"] == pytest.approx((2 + 3) / 2)


def test_the_optimum_of_three_states_by_hand():
    # Without the other term: from 1 take 6 at once, or first 2 and then from 0; with three steps left from 0 go right.
    text = MADE_UP.replace(', further: "-1 if at == 0 else 0"', "")

    def best(steps):
        problem = compile_meaning(made_up(3, steps, text), table=TABLE, compiled=False)
        return optimum_by_table(problem, TABLE, 1)

    assert best(1).best == pytest.approx((1 + 6) / 2)
    assert best(2).best == pytest.approx((4.5 + 6) / 2)
    # From 0: stay for 1, then 4.5. From 1: 2, then 4.5.
    assert best(3).best == pytest.approx((5.5 + 6.5) / 2)
    # Always the same: right in both, since left in 1 never ends well within three steps: from 1 2 + 0 + 2.
    assert best(3).fixed == pytest.approx((4.5 + 6) / 2)


@st.composite
def tables(draw):
    n_states = draw(st.integers(2, 4))
    rows = []
    for _ in range(n_states):
        row = []
        for _ in range(2):
            transitions = st.builds(
                Transition, st.integers(0, n_states - 1), st.integers(-3, 3).map(float), st.booleans()
            )
            kinds = draw(st.lists(transitions, min_size=1, max_size=3, unique=True))
            weights = np.array(draw(st.lists(st.integers(1, 4), min_size=len(kinds), max_size=len(kinds))))
            row.append(dict(zip(kinds, (weights / weights.sum()).tolist(), strict=True)))
        rows.append(row)
    weights = np.array(draw(st.lists(st.integers(0, 3), min_size=n_states, max_size=n_states))) + 0.0
    weights[draw(st.integers(0, n_states - 1))] += 1
    return rows, (weights / weights.sum()).tolist()


@settings(max_examples=25)
@given(tables(), st.lists(st.integers(0, 2), min_size=4, max_size=4), st.integers(1, 5))
def test_any_design_earns_what_recursion_over_all_that_may_happen_says(made, choices, steps):
    rows, starts = made
    table = table_of(rows, starts)

    @cache
    def moments(state, command, left):
        """Mean and mean square of what is still earned."""
        if left == 0:
            return 0.0, 0.0
        command = choices[state] - 1 if choices[state] else command
        mean = square = 0.0
        for (then, reward, ended), chance in rows[state][command].items():
            gain = reward - (then == 0)
            later, later_square = (0.0, 0.0) if ended else moments(then, command, left - 1)
            mean += chance * (gain + later)
            square += chance * (gain**2 + 2 * gain * later + later_square)
        return mean, square

    mean, square = np.array([moments(state, 0, steps) for state in range(len(rows))]).T @ np.array(starts)
    found = evaluated(choices[: len(rows)], steps, table)

    assert found.mean == pytest.approx(mean, abs=1e-9)
    assert found.sd**2 == pytest.approx(square - mean**2, abs=1e-9)
    assert sum(found.reward_terms.values()) == pytest.approx(mean, abs=1e-9)


@settings(max_examples=25)
@given(tables(), st.integers(1, 5))
def test_the_optimum_is_that_of_value_iteration_on_the_table(made, steps):
    rows, starts = made
    table = table_of(rows, starts)
    values = np.zeros(len(rows))
    for _ in range(steps):
        values = np.array(
            [
                max(
                    sum(
                        chance * (reward - (then == 0) + (0.0 if ended else values[then]))
                        for (then, reward, ended), chance in outcomes.items()
                    )
                    for outcomes in row
                )
                for row in rows
            ]
        )
    problem = compile_meaning(made_up(len(rows), steps), table=table, compiled=False)
    found = optimum_by_table(problem, table, 1)

    assert found.best == pytest.approx(float(values @ np.array(starts)), abs=1e-9)


WELL_KNOWN = [0, 3, 3, 3, 0, 0, 0, 0, 3, 1, 0, 0, 0, 2, 1, 0]
"""What is best on the lake if there is no end of time."""


def test_a_sample_of_episodes_agrees():
    meaning, table = with_table(LAKE)
    problem = compile_meaning(meaning, table=table, compiled=False)
    architecture = design(*(way + 1 for way in WELL_KNOWN))
    found = exact_evaluation(problem, table, architecture, 1)
    returns = returns_of(problem, agents_of([architecture]), evaluation_keys(1, 3000), 1)[0]

    assert 0.3 < found.mean < 0.7
    assert abs(returns.mean() - found.mean) < 4 * found.sd / np.sqrt(3000)
    assert returns.std() == pytest.approx(found.sd, rel=0.05)


def test_every_start_counts_as_much_as_the_environment_has_it():
    meaning, table = with_table(TAXI)
    problem = compile_meaning(meaning, table=table, compiled=False)
    architecture = random_agents(problem, 1, 1).architecture(0)
    found = exact_evaluation(problem, table, architecture, 1)
    returns = returns_of(problem, agents_of([architecture]), evaluation_keys(1, 1500), 1)[0]

    assert found.episodes == 300
    assert abs(returns.mean() - found.mean) < 4 * found.sd / np.sqrt(1500)
    assert returns.std() == pytest.approx(found.sd, rel=0.15)


def test_compiled_steps_are_the_same_to_the_last_bit(monkeypatch):
    meaning, table = with_table(LAKE)
    problem = compile_meaning(meaning, table=table, compiled=False)
    architecture = random_agents(problem, 1, 1).architecture(0)
    plain = steps_of(problem, table, 1, architecture)
    monkeypatch.setattr("bbsd.evaluation.exact.single_steps.WORTH_COMPILING", 0)
    compiled = steps_of(problem, table, 1, architecture)

    for name in ("starts", "targets", "probabilities", "terms", "control", "met"):
        np.testing.assert_array_equal(getattr(plain, name), getattr(compiled, name))


MEMORY = """
bbsd: 1
name: memory
environment:
  gymnasium: MadeUp-v0
  steps: 4
  observation: {at: 3}
  action: way
  world: {coin: chance(0.25)}
  state: {way: 0, seen: false, n: "integers(1, 2)"}
  dynamics:
    seen: seen or at == 1
    coin: chance(0.25)
    n: 1 if chance(0.5) else n
  sensors: {lucky: coin, late: step >= 2}
behaviors:
  go:
    inputs: [seen, lucky, late]
    actions: {left: {way: 0}, right: {way: 1}}
    expects: at == before(at)
reward: {earned: earned * n, lucky: 0.5 if coin else 0}
"""


def test_memory_draws_of_the_spec_and_the_step_are_part_of_the_state():
    problem = compile_meaning(meaning_of(MEMORY), table=TABLE, compiled=False)
    architecture = Architecture((np.array([1, 2, 0, 2, 2, 1, 1, 2], np.uint8),), np.array([0]))
    found = exact_evaluation(problem, TABLE, architecture, 1)
    returns = returns_of(problem, agents_of([architecture]), evaluation_keys(5, 4000), 1)[0]

    assert abs(returns.mean() - found.mean) < 4 * found.sd / np.sqrt(4000)
    assert returns.std() == pytest.approx(found.sd, rel=0.1)
    # The coin falls in every step anew, whatever is done.
    assert found.reward_terms["lucky"] == pytest.approx(0.5 * 0.25 * found.steps)
    assert 0.0 < found.expectation_share["go"] < 1.0


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        (
            "coin: chance(0.25)\n    n",
            "coin: uniform(0, 1) < 0.25\n    n",
            "uniform.* no finite list of values",
        ),
        (
            "n: 1 if chance(0.5) else n",
            "n: n + integers(1, 2000)",
            "8000 combinations of values are drawn in a step",
        ),
        ("n: 1 if chance(0.5) else n", "n: n / 0", "a value is infinite or not a number"),
    ],
)
def test_what_cannot_be_exact_is_refused_with_words(old, new, words):
    assert old in MEMORY
    problem = compile_meaning(meaning_of(MEMORY.replace(old, new)), table=TABLE, compiled=False)
    with pytest.raises(NotEnumerable, match=words):
        exact_evaluation(problem, TABLE, Architecture((np.ones(8, np.uint8),), np.array([0])), 1)


def test_too_many_states_are_refused(monkeypatch):
    monkeypatch.setattr("bbsd.evaluation.exact.single_steps.MOST_STATES", 30)
    text = MEMORY.replace("n: 1 if chance(0.5) else n", "n: n * 2")
    problem = compile_meaning(meaning_of(text), table=TABLE, compiled=False)
    with pytest.raises(NotEnumerable, match="more than 30 states, with all that is remembered"):
        exact_evaluation(problem, TABLE, Architecture((np.ones(8, np.uint8),), np.array([0])), 1)
