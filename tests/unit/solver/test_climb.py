from functools import partialmethod

import numpy as np
import pytest

from bbsd.compiler.team import Team
from bbsd.kernel.streams import fold, word_of
from bbsd.solver.arena import Arena
from bbsd.solver.changes import changes_of
from bbsd.solver.climb import MOST_EPISODES, PAIRED, advance_climb, begin_climb
from bbsd.solver.methods.method import arrays_of, restored
from bbsd.solver.space import Designs
from tests.unit.problems import problem_of
from tests.unit.solver.problems import guess

pytestmark = pytest.mark.slow

PATH = """
bbsd: 1
name: path
environment:
  steps: 4
  state: {{at: "integers(0, 3)", paid: 0, luck: 0}}
  dynamics: {{luck: {luck}}}
  sensors: {{seen: "values(at, 0, 9)"}}
behaviors:
  walk: {{inputs: [seen], actions: {{a: {{paid: 1}}, b: {{paid: 2}}, c: {{paid: 3}}}}}}
reward: {{gain: paid + luck}}
"""
"""Each of ten cells, of which four are ever asked, is the better the higher its choice."""

COIN = """
bbsd: 1
name: coin
environment: {steps: 1, state: {side: "chance(0.5)", bet: false}}
behaviors: {bet: {actions: {heads: {bet: true}, tails: {bet: false}}}}
reward: {gain: 1 if side == bet else 0}
"""
"""Heads are as good as tails, and nothing is tails."""


def path(luck="0", lanes=50):
    return Arena(problem_of(PATH.format(luck=f'"{luck}"'), lanes=lanes), 1)


def design(*cells):
    return Designs(np.array([cells], np.uint8), np.array([[0]]))


NONE = design(*[0] * 10)


def climbed(arena, start, key=1, budget=100_000, most_episodes=MOST_EPISODES):
    """The states of a climb, the first included."""
    climbs = [begin_climb(start)]
    while not climbs[-1].at_optimum and climbs[-1].spent < budget:
        climbs.append(advance_climb(climbs[-1], arena, key, budget, most_episodes))
    return climbs


def test_a_climb_ends_where_no_change_helps():
    *_, end = climbed(path(), NONE)
    assert end.at_optimum
    assert end.design.tables[0].tolist() == [3, 3, 3, 3, 0, 0, 0, 0, 0, 0]
    assert end.mean == 12


def test_no_change_of_the_end_helps():
    problem, _ = guess()
    arena = Arena(problem, 1)
    *_, end = climbed(arena, arena.space.random(3, 1))
    changes = changes_of(arena.space, end.design)
    rows = changes.applied(np.arange(len(changes))).joined(end.design)
    *others, own = arena.means(rows, 9, 400)
    assert end.at_optimum
    assert max(others) <= own


def test_improvements_of_different_cells_are_made_together():
    climbs = climbed(path(), NONE)
    # At most one cell was asked too seldom to be sure at once; the last pass is the one in which nothing helps.
    assert climbs[-1].passes <= 3


def test_what_is_never_asked_costs_nothing():
    # Each episode asks one cell, of which there are three changes, all of them worse.
    first, *_, end = climbed(path(), design(3, 3, 3, 3, 0, 0, 0, 0, 0, 0))[1:]
    assert first.spent == 50 + 3 * 50
    assert set(changes_of(path().space, first.design).cells[first.running]) == {4, 5, 6, 7, 8, 9}
    # Beyond that, the design runs alone to see whether it asks any other.
    assert (end.passes, end.spent, end.at_optimum) == (1, first.spent + MOST_EPISODES - 50, True)


def test_a_cell_that_is_seldom_asked_is_found():
    text = PATH.format(luck="0").replace("integers(0, 3)", "min(floor(uniform(0, 100)), 1)")
    arena = Arena(problem_of(text, lanes=50), 1)
    *_, end = climbed(arena, design(0, 3, *[0] * 8), budget=10_000)
    assert end.at_optimum
    assert end.design.tables[0].tolist() == [3, 3, 0, 0, 0, 0, 0, 0, 0, 0]


