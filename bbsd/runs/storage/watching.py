"""A run as another process writes it: read again and again, never locked, never written to.

Whatever is missing, half written or damaged is left out until it can be read.
"""

from __future__ import annotations

import os
import platform
from contextlib import suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

from bbsd.files import read_regular
from bbsd.runs.storage.finished import RUN_FILE, SPEC, run_content
from bbsd.runs.storage.reading import is_line, is_whole, plain_data

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    Line = dict[str, Any]
    """A line of metrics."""

State = Literal["waiting", "running", "stopped", "done"]
METRICS, LOCK = "metrics.jsonl", "lock"
RIVAL, RUN = "rival-", "run-"
MOST_DIGITS = 10
"""Of a run's number."""
MOST_PROCESSES = 2**31
MOST_BYTES = 1000
"""Bytes of a lock's file that are read: it names one process."""


@dataclass(frozen=True, slots=True)
class WatchedRun:
    """One of the runs of a design, or of a rival on the same budget."""

    run: int
    """Its number, from 1."""
    rival: str
    """The method, where it is a rival's; else ''."""
    lines: tuple[Line, ...]
    """Its metrics so far."""


@dataclass(frozen=True, slots=True)
class Watched:
    """How far a design is."""

    folder: Path
    state: State
    """`stopped` where nobody writes in the folder any more and there is no answer."""
    n_runs: int
    budget: int
    """Episodes of each run in all; 0 for the paper's loop, which has generations, or where it is not known."""
    runs: tuple[WatchedRun, ...]
    """Those that have begun."""
    result: Line
    """What `run.json` says of the answer; empty where there is none."""

    def to_frame(self) -> Any:  # noqa: ANN401 - pandas is optional
        """Return the metrics of all runs so far as a pandas DataFrame, a row for each record or generation.

        Raises NoPandas where pandas is not installed.
        """
        from bbsd.evaluation.frames import metrics_frame

        return metrics_frame({"rival": run.rival, **line} for run in self.runs for line in run.lines)

    def __repr__(self) -> str:
        return f"<Watched {self.folder}: {self.state}, {len(self.runs)} of {self.n_runs} runs>"


def look(folder: Path) -> Watched:
    """Return how far the design in a folder is now."""
    content = run_content(folder)
    n_runs, budgets, result = content.get("runs"), content.get("budgets"), content.get("result")
    count = n_runs if isinstance(n_runs, int) and n_runs > 0 else 1
    runs = (*_runs(folder, count, ""), *_rivals(folder, count))
    has_result = isinstance(result, dict) and bool(result)
    return Watched(
        folder,
        _state(folder, has_begun=bool(content), has_result=has_result),
        count,
        sum(each for each in budgets if is_whole(each)) if isinstance(budgets, list) else 0,
        runs,
        result if isinstance(result, dict) else {},
    )


def is_run(folder: Path) -> bool:
    """Return whether a folder is that of a run, or could become one: it is empty."""
    try:
        names = {path.name for path in folder.iterdir()}
    except OSError:
        return False
    return not names or not names.isdisjoint({SPEC, RUN_FILE, LOCK})


def _rivals(folder: Path, n_runs: int) -> Iterator[WatchedRun]:
    with suppress(OSError):
        for path in sorted(folder.glob(f"{RIVAL}*")):
            yield from _runs(path, n_runs, path.name.removeprefix(RIVAL))


def _runs(folder: Path, n_runs: int, rival: str) -> Iterator[WatchedRun]:
    for run in (1,) if n_runs == 1 else _begun(folder):
        lines = _lines((folder if n_runs == 1 else folder / f"run-{run}") / METRICS)
        if lines:
            yield WatchedRun(run, rival, lines)


def _begun(folder: Path) -> list[int]:
    """Return the numbers of the runs that have a folder."""
    names = (path.name.removeprefix(RUN) for path in folder.glob(f"{RUN}*"))
    return sorted(
        int(name) for name in names if name.isdecimal() and name.isascii() and len(name) < MOST_DIGITS
    )


def _lines(path: Path) -> tuple[Line, ...]:
    """Return the lines that are complete and have what a line of metrics has."""
    try:
        content = read_regular(path)
    except OSError:
        return ()
    return tuple(read for line in content.split(b"\n")[:-1] if (read := _read(line)))


def _read(line: bytes) -> Line:
    try:
        value = plain_data(line)
    except ValueError:
        return {}
    return value if is_line(value) else {}


def _state(folder: Path, *, has_begun: bool, has_result: bool) -> State:
    writer = _writer(folder)
    if writer:
        return "running" if _is_alive(writer) else "done" if has_result else "stopped"
    return "done" if has_result else "stopped" if has_begun else "waiting"


def _writer(folder: Path) -> Line:
    """Return the process that the lock's file names, empty where it names none."""
    try:
        value = plain_data(read_regular(folder / LOCK, MOST_BYTES))
    except (OSError, ValueError):
        return {}
    return value if isinstance(value, dict) else {}


def _is_alive(writer: Line) -> bool:
    """Return whether a process is there, as far as can be told: one on another machine is."""
    process = writer.get("process")
    if writer.get("host") != platform.node() or os.name != "posix":
        return True
    if not isinstance(process, int) or not 0 < process < MOST_PROCESSES:
        return False
    try:
        os.kill(process, 0)  # signal 0 is none: it asks whether the process is there
    except ProcessLookupError:
        return False
    except OSError:
        return True
    return True
