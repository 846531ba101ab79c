"""What a design earns under faults, as a table for people and as plain data for programs."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rich.console import Group
from rich.text import Text

from bbsd.errors import escape
from bbsd.report.plain import interval_plain
from bbsd.report.tables import plain_table
from bbsd.report.wording.numbers import count, with_halves

if TYPE_CHECKING:
    from rich.console import RenderableType

    from bbsd.explanation.faults import Degradations, Relearned
    from bbsd.report.plain import Plain


def faults_table(found: Degradations) -> RenderableType:
    """Return a table of returns and changes, one row for each fault, and of orders that were learned again."""
    table = plain_table("fault", "return", "change", right=[1, 2])
    returns = with_halves([found.returns, *(each.returns for each in found.faults)], signed=False)
    losses = with_halves([each.change for each in found.faults])
    table.add_row("none", Text(returns[0], "bold"))
    for each, mean, loss in zip(found.faults, returns[1:], losses, strict=True):
        table.add_row(Text(escape(each.fault.text)), mean, loss)
    notes = [f"{count(found.returns.count, 'episode')}, the same for all; ±: 95 % interval"]
    if any(each.fault.kind == "random" for each in found.faults):
        notes.append(f"random: the mean over {count(found.random_tables, 'random table')}")
    parts: list[RenderableType] = [table, *notes]
    if any(each.relearned for each in found.faults):
        parts += ["", _relearned(found)]
    return Group(*parts)


def _relearned(found: Degradations) -> RenderableType:
    """Return what the orders that were learned again earn, and those that are other than before."""
    rows = [(each.fault.text, each.relearned) for each in found.faults if each.relearned is not None]
    table = plain_table("order learned again around", "return", "gain", right=[1, 2])
    returns = with_halves([relearned.returns for _, relearned in rows], signed=False)
    gains = with_halves([relearned.gain for _, relearned in rows])
    others: list[RenderableType] = []
    for (fault, relearned), mean, gain in zip(rows, returns, gains, strict=True):
        same = relearned.structure == found.structure
        table.add_row(Text(escape(fault)), mean, "as it was" if same else gain)
        if not same:
            others.append(Text(escape(f"{fault}: {' '.join(relearned.structure)}")))
    heading = [Text("new orders, highest layer first", "bold")] if others else []
    return Group(table, *heading, *others)


def faults_plain(found: Degradations) -> dict[str, Plain]:
    """Return what a design earns undisturbed and under each fault; changes are beside the undisturbed design."""
    return {
        "return": interval_plain(found.returns),
        "episodes": found.returns.count,
        "structure": list(found.structure),
        "random_tables": found.random_tables,
        "faults": [
            {
                "fault": each.fault.text,
                "part": each.fault.part,
                "name": each.fault.name,
                "kind": each.fault.kind,
                "since": each.fault.since,
                "return": interval_plain(each.returns),
                "change": interval_plain(each.change),
                "relearned": None if each.relearned is None else _relearned_plain(each.relearned),
            }
            for each in found.faults
        ],
    }


def _relearned_plain(relearned: Relearned) -> dict[str, Plain]:
    return {
        "structure": list(relearned.structure),
        "return": interval_plain(relearned.returns),
        "change": interval_plain(relearned.change),
        "gain": interval_plain(relearned.gain),
    }
