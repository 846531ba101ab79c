"""The runs in folders, each with its state; nothing is written, and no file is trusted to be what its name says."""

from __future__ import annotations

import re
from dataclasses import dataclass
from hashlib import sha256
from math import isnan, nan
from typing import TYPE_CHECKING, Any, Literal

from bbsd.files import read_regular
from bbsd.runs.storage.checkpoint import is_undamaged
from bbsd.runs.storage.finished import ARCHITECTURE, RUN_FILE, run_content
from bbsd.runs.storage.lock import holder_text
from bbsd.runs.storage.watching import LOCK, METRICS, look
from bbsd.version import REVISION, __version__

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from pathlib import Path

    from bbsd.runs.storage.watching import Line, Watched

ListedState = Literal["running", "stopped", "finished", "not begun", "damaged"]
STATES: dict[str, ListedState] = {
    "running": "running",
    "stopped": "stopped",
    "done": "finished",
    "waiting": "not begun",
}
DEEPEST = 2
"""How many folders may be between the one that is given and a run's."""
CHECKPOINTS = ("checkpoint.npz", "checkpoint.previous.npz")
OF_RUN = (METRICS, *CHECKPOINTS, ARCHITECTURE)
"""Files of which a folder has at least one as soon as something came out of its run."""
NEEDED = ("bbsd", "revision", "seed", "runs")
"""Keys without which nobody can say what a run is."""
RESULT, DIGEST = "return", "architecture_sha256"


@dataclass(frozen=True, slots=True)
class Listed:
    """A run, or several of one design, in a folder."""

    folder: Path
    state: ListedState
    detail: str
    """Who writes in the folder, what is damaged, or what else is to be known; '' where there is nothing to say."""
    version: str
    """The version of bbsd that wrote the folder, where it is not this one: such a run cannot be resumed; else ''."""
    method: str
    """'' where no record says it yet."""
    seed: int | None
    runs: int
    done: int
    """Generations of all runs so far, where the method has such; else episodes."""
    budget: int
    """Of all runs, in the same unit; 0 where it is not known."""
    has_generations: bool
    mean: float
    """The mean return of the answer in new episodes; NaN where there is none."""
    low: float
    """The 95 % interval of the mean begins here, and ends at `high`."""
    high: float
    best: float
    """The best mean return that records have so far; NaN where there is none."""
    written: float
    """When a file of the run was last written, in seconds since 1970; 0 where there is none."""
    ended: tuple[dict[str, Any], ...] = ()
    """What is recorded of runs that ended before their budget was spent."""

    def __repr__(self) -> str:
        return f"<Listed {self.folder}: {self.state}>"


def listed_below(place: Path) -> list[Listed]:
    """Return the runs in a folder, in the order of their names: that of a run itself, or one that holds such.

    Raises OSError for a folder that cannot be read.
    """
    return [listed(folder) for folder in _run_folders(place, DEEPEST)]


def listed(folder: Path) -> Listed:
    """Return what is known of the run in a folder."""
    content, now = run_content(folder), look(folder)
    lines = [run.lines[-1] for run in now.runs if not run.rival]
    has_generations = any("generation" in line for line in lines)
    mean, low, high = (_number(_returns(now).get(key)) for key in ("mean", "low", "high"))
    state, detail = _state(folder, content, now)
    return Listed(
        folder=folder,
        state=state,
        detail=detail,
        version=_other_version(content),
        method="paper" if has_generations else next((_text(line.get("method")) for line in lines), ""),
        seed=_whole(content.get("seed")),
        runs=now.n_runs,
        done=sum(_whole(line.get("generation" if has_generations else "episodes")) or 0 for line in lines),
        budget=now.budget * now.n_runs,
        has_generations=has_generations,
        mean=mean,
        low=low,
        high=high,
        best=_best(now),
        ended=_ended(now),
        written=max(map(_written, _files(folder)), default=0.0),
    )


def _run_folders(place: Path, depth: int) -> Iterator[Path]:
    if _is_run(place):
        yield place
        return
    for path in sorted(place.iterdir(), key=_in_order):
        if not path.is_dir():
            continue
        if _is_run(path):
            yield path
        elif depth > 1 and _is_readable(path):
            yield from _run_folders(path, depth - 1)


def _is_run(folder: Path) -> bool:
    """Return whether a folder is that of a design that has begun, or was about to."""
    return (folder / RUN_FILE).exists() or (folder / LOCK).exists()


def _is_readable(folder: Path) -> bool:
    try:
        next(folder.iterdir(), None)
    except OSError:
        return False
    return True


