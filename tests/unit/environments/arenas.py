"""Small environments, as somebody may write them, without any library."""

import itertools
import sys
import time
from pathlib import Path

import numpy as np

from bbsd.environments.importing.consent import Consent
from bbsd.environments.opening import Recipe, open_environment
from bbsd.language.outside import Field, Outside

HERE = "tests.unit.environments.arenas"
ALLOWED = Consent(("tests",), (str(Path(__file__).parents[3]),))
"""Found there by other processes too."""


class Line:
    """A place on a line, which an action moves; the seed says where it begins."""

    def __init__(self, length=4):
        self.length = length

    def reset(self, *, seed=None):
        self.place = float(seed % self.length)
        return np.array([self.place, -self.place]), {}

    def step(self, action):
        self.place += action
        return np.array([self.place, -self.place]), self.place / 2, self.place >= self.length, False, {}


class Sensing(Line):
    """Has no spaces, and observes a mapping."""

    def reset(self, *, seed=None):
        super().reset(seed=seed)
        return self.seen(), {}

    def seen(self):
        return {"place": self.place, "map": np.arange(6).reshape(2, 3), "name": "line"}

    def step(self, action):
        return self.seen(), 0, False, False, {}


class Broken(Line):
    """Fails in its second step."""

    def reset(self, *, seed=None):
        self.steps = 0
        return super().reset(seed=seed)

    def step(self, action):
        self.steps += 1
        return super().step(action / (2 - self.steps))


class Slow(Line):
    """Does not return from its first step."""

    def step(self, action):
        time.sleep(60)


class Busy(Line):
    """Does not return from its first step, and never waits."""

    def step(self, action):
        while True:
            pass


class Talking(Line):
    """Prints what it does."""

    def step(self, action):
        sys.stdout.write("stepped\n")
        return super().step(action)


class Leaving(Line):
    """Ends the program."""

    def step(self, action):
        raise SystemExit(3)


class Old(Line):
    """Steps as Gym did."""

    def step(self, action):
        return super().step(action)[:4]


class Forgetful(Line):
    """Counts on from one episode to the next."""

    numbers = itertools.count()

    def reset(self, *, seed=None):
        return super().reset(seed=next(self.numbers) // 3)


class Remembering(Line):
    """Keeps something of the episode before."""

    def __init__(self):
        super().__init__()
        self.before = 0

    def reset(self, *, seed=None):
        seed, self.before = seed + self.before, self.before + 1
        return super().reset(seed=seed)


class Following(Line):
    """Begins as the episode that was begun before it, in whichever lane."""

    last = [0]  # noqa: RUF012

    def reset(self, *, seed=None):
        seed, self.last[0] = self.last[0], seed
        return super().reset(seed=seed)


class Elsewhere(Line):
    """Begins in another way in another process."""

    def __init__(self):
        super().__init__(length=1_000_000_007)  # no two processes' numbers are the same on so long a line

    def reset(self, *, seed=None):
        import os

        return super().reset(seed=seed + os.getpid())


class Duet:
    """Two agents; the first is done after two steps, both after four."""

    possible_agents = ("left", "right")

    def observation_space(self, agent):
        return Box(2)

    def action_space(self, agent):
        return Discrete(3)

    def reset(self, *, seed=None):
        self.agents, self.steps, self.told = list(self.possible_agents), 0, []
        return {agent: np.array([seed, 0.0]) for agent in self.agents}, {}

    def step(self, actions):
        assert list(actions) == self.agents
        self.steps += 1
        self.told.append(dict(actions))
        observations = {agent: np.array([action, self.steps]) for agent, action in actions.items()}
        rewards = {agent: 10.0 * self.steps + (agent == "right") for agent in actions}
        done = self.agents if self.steps == 4 else ["left"] if self.steps == 2 else []
        self.agents = [agent for agent in self.agents if agent not in done]
        return observations, rewards, {}, {}, {}


class Box:
    """As Gymnasium's, so far as bbsd looks at it."""

    def __init__(self, n, low=-np.inf, high=np.inf, dtype=np.float64):
        self.shape, self.dtype = (n,), np.dtype(dtype)
        self.low, self.high = np.full(n, low), np.full(n, high)


class Discrete:
    """As Gymnasium's."""

    def __init__(self, n, start=0):
        self.n, self.start = n, start


def outside(name="Line", fields=("here", "there"), actions=("move",), **arguments):
    """What a spec says of one of these."""
    named = tuple(field if isinstance(field, Field) else Field(field) for field in fields)
    return Outside("python", f"{HERE}:{name}", arguments, named, tuple(actions))


def opened(name="Line", fields=("here", "there"), actions=("move",), *, robots=1, seconds=30.0, **arguments):
    """One of these, opened."""
    told = outside(name, fields, actions, **arguments)
    return open_environment(Recipe(told, robots, ALLOWED, seconds=seconds))


def rows(opened):
    """How many rows of an array it fills."""
    fields = sum(field.is_used for field in opened.recipe.outside.fields)
    return (fields + 1) * opened.recipe.robots + 1
