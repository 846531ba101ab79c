"""Slots of values at another moment than now: as they were at the decision before, or are after the actions."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from bbsd.expression.node_data import Slot, Variable

BEFORE = "before "
"""Begins the name of what a value was at the decision before; no name of a spec has a blank."""
ACTED = "acted "
"""Begins the name of what a value is after the actions of the present step."""


def before(slot: Slot) -> Slot:
    """Return the slot that keeps what a value was at the decision before."""
    return slot._replace(name=f"{BEFORE}{slot.name}")


def acted(slot: Slot) -> Slot:
    """Return the slot of a value after the actions."""
    return slot._replace(name=f"{ACTED}{slot.name}")


def now(slot: Slot) -> Slot:
    """Return the slot of the same value now."""
    return slot._replace(name=plain_name(slot.name))


def plain_variable(slot: Slot) -> Variable:
    """Return the spec's name for the value of a slot at whichever moment, and the place in a list."""
    return plain_name(slot.name), slot.place


def plain_name(name: str) -> str:
    """Return the spec's name for a value at whichever moment."""
    return name.removeprefix(BEFORE).removeprefix(ACTED)
