"""Whether conditions provably cover everything: by cases over the comparisons they are made of."""

from __future__ import annotations

from itertools import pairwise, product
from math import inf
from typing import TYPE_CHECKING

from bbsd.expression.graph import Graph, Node, compute, value_of
from bbsd.expression.kinds import Kind
from bbsd.expression.operations import COMPARISONS, INFIX

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

MAX_CASES = 4096
MAX_WORK = 1_000_000
MAX_ATOMS = 300

MIRRORED = {"<": ">", "<=": ">=", ">": "<", ">=": "<=", "==": "==", "!=": "!="}


def covers_everything(conditions: list[Node], graph: Graph) -> bool:
    """True if at least one condition holds in every case that numbers can be in.

    Comparisons of one value with known bounds are decided together, in and between the bounds; two values are
    below, equal or above; anything else is free. NaN is no case: it falls into the last cell.
    """
    anything = graph.fold("|", conditions)
    if anything.literal:
        return bool(value_of(anything))
    nodes = _down_to_atoms(anything)
    cases = 1
    choices: dict[tuple[int, ...], list[dict[int, bool]]] = {}
    for key, group in _groups(node for node in nodes if _is_atom(node)).items():
        if len(group) > MAX_ATOMS:
            return False
        choices[key] = _cases(group)
        cases *= len(choices[key])
        if cases > MAX_CASES:
            return False
    if cases * len(nodes) > MAX_WORK:
        return False
    return all(_holds(nodes, combination) for combination in product(*choices.values()))


def _down_to_atoms(condition: Node) -> list[Node]:
    """The truths that a condition is made of, operands first; what an atom compares is not looked into."""
    found: dict[int, Node] = {}
    waiting = [condition]
    while waiting:
        node = waiting.pop()
        if node.number not in found:
            found[node.number] = node
            waiting.extend(() if _is_atom(node) else node.operands)
    return [found[number] for number in sorted(found)]


def _is_atom(node: Node) -> bool:
    return (
        node.kind is Kind.TRUTH
        and not node.literal
        and node.operation not in ("&", "|", "not", "select", "cell_of")
    )


def _groups(atoms: Iterable[Node]) -> dict[tuple[int, ...], list[Node]]:
    groups: dict[tuple[int, ...], list[Node]] = {}
    for atom in atoms:
        groups.setdefault(_subject(atom), []).append(atom)
    return groups


def _subject(atom: Node) -> tuple[int, ...]:
    """The same for atoms about the same thing: the value compared with numbers, or the pair of values."""
    if atom.operation not in COMPARISONS:
        return (-1, atom.number)
    left, right = atom.operands
    if right.literal or left.literal:
        return ((left if right.literal else right).number,)
    return tuple(sorted((left.number, right.number)))


def _cases(group: list[Node]) -> list[dict[int, bool]]:
    first = group[0]
    if first.operation not in COMPARISONS:
        return [{first.number: truth} for truth in (False, True)]
    if any(node.literal for node in first.operands):
        bounds = sorted({float(value_of(node)) for atom in group for node in atom.operands if node.literal})
        between = [low / 2 + high / 2 for low, high in pairwise(bounds)]
        points = [-inf, *bounds, *between, inf]
        return [{atom.number: _compared(atom, point) for atom in group} for point in points]
    return [{atom.number: _ordered(atom, order) for atom in group} for order in (-1, 0, 1)]


def _compared(atom: Node, point: float) -> bool:
    left, right = (value_of(node) if node.literal else point for node in atom.operands)
    return bool(INFIX[atom.operation](left, right))


def _ordered(atom: Node, order: int) -> bool:
    left, right = atom.operands
    operation = atom.operation if left.number < right.number else MIRRORED[atom.operation]
    return bool(INFIX[operation](order, 0))


def _holds(nodes: Sequence[Node], combination: Iterable[Mapping[int, bool]]) -> bool:
    """Whether the last of the nodes is true, given truths for the atoms among them."""
    truths: dict[int, bool] = {}
    for case in combination:
        truths.update(case)
    for node in nodes:
        if node.number not in truths:
            truths[node.number] = _decided(node, truths)
    return truths[nodes[-1].number]


def _decided(node: Node, truths: Mapping[int, bool]) -> bool:
    """The truth of what is made of truths; `node` is no atom."""
    if node.literal:
        return bool(value_of(node))
    return bool(compute(node.operation, [truths[operand.number] for operand in node.operands]))
