"""Settings that change over the generations or the episodes of a lifetime, as numbers for each of them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, cast

from bbsd.expression import elaboration
from bbsd.expression.graph import Graph, Level, Node, needed
from bbsd.expression.kinds import Kind
from bbsd.expression.mistakes import WHOLE
from bbsd.expression.repetition import values_for
from bbsd.expression.scope import Binding, Findings, Path, Scope, Shared

if TYPE_CHECKING:
    from collections.abc import Mapping

    from bbsd.language.field_types import Expression
    from bbsd.language.models import Spec


MOST_STEPS = 600_000
"""Of computing a rate for all generations or episodes: a fifth of a second."""


@dataclass(frozen=True, slots=True)
class Rates:
    """One number for each generation, or for each episode of a lifetime."""

    hard_mutation: tuple[float, ...]
    soft_mutation: tuple[float, ...]
    learning: tuple[float, ...]
    exploration: tuple[float, ...]


def evaluate_rates(spec: Spec, graph: Graph, findings: Findings, constants: Mapping[str, Binding]) -> Rates:
    """Evaluate the rates; each must be a probability everywhere."""
    generations, episodes = spec.design.coevolution.generations, spec.design.learning.episodes
    counted = range(1, max(episodes, spec.design.learning.last) + 1)
    shared = {
        **constants,
        "generations": Shared(graph.number(generations)),
        "episodes": Shared(graph.number(episodes)),
    }
    generation = graph.leaf("slot", "generation", Kind.NUMBER, Level.CALL)
    episode = graph.leaf("slot", "episode", Kind.NUMBER, Level.CALL)
    scope = Scope(graph, {**shared, "generation": Shared(generation)}, findings)
    written = spec.design.coevolution
    every, path = range(1, generations + 1), ("design", "coevolution", "hard_mutation")
    hard = _node(written.hard_mutation, scope, path)
    hard_rates = _probabilities(hard, every, findings, path, "generation")
    # What follows from a mistake in it is not told again.
    known = hard if hard_rates else graph.unknown
    scope = Scope(graph, {**scope.names, "hard_mutation": Shared(known)}, findings)
    soft = _node(written.soft_mutation, scope, ("design", "coevolution", "soft_mutation"))
    scope = Scope(graph, {**shared, "episode": Shared(episode)}, findings)
    rate = _node(spec.design.learning.rate, scope, ("design", "learning", "rate"))
    exploration = _node(spec.design.learning.exploration, scope, ("design", "learning", "exploration"))
    return Rates(
        hard_rates,
        _probabilities(soft, every, findings, ("design", "coevolution", "soft_mutation"), "generation"),
        _probabilities(rate, counted, findings, ("design", "learning", "rate"), "episode"),
        _probabilities(exploration, counted, findings, ("design", "learning", "exploration"), "episode"),
    )


def _node(written: Expression, scope: Scope, path: Path) -> Node:
    return elaboration.number(written.tree, scope.at(path))


def _probabilities(
    node: Node, counted: range, findings: Findings, path: Path, unit: str
) -> tuple[float, ...]:
    """The values for generations or episodes, each of which must be a probability."""
    nodes = needed([node])
    unknown = {cast("str", leaf.data) for leaf in nodes if leaf.operation == "slot"} - {unit}
    if node.kind is Kind.UNKNOWN:
        return ()
    if unknown:
        findings.tell(path, "BB066", f"this depends on the {unknown.pop()}, which is not known here")
        return ()
    n_steps = sum(1 for each in nodes if each.operands)
    if n_steps * len(counted) > MOST_STEPS:
        message = f"this takes {n_steps} steps to compute, too many for {len(counted):,} {unit}s"
        findings.tell(path, "BB068", message, WHOLE, f"write it shorter, or let there be fewer {unit}s")
        return ()
    values = []
    for number, value in zip(counted, values_for(node, map(float, counted)), strict=True):
        if not 0 <= value <= 1:
            findings.tell(path, "BB043", f"this is {value:g} in {unit} {number}; it must be from 0 to 1")
            return ()
        values.append(float(value))
    return tuple(values)
