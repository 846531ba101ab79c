"""The random streams of an evaluation's episodes: designs that are evaluated with one seed face the same episodes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.kernel.keys import keys
from bbsd.kernel.streams import fold, name_word, word_of
from bbsd.language.meaning import seed_key

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

EVALUATION = name_word("evaluation")


def evaluation_key(seed: int) -> int:
    """Return the key of all streams of an evaluation."""
    return fold(seed_key(seed), EVALUATION)


def episode_key(seed: int, episode: int) -> int:
    """Return the key of one of an evaluation's episodes, by its number from 0."""
    return fold(evaluation_key(seed), word_of(episode))


def evaluation_keys(seed: int, n_episodes: int) -> NDArray[np.uint64]:
    """Return the keys of an evaluation's first episodes, (n_episodes,)."""
    return keys(evaluation_key(seed), 0, n_episodes)
