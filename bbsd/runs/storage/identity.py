"""What makes two runs the same run: the spec's meaning, the seed, the number of runs, and what computes them."""

from __future__ import annotations

import json
from dataclasses import dataclass
from hashlib import sha256
from typing import TYPE_CHECKING, Any

from bbsd.version import REVISION, __version__

if TYPE_CHECKING:
    from collections.abc import Mapping

    from bbsd.language.loading import Loaded
    from bbsd.solver.starts import Starts
    from bbsd.text import Data

WITHOUT_MEANING = ("bbsd", "name", "summary", "view", "extends")
"""Blocks that change no episode."""
FREE = "x-"
ENVIRONMENT, START = "environment", "start"
"""The keys of what identifies the environment and the start, beside the spec."""


@dataclass(frozen=True, slots=True)
class Identity:
    """Identifies a design; resuming requires an equal one, by the same version and revision of bbsd."""

    spec: tuple[tuple[str, str], ...]
    """A digest of the values of each block, after overrides, without comments, layout and the budget of a search."""
    seed: int
    runs: int
    environment: tuple[tuple[str, str], ...] = ()
    """What identifies the environment that is stepped in Python; none where the world is the spec's own."""
    start: str = ""
    """A digest of the known designs that it begins with, '' of none."""

    def plain(self) -> dict[str, Any]:
        """Return the identity as `run.json` and checkpoints hold it."""
        environment = {ENVIRONMENT: dict(self.environment)} if self.environment else {}
        start = {START: self.start} if self.start else {}
        return {"bbsd": __version__, "revision": REVISION, **self.command(), **environment, **start}

    def command(self) -> dict[str, Any]:
        """Return the part of the identity that the user chose."""
        return {"spec": dict(self.spec), "seed": self.seed, "runs": self.runs}

    def differences(self, content: Mapping[str, Any]) -> list[str]:
        """Return what differs in another identity as it is held, in words; none if it is equal."""
        theirs = content.get("spec")
        spec = theirs if isinstance(theirs, dict) else {}
        own = dict(self.spec)
        blocks = [key for key in {**own, **spec} if own.get(key) != spec.get(key)]
        words = [f"the spec's {', '.join(map(str, blocks))}"] if blocks else []
        expected = self.plain()
        for key, name in {
            "seed": "seed",
            "runs": "number of runs",
            "bbsd": "version",
            "revision": "revision",
        }.items():
            if content.get(key) != expected[key]:
                words.append(f"the {name} ({content.get(key, 'unknown')}, not {expected[key]})")
        if content.get(START, "") != self.start:
            words.append("the start")
        return [*words, *self._other_environment(content)]

    def _other_environment(self, content: Mapping[str, Any]) -> list[str]:
        """Return what differs in the environment that is stepped in Python."""
        theirs, own = content.get(ENVIRONMENT), dict(self.environment)
        held = theirs if isinstance(theirs, dict) else {}
        return [
            f"the environment's {key} ({held.get(key, 'none')}, not {own.get(key, 'none')})"
            for key in {**own, **held}
            if own.get(key) != held.get(key)
        ]


def identity(
    loaded: Loaded,
    seed: int,
    runs: int,
    environment: Mapping[str, str] | None = None,
    starts: Starts | None = None,
) -> Identity:
    """Return the identity of a design; `environment` identifies one that is stepped in Python."""
    data = loaded.data if isinstance(loaded.data, dict) else {}
    paper = loaded.spec.design.chosen_method == "paper"
    blocks = {key: _meant(value, key, paper=paper) for key, value in data.items()}
    return Identity(
        tuple(
            (key, _digest(value))
            for key, value in sorted(blocks.items())
            if key not in WITHOUT_MEANING and not key.startswith(FREE) and value not in ({}, None)
        ),
        seed,
        runs,
        tuple((environment or {}).items()),
        "" if starts is None else starts.digest,
    )


def _meant(value: Data, key: str, *, paper: bool) -> Data:
    """Return a block without the budget, unless generations follow from it."""
    if key != "design" or paper or not isinstance(value, dict):
        return value
    return {inner: item for inner, item in value.items() if inner != "budget"}


def _digest(value: Data) -> str:
    return sha256(json.dumps(value, ensure_ascii=False).encode("utf-8", "surrogatepass")).hexdigest()[:32]
