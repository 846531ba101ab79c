"""The finished design of a run, found by its folder; reading it takes no time, since no method is imported."""

from __future__ import annotations

import re
import shlex
from typing import TYPE_CHECKING, Any

from bbsd.errors import UsageError
from bbsd.files import read_regular
from bbsd.runs.storage.reading import run_record

if TYPE_CHECKING:
    from pathlib import Path

ARCHITECTURE, BEST, RUN_FILE = "architecture.yaml", "best.yaml", "run.json"
"""Files of a run: the designed spec, the best so far while there is no answer, and what was run."""
LOCK = "lock"
"""The file that its writer holds; it is made before all others."""
SPEC, VISITS = "spec.yaml", "visits.json"
"""The spec as it was when the design began, and how often the cells of its design were asked."""
PART = re.compile(r"run-[1-9][0-9]*|rival-.+")
"""Names of folders that are parts of a design's."""
SPEC_BEGINS, MOST_OF_A_BEGINNING = re.compile(rb"^bbsd *:", re.MULTILINE), 10_000
"""The line that every spec has, and the bytes in which it is searched."""
MOST_NAMED = 3
"""Runs inside a folder that are named, at most."""


class NoDesign(UsageError):
    """A folder that holds no finished design; `advice` says how to go on."""

    def __init__(self, message: str, advice: str) -> None:
        super().__init__(message)
        self.advice = advice


def design_file(path: Path) -> Path:
    """Return the file of a design: of a run's folder its designed spec, else the path itself.

    Raises NoDesign for a folder that is no run, or a run without an answer.
    """
    if not path.is_dir():
        return path
    architecture = path / ARCHITECTURE
    if architecture.is_file():
        return architecture
    if (path / RUN_FILE).is_file():
        raise NoDesign(f"the run in {path} has no answer yet: there is no {architecture}", way_on(path))
    raise NoDesign(
        f"{path} is a folder, and not that of a run: a run has the files {ARCHITECTURE} and {RUN_FILE}",
        _other_choices(path),
    )


def is_of_run(path: Path) -> bool:
    """Return whether a folder is that of a run, with an answer or without one."""
    return (path / ARCHITECTURE).is_file() or (path / RUN_FILE).is_file()


def spec_inside(path: Path) -> Path | None:
    """Return a spec in a folder, in the order of their names; None where it has none."""
    for file in sorted(path.glob("*.y*ml")):
        try:
            content = read_regular(file, MOST_OF_A_BEGINNING)
        except (OSError, ValueError):
            continue
        if SPEC_BEGINS.search(content):
            return file
    return None


def run_content(path: Path) -> dict[str, Any]:
    """Return what a run's folder says of the run, empty where that is missing or damaged."""
    try:
        return run_record(read_regular(path / RUN_FILE))
    except (OSError, ValueError):
        return {}


def way_on(path: Path) -> str:
    """Return how a run without an answer is continued, and what there is of it until then."""
    content = run_content(path)
    seed, runs, overrides = content.get("seed", 0), content.get("runs", 1), content.get("set", [])
    words = ["bbsd", "design", str(path / SPEC), "--resume", "--out", str(path)]
    words += ["--seed", str(seed), *(["--runs", str(runs)] if runs != 1 else [])]
    for override in overrides:
        words += ["--set", str(override)]
    best = path / BEST
    meanwhile = f"; or look at its best design so far, {best}" if best.is_file() else ""
    return f"continue it: {shlex.join(words)}{meanwhile}"


def _other_choices(path: Path) -> str:
    """Return what to give instead of a folder that is no run: the design that it is of, or one of the runs in it."""
    if PART.fullmatch(path.name) and (path.parent / RUN_FILE).is_file():
        return (
            f"it is one of the runs of {path.parent}: give that folder, which has the best of their designs"
        )
    inside = sorted(file.parent for file in path.glob(f"*/{ARCHITECTURE}"))
    if not inside:
        return "give the file of a design, or the folder that bbsd design wrote"
    means = {run: mean for run in inside if (mean := _mean(run)) is not None}
    more = f" and {len(inside) - MOST_NAMED} more" if len(inside) > MOST_NAMED else ""
    runs = f"give one of the runs in it: {', '.join(map(str, inside[:MOST_NAMED]))}{more}"
    if len(means) < 2:
        return runs
    best = max(means, key=lambda run: means[run])
    return f"{runs}; {best} has the highest mean return, {means[best]:.6g}"


def _mean(path: Path) -> float | None:
    """Return the mean return of a run's design as it is recorded, None where it is not."""
    result = run_content(path).get("result")
    returns = result.get("return") if isinstance(result, dict) else None
    mean = returns.get("mean") if isinstance(returns, dict) else None
    return float(mean) if isinstance(mean, int | float) and not isinstance(mean, bool) else None
