"""A run's state on disk: one file of plain arrays, replaced whole, so a killed run loses at most one generation."""

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
from bbsd.version import REVISION

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

DIGEST_BYTES = 32


@dataclass(frozen=True, slots=True, eq=False)
class RunState:
    """How far a run is: its number (from 0), the state of its method, and its answer once there is one."""

    run: int
    state: State
    answer: Architecture | None = None


class CheckpointError(Exception):
    """A checkpoint that cannot be resumed; the message says why."""


def save(path: Path, reached: RunState) -> None:
    """Write a run's state and its digest into a file, completely or not at all."""
    part = path.with_suffix(".part")
    part.write_bytes(packed(reached))
    part.replace(path)


def packed(reached: RunState) -> bytes:
    """Return the content of a checkpoint file: a digest, then the arrays."""
    buffer = BytesIO()
    np.savez(buffer, **_arrays(reached), allow_pickle=False)
    content = buffer.getvalue()
    return sha256(content).digest() + content


def load(path: Path) -> RunState:
    """Read a run's state from a file. Raises CheckpointError for a file that is damaged or of another revision."""
    content = path.read_bytes()
    digest, content = content[:DIGEST_BYTES], content[DIGEST_BYTES:]
    if sha256(content).digest() != digest:
        raise CheckpointError(f"{path} is damaged: its digest does not match")
    try:
        with np.load(BytesIO(content), allow_pickle=False) as file:
            arrays = dict(file)
        revision = int(arrays["revision"])
        if revision == REVISION:
            return _run_state(arrays)
    except (BadZipFile, EOFError, KeyError, MemoryError, TypeError, ValueError) as error:
        raise CheckpointError(f"{path} cannot be read: {error}") from None
    raise CheckpointError(f"{path} was written by revision {revision} of bbsd; this is revision {REVISION}")


def _arrays(reached: RunState) -> dict[str, NDArray[np.generic]]:
    state = reached.state
    return {
        "revision": np.array(REVISION),
        "run": np.array(reached.run),
        "generation": np.array(state.generation),
        **{f"pool_{index}": pool for index, pool in enumerate(state.pools)},
        "fitness": state.fitness,
        "memes": state.culture.memes,
        "meme_fitness": state.culture.fitness,
        "champion_tables": state.champions.tables,
        "champion_structures": state.champions.structures,
        "champion_fitness": state.champions.fitness,
        "champion_capacity": np.array(state.champions.capacity),
        **_answer_arrays(reached.answer),
    }


def _answer_arrays(answer: Architecture | None) -> dict[str, NDArray[np.generic]]:
    if answer is None:
        return {}
    tables = {f"answer_{index}": table for index, table in enumerate(answer.tables)}
    return {**tables, "answer_structure": answer.structure}


def _run_state(arrays: dict[str, NDArray[Any]]) -> RunState:
    pools = tuple(arrays[f"pool_{index}"] for index in range(len(arrays["fitness"])))
    champions = Champions(
        arrays["champion_tables"],
        arrays["champion_structures"],
        arrays["champion_fitness"],
        int(arrays["champion_capacity"]),
    )
    culture = Culture(arrays["memes"], arrays["meme_fitness"])
    state = State(int(arrays["generation"]), pools, arrays["fitness"], culture, champions)
    return RunState(int(arrays["run"]), state, _answer(arrays))


def _answer(arrays: dict[str, NDArray[Any]]) -> Architecture | None:
    if "answer_structure" not in arrays:
        return None
    tables = tuple(arrays[f"answer_{index}"] for index in range(len(arrays["fitness"])))
    return Architecture(tables, arrays["answer_structure"])
