"""Which joint cells can occur, as far as it follows from the expressions alone.

Inputs that look at the same value exclude combinations: where `x < 1` holds, `x > 2` does not. The proof goes through
the cases of each value that is compared with constants or divided by `values(...)`, and of each pair of values that are
compared with each other. Values that are no numbers are left out.
"""

from __future__ import annotations

from itertools import pairwise, product
from math import ceil, floor, inf, prod
from typing import TYPE_CHECKING

import numpy as np

from bbsd.expression.graph import compute, value_of
from bbsd.expression.kinds import Kind
from bbsd.expression.operations import COMPARISONS, MIRRORED

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping, Sequence

    from numpy.typing import NDArray

    from bbsd.architecture.policy import JointSpace
    from bbsd.expression.graph import Node
    from bbsd.language.meaning import Meaning

    Subject = tuple[int, ...]
    """The numbers of the nodes that are compared: one, or two; (-1, number) of a truth that is free."""
    Case = Mapping[int, float]
    """The values that some atoms have together, by their numbers."""

MOST_EVALUATIONS = 50_000
"""Combinations of cases times operations; of inputs beyond that, all cells count as possible."""
MOST_CASES = 4096
"""Cases of one value."""
MOST_ROBOTS = 20
"""Robots that are looked at: their sensors may differ."""
THROUGH = frozenset({"&", "|", "not", "select", "cell_of", "+"})
"""Operations whose values follow from those of their operands, which are truths or cells."""


def possible_cells(meaning: Meaning, space: JointSpace) -> NDArray[np.bool_]:
    """Return which joint cells may occur for some robot, of the shape `space.sizes`; the space should be small."""
    robots = len(meaning.episode.modules[0].cells)
    if robots > MOST_ROBOTS:
        return np.ones(space.sizes, np.bool_)
    possible = np.zeros(space.sizes, np.bool_)
    for robot in range(robots):
        of_robot = np.ones(space.sizes, np.bool_)
        for roots in _linked(meaning, _roots(meaning, space, robot)):
            of_robot &= _possible(meaning, roots, space.sizes)
        possible |= of_robot
        if possible.all():
            break
    return possible


def _roots(meaning: Meaning, space: JointSpace, robot: int) -> dict[int, Node]:
    """Return for each axis of the joint space the node that gives a robot's place on it."""
    roots: dict[int, Node] = {}
    for module, projection in zip(meaning.episode.modules, space.projections, strict=True):
        for node, axis in zip(module.cells[robot], projection.axes, strict=True):
            roots.setdefault(axis, node)
    for module, projection in zip(meaning.episode.modules, space.projections, strict=True):
        if projection.excitement is not None and projection.excited_at == 1:
            roots.setdefault(projection.excitement, module.excited[robot])
    return roots


def _linked(meaning: Meaning, roots: Mapping[int, Node]) -> Iterator[dict[int, Node]]:
    """Yield axes in groups that look at common values, without those that cannot be looked into."""
    groups: list[tuple[set[Subject], dict[int, Node]]] = []
    for axis, root in roots.items():
        atoms = _atoms(root)
        if atoms is None:
            continue
        subjects, group = {_subject(meaning, atom) for atom in atoms}, {axis: root}
        for other in [each for each in groups if each[0] & subjects]:
            groups.remove(other)
            subjects, group = subjects | other[0], other[1] | group
        groups.append((subjects, group))
    yield from (group for _, group in groups)


def _atoms(root: Node) -> list[Node] | None:
    """Return the truths and cells that a node consists of; None where something else is among them."""
    atoms: dict[int, Node] = {}
    waiting = [root]
    while waiting:
        node = waiting.pop()
        if node.operation in THROUGH and node.kind in (Kind.TRUTH, Kind.CELL):
            waiting += node.operands
        elif node.kind is Kind.TRUTH or node.operation == "clamp_index":
            if not node.literal:
                atoms[node.number] = node
        elif not (node.literal and node.kind is Kind.CELL):
            return None
    return [atoms[number] for number in sorted(atoms)]


def _subject(meaning: Meaning, atom: Node) -> Subject:
    if atom.operation == "clamp_index":
        return (_shifted(atom.operands[0])[0].number,)
    if atom.operation not in COMPARISONS:
        return (-1, atom.number)
    return tuple(sorted(node.number for node in atom.operands if _constant(meaning, node) is None)) or (
        -1,
        atom.number,
    )


