"""A cell of a comparison, its result, and the file that keeps results: a line of JSON for each finished cell."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path


class Cell(NamedTuple):
    """A task, a method, a budget in episodes and a seed."""

    task: str
    method: str
    budget: int
    seed: int


@dataclass(frozen=True, kw_only=True)
class Result:
    """What came out of a cell."""

    task: str
    method: str
    budget: int
    seed: int
    of: str
    """A digest of the task and of the revision of bbsd: results of another one do not count."""
    mean: float | None
    """The mean return of the design; None where the method cannot design this task."""
    sd: float = 0.0
    episodes: int = 0
    """The sample that the mean is of, or the number of all starts, weighted by their probabilities."""
    exact: bool = False
    structure: tuple[str, ...] = ()
    spent: int = 0
    """Episodes of search, race and measurements: at most the budget."""
    seconds: float = 0.0
    processor: float = 0.0
    """Seconds of the processor, which depend less on what else the machine does."""
    curve: tuple[tuple[int, float], ...] = ()
    """Episodes, and the mean return of the best so far in fresh episodes of the search itself."""
    reason: str = ""
    """Why the method cannot design this task."""

    @property
    def cell(self) -> Cell:
        """The cell that this is the result of."""
        return Cell(self.task, self.method, self.budget, self.seed)


def result_of(data: dict[str, Any]) -> Result:
    """Return a result from the data of its JSON."""
    curve = tuple((int(episodes), float(mean)) for episodes, mean in data["curve"])
    return Result(**{**data, "structure": tuple(data["structure"]), "curve": curve})


class ResultsFile:
    """A file of results, to which one process writes."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def read(self) -> dict[Cell, Result]:
        """Return the results by cell, the last one of each; a line that a crash cut short is no result."""
        results: dict[Cell, Result] = {}
        if self.path.exists():
            for line in self.path.read_text(encoding="utf-8").splitlines():
                try:
                    data = json.loads(line)
                except json.JSONDecodeError:
                    continue
                result = result_of(data)
                results[result.cell] = result
        return results

    def begin(self) -> None:
        """Make the file ready for further lines, after one that a crash cut short too."""
        self.path.parent.mkdir(parents=True, exist_ok=True)
        with self.path.open("ab+") as file:
            if file.tell():
                file.seek(-1, 2)
                if file.read(1) != b"\n":
                    file.write(b"\n")

    def add(self, result: Result) -> None:
        """Append a result."""
        with self.path.open("a", encoding="utf-8") as file:
            file.write(json.dumps(asdict(result)) + "\n")


def missing(
    cells: Iterable[Cell], results: dict[Cell, Result], digests: dict[tuple[str, str], str]
) -> list[Cell]:
    """Return the cells without a result of the present task, given the digest of each task and method."""
    return [
        cell for cell in cells if cell not in results or results[cell].of != digests[cell.task, cell.method]
    ]
