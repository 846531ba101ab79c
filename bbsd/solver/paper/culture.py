"""The culture of the agents' society: a pool of memes, which are structures that were learned (V.C).

Memes are drawn from the culture as it stood when the generation began, and the generation's structures are
taken in when it ends, so the agents of a generation are independent.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bbsd.kernel.jit import jit
from bbsd.kernel.streams import chance, fold, unit, word_of
from bbsd.solver.draws import below

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bbsd.language.design import CultureSettings

WHEEL, PLACE, ANY = range(3)  # the streams of one agent


@dataclass(frozen=True, slots=True, eq=False)
class Culture:
    """(20): memes (n_memes, n_layers), each once, and the fitness (n_memes,) of each."""

    memes: NDArray[np.int64]
    fitness: NDArray[np.float64]

    def __len__(self) -> int:
        return len(self.memes)


def empty_culture(n_layers: int) -> Culture:
    """Return the culture before the first generation; no meme can be drawn from it."""
    return Culture(np.empty((0, n_layers), np.int64), np.empty(0))


def draw_memes(key: int, culture: Culture, n_agents: int, scaled: float) -> NDArray[np.int64]:
    """Draw a meme for each newborn agent: from the scaled roulette wheel with probability `scaled`, otherwise any.

    Args:
        key: the generation's stream for memes.
        culture: not empty.
        n_agents: how many agents are born.
        scaled: a probability.

    Returns:
        (n_agents, n_layers).
    """
    chosen = np.empty(n_agents, np.int64)
    spin(np.uint64(key), wheel(culture.fitness), scaled, chosen)
    return culture.memes[chosen]


def wheel(fitness: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return where the memes' sectors end, (n_memes,): each f - min + 0.1 (max - min) wide, or all equally wide."""
    low, high = fitness.min(), fitness.max()
    sectors = fitness - low + 0.1 * (high - low) if high > low else np.ones_like(fitness)
    return np.cumsum(sectors)


@jit
def spin(key: np.uint64, ends: NDArray[np.float64], scaled: float, chosen: NDArray[np.int64]) -> None:
    """Write the index of each agent's meme into `chosen` (n_agents,)."""
    for agent in range(len(chosen)):
        stream = fold(int(key), word_of(agent))
        if chance(stream, word_of(WHEEL), scaled):
            place = unit(fold(stream, word_of(PLACE))) * ends[-1]
            meme = 0
            while meme < len(ends) - 1 and place >= ends[meme]:
                meme += 1
            chosen[agent] = meme
        else:
            chosen[agent] = below(fold(stream, word_of(ANY)), len(ends))


def take_in(
    culture: Culture, structures: NDArray[np.int64], fitness: NDArray[np.float64], settings: CultureSettings
) -> Culture:
    """Return the culture after a generation: its agents' final structures are taken in one after another.

    Args:
        culture: as it stood when the generation began.
        structures: (n_agents, n_layers).
        fitness: the agents' (14), (n_agents,).
        settings: the culture's size and forgetting factor.
    """
    memes, values = culture.memes.tolist(), culture.fitness.tolist()
    for structure, value in zip(structures.tolist(), fitness.tolist(), strict=True):
        learn(memes, values, structure, value, settings)
    return Culture(np.array(memes, np.int64).reshape(-1, structures.shape[1]), np.array(values, np.float64))


def learn(
    memes: list[list[int]],
    fitness: list[float],
    structure: list[int],
    value: float,
    settings: CultureSettings,
) -> None:
    """Take in a structure: by (22) if the culture has it, else if there is room or a meme that is less fit."""
    if structure in memes:
        meme = memes.index(structure)
        fitness[meme] = (1.0 - settings.rate) * fitness[meme] + settings.rate * value
    elif len(memes) < settings.size:
        memes.append(structure)
        fitness.append(value)
    elif value > min(fitness):
        least = fitness.index(min(fitness))
        memes[least], fitness[least] = structure, value