def _shifted(node: Node) -> tuple[Node, float]:
    """Return a node and what is subtracted from it."""
    if node.operation == "-" and node.operands[1].literal:
        return node.operands[0], float(value_of(node.operands[1]))
    return node, 0.0


def _constant(meaning: Meaning, node: Node) -> float | None:
    """Return the value of a node that is the same in every generation, else None."""
    return float(value_of(node)) if node.literal else meaning.constants.static(node)


def _possible(meaning: Meaning, roots: Mapping[int, Node], sizes: Sequence[int]) -> NDArray[np.bool_]:
    """Return which places on some axes occur together; its shape broadcasts to `sizes`."""
    shape = [size if axis in roots else 1 for axis, size in enumerate(sizes)]
    groups: dict[Subject, dict[int, Node]] = {}
    for root in roots.values():
        for atom in _atoms(root) or ():
            groups.setdefault(_subject(meaning, atom), {})[atom.number] = atom
    cases = [_cases(meaning, subject, [*group.values()]) for subject, group in groups.items()]
    composed = _composed(roots.values(), {atom for group in groups.values() for atom in group})
    if not all(cases) or prod(map(len, cases)) * (len(composed) + 1) > MOST_EVALUATIONS:
        return np.ones(shape, np.bool_)
    possible = np.zeros(shape, np.bool_)
    for combination in product(*cases):
        values = {number: value for case in combination for number, value in case.items()}
        for node in composed:
            values[node.number] = _value(node, values)
        place = [int(values[roots[axis].number]) if axis in roots else 0 for axis in range(len(sizes))]
        possible[tuple(place)] = True
    return possible


def _composed(roots: Iterable[Node], atoms: set[int]) -> list[Node]:
    """Return the nodes between atoms and roots, operands first."""
    nodes: dict[int, Node] = {}
    waiting = [*roots]
    while waiting:
        node = waiting.pop()
        if node.number not in atoms and node.number not in nodes:
            nodes[node.number] = node
            waiting += node.operands
    return [nodes[number] for number in sorted(nodes)]


def _value(node: Node, values: Mapping[int, float]) -> float:
    """Return the value of a truth or cell, given those of its operands."""
    if node.literal:
        return float(value_of(node))
    return float(compute(node.operation, [_typed(each, values[each.number]) for each in node.operands]))


def _typed(node: Node, value: float) -> bool | int:
    return bool(value) if node.kind is Kind.TRUTH else int(value)


def _cases(meaning: Meaning, subject: Subject, atoms: Sequence[Node]) -> list[Case]:
    """Return the values that atoms about one subject can have together; none where these are too many."""
    if subject[0] == -1:
        return [{atoms[0].number: float(truth)} for truth in (False, True)]
    if len(subject) == 2:
        return [{atom.number: float(_in_order(atom, order)) for atom in atoms} for order in (-1, 0, 1)]
    points = _points(meaning, atoms)
    return [{atom.number: _at(meaning, atom, point) for atom in atoms} for point in points]


def _in_order(atom: Node, order: int) -> bool:
    """Return a comparison's truth where its value of lower number is below (-1), equal to (0) or above the other."""
    left, right = atom.operands
    operation = atom.operation if left.number <= right.number else MIRRORED[atom.operation]
    return bool(compute(operation, [order, 0]))


def _points(meaning: Meaning, atoms: Sequence[Node]) -> list[float]:
    """Return numbers among which there is one for every combination of what atoms about one number say."""
    bounds: set[float] = set()
    is_whole = False
    for atom in atoms:
        if atom.operation == "clamp_index":
            first = _shifted(atom.operands[0])[1]
            bounds |= {first, first + atom.index}
            is_whole = True
        else:
            bounds |= {value for node in atom.operands if (value := _constant(meaning, node)) is not None}
    if not is_whole:
        ordered = sorted(bounds)
        return [-inf, *ordered, *(low / 2 + high / 2 for low, high in pairwise(ordered)), inf]
    lowest, highest = floor(min(bounds)) - 1, ceil(max(bounds)) + 1
    return [float(point) for point in range(lowest, highest + 1)] if highest - lowest < MOST_CASES else []


def _at(meaning: Meaning, atom: Node, point: float) -> float:
    if atom.operation == "clamp_index":
        return min(max(point - _shifted(atom.operands[0])[1], 0.0), float(atom.index))
    values: Iterable[float | None] = (_constant(meaning, node) for node in atom.operands)
    return float(compute(atom.operation, [point if value is None else value for value in values]))
