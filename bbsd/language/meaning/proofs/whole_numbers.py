"""Whether values that must be whole numbers are, as far as can be proven."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Protocol

from bbsd.expression.graph import needed
from bbsd.expression.kinds import Kind
from bbsd.expression.syntax.mistakes import Enclosing
from bbsd.expression.whole_numbers import whole_nodes
from bbsd.language.meaning.naming.constants import GENERATION_SLOT

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from bbsd.expression.graph import Node
    from bbsd.expression.node_data import Gather, Slot
    from bbsd.expression.scope import Findings
    from bbsd.language.meaning.naming.constants import Constants

MAX_SPREAD = 100
"""Steps in which a fraction can spread from one slot to the next; if it spreads on, no slot counts as whole."""


class Values(Protocol):
    """What an episode computes, as far as it is looked at here."""

    @property
    def start(self) -> Mapping[Slot, Node]:
        """What the slots hold at the start."""

    @property
    def after(self) -> Mapping[Slot, Node]:
        """What they hold after a step."""

    @property
    def definitions(self) -> Mapping[Slot, Node]:
        """What is defined in each step."""

    @property
    def fractions(self) -> frozenset[Slot]:
        """What an environment in Python gives that need not be a whole number."""


def report_fractions(episode: Values | None, constants: Constants, findings: Findings) -> None:
    """Report every value used as an index or in values(...) that may be a fraction.

    Where the episode could not be understood, all slots count as whole.
    """
    is_whole_constant = cache(constants.whole)
    nodes = [node for *_, node in findings.wholes]
    slots = _whole_slots(episode, is_whole_constant) if episode else _slots_read(nodes)
    whole = whole_nodes(nodes, {**slots, GENERATION_SLOT: True}, is_whole_constant)
    for path, span, purpose, node in findings.wholes:
        if not whole[node.number]:
            message = f"{purpose} must be a whole number, and this need not be one"
            advice = "round it: floor(...) or round(...)"
            if purpose.startswith("what values"):
                advice += "; or cut it at bounds: cut(..., 0.5)"
            findings.report(path, "BB064", message, span, advice, Enclosing("round(", ")", span))


def whole_values(episode: Values, constants: Constants) -> set[Slot]:
    """Return the slots and the definitions that provably always hold whole numbers."""
    is_whole_constant = cache(constants.whole)
    slots = {**_whole_slots(episode, is_whole_constant), GENERATION_SLOT: True}
    defined = {slot: node for slot, node in episode.definitions.items() if node.kind is Kind.NUMBER}
    whole = whole_nodes(defined.values(), slots, is_whole_constant)
    return {slot for slot, is_whole in slots.items() if is_whole} | {
        slot for slot, node in defined.items() if whole[node.number]
    }


def _slots_read(nodes: Sequence[Node]) -> dict[Slot, bool]:
    return {node.slot: True for node in needed(nodes) if node.operation in ("slot", "outside")}


def _whole_slots(episode: Values, is_whole_constant: Callable[[int | Gather], bool]) -> dict[Slot, bool]:
    """Say of each slot whether it always holds a whole number: in the largest set that starts so and stays so."""
    whole: dict[Slot, bool] = {
        slot: node.kind is Kind.NUMBER and slot not in episode.fractions
        for slot, node in episode.start.items()
    }
    for _ in range(MAX_SPREAD):
        nodes = whole_nodes([*episode.start.values(), *episode.after.values()], whole, is_whole_constant)
        still_whole: dict[Slot, bool] = {
            slot: whole[slot] and nodes[start.number] and nodes[episode.after[slot].number]
            for slot, start in episode.start.items()
        }
        if still_whole == whole:
            return whole
        whole = still_whole
    return dict.fromkeys(whole, False)
