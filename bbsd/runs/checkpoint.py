"""A run's state on disk: one file of plain arrays.

Replaced whole, so a run that is killed loses at most one generation.
"""

from __future__ import annotations

from dataclasses import dataclass
from hashlib import sha256
from io import BytesIO
from typing import TYPE_CHECKING, Any
from zipfile import BadZipFile

import numpy as np

from bbsd.architecture import Architecture
from bbsd.solver.champions import Champions
from bbsd.solver.culture import Culture
from bbsd.solver.generation import State

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

DIGEST_BYTES = 32


@dataclass(frozen=True, slots=True, eq=False)
class Progress:
    """Where a run stands: its number (from 0), its state, and its answer once there is one."""

    run: int
    state: State
    answer: Architecture | None = None


class CheckpointError(ValueError):
    """A checkpoint that cannot be gone on from, and why."""


def save(path: Path, progress: Progress) -> None:
    """Write the state beside its digest, whole or not at all."""
    part = path.with_suffix(".part")
    part.write_bytes(packed(progress))
    part.replace(path)


def packed(progress: Progress) -> bytes:
    """The content of the file."""
    buffer = BytesIO()
    np.savez(buffer, **_arrays(progress), allow_pickle=False)
    content = buffer.getvalue()
    return sha256(content).digest() + content


def load(path: Path) -> Progress:
    """Read a state back; raises CheckpointError for a file that is damaged."""
    content = path.read_bytes()
    digest, content = content[:DIGEST_BYTES], content[DIGEST_BYTES:]
    if sha256(content).digest() != digest:
        raise CheckpointError(f"{path} is damaged: its digest does not match")
    try:
        with np.load(BytesIO(content), allow_pickle=False) as arrays:
            return _progress(dict(arrays))
    except (BadZipFile, EOFError, KeyError, MemoryError, TypeError, ValueError) as error:
        raise CheckpointError(f"{path} cannot be read: {error}") from None


def _arrays(progress: Progress) -> dict[str, NDArray[np.generic]]:
    state = progress.state
    return {
        "run": np.array(progress.run),
        "generation": np.array(state.generation),
        **{f"pool_{index}": pool for index, pool in enumerate(state.pools)},
        "fitness": state.fitness,
        "memes": state.culture.memes,
        "meme_fitness": state.culture.fitness,
        "champion_tables": state.champions.tables,
        "champion_structures": state.champions.structures,
        "champion_fitness": state.champions.fitness,
        "champion_capacity": np.array(state.champions.capacity),
        **_answer_arrays(progress.answer),
    }


def _answer_arrays(answer: Architecture | None) -> dict[str, NDArray[np.generic]]:
    if answer is None:
        return {}
    tables = {f"answer_{index}": table for index, table in enumerate(answer.tables)}
    return {**tables, "answer_structure": answer.structure}


def _progress(arrays: dict[str, NDArray[Any]]) -> Progress:
    pools = tuple(arrays[f"pool_{index}"] for index in range(len(arrays["fitness"])))
    champions = Champions(
        arrays["champion_tables"],
        arrays["champion_structures"],
        arrays["champion_fitness"],
        int(arrays["champion_capacity"]),
    )
    culture = Culture(arrays["memes"], arrays["meme_fitness"])
    state = State(int(arrays["generation"]), pools, arrays["fitness"], culture, champions)
    return Progress(int(arrays["run"]), state, _answer(arrays))


def _answer(arrays: dict[str, NDArray[Any]]) -> Architecture | None:
    if "answer_structure" not in arrays:
        return None
    tables = tuple(arrays[f"answer_{index}"] for index in range(len(arrays["fitness"])))
    return Architecture(tables, arrays["answer_structure"])
