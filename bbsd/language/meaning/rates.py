"""Rates of mutation, learning and exploration: a number for each generation, or each episode of a lifetime."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from bbsd.expression.elaboration import elaboration
from bbsd.expression.graph import Graph, Level, Node, needed
from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import Slot
from bbsd.expression.repetition import values_for
from bbsd.expression.scope import Binding, Findings, Path, Scope, Shared
from bbsd.expression.syntax.mistakes import WHOLE
from bbsd.language.design import SOFT_MUTATION

if TYPE_CHECKING:
    from collections.abc import Mapping

    from bbsd.language.field_types import Expression
    from bbsd.language.models import Spec


MAX_OPERATIONS = 600_000
"""Operations that compute a rate for all generations or episodes: a fifth of a second."""
FOLLOWING = "soft_mutation, {} where it is not given,"


class Rates(NamedTuple):
    """One number for each generation, or for each episode of a lifetime."""

    hard_mutation: tuple[float, ...]
    soft_mutation: tuple[float, ...]
    learning: tuple[float, ...]
    exploration: tuple[float, ...]


def evaluate_rates(spec: Spec, graph: Graph, findings: Findings, constants: Mapping[str, Binding]) -> Rates:
    """Evaluate the rates, and report each that is not a probability everywhere."""
    coevolution, learning = spec.design.coevolution, spec.design.learning
    all_generations = range(1, coevolution.generations + 1)
    all_episodes = range(1, max(learning.episodes, learning.last) + 1)
    shared = {
        **constants,
        "generations": Shared(graph.number(coevolution.generations)),
        "episodes": Shared(graph.number(learning.episodes)),
    }
    generation = graph.leaf("slot", Slot("generation"), Kind.NUMBER, Level.CALL)
    episode = graph.leaf("slot", Slot("episode"), Kind.NUMBER, Level.CALL)
    scope = Scope(graph, {**shared, "generation": Shared(generation)}, findings)
    path = ("design", "coevolution", "hard_mutation")
    hard = _node(coevolution.hard_mutation, scope, path)
    hard_rates = _probabilities(hard, all_generations, findings, path, "generation")
    # After a mistake in it, whatever uses it is unknown, so that the mistake is reported once.
    hard_or_unknown = hard if hard_rates else graph.unknown
    scope = Scope(graph, {**scope.names, "hard_mutation": Shared(hard_or_unknown)}, findings)
    soft = _node(coevolution.soft_mutation, scope, ("design", "coevolution", "soft_mutation"))
    scope = Scope(graph, {**shared, "episode": Shared(episode)}, findings)
    rate = _node(learning.rate, scope, ("design", "learning", "rate"))
    exploration = _node(learning.exploration, scope, ("design", "learning", "exploration"))
    follows = hard_rates and "soft_mutation" not in coevolution.model_fields_set
    soft_rates = (
        _probabilities(soft, all_generations, findings, path, "generation", FOLLOWING.format(SOFT_MUTATION))
        if follows
        else _probabilities(
            soft, all_generations, findings, ("design", "coevolution", "soft_mutation"), "generation"
        )
    )
    return Rates(
        hard_rates,
        soft_rates,
        _probabilities(rate, all_episodes, findings, ("design", "learning", "rate"), "episode"),
        _probabilities(exploration, all_episodes, findings, ("design", "learning", "exploration"), "episode"),
    )


def _node(rate: Expression, scope: Scope, path: Path) -> Node:
    return elaboration.number(rate.tree, scope.at(path))


def _probabilities(
    node: Node, numbers: range, findings: Findings, path: Path, unit: str, what: str = "this"
) -> tuple[float, ...]:
    """Return the values for generations or episodes; report one that is no probability and return none."""
    nodes = needed([node])
    unknown = {leaf.slot.name for leaf in nodes if leaf.operation == "slot"} - {unit}
    if node.kind is Kind.UNKNOWN:
        return ()
    if unknown:
        findings.report(path, "BB066", f"this depends on the {unknown.pop()}, which is not known here")
        return ()
    n_operations = sum(1 for node in nodes if node.operands)
    if n_operations * len(numbers) > MAX_OPERATIONS:
        message = f"this takes {n_operations} steps to compute, too many for {len(numbers):,} {unit}s"
        findings.report(path, "BB068", message, WHOLE, f"write it shorter, or let there be fewer {unit}s")
        return ()
    values = []
    for number, value in zip(numbers, values_for(node, map(float, numbers)), strict=True):
        if not 0 <= value <= 1:
            findings.report(path, "BB043", f"{what} is {value:g} in {unit} {number}; it must be from 0 to 1")
            return ()
        values.append(float(value))
    return tuple(values)
