"""Elements at a computed index, which clamps to the range and never wraps."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.graph import Graph, Node, value_of
from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import Gather
from bbsd.expression.scope import Named
from bbsd.kernel.functions import clamp_index

if TYPE_CHECKING:
    from bbsd.expression.scope import Names, Value


def pick(items: tuple[Value, ...], index: Node, graph: Graph) -> Value:
    """Return the element of `items` at `index`; where the items are lists, their elements are picked one by one."""
    if index.literal:
        return items[clamp_index(value_of(index), len(items) - 1)]
    nodes = [item for item in items if isinstance(item, Node)]
    if len(nodes) == len(items):
        return _gather(nodes, index, graph) or _choose(nodes, index, graph)
    if named := [item for item in items if isinstance(item, Named)]:
        return _pick_named(named, index, graph) if len(named) == len(items) else graph.unknown
    rows = [item for item in items if isinstance(item, tuple)]
    return tuple(pick(column, index, graph) for column in zip(*rows, strict=True))


def _pick_named(items: list[Named], index: Node, graph: Graph) -> Value:
    """Return one of several values with names; unknown where no list has the names of all."""
    readings: list[tuple[Names, Node]] = []
    for names, _ in items[0].readings:
        picked = pick(tuple(node for item in items if (node := item.of(names)) is not None), index, graph)
        if isinstance(picked, Node) and all(item.of(names) is not None for item in items):
            readings.append((names, picked))
    return Named(tuple(readings)) if readings else graph.unknown


def _gather(nodes: list[Node], index: Node, graph: Graph) -> Node | None:
    """Return one read of the constants, where the nodes stand there at equal distances; else None."""
    reads = [read for node in nodes if (read := _read(node)) is not None]
    if not 1 < len(nodes) == len(reads):
        return None
    first, second = reads[0][0], reads[1][0]
    stride = second.base - first.base
    for place, (gather, indices) in enumerate(reads):
        if gather != first._replace(base=first.base + stride * place) or indices != reads[0][1]:
            return None
    strides, lengths = (*first.strides, stride), (*first.lengths, len(nodes))
    return graph.gather(first.base, strides, lengths, (*reads[0][1], index))


def _read(node: Node) -> tuple[Gather, tuple[Node, ...]] | None:
    """Return which element of the constants a node is, and by which indices; None where it is none."""
    match node.operation:
        case "constant":
            return Gather(node.index, (), ()), ()
        case "gather":
            return node.gather, node.operands
    return None


def _choose(nodes: list[Node], index: Node, graph: Graph) -> Node:
    """Return a chain of choices; an index that is NaN gives the first element, as a clamped one does."""
    chosen = nodes[0]
    for position, node in enumerate(nodes[1:], start=1):
        chosen = graph.apply("select", graph.apply(">=", index, graph.number(position)), node, chosen)
    return chosen if chosen.kind is not Kind.UNKNOWN else graph.unknown
