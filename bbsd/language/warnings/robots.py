"""Robots that can only do the same, and robots that are not there."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.graph import needed
from bbsd.expression.syntax.mistakes import WHOLE, Mistake, Rewriting
from bbsd.expression.syntax.text import number_text
from bbsd.expression.syntax.tree import Comparison, Expr, Name, Number, parts
from bbsd.language.base import Part
from bbsd.language.field_types import Expression

if TYPE_CHECKING:
    from collections.abc import Hashable, Iterator, Mapping

    from bbsd.expression.graph import Node
    from bbsd.expression.node_data import Slot
    from bbsd.expression.scope import Path
    from bbsd.language.meaning import Meaning
    from bbsd.language.models import Spec
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


def absent_robots(meaning: Meaning) -> Iterator[LocatedMistake]:
    """Yield a warning for each comparison of robot with a number that no robot has."""
    robots = meaning.spec.environment.robots
    for path, tree in expressions_of(meaning.spec):
        for part in _parts_of(tree):
            match part:
                case Comparison(operators=("==" | "!=",), operands=operands):
                    number = next((each for each in operands if isinstance(each, Number)), None)
                    is_robot = any(isinstance(each, Name) and each.name == "robot" for each in operands)
                case _:
                    continue
            if number is None or not is_robot or (0 <= number.value < robots and number.value.is_integer()):
                continue
            has = "robot is 0, the only one" if robots == 1 else f"robot is one of 0 to {robots - 1}"
            message = f"there is no robot {number_text(number.value)}: they count from 0, and {has}"
            last = Rewriting(str(robots - 1), number.span, is_certain=False)
            correction = last if number.value == robots else None
            yield path, Mistake("BB211", message, number.span, f"the last is robot {robots - 1}", correction)


def expressions_of(spec: Spec) -> Iterator[tuple[Path, Expr]]:
    """Yield the expressions of environment, behaviors and reward, with their paths."""
    for key, value in spec.values_by_key().items():
        if key in ("environment", "behaviors", "reward", "expects"):
            yield from _expressions((key,), value)


def _expressions(path: Path, value: object) -> Iterator[tuple[Path, Expr]]:
    match value:
        case Expression():
            yield path, value.tree
        case Part():
            for key, inner in value.values_by_key().items():
                yield from _expressions((*path, key), inner)
        case dict():
            for key, inner in value.items():
                yield from _expressions((*path, key), inner)


def _parts_of(tree: Expr) -> Iterator[Expr]:
    yield tree
    for part in parts(tree):
        yield from _parts_of(part)
