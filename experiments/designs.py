"""What all experiments share: the shipped specs, the seeds, and what a finished design earns in given episodes."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

import bbsd
from bbsd.architecture import given_architecture
from bbsd.compiler import compile_meaning
from bbsd.evaluation import agents_of, detailed_outcomes, returns_of

if TYPE_CHECKING:
    from bbsd.compiler import Problem
    from bbsd.evaluation import Agents

Floats = npt.NDArray[np.float64]
Keys = npt.NDArray[np.uint64]

SPECS = Path(__file__).parents[1] / "specs"
SEEDS = range(10)


@dataclass(frozen=True)
class Earnings:
    """What a finished design earned in each episode, (n_episodes,): the returns, and each term of the reward."""

    returns: Floats
    terms: dict[str, Floats]


def spec_path(name: str) -> Path:
    """Return the path of a shipped spec."""
    return SPECS / f"{name}.yaml"


def returns(path: Path, streams: Keys) -> Floats:
    """Return the returns (n_episodes,) of a finished design in the episodes that the keys name."""
    problem, agents, generation = _loaded(path)
    earned: Floats = returns_of(problem, agents, streams, generation)[0]
    return earned


def earnings(path: Path, streams: Keys) -> Earnings:
    """Return the returns and reward terms of a finished design in the episodes that the keys name."""
    problem, agents, generation = _loaded(path)
    outcomes = list(detailed_outcomes(problem, agents, streams, generation))
    terms = np.concatenate([outcome.terms for outcome in outcomes])
    return Earnings(
        np.concatenate([outcome.returns for outcome in outcomes]),
        dict(zip(problem.meaning.episode.reward, terms.T, strict=True)),
    )


def _loaded(path: Path) -> tuple[Problem, Agents, int]:
    loaded = bbsd.load(path)
    problem = compile_meaning(loaded.meaning)
    generation = loaded.spec.design.coevolution.generations
    return problem, agents_of([given_architecture(problem)]), generation


def verdict(holds: bool | None) -> str:
    """Return how a claim came out as text; None stands for one that the figures leave open."""
    return "open" if holds is None else "holds" if holds else "FAILS"
