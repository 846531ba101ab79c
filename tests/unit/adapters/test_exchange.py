"""What is observed of a world, and what can be chosen."""

import numpy as np
import pytest

from bbsd.adapters.exchange import NOBODY, Exchange, NotOurWorld
from tests.unit.architecture.designs import meaning_of, shipped
from tests.unit.compiler.twins import CORRIDOR_OUTSIDE
from tests.unit.problems import RICH


def test_actions_that_set_the_same_are_one_choice():
    exchange = Exchange(meaning_of(shipped("tasks/cartpole")))
    assert exchange.actions == (NOBODY, "balance left, center left", "balance right, center right")
    np.testing.assert_array_equal(exchange.numbers, [0, 1, 2])
    np.testing.assert_array_equal(exchange.choices, [0, 1, 2, 1, 2])


def test_what_behaviors_may_know_is_observed_by_name():
    exchange = Exchange(meaning_of(RICH))
    assert exchange.names == ("x", "armed", "n", "noisy", "sides[0]", "sides[1]", "place")
    assert len(exchange.nodes) == 3 * 7
    named = exchange.named([0.5, 1.0, 2.0, 0.25, -1.0, 4.0, 1.0])
    assert named == {"x": 0.5, "armed": True, "n": 2.0, "noisy": 0.25, "sides": [-1.0, 4.0], "place": 1}
    assert named["armed"] is True


def test_cells_are_those_that_behaviors_tell_apart():
    exchange = Exchange(meaning_of(shipped("object_lifting")), "cells")
    assert exchange.sizes == tuple(map(len, exchange._space.dimensions.values()))
    observed = np.arange(3 * len(exchange.names), dtype=np.float64)
    robots = exchange.of_robots(observed)
    assert robots.dtype == np.int64
    np.testing.assert_array_equal(robots[1], np.arange(len(exchange.names)) + len(exchange.names))
    assert list(exchange.named(robots[0])) == list(exchange.names)


def test_the_mean_of_robots_is_added_up_from_the_first():
    earned = np.array([0.1, 0.2, 0.3])
    assert Exchange(meaning_of(RICH)).of_team(earned) == (0.1 + 0.2 + 0.3) / 3
    assert Exchange(meaning_of(shipped("tasks/cartpole"))).of_team(earned[:1]) == 0.1


def test_the_world_of_somebody_else_is_refused():
    with pytest.raises(NotOurWorld, match="corridor is stepped in Python"):
        Exchange(meaning_of(CORRIDOR_OUTSIDE))
