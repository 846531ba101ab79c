"""Real environments and their tables: those that keep to them, and those that do not."""

import pickle
from dataclasses import replace
from types import SimpleNamespace

import gymnasium
import numpy as np
import pytest

from bbsd.environments.opening import OtherEnvironment, open_environment, opened_again, recipe_of
from bbsd.environments.table_check import check_table, checked_table
from bbsd.environments.tables import NoTable, copied_table

RECIPE = {
    "kind": "gymnasium",
    "target": "FrozenLake-v1",
    "arguments": {},
    "fields": [["square", 16, None]],
    "actions": ["way"],
    "robots": 1,
    "modules": ["gymnasium"],
    "folders": [],
    "closed": [],
    "seconds": 30.0,
}


class Chain:
    """A walk along five squares; at the last one it is over. With some chance a step goes nowhere."""

    def __init__(self, slip=0.0):
        self.observation_space, self.action_space = SimpleNamespace(n=5), SimpleNamespace(n=2)
        self.initial_state_distrib = np.array([0.5, 0.5, 0, 0, 0])
        self.P = {state: {way: self._outcomes(state, way, slip) for way in (0, 1)} for state in range(5)}

    def _outcomes(self, state, way, slip):
        moved = min(max(state + 2 * way - 1, 0), 4)
        stays = [(slip, state, -1.0, False)] if slip else []
        return [(1.0 - slip, moved, float(moved == 4), moved == 4), *stays]

    def reset(self, seed):
        self.random = np.random.default_rng(seed)
        self.state = self.start()
        return self.state, {}

    def start(self):
        return int(self.random.choice(5, p=self.initial_state_distrib))

    def step(self, action):
        outcomes = self.P[self.state][action]
        chosen = self.random.choice(len(outcomes), p=[probability for probability, *_ in outcomes])
        _, self.state, reward, ended = outcomes[chosen]
        return self.state, reward, ended, False, {}


@pytest.mark.parametrize("slip", [0.0, 0.3])
def test_an_environment_that_keeps_to_its_table_passes(slip):
    check = check_table(Chain(slip), copied_table(Chain(slip)))

    assert check.tried == check.reachable == 8, "nothing is done in the last square"
    assert check.steps >= (24 if slip == 0.0 else 6000)


def opened(environment, most_steps=None):
    """What an opened environment is to the check."""
    making = SimpleNamespace(most_steps=most_steps, make=lambda: environment)
    return SimpleNamespace(making=making, name="Chain-v0", recipe=SimpleNamespace(seconds=30.0))


class OtherReward(Chain):
    def step(self, action):
        state, reward, *others = super().step(action)
        return state, reward + (state == 3), *others


class TiresOfIt(Chain):
    """Ends after seven steps, which no table can say."""

    def reset(self, seed):
        self.left = 7
        return super().reset(seed)

    def step(self, action):
        self.left -= 1
        state, reward, ended, _, info = super().step(action)
        return state, reward, ended, self.left == 0, info


class StartsElsewhere(Chain):
    def start(self):
        return 2


class StartsMostlyAtTheFirst(Chain):
    def start(self):
        return int(self.random.random() < 0.1)


class SlipsMore(Chain):
    """Slips in four of ten steps where its table says three of ten."""

    def step(self, action):
        slipped = self.random.random() < 1 / 7
        return (self.state, -1.0, False, False, {}) if slipped else super().step(action)


class Breaks(Chain):
    def step(self, action):
        raise ZeroDivisionError("no more")


class SeesMore(Chain):
    def start(self):
        return 7


class SeesWords(Chain):
    def start(self):
        return "here"


@pytest.mark.parametrize(
    ("liar", "words"),
    [
        (OtherReward(), "led to state 3 with reward 1, which"),
        (TiresOfIt(), "led to state . with reward -?.( and the end)?, which its table does not list"),
        (StartsElsewhere(), "began in state 2, which initial_state_distrib excludes"),
        (StartsMostlyAtTheFirst(0.5), "first states do not come as often"),
        (SlipsMore(0.3), "do not come as often as its table says"),
        (Breaks(), "a step of the check raised ZeroDivisionError: no more"),
        (SeesMore(), "observed 7, which is none of its 5 states"),
        (SeesWords(), "something else than the number of its state"),
    ],
)
def test_an_environment_that_does_something_else_is_found_out(liar, words):
    with pytest.raises(NoTable, match=words):
        checked_table(opened(liar))


@pytest.mark.parametrize(
    ("name", "arguments", "shape"),
    [
        ("Taxi-v4", {}, (500, 6, 1)),
        ("FrozenLake-v1", {}, (16, 4, 3)),
        ("FrozenLake-v1", {"is_slippery": False, "map_name": "8x8"}, (64, 4, 1)),
        ("FrozenLake-v1", {"desc": ["SFFS", "FHFG"]}, (8, 4, 3)),
        ("CliffWalking-v1", {}, (48, 4, 1)),
    ],
)
def test_environments_of_gymnasium_keep_to_their_tables(name, arguments, shape):
    table, check = checked_table(opened(gymnasium.make(name, **arguments).unwrapped, most_steps=100))

    assert table.most_steps == 100
    assert table.probabilities.shape == shape
    assert check.tried == check.reachable


def test_a_taxi_with_a_fickle_passenger_does_not_keep_to_its_table():
    with pytest.raises(NoTable, match="which its table does not list"):
        checked_table(opened(gymnasium.make("Taxi-v4", fickle_passenger=True).unwrapped))


def test_an_environment_that_is_made_differently_each_time_has_no_table():
    maps = iter([["SF", "FG"], ["SH", "FG"]])
    made = SimpleNamespace(
        most_steps=None, make=lambda: gymnasium.make("FrozenLake-v1", desc=next(maps)).unwrapped
    )
    with pytest.raises(NoTable, match="another table each time it is made"):
        checked_table(
            SimpleNamespace(making=made, name="FrozenLake-v1", recipe=SimpleNamespace(seconds=30.0))
        )


def test_an_environment_without_a_table_has_none():
    assert checked_table(opened(gymnasium.make("Blackjack-v1").unwrapped)) is None


def test_another_process_uses_the_same_table_without_checking_it_again():
    opened = open_environment(recipe_of(RECIPE))
    table, _ = checked_table(opened)
    by_table = replace(opened, table=table)
    again = opened_again(by_table.recipe.plain(), by_table.plain())

    assert by_table.plain()["table"] == table.digest == again.table.digest
    assert opened_again(opened.recipe.plain(), opened.plain()).table is None
    assert pickle.loads(pickle.dumps(by_table)).table.digest == table.digest
    with pytest.raises(OtherEnvironment, match=r"FrozenLake-v1 is another one .* table \(.*, not 0123\)"):
        opened_again(by_table.recipe.plain(), {**by_table.plain(), "table": "0123"})
