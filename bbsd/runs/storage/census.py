"""Tables of what a run's agents were, for statistics by other programs: CSV files that depend on no clock and no path.

`census.csv` has the agents of the generations that `design.record` names, `culture.csv` the memes of all generations.
Runs of methods that have no generations write `champions.csv`: the best designs so far at the records that it names.
"""

from __future__ import annotations

import csv
from io import StringIO
from itertools import chain
from typing import TYPE_CHECKING, NamedTuple

from bbsd.runs.storage.state import Searching

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    import numpy as np
    from numpy.typing import NDArray

    from bbsd.compiler import Problem
    from bbsd.runs.storage.state import RunState
    from bbsd.solver.champions import Champions
    from bbsd.solver.paper.generation import Census, State

    Row = tuple[int | float | str, ...]

CENSUS, CULTURE, CHAMPIONS = "census.csv", "culture.csv", "champions.csv"
TABLES = (CENSUS, CULTURE, CHAMPIONS)
"""The names of all files of tables."""

MOST_CHAMPIONS = 100
"""Champions of a record: fifty records of them are some hundred kilobytes."""


class Table(NamedTuple):
    """Rows that are added to a file of tables."""

    file: str
    columns: tuple[str, ...]
    rows: Iterable[Row]

    def content(self, *, with_columns: bool) -> bytes:
        """Return the rows as lines of comma-separated values, below the names of the columns where these are wanted.

        Floats are written with the digits that give the same number again.
        """
        text = StringIO()
        writer = csv.writer(text, lineterminator="\n")
        writer.writerows(chain([self.columns] if with_columns else [], self.rows))
        return text.getvalue().encode()


def tables(reached: RunState, episodes: int, problem: Problem, number: int) -> Iterator[Table]:
    """Yield what a step of a run adds to its tables.

    Args:
        reached: the run after the step, whose metrics were recorded.
        episodes: those so far, for a run that has no generations.
        problem: the run's problem.
        number: the generation, or the number of the record of metrics; they count from 1.
    """
    design, names, run = problem.meaning.spec.design, problem.names, reached.run + 1
    if isinstance(reached.state, Searching):
        if design.records(number):
            yield _champions_table(reached.state.search.champions, run, episodes, names)
    elif reached.census is not None and design.record != "none":
        if design.records(number):
            yield _census_table(reached.census, run, number, names)
        yield _culture_table(reached.state, run, names)


def _census_table(census: Census, run: int, generation: int, names: Sequence[str]) -> Table:
    columns = ("run", "generation", "agent", "fitness", "lifetime_fitness", "structure")
    agents = zip(
        census.fitness.tolist(),
        census.lifetime_fitness.tolist(),
        _texts(census.structures, names),
        strict=True,
    )
    return Table(CENSUS, columns, ((run, generation, agent, *row) for agent, row in enumerate(agents)))


def _culture_table(state: State, run: int, names: Sequence[str]) -> Table:
    columns = ("run", "generation", "meme", "fitness", "structure")
    memes = zip(state.culture.fitness.tolist(), _texts(state.culture.memes, names), strict=True)
    return Table(CULTURE, columns, ((run, state.generation, meme, *row) for meme, row in enumerate(memes)))


def _champions_table(champions: Champions, run: int, episodes: int, names: Sequence[str]) -> Table:
    columns = ("run", "episodes", "rank", "mean", "structure")
    means = champions.fitness[:MOST_CHAMPIONS].tolist()
    rows = zip(means, _texts(champions.structures[:MOST_CHAMPIONS], names), strict=True)
    return Table(CHAMPIONS, columns, ((run, episodes, rank, *row) for rank, row in enumerate(rows, start=1)))


def _texts(structures: NDArray[np.int64], names: Sequence[str]) -> list[str]:
    """Return structures as names of behaviors, highest layer first, with blanks between them."""
    return [" ".join(names[behavior] for behavior in reversed(layers)) for layers in structures.tolist()]
