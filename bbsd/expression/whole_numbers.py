"""Which values are certainly whole numbers, as far as follows from the operations that compute them."""

from __future__ import annotations

from math import isfinite
from typing import TYPE_CHECKING

from bbsd.expression.graph import needed, value_of
from bbsd.expression.kinds import Wholeness
from bbsd.expression.operations import OPERATIONS

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from bbsd.expression.graph import Node
    from bbsd.expression.node_data import Gather, Slot


def whole_nodes(
    outputs: Iterable[Node], whole_slots: Mapping[Slot, bool], whole_constant: Callable[[int | Gather], bool]
) -> dict[int, bool]:
    """Return for every node needed whether it is certainly a whole number, given the same for slots and constants."""
    whole: dict[int, bool] = {}
    for node in needed(outputs):
        operands = [whole[operand.number] for operand in node.operands]
        whole[node.number] = _is_whole(node, operands, whole_slots, whole_constant)
    return whole


def _is_whole(
    node: Node,
    operands: list[bool],
    whole_slots: Mapping[Slot, bool],
    whole_constant: Callable[[int | Gather], bool],
) -> bool:
    match node.operation:
        case "literal":
            value = value_of(node)
            return not isinstance(value, float) or not isfinite(value) or value.is_integer()
        case "slot" | "outside":
            return whole_slots.get(node.slot, False)
        case "constant":
            return whole_constant(node.index)
        case "gather":
            return whole_constant(node.gather)
        case "draw":
            return node.draw.distribution == "integers" and all(operands)
        case "select":
            return all(operands[1:])
        case "whole_power":
            return all(operands) and node.index >= 0
        case "step" | "unknown":
            return True
    match OPERATIONS[node.operation].wholeness if node.operation in OPERATIONS else Wholeness.NEVER:
        case Wholeness.ALWAYS:
            return True
        case Wholeness.LIKE_OPERANDS:
            return all(operands)
    return False
