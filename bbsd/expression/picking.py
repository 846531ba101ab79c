"""Elements at a computed index, which clamps to the range and never wraps."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

from bbsd.expression.graph import Graph, Node, value_of
from bbsd.expression.kinds import Kind
from bbsd.kernel.functions import clamp_index

if TYPE_CHECKING:
    from bbsd.expression.scope import Value


def pick(items: tuple[Value, ...], index: Node, graph: Graph) -> Value:
    """The element of `items` at `index`; lists in the list are picked element by element."""
    if index.literal:
        return items[clamp_index(value_of(index), len(items) - 1)]
    if any(isinstance(item, tuple) for item in items):
        rows = cast("tuple[tuple[Value, ...], ...]", items)
        return tuple(pick(tuple(column), index, graph) for column in zip(*rows, strict=True))
    nodes = cast("tuple[Node, ...]", items)
    return _gathered(nodes, index, graph) or _chosen(nodes, index, graph)


def _gathered(nodes: tuple[Node, ...], index: Node, graph: Graph) -> Node | None:
    """One read of the constants, where the nodes stand there at equal distances."""
    origins = [_origin(node) for node in nodes]
    if len(nodes) < 2 or None in origins:
        return None
    (base, *rest), kinds = zip(*cast("list[tuple[int, tuple[object, ...]]]", origins), strict=True)
    stride = rest[0] - base
    if len(set(kinds)) > 1 or any(place != base + stride * (k + 1) for k, place in enumerate(rest)):
        return None
    strides, lengths, operands = cast("tuple[tuple[int, ...], tuple[int, ...], tuple[Node, ...]]", kinds[0])
    return graph.gather(base, (*strides, stride), (*lengths, len(nodes)), (*operands, index))


def _origin(node: Node) -> tuple[int, tuple[object, ...]] | None:
    """Where a node reads the constants: its base, and what else tells how."""
    if node.operation == "constant":
        return cast("int", node.data), ((), (), ())
    if node.operation == "gather":
        base, strides, lengths = cast("tuple[int, tuple[int, ...], tuple[int, ...]]", node.data)
        return base, (strides, lengths, node.operands)
    return None


def _chosen(nodes: tuple[Node, ...], index: Node, graph: Graph) -> Node:
    """A chain of choices; an index that is not a number gives the first element, as a clamped one does."""
    found = nodes[0]
    for place, node in enumerate(nodes[1:], start=1):
        found = graph.apply("select", graph.apply(">=", index, graph.number(place)), node, found)
    return found if found.kind is not Kind.UNKNOWN else graph.unknown
