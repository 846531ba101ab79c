"""Cells of inputs that can never be the present one."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.graph import value_of
from bbsd.expression.kinds import Kind
from bbsd.expression.syntax.mistakes import WHOLE, Mistake
from bbsd.language.meaning.partitions import TRUTH_CELLS

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from bbsd.expression.graph import Node
    from bbsd.expression.scope import Path
    from bbsd.language.meaning import Meaning
    from bbsd.language.meaning.tables.labels import Labels
    from bbsd.language.validation import LocatedMistake
    from bbsd.language.warnings.proving import Prover

MOST_SHOWN = 5
"""Cells that a warning names."""
MOST_CELLS = 1000
"""Cells of an input that is looked at."""


def unreached_cells(meaning: Meaning, prover: Prover) -> Iterator[LocatedMistake]:
    """Yield a warning for each input and sensor with cells that are provably never the present one."""
    for path, cells, nodes in _partitions(meaning):
        if len(cells) > MOST_CELLS:
            continue
        unreached = set(range(len(cells)))
        for node in dict.fromkeys(nodes):
            unreached -= _reached(node, len(cells), prover)
            if not unreached:
                break
        if unreached:
            yield path, _mistake(cells, sorted(unreached))


def _partitions(meaning: Meaning) -> Iterator[tuple[Path, Labels, Sequence[Node]]]:
    """Yield the inputs and the sensors that have cells, with the nodes that give the present cell of any robot."""
    episode, environment = meaning.episode, meaning.spec.environment
    listed = {name for behavior in meaning.spec.behaviors.values() for name in behavior.inputs}
    stored: dict[str, list[Node]] = {name: [] for name in environment.sensors}
    for slot, node in (*episode.start.items(), *episode.after.items()):
        if slot.name in stored and not slot.place:
            stored[slot.name].append(node)
    for name, nodes in stored.items():
        if name in episode.partitions:
            yield ("environment", "sensors", name), episode.partitions[name], nodes
        elif name in listed and all(node.kind is Kind.TRUTH for node in nodes):
            yield ("environment", "sensors", name), TRUTH_CELLS, nodes
    for module in episode.modules:
        inputs = meaning.spec.behaviors[module.name].inputs
        for index, (name, cells) in enumerate(module.inputs.items()):
            if isinstance(inputs, dict):
                yield ("behaviors", module.name, "inputs", name), cells, [row[index] for row in module.cells]


def _mistake(cells: Labels, unreached: Sequence[int]) -> Mistake:
    shown = [cells[cell] for cell in unreached[:MOST_SHOWN]]
    more = f" and {len(unreached) - MOST_SHOWN} more" if len(unreached) > MOST_SHOWN else ""
    names = (
        shown[0]
        if len(unreached) == 1
        else f"{', '.join(shown[:-1])} {'and' if not more else ','} {shown[-1]}"
    )
    if len(unreached) == len(cells) - 1:
        (only,) = set(range(len(cells))) - set(unreached)
        message = f"this is always {cells[only]}"
        return Mistake("BB207", message, WHOLE, "an input that cannot change tells a behavior nothing")
    many = len(unreached) > 1
    message = f"the cell{'s' * many} {names}{more} can never be the present one"
    return Mistake("BB207", message, WHOLE, "leave out what cannot occur, or mend the condition")


def _reached(node: Node, n_cells: int, prover: Prover) -> set[int]:
    """Return the cells that may be the present one."""
    if node.literal:
        return {int(value_of(node))}
    if node.operation == "select" and node.kind is Kind.CELL:
        return _reached_in_chain(node, prover)
    if node.operation == "cell_of" or node.kind is Kind.TRUTH:
        condition = node if node.kind is Kind.TRUTH else node.operands[0]
        return _truths(condition, prover)
    low, high = prover.bounds.of(node)
    return set(range(int(max(low, 0)), int(min(high, n_cells - 1)) + 1))


def _truths(condition: Node, prover: Prover) -> set[int]:
    """Return 0 where a condition may not hold, and 1 where it may."""
    if prover.always(condition):
        return {1}
    return {0} if prover.never(condition) else {0, 1}


def _reached_in_chain(node: Node, prover: Prover) -> set[int]:
    """Return the cells of named ones that may be the present one: those whose condition may hold, and none before."""
    reached, earlier = set[int](), list["Node"]()
    while node.operation == "select":
        condition, cell, node = node.operands
        if not prover.never(condition, tuple(earlier)):
            reached.add(int(value_of(cell)))
        if prover.bounds.of(condition)[0]:
            return reached
        earlier.append(condition)
    return reached if prover.one_holds(earlier) else reached | {int(value_of(node))}
