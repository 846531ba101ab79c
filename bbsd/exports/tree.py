"""A design as a behavior tree, as a person would draw it: the highest layer first, each by its shortest rules.

A tree is evaluated anew at each step, without memory, and nothing in it takes longer than a step. It does in every
joint cell what the design does; where a higher layer always acts, any rule of a behavior will do, so rules get shorter.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import groupby
from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np

from bbsd.architecture.boxes import FREE, KEEP, n_words
from bbsd.architecture.policy import MAX_JOINT_CELLS
from bbsd.architecture.shortest import rule_list, shortest_cover
from bbsd.architecture.spec_changes import MOST_WORDS
from bbsd.errors import UsageError
from bbsd.explanation.conditions import condition_text
from bbsd.language.meaning.tables.table import NO_ACTION

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from numpy.typing import NDArray

    from bbsd.architecture.boxes import Box
    from bbsd.architecture.controller import Controller, Layer

NOBODY = 0
"""The number of the action where no behavior controls."""
MOST_EXCEPTIONS = 8
"""Times that rules of a behavior may change to No Action and back; each time the tree becomes deeper."""


@dataclass(frozen=True, slots=True)
class Condition:
    """Succeeds where a dimension has one of some cells, not of all."""

    text: str
    dimension: int
    cells: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Act:
    """Takes an action, or none where nobody controls, and succeeds."""

    text: str
    action: int


@dataclass(frozen=True, slots=True)
class Group:
    """Tries its children in order: a sequence up to the first that fails, a fallback up to the first that succeeds."""

    kind: Literal["sequence", "fallback"]
    text: str
    children: tuple[Node, ...]


Node = Condition | Act | Group


class Tree(NamedTuple):
    """A tree, and the behaviors that never control and are not in it, highest first."""

    root: Group
    silent: tuple[str, ...]


class TooLongForATree(UsageError):
    """A behavior whose rules are too long to read is too long for a tree, which is there to be looked at."""

    advice = "bbsd export --to c or --to python writes its table"


def tree_of(controller: Controller) -> Tree:
    """Return the tree of a design: a fallback over its layers, and after them nobody's action where that may be.

    Raises TooLongForATree.
    """
    matters, may_be_nobody = _where_tables_matter(controller)
    children: list[Node] = []
    silent: list[str] = []
    for layer, counts in zip(controller.layers, matters, strict=True):
        node = _layer(controller, layer, counts)
        if node is None:
            silent.append(layer.behavior)
        else:
            children.append(node)
    if may_be_nobody:
        children.append(Act("nobody controls", NOBODY))
    return Tree(Group("fallback", controller.name, tuple(children)), tuple(silent))


def nodes_of(node: Node) -> Iterator[Node]:
    """Yield a node and all below it, each before its children."""
    yield node
    for child in node.children if isinstance(node, Group) else ():
        yield from nodes_of(child)


def n_nodes(controller: Controller) -> int:
    """Return the number of nodes of a design's tree."""
    return sum(1 for _ in nodes_of(tree_of(controller).root))


def silent_said(tree: Tree) -> list[str]:
    """Return a sentence about the behaviors that are left out, if there are any."""
    return [f"Never controls, and is left out: {', '.join(tree.silent)}."] if tree.silent else []


def _where_tables_matter(controller: Controller) -> tuple[list[NDArray[np.bool_]], bool]:
    """Return for each layer which cells of its table decide in a joint cell, and whether nobody may control in one.

    In a joint space that is too large to go through, all of them may.
    """
    sizes, layers = controller.sizes, controller.layers
    if controller.joint_size > MAX_JOINT_CELLS:
        return [np.ones(len(layer.table), np.bool_) for layer in layers], True
    free, matters = np.ones(sizes, np.bool_), []
    mesh = np.ogrid[tuple(slice(size) for size in sizes)]
    for layer in layers:
        own = np.zeros((1,) * len(sizes), np.int64)
        for axis, size in zip(layer.axes, layer.sizes, strict=True):
            own = own * size + mesh[axis]
        asked = free if layer.excitement is None else free & (mesh[layer.excitement] == layer.excited_at)
        own, table = np.broadcast_to(own, sizes), np.frombuffer(layer.table, np.uint8)
        matters.append(np.bincount(own[asked], minlength=len(table)) > 0)
        free = free & ~(asked & (table[own] > 0))
    return matters, bool(free.any())


