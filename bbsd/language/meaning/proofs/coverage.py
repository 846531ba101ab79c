"""Whether conditions provably cover everything: a proof by cases over the comparisons in them."""

from __future__ import annotations

from itertools import pairwise, product
from math import inf
from typing import TYPE_CHECKING

from bbsd.expression.graph import Graph, Node, compute, value_of
from bbsd.expression.kinds import Kind
from bbsd.expression.operations import COMPARISONS, MIRRORED

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping, Sequence

MAX_CASES = 4096
"""Combinations of cases to go through."""
MAX_EVALUATIONS = 1_000_000
"""Cases times nodes of the condition, by default."""
MAX_ATOMS = 300
"""Comparisons of one value: each is computed at every bound and between them."""


def covers_everything(
    conditions: list[Node],
    graph: Graph,
    size: Callable[[Node], int | None] = lambda _: None,
    most_evaluations: int = MAX_EVALUATIONS,
) -> bool:
    """Return whether at least one condition provably holds, whatever the values compared in them.

    Comparisons of one value with known bounds are decided together, at and between the bounds; of two values, the
    first is below, equal to or above the second; any other truth is free. NaN is no case: it falls into the last
    cell. Where there are too many cases to go through, nothing is proven.

    Args:
        conditions: truths.
        graph: the graph that they are from.
        size: gives how many values a node has that are the whole numbers from 0 on; None for all other nodes.
        most_evaluations: cases times nodes of the condition.
    """
    any_holds = graph.fold("|", conditions)
    if any_holds.literal:
        return bool(value_of(any_holds))
    nodes = _down_to_atoms(any_holds)
    cases = 1
    choices: dict[tuple[int, ...], list[dict[int, bool]]] = {}
    for subject, group in _by_subject(node for node in nodes if _is_atom(node)).items():
        if len(group) > MAX_ATOMS:
            return False
        choices[subject] = _cases(group, size)
        cases *= len(choices[subject])
        if cases > MAX_CASES:
            return False
    if cases * len(nodes) > most_evaluations:
        return False
    return all(_holds(nodes, combination) for combination in product(*choices.values()))


def _down_to_atoms(condition: Node) -> list[Node]:
    """Return the truths that a condition consists of, operands first, down to atoms (comparisons and free truths)."""
    nodes: dict[int, Node] = {}
    waiting = [condition]
    while waiting:
        node = waiting.pop()
        if node.number not in nodes:
            nodes[node.number] = node
            waiting.extend(() if _is_atom(node) else node.operands)
    return [nodes[number] for number in sorted(nodes)]


def _is_atom(node: Node) -> bool:
    return (
        node.kind is Kind.TRUTH
        and not node.literal
        and node.operation not in ("&", "|", "not", "select", "cell_of")
    )


def _by_subject(atoms: Iterable[Node]) -> dict[tuple[int, ...], list[Node]]:
    groups: dict[tuple[int, ...], list[Node]] = {}
    for atom in atoms:
        groups.setdefault(_subject(atom), []).append(atom)
    return groups


def _subject(atom: Node) -> tuple[int, ...]:
    """Return what an atom is about: the value that it compares with a number, or the pair of values."""
    if atom.operation not in COMPARISONS:
        return (-1, atom.number)
    left, right = atom.operands
    if right.literal or left.literal:
        return ((left if right.literal else right).number,)
    return tuple(sorted((left.number, right.number)))


def _cases(group: list[Node], size: Callable[[Node], int | None]) -> list[dict[int, bool]]:
    """Return the truths that atoms about one subject can have together."""
    first = group[0]
    if first.operation not in COMPARISONS:
        return [{first.number: truth} for truth in (False, True)]
    if any(node.literal for node in first.operands):
        bounds = sorted({float(value_of(node)) for atom in group for node in atom.operands if node.literal})
        n_values = next((size(node) for node in first.operands if not node.literal), None)
        points = _points(bounds) if n_values is None else _whole_points(bounds, n_values)
        return [{atom.number: _truth_at(atom, point) for atom in group} for point in points]
    return [{atom.number: _truth_in_order(atom, order) for atom in group} for order in (-1, 0, 1)]


def _points(bounds: Sequence[float]) -> Sequence[float]:
    """Return every bound, and a number between each and the next, below the first and above the last."""
    between = [low / 2 + high / 2 for low, high in pairwise(bounds)]
    return [-inf, *bounds, *between, inf]


def _whole_points(bounds: Sequence[float], n_values: int) -> Sequence[float]:
    """Return of the whole numbers from 0 to below `n_values` those at and beside bounds, and the first and the last."""
    last = n_values - 1
    near = {int(bound) + beside for bound in bounds if abs(bound) <= n_values for beside in (-1, 0, 1)}
    return [float(number) for number in sorted({0, last} | {each for each in near if 0 <= each <= last})]


def _truth_at(atom: Node, point: float) -> bool:
    left, right = (value_of(node) if node.literal else point for node in atom.operands)
    return bool(compute(atom.operation, [left, right]))


def _truth_in_order(atom: Node, order: int) -> bool:
    """Return an atom's truth where its value of lower number is below (-1), equal to (0) or above (1) the other."""
    left, right = atom.operands
    operation = atom.operation if left.number < right.number else MIRRORED[atom.operation]
    return bool(compute(operation, [order, 0]))


def _holds(nodes: Sequence[Node], combination: Iterable[Mapping[int, bool]]) -> bool:
    """Return whether the last of the nodes is true, given the truths of the atoms among them."""
    truths: dict[int, bool] = {}
    for case in combination:
        truths.update(case)
    for node in nodes:
        if node.number not in truths:
            truths[node.number] = _evaluate(node, truths)
    return truths[nodes[-1].number]


def _evaluate(node: Node, truths: Mapping[int, bool]) -> bool:
    """Return the truth of a node that is no atom, given those of its operands."""
    if node.literal:
        return bool(value_of(node))
    return bool(compute(node.operation, [truths[operand.number] for operand in node.operands]))
