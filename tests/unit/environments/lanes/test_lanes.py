"""Environments in lanes: what is filled, what is sent, what is said of what goes wrong."""

import numpy as np
import pytest

from bbsd.environments.failures import ActionRefused, EnvironmentFailed, EnvironmentHangs
from bbsd.environments.lanes.common import SEED_BITS, seed_of
from bbsd.kernel.keys import keys
from bbsd.stopping import stop_request_of_context
from tests.unit.environments.arenas import Field, opened, rows

STREAMS = keys(7, 0, 4)


def begun(arena, n_lanes=4, lanes=None):
    """A stepper with an episode begun in some lanes, and what it filled."""
    stepper, outside = arena.stepper(), np.full((rows(arena), n_lanes), np.nan)
    stepper.reset(np.arange(n_lanes) if lanes is None else np.array(lanes), keys(7, 0, n_lanes), outside)
    return stepper, outside


def stepped(stepper, outside, sent, lanes=None):
    sent = np.array(sent, float).reshape(-1, outside.shape[1])
    stepper.step(np.arange(outside.shape[1]) if lanes is None else np.array(lanes), sent, outside)
    return outside


def test_a_seed_follows_from_the_key_alone():
    seeds = [seed_of(int(key)) for key in keys(1, 0, 1000)]
    assert all(0 <= seed < 1 << SEED_BITS for seed in seeds)
    assert len(set(seeds)) > 995
    assert seeds == [seed_of(int(key)) for key in keys(1, 0, 1000)]


def test_a_reset_fills_what_is_observed_and_nothing_earned():
    arena = opened()
    _, outside = begun(arena)
    places = [float(seed_of(int(key)) % 4) for key in STREAMS]
    assert outside.tolist() == [places, [-place for place in places], [0.0] * 4, [0.0] * 4]


def test_only_the_lanes_that_are_named_are_touched():
    stepper, outside = begun(opened(), lanes=[2, 0])
    assert np.isnan(outside[:, [1, 3]]).all()
    assert not np.isnan(outside[:, [0, 2]]).any()
    before = outside.copy()
    stepped(stepper, outside, [1, 1, 1, 1], lanes=[2])
    assert np.array_equal(outside[:, [0, 1, 3]], before[:, [0, 1, 3]], equal_nan=True)


def test_a_step_fills_what_is_observed_what_it_earned_and_whether_it_ended():
    stepper, outside = begun(opened())
    start = outside[0].copy()
    stepped(stepper, outside, [0, 1, 2, 9])
    there = start + np.array([0, 1, 2, 9])
    assert outside[0].tolist() == there.tolist()
    assert outside[2].tolist() == (there / 2).tolist()
    assert outside[3].tolist() == (there >= 4).tolist()


def test_what_a_lane_gives_depends_on_its_key_and_what_was_sent_alone():
    arena = opened()
    stepper, outside = begun(arena)
    for sent in (1, 0, 1):
        stepped(stepper, outside, [sent] * 4)
    other, reversed_outside = arena.stepper(), np.zeros_like(outside)
    other.reset(np.array([3, 1, 0, 2]), STREAMS[::-1].copy(), reversed_outside)
    for sent in (1, 0, 1):
        stepped(other, reversed_outside, [sent] * 4, lanes=[1, 3, 2, 0])
    assert np.array_equal(reversed_outside[:, ::-1], outside)


def test_names_of_single_numbers_may_be_left_out():
    _, outside = begun(opened(fields=("_", "there")))
    assert outside.shape == (3, 4)
    assert (outside[0] <= 0).all()


def test_an_environment_without_spaces_shows_what_its_first_observation_has():
    arena = opened("Sensing", (Field("at", path=("place",)), Field("wall", path=("map", 1, 2))))
    assert str(arena.observed).startswith("Dict('place': Box(")
    assert begun(arena)[1][1].tolist() == [5.0] * 4


def test_a_registered_limit_of_steps_ends_an_episode(monkeypatch):
    pytest.importorskip("gymnasium")
    from bbsd.environments.importing.consent import Consent
    from bbsd.environments.opening import Recipe, open_environment
    from bbsd.language.outside import Outside

    told = Outside("gymnasium", "CartPole-v1", {"max_episode_steps": 3}, tuple(map(Field, "abcd")), ("push",))
    arena = open_environment(Recipe(told, 1, Consent(("gymnasium",))))
    assert type(arena.make()).__name__ == "CartPoleEnv"  # no wrapper around it
    stepper, outside = begun(arena)
    ended = [stepped(stepper, outside, [step % 2] * 4)[-1].tolist() for step in range(3)]
    assert ended == [[0.0] * 4, [0.0] * 4, [1.0] * 4]


