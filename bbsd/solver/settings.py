"""What the solver is told by a spec's `design` block; the defaults are Table 1's for object lifting."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray


def default_hard_mutation() -> NDArray[np.float64]:
    """p_hard of Table 1 for 50 generations: 0.01 / log2(generation + 1), 0 from generation 41."""
    generation = np.arange(1, 51)
    return np.where(generation <= 40, 0.01 / np.log2(generation + 1), 0.0)


def default_soft_mutation() -> NDArray[np.float64]:
    """p_soft of Table 1: twice p_hard."""
    return 2.0 * default_hard_mutation()


def default_rate() -> NDArray[np.float64]:
    """α of Table 1 for 25 episodes: 0.1 * 0.99**episode."""
    return np.array([0.1 * 0.99**episode for episode in range(1, 26)])


def require_one_each(name: str, values: NDArray[np.float64], n_times: int, time: str) -> None:
    """Refuse a schedule that does not hold one value for each generation or episode."""
    if values.shape != (n_times,):
        raise ValueError(f"{name} must hold one value for each of {n_times} {time}s, not {values.shape}")


@dataclass(frozen=True, slots=True)
class Breeding:
    """What the genetic operators of one generation are told (V.B.2)."""

    tournament: int = 3
    elites: int = 1
    crossover: float = 0.5  # p_c, the probability that a cell comes from the first parent
    hard_mutation: float = 0.0  # a child
    soft_mutation: float = 0.0  # a cell


@dataclass(frozen=True, slots=True, eq=False)
class Coevolution:
    """How the pools evolve (V.B).

    Raises:
        ValueError: a mutation schedule does not hold one value for each generation.
    """

    generations: int = 50
    population: int = 20  # individuals a pool
    agents: int = 200  # a generation
    pairing: Literal["balanced"] = "balanced"
    tournament: int = 3
    elites: int = 1
    crossover: float = 0.5
    hard_mutation: NDArray[np.float64] = field(default_factory=default_hard_mutation)  # (generations,)
    soft_mutation: NDArray[np.float64] = field(default_factory=default_soft_mutation)  # (generations,)

    def __post_init__(self) -> None:
        require_one_each("hard_mutation", self.hard_mutation, self.generations, "generation")
        require_one_each("soft_mutation", self.soft_mutation, self.generations, "generation")

    def breeding(self, generation: int) -> Breeding:
        """The genetic operators' settings in a generation, which counts from 1."""
        return Breeding(
            self.tournament,
            self.elites,
            self.crossover,
            float(self.hard_mutation[generation - 1]),
            float(self.soft_mutation[generation - 1]),
        )


@dataclass(frozen=True, slots=True, eq=False)
class Learning:
    """How an agent learns its structure (V.A).

    Raises:
        ValueError: the rate does not hold one value for each episode, or `last` is not within a lifetime.
    """

    episodes: int = 25  # a lifetime in which a structure is learned
    last: int = 5  # K of (14), and the whole lifetime where the structure is given
    rate: NDArray[np.float64] = field(default_factory=default_rate)  # α of (13), (episodes,)
    search: Literal["sampled", "exact"] = "sampled"
    candidates: int = 20  # random structures that compete with the present one

    def __post_init__(self) -> None:
        require_one_each("rate", self.rate, self.episodes, "episode")
        if not 1 <= self.last <= self.episodes:
            raise ValueError(f"last must be from 1 to {self.episodes} episodes, not {self.last}")

    def lifetime(self, *, learned: bool) -> int:
        """The episodes of a lifetime, by whether there is a structure to learn in it."""
        return self.episodes if learned else self.last


@dataclass(frozen=True, slots=True)
class Enculturation:
    """How memes are kept and passed on (V.C)."""

    size: int = 5  # memes
    rate: float = 0.3  # the forgetting factor α of (22)
    scaled: float = 0.9  # the probability of the scaled roulette wheel, otherwise any meme


@dataclass(frozen=True, slots=True, eq=False)
class Settings:
    """The whole `design` block, its expressions evaluated."""

    layers: int | None = None  # open layers where the spec gives no structure; None: one for each behavior
    sharing: Literal["uniform", "value"] = "uniform"
    coevolution: Coevolution = field(default_factory=Coevolution)
    learning: Learning = field(default_factory=Learning)
    culture: Enculturation | None = None
