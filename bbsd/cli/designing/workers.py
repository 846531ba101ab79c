"""Where runs are done: the options that choose an engine, and the engine that they choose."""

from contextlib import contextmanager, nullcontext
from enum import StrEnum
from typing import TYPE_CHECKING, Annotated

import typer

from bbsd.cli.terminal.output import say
from bbsd.errors import escape

if TYPE_CHECKING:
    from collections.abc import Iterator
    from contextlib import AbstractContextManager

    from bbsd.engines.engine import Engine

NEEDED = ("bbsd.runs.workers.portions",)
"""As in `bbsd.runs.workers.side_by_side`, which takes long to import."""


class EngineName(StrEnum):
    """An engine."""

    PROCESSES = "processes"
    DASK = "dask"


AnyEngine = Annotated[
    EngineName,
    typer.Option(
        "--engine",
        help="Where several runs are done: by processes of this machine, or by the workers of a Dask cluster; "
        "affects only the speed.",
    ),
]
Scheduler = Annotated[
    str | None,
    typer.Option(
        "--scheduler",
        metavar="ADDRESS",
        help="With --engine dask: the cluster's scheduler, such as tcp://host:8786.",
        show_default="a cluster of --jobs workers on this machine",
    ),
]


def require_engine(engine: EngineName, scheduler: str | None) -> None:
    """Raise BadParameter for options that do not fit together."""
    if scheduler is not None and engine is not EngineName.DASK:
        raise typer.BadParameter("it is for --engine dask", param_hint="--scheduler")


def chosen_engine(
    engine: EngineName, scheduler: str | None, *, jobs: int, processes: int
) -> "AbstractContextManager[Engine | None]":
    """Start an engine, and end it at exit.

    Args:
        engine: Which one.
        scheduler: The address of a cluster's scheduler, where there is one.
        jobs: Workers of a cluster on this machine, where there is none.
        processes: Processes beside this one; with none, and no cluster, there is no engine.
    """
    if engine is EngineName.DASK:
        return _cluster(scheduler, jobs)
    if processes == 0:
        return nullcontext()
    from bbsd.engines.local import processes_engine

    return processes_engine(processes, NEEDED)


@contextmanager
def _cluster(scheduler: str | None, jobs: int) -> "Iterator[Engine]":
    from bbsd.engines.cluster import dask_engine

    with dask_engine(scheduler, jobs) as engine:
        if engine.capacity() == 0:
            say(f"waiting for workers of {escape(scheduler or 'the cluster')}")
        yield engine
