"""Environments that do not repeat themselves are found out, each in another way."""

import pytest

from bbsd.engines.processes import waiting_processes
from bbsd.environments.self_check import episodes_of, in_fresh_process, self_check, values_to_send
from bbsd.environments.spaces.kinds import Box, Discrete, MultiDiscrete, Several
from bbsd.environments.spaces.matching import Setting
from tests.unit.environments.arenas import opened

SETTINGS = [Setting("move", value, ()) for value in (0.0, 1.0)]


def test_one_that_repeats_itself_passes():
    assert self_check(opened(), SETTINGS) == ""
    assert self_check(opened("Duet", ("at", "count"), ("go",), robots=2), ()) == ""


def test_one_that_counts_on_does_not():
    assert self_check(opened("Forgetful"), SETTINGS) == "the same seed gave another episode the second time"


def test_nor_does_one_that_keeps_something():
    assert "the second time" in self_check(opened("Remembering"), SETTINGS)


def test_one_that_depends_on_others_is_found_out():
    """It gives the same twice, and something else where other episodes were before."""
    arena = opened("Following")
    episodes_of(arena.stepper(), arena, [[0.0, 1.0]], [0, 1, 2, 3], 1)
    assert self_check(arena, SETTINGS) == "the same seed gave another episode after others"


@pytest.mark.slow
def test_a_fresh_process_must_give_the_same():
    with waiting_processes(1, ("bbsd.environments.self_check",)) as processes:
        assert self_check(opened(), SETTINGS, processes.submit) == ""
        assert "in a fresh process" in self_check(opened("Elsewhere"), SETTINGS, processes.submit)


def test_episodes_are_known_by_their_key_whatever_the_lane():
    arena, values = opened(), [[0.0, 1.0]]
    there, steps = episodes_of(arena.stepper(), arena, values, [0, 1, 2, 3], 5)
    assert steps == 5
    assert episodes_of(arena.stepper(), arena, values, [3, 0, 2, 1], 5)[0] == there
    assert len(set(there)) > 1
    assert in_fresh_process(arena.recipe.plain(), arena.plain(), values, 5) == there


def test_values_are_those_of_the_spec_else_those_of_the_space(monkeypatch):
    duet = opened("Duet", ("at", "count"), ("go",), robots=2)
    assert values_to_send(duet, [Setting("go", 2.0, ()), Setting("go", 0.0, ())]) == [[2.0, 0.0]]
    assert values_to_send(duet, ()) == [[0.0, 1.0, 2.0]]
    assert values_to_send(opened(), ()) == [[0.0]]


@pytest.mark.parametrize(
    ("space", "values"),
    [
        (Discrete(2, 5), [5.0, 6.0]),
        (MultiDiscrete((3,), (1,), (1,)), [1.0, 2.0, 3.0]),
        (Box((1,), (0.25,), (0.75,), "float32"), [0.25, 0.75]),
        (Box((1,), (float("-inf"),), (float("inf"),), "float32"), [-1.0, 1.0]),
        (Box((1,), (5.0,), (float("inf"),), "float32"), [5.0, 5.0]),
        (Several((Discrete(2),)), [0.0, 1.0]),
    ],
)
def test_values_of_a_space_are_taken_by_it(space, values):
    from dataclasses import replace

    from bbsd.environments.spaces.sending import takes

    assert values_to_send(replace(opened(), taken=space), ()) == [values]
    assert all(takes(space, 0, value) for value in values)