def _layer(controller: Controller, layer: Layer, matters: NDArray[np.bool_]) -> Group | None:
    """Return a behavior's tree; None where it never acts."""
    table = np.frombuffer(layer.table, np.uint8).astype(np.int64)
    body: Node | None = None
    runs = _runs(np.where(matters, table, FREE), layer.sizes)
    n = sum(n_words(box, layer.sizes) for _, boxes in runs for box in boxes)
    if n > MOST_WORDS:
        raise TooLongForATree(f"the rules of {layer.behavior} have {n:,} words, more than {MOST_WORDS:,}")
    for decision, boxes in reversed(runs):
        body = _with_rules(controller, layer, decision, boxes, body)
    if body is None:
        return None
    if layer.excitement is not None:
        excited = _condition(controller, layer.excitement, (layer.excited_at,))
        body = _group("sequence", layer.behavior, [excited, body])
    text = f"layer {layer.number}: {layer.behavior}"
    return replace(body, text=text) if isinstance(body, Group) else Group("sequence", text, (body,))


def _runs(values: NDArray[np.int64], sizes: Sequence[int]) -> list[tuple[int, list[Box]]]:
    """Return the shortest rules of a table, first match first; neighbors with the same decision go together.

    Where too many say No Action before the last, they are rules for actions alone.
    """
    runs = _grouped(rule_list(values, sizes).boxes)
    if sum(decision == NO_ACTION for decision, _ in runs) <= MOST_EXCEPTIONS:
        return runs
    return _grouped(shortest_cover(np.where(values == NO_ACTION, KEEP, values), sizes).boxes)


def _grouped(rules: Sequence[tuple[Box, int]]) -> list[tuple[int, list[Box]]]:
    return [(decision, [box for box, _ in group]) for decision, group in groupby(rules, lambda rule: rule[1])]


def _with_rules(
    controller: Controller, layer: Layer, decision: int, boxes: Sequence[Box], rest: Node | None
) -> Node | None:
    """Return the tree that takes a decision in some boxes, and does elsewhere what the rest does; None for nothing."""
    places = [_place(controller, layer, box) for box in boxes]
    if decision == NO_ACTION:
        exceptions = [_unless(controller, place) for place in places if place]
        return None if rest is None else _group("sequence", rest.text, [*exceptions, rest])
    action = _act(controller, layer, decision)
    if not all(places):  # the last rule: it holds everywhere
        return action
    where = [_group("sequence", "all of", place) for place in places]
    rule = _group("sequence", action.text, [_group("fallback", "any of", where), action])
    return rule if rest is None else _group("fallback", layer.behavior, [rule, rest])


def _place(controller: Controller, layer: Layer, box: Box) -> list[Condition]:
    """Return the conditions that hold together in a box; none where it holds everything."""
    return [
        _condition(controller, axis, cells)
        for axis, size, cells in zip(layer.axes, layer.sizes, box, strict=True)
        if len(cells) < size
    ]


def _unless(controller: Controller, place: Sequence[Condition]) -> Node:
    """Return what succeeds where some conditions do not hold together: where one of their opposites holds."""
    opposites = [
        _condition(
            controller,
            axis := each.dimension,
            tuple(cell for cell in range(controller.dimensions[axis].size) if cell not in each.cells),
        )
        for each in place
    ]
    return _group("fallback", "any of", opposites)


def _condition(controller: Controller, axis: int, cells: tuple[int, ...]) -> Condition:
    dimension = controller.dimensions[axis]
    return Condition(condition_text((cells,), {dimension.name: dimension.cells}), axis, cells)


def _act(controller: Controller, layer: Layer, decision: int) -> Act:
    number = layer.first_action + decision
    return Act(controller.actions[number - 1].name, number)


def _group(kind: Literal["sequence", "fallback"], text: str, children: Sequence[Node]) -> Node:
    """Return a group in which groups of its kind are taken apart; of one child only the child."""
    flat: list[Node] = []
    for child in children:
        flat += child.children if isinstance(child, Group) and child.kind == kind else [child]
    return flat[0] if len(flat) == 1 else Group(kind, text, tuple(flat))