def _in_order(path: Path) -> list[tuple[int, str]]:
    """Return the key by which names are in the order that people expect: with 9 before 10."""
    parts = re.split(r"([0-9]+)", path.name)
    return [(len(part.lstrip("0")), part) if index % 2 else (0, part) for index, part in enumerate(parts)]


def _state(folder: Path, content: dict[str, Any], now: Watched) -> tuple[ListedState, str]:
    if now.state == "running":
        return "running", f"by {holder_text(folder / LOCK)}"
    if damage := _damage(folder, content, now):
        return "damaged", damage
    if now.state == "stopped" and not any(
        (path / name).exists() for path in _folders(folder) for name in OF_RUN
    ):
        return "not begun", ""
    return STATES[now.state], _edited(folder, now) if now.state == "done" else ""


def _damage(folder: Path, content: dict[str, Any], now: Watched) -> str:
    """Return what of a run that nobody writes is damaged, '' where nothing is, as far as can be seen from outside."""
    if not (folder / RUN_FILE).exists():
        there = [name for name in OF_RUN if any((path / name).exists() for path in _folders(folder))]
        return f"{RUN_FILE} is missing, {there[0]} is there" if there else ""
    if not content:
        return f"{RUN_FILE} cannot be read"
    if missing := [key for key in NEEDED if key not in content]:
        return f"{RUN_FILE} does not say {' and '.join(missing)}"
    if now.state == "done" and not _content(folder / ARCHITECTURE):
        return f"{ARCHITECTURE} is missing or empty; --resume writes it again"
    for path in _folders(folder):
        states = [path / name for name in CHECKPOINTS if (path / name).exists()]
        if states and not any(is_undamaged(_content(state)) for state in states):
            return f"{states[0].relative_to(folder)} is damaged"
    known = sum(len(run.lines) for run in now.runs if not run.rival)
    there_are = sum(_content(path / METRICS).count(b"\n") for path in _folders(folder, now.n_runs))
    return f"{METRICS} has lines that are no records" if known != there_are else ""


def _edited(folder: Path, now: Watched) -> str:
    """Return whether a designed spec is another one than was written."""
    digest = now.result.get(DIGEST)
    differs = digest is not None and sha256(_content(folder / ARCHITECTURE)).hexdigest() != digest
    return f"{ARCHITECTURE} was changed since" if differs else ""


def _folders(folder: Path, n_runs: int = 0) -> list[Path]:
    """Return the folders in which a design's records are: its own, or those of its runs where they are several."""
    below = [path for path in folder.glob("run-*") if path.is_dir()]
    return [folder] if n_runs == 1 else below if n_runs else [folder, *below]


def _files(folder: Path) -> Iterable[Path]:
    return (path / name for path in _folders(folder) for name in (RUN_FILE, *OF_RUN))


def _written(path: Path) -> float:
    try:
        return path.stat().st_mtime
    except OSError:
        return 0.0


def _content(path: Path) -> bytes:
    """Return what a regular file holds; nothing where there is none, or it cannot be read."""
    try:
        return read_regular(path)
    except OSError:
        return b""


def _returns(now: Watched) -> Line:
    returns = now.result.get(RESULT)
    return returns if isinstance(returns, dict) else {}


def _ended(now: Watched) -> tuple[dict[str, Any], ...]:
    ended = now.result.get("ended")
    return tuple(each for each in ended if isinstance(each, dict)) if isinstance(ended, list) else ()


def _best(now: Watched) -> float:
    """Return the best of the means that runs measured last, or of the fittest agents of their last generations."""
    lines = [run.lines[-1] for run in now.runs if not run.rival]
    means = [_number(line.get("best", line.get("mean"))) for line in lines]
    return max((mean for mean in means if not isnan(mean)), default=nan)


def _other_version(content: dict[str, Any]) -> str:
    theirs = content.get("bbsd"), content.get("revision")
    if not content or theirs == (__version__, REVISION):
        return ""
    return (
        f"bbsd {theirs[0] or 'of unknown version'}, revision {'unknown' if theirs[1] is None else theirs[1]}"
    )


def _number(value: object) -> float:
    """Return a number, NaN for all else."""
    if type(value) not in (int, float):
        return nan
    try:
        return float(value)  # type: ignore[arg-type]
    except OverflowError:
        return nan


def _whole(value: object) -> int | None:
    return value if type(value) is int else None


def _text(value: object) -> str:
    return value if isinstance(value, str) else ""