def test_what_an_environment_prints_is_no_result(capsys):
    stepper, outside = begun(opened("Talking"), 1)
    stepped(stepper, outside, [0])
    printed = capsys.readouterr()
    assert (printed.out, printed.err) == ("", "stepped\n")


def test_an_error_is_told_with_its_step_its_seed_and_its_own_lines():
    stepper, outside = begun(opened("Broken"), 1)
    stepped(stepper, outside, [1])
    with pytest.raises(EnvironmentFailed) as failed:
        stepped(stepper, outside, [1])
    first, *lines = str(failed.value).split("\n")
    assert first.startswith("tests.unit.environments.arenas:Broken, in step 2 of an episode (seed ")
    assert first.endswith(") raised ZeroDivisionError: float division by zero")
    assert len(lines) == 1
    assert lines[0].endswith("in step: return super().step(action / (2 - self.steps))")


def test_an_environment_cannot_end_the_program():
    stepper, outside = begun(opened("Leaving"), 1)
    with pytest.raises(EnvironmentFailed, match="raised SystemExit: 3"):
        stepped(stepper, outside, [1])


def test_a_step_of_another_kind_is_told():
    stepper, outside = begun(opened("Old"), 1)
    with pytest.raises(EnvironmentFailed, match="step returned 4 values, not five"):
        stepped(stepper, outside, [1])


def test_a_value_that_is_not_taken_is_told_and_not_rounded():
    arena = opened("Duet", ("at", "count"), ("go",), robots=2)
    stepper, outside = begun(arena, 1)
    with pytest.raises(ActionRefused, match=r"step 1 .*: go is 1\.5, and .* a whole number from 0 to 2"):
        stepped(stepper, outside, [1, 1.5])


@pytest.mark.parametrize("name", ["Slow", "Busy"])
def test_a_step_that_hangs_is_told(name):
    stepper, outside = begun(opened(name, seconds=0.2), 1)
    with pytest.raises(EnvironmentHangs, match=r"in step 1 .* did not return within 0\.2 s") as hangs:
        stepped(stepper, outside, [1])
    assert "--step-limit" in hangs.value.advice


def test_a_request_to_stop_is_heeded_before_a_step():
    stepper, outside = begun(opened(), 1)
    with stop_request_of_context() as request:
        request.make()
        with pytest.raises(KeyboardInterrupt):
            stepped(stepper, outside, [1])


class TestAgents:
    """Agents that act at the same time are the robots."""

    @pytest.fixture
    def duet(self):
        return opened("Duet", ("at", "count"), ("go",), robots=2)

    def test_rows_hold_robots_within_a_name(self, duet):
        stepper, outside = begun(duet, 1)
        seed = float(seed_of(int(STREAMS[0])))
        assert outside[:, 0].tolist() == [seed, seed, 0.0, 0.0, 0.0, 0.0, 0.0]
        stepped(stepper, outside, [1, 2])
        assert outside[:, 0].tolist() == [1.0, 2.0, 1.0, 1.0, 10.0, 11.0, 0.0]

    def test_one_that_is_done_earns_nothing_keeps_what_it_saw_and_is_told_nothing(self, duet):
        stepper, outside = begun(duet, 1)
        for _ in range(2):
            stepped(stepper, outside, [1, 2])
        assert outside[:, 0].tolist() == [1.0, 2.0, 2.0, 2.0, 20.0, 21.0, 0.0]
        stepped(stepper, outside, [0, 0])
        assert outside[:, 0].tolist() == [1.0, 0.0, 2.0, 3.0, 0.0, 31.0, 0.0]

    def test_its_value_may_then_be_anything(self, duet):
        stepper, outside = begun(duet, 1)
        for first in (1, 1, 99):
            stepped(stepper, outside, [first, 2])

    def test_an_episode_is_over_when_no_agent_is_left(self, duet):
        stepper, outside = begun(duet, 1)
        ended = [stepped(stepper, outside, [1, 1])[-1, 0] for _ in range(4)]
        assert ended == [0.0, 0.0, 0.0, 1.0]

    def test_the_next_episode_has_all_of_them_again(self, duet):
        stepper, outside = begun(duet, 1)
        for _ in range(4):
            stepped(stepper, outside, [1, 1])
        stepper.reset(np.array([0]), STREAMS[:1], outside)
        assert stepped(stepper, outside, [2, 2])[4:, 0].tolist() == [10.0, 11.0, 0.0]
