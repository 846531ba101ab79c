"""The numbers that decide a behavior's cell or which element is taken; one that is NaN decides something all the same.

A NaN fails every condition, so it falls into the last of named cells, and as an index it takes the first element.
State, sensors and the world are checked by their own names; what expressions compute between them is checked here.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.graph import Level, needed, value_of
from bbsd.expression.kinds import Kind

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from bbsd.expression.graph import Node
    from bbsd.language.meaning.episode.episode import Episode

FINITE = frozenset(
    {
        "literal",
        "table",
        "constant",
        "pick",
        "element",
        "step",
        "sign",
        "sin",
        "cos",
        "atan",
        "atan2",
        "tanh",
        "cell_of",
    }
)
"""Operations whose values are finite where those of slots are, whatever their operands; what is given counts so."""
KEEPING = frozenset(
    {
        "slot",
        "negate",
        "abs",
        "minimum",
        "maximum",
        "select",
        "floor",
        "ceil",
        "round_half_even",
        "quick_modulo",
    }
)
"""Operations whose values are finite where those of their operands are."""


def deciding_numbers(episode: Episode, outputs: Iterable[Node]) -> list[Node]:
    """Return the numbers that decide cells and indices and need not be finite where the values of all slots are.

    Those that are computed for each pair of robots in a loop are left out.
    """
    cells = [node for module in episode.modules for robot in module.cells for node in robot]
    subjects = [*_subjects(cells)]
    nodes = needed(outputs)
    subjects += [index for node in nodes for index in _indices(node)]
    finite: dict[int, bool] = {}
    for node in nodes:
        operands = [finite[operand.number] for operand in node.operands if operand.kind is Kind.NUMBER]
        finite[node.number] = node.operation in FINITE or (node.operation in KEEPING and all(operands))
    found = {
        node.number: node for node in subjects if node.level is not Level.PAIR and not finite[node.number]
    }
    return [found[number] for number in sorted(found)]


def _subjects(cells: Iterable[Node]) -> Iterator[Node]:
    """Yield the numbers from which the indices of cells follow."""
    waiting, seen = list(cells), set[int]()
    while waiting:
        node = waiting.pop()
        if node.number in seen:
            continue
        seen.add(node.number)
        if node.kind is Kind.NUMBER:
            yield node
        else:
            waiting.extend(node.operands)


def _indices(node: Node) -> Iterator[Node]:
    """Yield the numbers by which a node takes an element."""
    if node.operation in ("gather", "element", "clamp_index"):
        yield from (operand for operand in node.operands if operand.kind is Kind.NUMBER)
    if node.operation == "select" and (index := _chosen_by(node)) is not None:
        yield index


def _chosen_by(node: Node) -> Node | None:
    """Return the index of a chain of choices that takes an element: the last one asks whether it is at least 1."""
    condition = node.operands[0]
    if condition.operation != ">=" or not condition.operands[1].literal:
        return None
    return condition.operands[0] if value_of(condition.operands[1]) == 1.0 else None
