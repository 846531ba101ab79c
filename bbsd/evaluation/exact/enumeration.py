"""Exact evaluation: where only the start is drawn, and from finitely many values, every start is run once."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from bbsd.errors import UsageError
from bbsd.expression.graph import Graph, Level, Node, needed, replace_leaves
from bbsd.expression.kinds import Kind

if TYPE_CHECKING:
    from collections.abc import Iterable

    from bbsd.compiler import Problem
    from bbsd.language.meaning.naming.constants import Constants

MAX_STARTS = 1_000_000
"""Starts that are run at most."""


class NotEnumerable(UsageError):
    """A spec whose starts cannot all be run; the message says why."""


def enumerate_starts(problem: Problem) -> tuple[Problem, npt.NDArray[np.float64]]:
    """Return a problem whose key n chooses the n-th start, and the probability of each start (n_starts,).

    Raises NotEnumerable where something is drawn after the start, from a continuous range, or from too many values.
    """
    graph, episode = problem.meaning.graph, problem.meaning.episode
    if episode.outside:
        raise NotEnumerable("the world is stepped in Python, and what it draws is not known")
    later = [*episode.after.values(), *(node for nodes in episode.reward.values() for node in nodes)]
    if _draws(later):
        raise NotEnumerable("values are drawn during the episode, not only at its start")
    draws = _draws(episode.start.values())
    choices = [values_of_draw(draw, problem.meaning.constants) for draw in draws]
    total = int(np.prod([len(weights) for _, weights in choices], dtype=np.float64)) if choices else 1
    if total > MAX_STARTS:
        raise NotEnumerable(f"there are {total} starts; at most {MAX_STARTS} are tried")
    digits, weights = _combine(draws, choices, total, graph)
    start = {slot: _with_digits(node, digits, graph) for slot, node in episode.start.items()}
    meaning = replace(problem.meaning, episode=replace(episode, start=start))
    return replace(problem, meaning=meaning), weights


def _draws(nodes: Iterable[Node]) -> list[Node]:
    return [node for node in needed(nodes) if node.operation == "draw"]


def values_of_draw(draw: Node, constants: Constants) -> tuple[float, list[float]]:
    """Return the first value of a draw, and the probabilities of this value and of those that follow it.

    Raises NotEnumerable where it has no finite list of values.
    """
    distribution = draw.draw.distribution
    values = [constants.static(operand) for operand in draw.operands]
    match distribution, values:
        case "chance", [float(probability)]:
            return 0.0, [1.0 - probability, probability]
        case "integers", [float(first), float(last)] if first.is_integer() and last.is_integer():
            count = int(last - first + 1.0)
            if count > MAX_STARTS:
                raise NotEnumerable(
                    f"a start is drawn from {count} values; at most {MAX_STARTS} starts are tried"
                )
            return first, [1.0 / count] * count
    raise NotEnumerable(f"a value is drawn by {distribution}(...), which has no finite list of values")


def _combine(
    draws: list[Node], choices: list[tuple[float, list[float]]], total: int, graph: Graph
) -> tuple[dict[int, Node], npt.NDArray[np.float64]]:
    """Return each draw as a digit of the start's number, by the draw's number, and the starts' probabilities."""
    number = graph.leaf("start", None, Kind.NUMBER, Level.LANE)
    digits, weights, stride = {}, np.ones(total), 1
    for draw, (first, probabilities) in zip(draws, choices, strict=True):
        digit = graph.apply(
            "modulo",
            graph.apply("floor_divide", number, graph.number(stride)),
            graph.number(len(probabilities)),
        )
        value = graph.apply("+", digit, graph.number(first)) if first else digit
        digits[draw.number] = graph.apply(">", value, graph.number(0)) if draw.kind is Kind.TRUTH else value
        weights *= np.array(probabilities)[np.arange(total) // stride % len(probabilities)]
        stride *= len(probabilities)
    return digits, weights


def _with_digits(node: Node, digits: dict[int, Node], graph: Graph) -> Node:
    return replace_leaves(
        node, graph, lambda leaf, operands: digits.get(leaf.number) or _copy(leaf, operands, graph)
    )


def _copy(leaf: Node, operands: list[Node], graph: Graph) -> Node:
    if leaf.operation == "gather":
        return graph.copy(leaf, operands)
    return leaf
