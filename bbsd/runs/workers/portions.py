"""Portions of a run, as a worker does them: the run goes on from a state for some seconds, and what came of it returns.

The worker reads and compiles the spec itself, and writes nothing. What it has compiled, and the run that it left off,
are still there if it is asked to go on; if not, or on another worker, the run is taken up from its state.
"""

from __future__ import annotations

import json
import time
from functools import lru_cache
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from bbsd.engines.units import Result
from bbsd.runs.beginnings import beginning_of_plain, solver_starts
from bbsd.runs.command import Command
from bbsd.runs.origin import remade
from bbsd.runs.rival_command import rival_command
from bbsd.runs.storage import checkpoint
from bbsd.runs.storage.folder import Folder
from bbsd.runs.storage.identity import ENVIRONMENT, identity
from bbsd.runs.storage.records import METRICS, line_text
from bbsd.runs.storage.state import run_arrays
from bbsd.solver.paper.settings import settings_of

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from bbsd.engines.units import Unit
    from bbsd.runs.storage.state import RunState

WORK, PREPARE = f"{__name__}:advance", f"{__name__}:prepare"
"""What a unit names as its work."""
STATE, BEGUN = "state", "begun"
"""Files of a unit and of its result: the arrays of a state; how far the files that grow are written, and the time."""
KEPT = 2
"""Commands that a worker keeps."""


class Begun(NamedTuple):
    """How far a run's files are."""

    lines: int
    """Of metrics."""
    files: list[str]
    """Those that have a first line."""
    seconds: float | None
    """What is left of the time of its rounds; None where they have none."""

    def to_bytes(self) -> bytes:
        """Return this as bytes."""
        return json.dumps(self._asdict()).encode()


class _LeftOff(NamedTuple):
    """A run that a worker left off: the state that it gave back, and the steps that come next."""

    digest: bytes
    steps: Iterator[tuple[RunState, dict[str, Any] | None]]


_left_off: dict[str, _LeftOff] = {}


def order_of(command: Command, run: int) -> dict[str, Any]:
    """Return the order of the units that do a run. Raises ValueError for a command without origin."""
    origin = command.origin
    if origin is None:
        raise ValueError("it is not known what this command is made of")
    return {
        "problem": origin.plain(command.problem),
        "rival": origin.rival,
        "seed": command.seed,
        "runs": command.n_runs,
        "starts": [each.plain() for each in origin.beginnings],
        "budgets": list(origin.budgets if origin.rival else command.budgets),
        "identity": command.who.plain(),
        "run": run,
    }


def prepare(unit: Unit) -> Result:
    """Read and compile the spec of a unit, so that it can begin at once when it is sent."""
    _command(_what(unit))
    return Result({})


def advance(unit: Unit) -> Result:
    """Take a run further, for as long as the unit says, by a step at least.

    Returns what the steps add to each of the run's files, and the state after them. A worker that is asked to stop
    returns what it has.
    """
    what, run = _what(unit), unit.order["run"]
    command, begun = _command(what), Begun(**json.loads(unit.files[BEGUN]))
    steps = _steps(command, unit, begun, f"{run} of {what}")
    written = _Written(command, begun)
    end = None if unit.seconds is None else time.monotonic() + unit.seconds
    reached, finished, stopped = None, True, False
    try:
        for reached, line in steps:
            written.add(reached, line)
            if end is not None and time.monotonic() >= end and not command.is_complete(reached):
                finished = False
                break
    except KeyboardInterrupt:
        finished, stopped = False, True
    if reached is None:
        return Result({}, finished)
    state = checkpoint.packed(command.who, run_arrays(reached))
    if not finished and not stopped:
        _left_off[f"{run} of {what}"] = _LeftOff(sha256(state).digest(), steps)
    return Result({**written.texts(), STATE: state}, finished)


def _steps(
    command: Command, unit: Unit, begun: Begun, name: str
) -> Iterator[tuple[RunState, dict[str, Any] | None]]:
    """Return the steps of a run from where its unit begins."""
    left = _left_off.pop(name, None)
    state = unit.files.get(STATE)
    if left is not None and state is not None and left.digest == sha256(state).digest():
        return left.steps
    run = unit.order["run"]
    reached = (
        command.fresh(run)
        if state is None
        else command.restored(run, checkpoint.unpacked(state, command.who, unit.name))
    )
    return command.steps(reached, None if begun.seconds is None else time.monotonic() + begun.seconds)


class _Written:
    """What is added to the files of a run."""

    def __init__(self, command: Command, begun: Begun) -> None:
        self._command, self._lines = command, begun.lines
        self._begun = set(begun.files)
        self._texts: dict[str, list[bytes]] = {}

    def add(self, reached: RunState, line: dict[str, Any] | None) -> None:
        """Add a step."""
        if line is not None:
            self._texts.setdefault(METRICS, []).append(line_text(line))
        for table in self._command.tables(reached, line, self._lines + 1):
            content = table.content(with_columns=table.file not in self._begun)
            self._begun.add(table.file)
            self._texts.setdefault(table.file, []).append(content)
        self._lines += line is not None

    def texts(self) -> dict[str, bytes]:
        """Return what is added to each file."""
        return {name: b"".join(parts) for name, parts in self._texts.items()}


def _what(unit: Unit) -> str:
    """Return what all runs of a command have in common, as text."""
    return json.dumps({key: value for key, value in unit.order.items() if key != "run"}, sort_keys=True)


@lru_cache(maxsize=KEPT)
def _command(what: str) -> Command:
    """Return the command that units are of; it has no folder."""
    order: Mapping[str, Any] = json.loads(what)
    loaded, problem = remade(order["problem"])
    seed, runs, budgets = order["seed"], order["runs"], tuple(order["budgets"])
    starts = solver_starts(problem, [beginning_of_plain(each) for each in order["starts"]], seed)
    who = identity(loaded, seed, runs, order["identity"].get(ENVIRONMENT), starts)
    command = Command(problem, settings_of(problem.meaning, starts), seed, runs, Folder(Path()), who, budgets)
    if order["rival"]:
        command = rival_command(command, order["rival"], loaded)
    if command.who.plain() != order["identity"]:
        raise RuntimeError("the spec that a worker reads is not the one that was sent")
    return command
