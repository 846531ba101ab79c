"""What an interrupt of a design leaves: its state, and the best design so far."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING

from bbsd.api.compiling import located_reward_errors
from bbsd.api.results import BestSoFar, Interrupted
from bbsd.architecture import designed_text, tidy_tables
from bbsd.runs.outcome.interim import best_so_far
from bbsd.runs.signals import interrupts_request_stop
from bbsd.stopping import stop_request_of_context

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from bbsd.language.loading import Loaded
    from bbsd.runs.command import Command


@contextmanager
def interruptible(
    command: Command,
    loaded: Loaded,
    overdue: Callable[[Interrupted], object] | None,
    *,
    keep_best: bool,
    is_kept: bool,
) -> Iterator[None]:
    """Turn an interrupt inside into Interrupted, the best design so far being kept where there is no answer yet.

    Args:
        command: what is run.
        loaded: its spec.
        overdue: called in another thread if it does not stop soon after.
        keep_best: whether there is no answer yet.
        is_kept: whether the command's folder stays, so that it can be continued.
    """
    interrupted = Interrupted(command.folder.path if is_kept else None)
    with located_reward_errors(loaded), interrupts_request_stop(overdue and (lambda: overdue(interrupted))):
        try:
            yield
        except KeyboardInterrupt:
            if keep_best:
                with stop_request_of_context():
                    interrupted.best = _kept_best(command, loaded, is_kept=is_kept)
            raise interrupted from None


def _kept_best(command: Command, loaded: Loaded, *, is_kept: bool) -> BestSoFar | None:
    """Return the best design so far of a search that was stopped, and write it where its folder stays."""
    best = best_so_far(command)
    if best is None:
        return None
    text = designed_text(loaded, tidy_tables(command.problem.meaning, best.architecture))
    path = command.folder.write_best(text) if is_kept else None
    return BestSoFar(path, text, best.mean, best.episodes)
