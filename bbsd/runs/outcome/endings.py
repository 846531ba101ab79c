"""Which runs of a command ended before their budget was spent, and why."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

from bbsd.runs.storage.state import Searching
from bbsd.solver.early import ENDINGS, EndedBy

if TYPE_CHECKING:
    from bbsd.runs.command import Command


@dataclass(frozen=True, slots=True)
class Ending:
    """A run that ended early."""

    run: int
    """Its number, from 1."""
    ended_by: EndedBy
    """`return`: it is enough; `unimproved`: nothing got better; `time`: its time was over."""
    done: int
    """Episodes of all its budgets, races included; of the paper's loop, generations."""
    of: int
    """Those that it could have had."""
    unit: str
    """`episodes` or `generations`."""

    def plain(self) -> dict[str, Any]:
        """Return it as `run.json` holds it."""
        return asdict(self)


def endings(command: Command) -> tuple[Ending, ...]:
    """Return the runs of a command that is complete which ended early."""
    found = []
    for run in range(command.n_runs):
        reached = command.reached(run)
        if reached is None or not reached.state.ended:
            continue
        state, why = reached.state, ENDINGS[reached.state.ended]
        if isinstance(state, Searching):
            found.append(Ending(run + 1, why, state.spent, sum(command.budgets), "episodes"))
        else:
            generations = command.settings.coevolution.generations
            found.append(Ending(run + 1, why, state.generation, generations, "generations"))
    return tuple(found)
