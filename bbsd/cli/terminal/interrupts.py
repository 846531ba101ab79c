"""Ctrl-C: a command that takes long ends soon, whatever it is doing; a second one ends it at once."""

from __future__ import annotations

from functools import wraps
from typing import TYPE_CHECKING, ParamSpec, TypeVar

import typer

from bbsd.cli.terminal.output import leave_now, say
from bbsd.runs.signals import interrupts_request_stop

if TYPE_CHECKING:
    from collections.abc import Callable

P = ParamSpec("P")
T = TypeVar("T")

INTERRUPTED = 130
"""The exit code of a command that was interrupted."""


def stoppable(command: Callable[P, T]) -> Callable[P, T]:
    """Let an interrupt stop a command between two batches of episodes, or soon after wherever it is.

    What it writes it writes whole, so that it can be left at any place.
    """

    @wraps(command)
    def run(*arguments: P.args, **options: P.kwargs) -> T:
        with interrupts_request_stop(_leave):
            try:
                return command(*arguments, **options)
            except KeyboardInterrupt:
                say("bbsd: interrupted, without a result")
                raise typer.Exit(INTERRUPTED) from None

    return run


def _leave() -> None:
    say("bbsd: interrupted, without a result")
    leave_now(INTERRUPTED)
