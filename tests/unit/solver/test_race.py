import numpy as np
import pytest

from bbsd.architecture import Architecture
from bbsd.solver.race import race, still_running
from tests.unit.problems import problem_of

BETS = """
bbsd: 1
name: bets
environment: {{steps: 1, state: {{luck: {luck}, bet: 0}}}}
behaviors:
  gambler: {{actions: {{a: {{bet: 1}}, b: {{bet: 2}}, c: {{bet: 3}}}}}}
reward: {{gain: bet * luck, fee: "-0.1 if bet == 3 else 0"}}
"""


def bets(luck):
    """A problem in which a design's return is its bet times the luck of the episode."""
    return problem_of(BETS.format(luck=f'"{luck}"'), lanes=50)


def bet(amount):
    return Architecture((np.array([amount], np.uint8),), np.array([0]))


def test_a_clear_winner_takes_one_round():
    finish = race(bets("1"), [bet(1), bet(2), bet(0)], key=1, cap=5000)
    assert (finish.winner, finish.episodes, finish.undecided) == (1, 100, 1)


def test_one_entrant_has_won():
    finish = race(bets("1"), [bet(1)], key=1, cap=5000)
    assert (finish.winner, finish.episodes, finish.undecided) == (0, 0, 1)


def test_designs_that_earn_the_same_are_one():
    finish = race(bets("normal(0, 1)"), [bet(2), bet(2), bet(2)], key=1, cap=5000)
    assert (finish.winner, finish.episodes, finish.undecided) == (0, 100, 1)


@pytest.mark.parametrize("cap", [100, 150, 250])
def test_what_is_in_doubt_at_the_cap_is_decided_by_the_mean(cap):
    problem = bets("normal(0, 1)")
    finish = race(problem, [bet(1), bet(2)], key=3, cap=cap)
    other_way = race(problem, [bet(2), bet(1)], key=3, cap=cap)
    assert (finish.episodes, finish.undecided) == (cap, 2)
    assert other_way.winner == 1 - finish.winner


def test_rounds_double_until_the_difference_is_clear():
    # A bet of 1 more gains 0.2 more an episode with a standard deviation of 1: known after about 400 episodes.
    finish = race(bets("normal(0.2, 1)"), [bet(1), bet(2)], key=1, cap=100_000)
    assert finish.winner == 1
    assert finish.episodes in (200, 400, 800, 1600)


def test_a_race_is_the_same_on_the_same_key_only():
    problem = bets("normal(0.05, 1)")
    lengths = [race(problem, [bet(1), bet(2)], key=key, cap=20_000).episodes for key in (1, 1, 2, 3, 4)]
    assert lengths[0] == lengths[1]
    assert len(set(lengths)) > 1


def test_the_beaten_are_out_and_the_leader_stays():
    # Behind the leader by 1, 3, 1, 3, a mean of 2 with a standard error of 0.58: 3.46 of them, not yet out.
    # Behind by 2, 3, 2, 3, a mean of 2.5 with a standard error of 0.29: 8.7 of them.
    leader = np.array([10.0, 10, 10, 10])
    earned = np.stack([leader - [1, 3, 1, 3], leader, leader - [2, 3, 2, 3], leader - 1])
    assert still_running(earned).tolist() == [0, 1]


def test_who_repeats_another_is_out_even_behind_the_leader():
    some, best = np.array([1.0, 9, 1, 9]), np.array([8.0, 2, 8, 3])
    assert still_running(np.stack([some, best, some, best])).tolist() == [0, 1]


def test_all_alike_leave_the_first():
    assert still_running(np.zeros((4, 10))).tolist() == [0]
