"""Robots that can only do the same."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.graph import needed
from bbsd.expression.syntax.mistakes import WHOLE, Mistake

if TYPE_CHECKING:
    from collections.abc import Hashable, Iterator, Mapping

    from bbsd.expression.graph import Node
    from bbsd.expression.node_data import Slot
    from bbsd.language.meaning import Meaning
    from bbsd.language.validation import LocatedMistake


def robots_alike(meaning: Meaning) -> Iterator[LocatedMistake]:
    """Yield a warning where several robots start alike and cannot come to differ.

    The proof is by induction: if all robots hold the same values, what they perceive, choose and hold next is computed
    alike. A draw, the robot's index and what an environment in Python shows are another value for each robot.
    """
    robots = meaning.spec.environment.robots
    if robots > 1 and _are_alike(meaning):
        message = f"all {robots} robots always do the same: they start alike, and nothing makes them differ"
        advice = "draw a starting value, or let one depend on robot"
        yield ("environment", "robots"), Mistake("BB206", message, WHOLE, advice)


def _are_alike(meaning: Meaning) -> bool:
    episode = meaning.episode
    nodes = [*episode.start.values(), *episode.after.values()]
    nodes += [node for module in episode.modules for node in module.nodes]
    classes = _classes(nodes)
    rows: dict[Hashable, set[int]] = {}
    for moment in ("start", "after"):
        values: Mapping[Slot, Node] = getattr(episode, moment)
        for slot, node in values.items():
            if slot.robot is not None:
                rows.setdefault((moment, slot.variable), set()).add(classes[node.number])
    for module in episode.modules:
        for node in module.excited:
            rows.setdefault(("excited", module.name), set()).add(classes[node.number])
        for robot in module.cells:
            for index, node in enumerate(robot):
                rows.setdefault((module.name, index), set()).add(classes[node.number])
    return all(len(row) == 1 for row in rows.values())


def _classes(nodes: list[Node]) -> dict[int, int]:
    """Return a class for each node: nodes of one class are equal where all robots hold the same and choose the same."""
    classes: dict[int, int] = {}
    first: dict[Hashable, int] = {}
    for node in needed(nodes):
        key: Hashable = (
            node.operation,
            node.kind,
            node.data,
            *(classes[each.number] for each in node.operands),
        )
        if node.operation == "slot":
            key = (node.operation, node.kind, node.slot.variable)
        elif node.operation == "choice":
            key = (node.operation,)
        classes[node.number] = first.setdefault(key, node.number)
    return classes
