"""Computes `%` by a division where its quotient is certainly small, as it nearly always is.

The remainder of any two numbers takes a call of the system's `fmod` for each lane, five times as long.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from bbsd.compiler.passes.ranges import ranges_of
from bbsd.expression.graph import needed

if TYPE_CHECKING:
    from bbsd.compiler.passes.ranges import Range
    from bbsd.expression.graph import Node
    from bbsd.language.meaning import Meaning

MOST_QUOTIENT = 2.0**51
SMALLEST, LARGEST = 1e-270, 1e270
"""Of divisors: beyond them, parts of a product have no room in a number."""


def compute_moduli_quickly(meaning: Meaning) -> Meaning:
    """Return the same meaning, with a quick operation for each `%` whose quotient is certainly below 2**52."""
    episode = meaning.episode
    nodes = needed([*episode.start.values(), *episode.nodes])
    moduli = [node for node in nodes if node.operation == "modulo"]
    if not moduli:
        return meaning
    known, graph = ranges_of(meaning, moduli), replace(meaning.graph, bounded=False)
    new: dict[int, Node] = {}
    for node in nodes:
        operands = tuple(new[operand.number] for operand in node.operands)
        if node.operation == "modulo" and _is_small(*(known[operand.number] for operand in node.operands)):
            new[node.number] = graph.make("quick_modulo", operands, None, node.kind, node.level)
        else:
            new[node.number] = node if operands == node.operands else graph.copy(node, operands)
    changed = episode.with_nodes(lambda node: new[node.number])
    start = {slot: new[node.number] for slot, node in episode.start.items()}
    return replace(meaning, episode=replace(changed, start=start))


def _is_small(dividend: Range, divisor: Range) -> bool:
    """Say whether a quotient is certainly small, and the divisor of a usual size."""
    least = max(divisor.low, -divisor.high)
    in_reach = least >= SMALLEST and divisor.size <= LARGEST and not divisor.may_be_nan
    return in_reach and dividend.is_known and dividend.size / least < MOST_QUOTIENT
