"""What the solver is told by a spec's `design` block, its expressions evaluated."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bbsd.language.design import Answer
    from bbsd.language.meaning import Meaning


@dataclass(frozen=True, slots=True)
class Breeding:
    """What the genetic operators of one generation are told (V.B.2)."""

    tournament: int
    elites: int
    crossover: float
    """p_c, the probability that a cell comes from the first parent."""
    children: int
    """Of a pair of parents: 1, or 2 with complementary masks."""
    hard_mutation: float
    """p_hard, of a child."""
    soft_mutation: float
    """p_soft, of a cell."""


@dataclass(frozen=True, slots=True, eq=False)
class Coevolution:
    """How the pools evolve (V.B); mutation rates (generations,)."""

    generations: int
    population: int
    agents: int
    pairing: Literal["balanced", "random", "proportional"]
    tournament: int
    elites: int
    crossover: float
    children: int
    hard_mutation: NDArray[np.float64]
    soft_mutation: NDArray[np.float64]

    def breeding(self, generation: int) -> Breeding:
        """The genetic operators' settings in a generation, which counts from 1."""
        rates = float(self.hard_mutation[generation - 1]), float(self.soft_mutation[generation - 1])
        return Breeding(self.tournament, self.elites, self.crossover, self.children, *rates)


@dataclass(frozen=True, slots=True, eq=False)
class Learning:
    """How an agent learns its structure (V.A)."""

    learned: bool
    """Whether there is a structure to learn."""
    lifetime: int
    """Episodes of a lifetime: where the structure is given only those that fitness is measured in."""
    last: int
    """K of (14)."""
    rate: NDArray[np.float64]
    """α of (13), at least (lifetime,)."""
    exploration: NDArray[np.float64]
    """ε of an episode: the probability of a random structure; not used in the last ones."""
    estimate: Literal["joint", "counters"]
    search: Literal["sampled", "exact"]
    candidates: int
    """Random structures that compete with the present one."""


@dataclass(frozen=True, slots=True)
class Enculturation:
    """How memes are kept and passed on (V.C)."""

    size: int
    rate: float
    """The forgetting factor α of (22)."""
    scaled: float
    """The probability of the scaled roulette wheel; otherwise any meme is as likely."""


@dataclass(frozen=True, slots=True, eq=False)
class Settings:
    """The whole `design` block."""

    sharing: Literal["uniform", "value"]
    coevolution: Coevolution
    learning: Learning
    culture: Enculturation | None
    """None where there is none, or nothing that a meme could tell."""
    answer: Answer


def settings_of(meaning: Meaning) -> Settings:
    """The settings of a spec."""
    design, rates = meaning.spec.design, meaning.rates
    learned, culture = meaning.structure.is_open, design.culture
    lifetime = design.learning.episodes if learned else design.learning.last
    evolved, learning = design.coevolution, design.learning
    return Settings(
        design.sharing,
        Coevolution(
            generations=evolved.generations,
            population=evolved.population,
            agents=evolved.agents,
            pairing=evolved.pairing,
            tournament=evolved.tournament,
            elites=min(evolved.elites, evolved.population),
            crossover=evolved.crossover,
            children=evolved.children,
            hard_mutation=np.array(rates.hard_mutation),
            soft_mutation=np.array(rates.soft_mutation),
        ),
        Learning(
            learned=learned,
            lifetime=lifetime,
            last=min(learning.last, lifetime),
            rate=np.array(rates.learning),
            exploration=np.array(rates.exploration),
            estimate=learning.estimate,
            search=learning.search,
            candidates=learning.candidates,
        ),
        Enculturation(culture.size, culture.rate, culture.scaled) if learned and culture != "none" else None,
        design.answer,
    )