def test_noise_that_is_common_does_not_hide_a_gain():
    *_, end = climbed(path("normal(0, 1000)"), NONE)
    assert end.design.tables[0].tolist() == [3, 3, 3, 3, 0, 0, 0, 0, 0, 0]


def test_a_small_gain_within_noise_of_its_own_is_found_in_longer_rounds():
    # From 2 to 3 is a gain of 4 in four steps, beside a deviation of 12, in a quarter of the episodes.
    start = design(3, 3, 3, 2, 0, 0, 0, 0, 0, 0)
    climbs = climbed(path("normal(0, 6 * paid)"), start, budget=20_000)
    assert climbs[-1].design.tables[0, :4].tolist() == [3, 3, 3, 3]
    assert max(climb.episodes for climb in climbs if not climb.passes) >= 200


def test_what_is_known_of_changes_is_that_of_all_their_episodes():
    arena, start = path("normal(0, 30 * paid)"), design(3, 3, 2, 2, 0, 0, 0, 0, 0, 0)
    climb = climbed(arena, start, budget=2000)[3]
    assert (climb.passes, climb.episodes) == (0, 200)
    changed = changes_of(arena.space, start).applied(climb.running)
    *returns, own = arena.returns(changed.joined(start), fold(fold(1, word_of(0)), PAIRED), 200)
    differences = np.array(returns) - own
    assert len(differences) > 3
    assert climb.mean == pytest.approx(own.mean())
    assert climb.gains == pytest.approx(differences.mean(axis=1))
    assert climb.squares == pytest.approx(differences.var(axis=1) * 200)
    assert (climb.tried >= (differences != 0).sum(axis=1)).all()


def test_choices_that_are_worth_the_same_are_given_up_at_last():
    climbs = climbed(Arena(problem_of(COIN, lanes=50), 1), design(1), key=2, most_episodes=400)
    assert climbs[-1].at_optimum
    assert (climbs[-1].passes, climbs[-1].spent) == (1, 3 * 400)


@pytest.mark.parametrize("budget", [1, 2, 3, 49, 51, 1000, 1549, 1551, 3000])
def test_a_climb_never_spends_more_than_its_budget_and_always_something(budget):
    spent = [climb.spent for climb in climbed(path("normal(0, paid)"), NONE, budget=budget)]
    assert spent[-1] == budget or spent[-1] > budget - 50
    assert spent[-1] <= budget
    assert (np.diff(spent) > 0).all()


def test_spent_is_what_episodes_ran(monkeypatch):
    ran = []

    def count_lanes(team, keys, *others, function):
        ran.append(len(keys))
        return function(team, keys, *others)

    for name in ("episode", "practice"):
        monkeypatch.setattr(Team, name, partialmethod(count_lanes, function=getattr(Team, name)))
    *_, end = climbed(path("normal(0, paid)"), NONE, budget=8_000)
    assert sum(ran) == end.spent


def test_an_optimum_is_not_claimed_while_changes_were_left_out():
    *_, end = climbed(path(), design(3, 3, 3, 3, 0, 0, 0, 0, 0, 0), budget=50 * 20)
    assert not end.at_optimum


def test_a_design_without_changes_is_an_optimum_that_costs_nothing():
    text = PATH.format(luck="0").replace("c: {paid: 3}}", "c: {paid: 3}}, rules: [otherwise: a]")
    arena = Arena(problem_of(text), 1)
    end = advance_climb(begin_climb(NONE), arena, 1, 100)
    assert (end.at_optimum, end.spent) == (True, 0)


def test_a_climb_that_was_written_down_goes_on_equally():
    arena = path("normal(0, paid)")
    climbs = climbed(arena, NONE, budget=8_000)
    half = climbs[len(climbs) // 2]
    again = restored(begin_climb(NONE), arrays_of(half))
    while not again.at_optimum and again.spent < 8_000:
        again = advance_climb(again, arena, 1, 8_000)
    assert str(arrays_of(again)) == str(arrays_of(climbs[-1]))


def test_lanes_change_nothing():
    ends = [climbed(path("normal(0, paid)", lanes), NONE, budget=8_000)[-1] for lanes in (1, 64)]
    assert str(arrays_of(ends[0])) == str(arrays_of(ends[1]))
