"""The tasks, and what a design earns in them: exactly where all starts can be run, else in common fresh episodes."""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cached_property, lru_cache
from hashlib import sha256
from math import sqrt
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

import bbsd
from bbsd.compiler import compile_meaning
from bbsd.evaluation import NotEnumerable, enumerate_starts, returns_of
from bbsd.evaluation.sums import deviation, expectation, mean
from bbsd.kernel.keys import keys
from bbsd.kernel.streams import name_word
from bbsd.runs.storage.identity import identity
from bbsd.solver.arena import Arena
from bbsd.version import REVISION
from experiments.designs import SPECS

if TYPE_CHECKING:
    from pathlib import Path

    from bbsd.compiler import Problem
    from bbsd.language.loading import Loaded
    from bbsd.solver.space import Designs
    from experiments.designs import Floats

FRESH = name_word("methods compared")
EPISODES = 200_000
"""Episodes that designs are measured in: 5,000 do not tell 307.4 from 307.5 in object lifting."""
FEWER = {"aggregation": 20_000, "mobile_robot": 50_000}
"""Where an episode takes a tenth of a millisecond; the 95 % interval is 0.4 and 0.04 wide at most."""

IN_ORDER = (
    "abstract", "object_lifting", "grid_world", "lake", "lake_8x8", "cliff_walking", "taxi", "four_rooms",
    "door_and_key", "cartpole", "mountain_car", "acrobot", "survival", "forager", "pursuit", "mobile_robot",
    "aggregation",
)  # fmt: skip
"""The paper's problems, the benchmarks, and the worlds, of which the last are slow."""


class Earned(NamedTuple):
    """What a design earns: the mean return, its standard deviation, and the episodes or starts that it is of."""

    mean: float
    sd: float
    episodes: int
    exact: bool


@dataclass(frozen=True)
class Task:
    """A shipped task with holes."""

    name: str

    @property
    def path(self) -> Path:
        """The file of its spec."""
        path = SPECS / f"{self.name}.yaml"
        return path if path.exists() else SPECS / "tasks" / f"{self.name}.yaml"

    @cached_property
    def loaded(self) -> Loaded:
        """The spec, its constants drawn with seed 0."""
        return bbsd.load(self.path)

    @cached_property
    def arena(self) -> Arena:
        """Where designs run their episodes."""
        return Arena(compile_meaning(self.loaded.meaning), self.loaded.spec.design.coevolution.generations)

    @property
    def paper_path(self) -> Path | None:
        """The file of the spec with settings of the paper's loop for this task, None where there are none."""
        path = SPECS / "paper" / f"{self.name}.yaml"
        return path if path.exists() else None

    def digest(self, method: str) -> str:
        """Return what tells results of this task from those of another state of it or of bbsd."""
        blocks = {key: value for key, value in identity(self.loaded, 0, 1).spec if key != "design"}
        settings: dict[str, object] = {"layers": self.loaded.spec.design.layers}
        if method == "paper" and self.paper_path is not None:
            settings |= dict(identity(bbsd.load(self.paper_path), 0, 1).spec)
        content = [REVISION, blocks, settings]
        return sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()[:16]

    def earned(self, design: Designs) -> Earned:
        """Return what a design, one row, earns."""
        agents = self.arena.space.agents(design)
        if self._starts is not None:
            problem, weights = self._starts
            numbers = np.arange(len(weights), dtype=np.uint64)
            returns = returns_of(problem, agents, numbers, self.arena.generation)[0]
            center = expectation(weights, returns)
            return Earned(
                center, sqrt(expectation(weights, (returns - center) ** 2)), len(weights), exact=True
            )
        episodes = keys(FRESH, 0, FEWER.get(self.name, EPISODES))
        returns = returns_of(self.arena.problem, agents, episodes, self.arena.generation)[0]
        return Earned(mean(returns), deviation(returns), len(returns), exact=False)

    @cached_property
    def _starts(self) -> tuple[Problem, Floats] | None:
        try:
            return enumerate_starts(self.arena.problem)
        except NotEnumerable:
            return None


@lru_cache(maxsize=4)
def task(name: str) -> Task:
    """Return a task; the last few stay compiled."""
    return Task(name)
