"""`visits.json`: how often cells of a run's design were asked and controlled; so explaining it runs no episodes."""

from __future__ import annotations

import json
from hashlib import sha256
from typing import TYPE_CHECKING, Any

import numpy as np

from bbsd.architecture.visits import Visits
from bbsd.files import read_regular, write_text_whole
from bbsd.runs.storage.finished import ARCHITECTURE, VISITS
from bbsd.runs.storage.reading import is_whole, plain_data

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

    from numpy.typing import NDArray

    Counts = NDArray[np.int64]

FORMAT = 1
DIGEST = "architecture_sha256"


def write_visits(folder: Path, text: str, names: Sequence[str], visits: Visits) -> None:
    """Write the visits of a run's design, whose file has this text; a line for each behavior."""
    head = {
        "format": FORMAT,
        DIGEST: sha256(text.encode()).hexdigest(),
        "episodes": visits.episodes,
        "robot_steps": visits.robot_steps,
    }
    behaviors = ",\n".join(
        f"    {json.dumps(name)}: {json.dumps(_plain(asked, controlled))}"
        for name, asked, controlled in zip(names, visits.asked, visits.controlled, strict=True)
    )
    lines = [f"  {json.dumps(key)}: {json.dumps(value)}," for key, value in head.items()]
    content = "\n".join(["{", *lines, '  "behaviors": {', behaviors, "  }", "}", ""])
    write_text_whole(folder / VISITS, content)


def _plain(asked: Counts, controlled: Counts) -> dict[str, Any]:
    """Return the cells that were asked, each with the counts asked and controlled."""
    cells = np.flatnonzero(asked).tolist()
    return {
        "cells": len(asked),
        "asked": {str(cell): [int(asked[cell]), int(controlled[cell])] for cell in cells},
    }


def read_visits(folder: Path, cells: Mapping[str, int]) -> Visits | None:
    """Return the visits of a run's design, whose behaviors have so many cells; None where its file is no such thing.

    It is none where it is missing, damaged, or of a design that was changed since.
    """
    try:
        content = plain_data(read_regular(folder / VISITS))
        if content["format"] != FORMAT or content[DIGEST] != _digest(folder / ARCHITECTURE):
            return None
        counts = [_counts(content["behaviors"][name], count) for name, count in cells.items()]
        return Visits(
            _count(content["episodes"]),
            _count(content["robot_steps"]),
            tuple(asked for asked, _ in counts),
            tuple(controlled for _, controlled in counts),
        )
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return None


def _counts(plain: Mapping[str, Any], cells: int) -> tuple[Counts, Counts]:
    if plain["cells"] != cells:
        raise ValueError("a behavior has other cells")
    asked, controlled = np.zeros((2, cells), np.int64)
    for cell, (n_asked, n_controlled) in plain["asked"].items():
        if not 0 <= int(cell) < cells:
            raise ValueError("there is no such cell")
        asked[int(cell)], controlled[int(cell)] = _count(n_asked), _count(n_controlled)
    return asked, controlled


def _count(value: object) -> int:
    if not is_whole(value) or not isinstance(value, int) or value < 0:
        raise ValueError("it is no count")
    return value


def _digest(path: Path) -> str:
    return sha256(read_regular(path)).hexdigest()
