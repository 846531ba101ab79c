"""Computed fractions that are compared by ==."""

from __future__ import annotations

from enum import IntEnum
from typing import TYPE_CHECKING

from bbsd.expression.graph import needed, value_of
from bbsd.expression.kinds import Kind, Wholeness
from bbsd.expression.operations import OPERATIONS
from bbsd.expression.syntax.mistakes import Mistake

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from bbsd.expression.graph import Node
    from bbsd.expression.node_data import Slot
    from bbsd.expression.scope import Path
    from bbsd.expression.syntax.tree import Span
    from bbsd.language.meaning import Meaning
    from bbsd.language.validation import LocatedMistake

MOST_LOOKS = 200_000
"""Nodes that are looked at in all passes together."""
MOST_PASSES = 50
"""Steps in which rounding spreads from one slot to the next; if it spreads on, nothing is told."""
FINEST = 1024.0
"""Multiples of 1 / 1024 are added, subtracted and multiplied without rounding, as long as they are not huge."""


class Exactness(IntEnum):
    """How exact a value is."""

    ROUNDED = 0
    """A result of several operations with rounding."""
    WRITTEN = 1
    """One of the numbers that are written in the spec, or a single operation on exact numbers."""
    EXACT = 2
    """A multiple of 1 / 1024."""


def rounded_equalities(meaning: Meaning) -> Iterator[LocatedMistake]:
    """Yield a warning for each comparison by == or != of a constant with a value that rounding keeps from equalling it.

    Not so where the value may be set to that constant, or be clipped there, at one of the moments at which it is
    compared.
    """
    places: dict[tuple[Path, Span], list[tuple[Node, float]]] = {}
    for path, span, left, right in meaning.equalities:
        node, value = _sides(meaning, left, right)
        if value is not None:
            places.setdefault((path, span), []).append((node, value))
    if not places:
        return
    exactness = _exactness(meaning, [node for pairs in places.values() for node, _ in pairs])
    for (path, span), pairs in places.items():
        if all(
            exactness.get(node.number) is Exactness.ROUNDED and value not in _written(meaning, node)
            for node, value in pairs
        ):
            value = pairs[0][1]
            message = f"what is computed here is rounded, so that it is hardly ever exactly {value:g}"
            size = f"abs(... - {value:g})" if value else "abs(...)"
            advice = f"compare with a margin, such as {size} < 0.001, or use <= or >="
            yield path, Mistake("BB210", message, span, advice)


def _sides(meaning: Meaning, left: Node, right: Node) -> tuple[Node, float | None]:
    """Return what is compared with a constant, and its value; None where neither side is one, or both are."""
    values = [_value(meaning, side) for side in (left, right)]
    if values.count(None) != 1:
        return left, None
    return (right, values[0]) if values[1] is None else (left, values[1])


def _value(meaning: Meaning, node: Node) -> float | None:
    return float(value_of(node)) if node.literal else meaning.constants.static(node)


def _exactness(meaning: Meaning, nodes: Sequence[Node]) -> Mapping[int, Exactness]:
    """Return how exact nodes are; nothing where that takes too long."""
    start, after = meaning.episode.start, meaning.episode.after
    order = needed([*nodes, *start.values(), *after.values()])
    slots: dict[Slot, Exactness] = dict.fromkeys(start, Exactness.EXACT)
    found: dict[int, Exactness] = {}
    for _ in range(min(MOST_PASSES, MOST_LOOKS // len(order))):
        changed = set[int]()
        for node in order:
            is_same = changed.isdisjoint([each.number for each in node.operands])
            if node.number in found and node.operation != "slot" and is_same:
                continue
            operands = [found[each.number] for each in node.operands if each.kind is Kind.NUMBER]
            exactness = _exactness_of(meaning, node, operands, slots)
            if found.get(node.number) is not exactness:
                found[node.number] = exactness
                changed.add(node.number)
        then = {slot: min(found[start[slot].number], found[after[slot].number]) for slot in slots}
        if then == slots:
            return found
        slots = then
    return {}


def _exactness_of(
    meaning: Meaning, node: Node, operands: Sequence[Exactness], slots: Mapping[Slot, Exactness]
) -> Exactness:
    match node.operation:
        case "literal" | "constant":
            value = _value(meaning, node)
            return Exactness.EXACT if value is None or (value * FINEST).is_integer() else Exactness.WRITTEN
        case "gather":
            values = [meaning.constants.scalars[place] for place in node.gather.places]
            return min(
                _exactness_of(meaning, each, (), slots) if each.literal else Exactness.EXACT
                for each in values
            )
        case "slot":
            return slots.get(node.slot, Exactness.EXACT)
        case "draw":
            is_whole = node.draw.distribution == "integers"
            return min(operands, default=Exactness.EXACT) if is_whole else Exactness.ROUNDED
        case "select" | "minimum" | "maximum" | "negate" | "abs":
            return min(operands, default=Exactness.EXACT)
        case "divide" | "sqrt" | "hypot":
            return Exactness.WRITTEN if _all_exact(operands) else Exactness.ROUNDED
    if node.kind is not Kind.NUMBER or node.operation not in OPERATIONS:
        return Exactness.EXACT
    match OPERATIONS[node.operation].wholeness:
        case Wholeness.ALWAYS:
            return Exactness.EXACT
        case Wholeness.LIKE_OPERANDS if _all_exact(operands):
            return Exactness.EXACT
    return Exactness.ROUNDED


def _all_exact(operands: Sequence[Exactness]) -> bool:
    return all(each is Exactness.EXACT for each in operands)


def _written(meaning: Meaning, node: Node) -> set[float]:
    """Return the constants that a value may be set to, be clipped to, or be the size of."""
    values, seen, waiting = set[float](), set[int](), [node]
    while waiting:
        node = waiting.pop()
        if node.number in seen:
            continue
        seen.add(node.number)
        value = _value(meaning, node)
        if value is not None:
            values |= {value, -value}
        elif node.operation == "slot" and node.slot in meaning.episode.start:
            waiting += [meaning.episode.start[node.slot], meaning.episode.after[node.slot]]
        elif node.operation in ("select", "minimum", "maximum", "negate", "abs"):
            waiting += [each for each in node.operands if each.kind is Kind.NUMBER]
    return values
