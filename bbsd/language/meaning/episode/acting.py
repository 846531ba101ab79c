"""From a decision to the next world and state: behaviors, the assignments of controlling actions, dynamics."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.errors import did_you_mean
from bbsd.expression.elaboration import elaboration
from bbsd.expression.elaboration.naming import report_unknown_values
from bbsd.expression.node_data import Slot
from bbsd.expression.syntax.mistakes import KEY
from bbsd.language.meaning.behaviors import Module, elaborate_behavior
from bbsd.language.meaning.episode.stored import slots_of_state
from bbsd.language.meaning.forms import Form, fitted
from bbsd.language.meaning.naming.names import Names, Stored, refilled
from bbsd.language.meaning.outside.exchange import ONLY_OUTSIDE, names_outside, value_outside, what_sets
from bbsd.language.meaning.partitions import MAX_CELLS_IN_ALL

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from bbsd.expression.graph import Node
    from bbsd.expression.scope import Path, Scope, Value
    from bbsd.language.field_types import Expression
    from bbsd.language.meaning.moments import Moment


def modules_at(names: Names, decision: Moment, forms: Mapping[str, Form]) -> Iterator[Module]:
    """Yield the behaviors that could be understood, up to the one that makes all tables together too large."""
    n_cells = 0
    for name, behavior in names.spec.behaviors.items():
        module = elaborate_behavior(name, behavior, decision, forms)
        if module is not None:
            yield module
        n_cells += module.n_cells if module else 0
        if n_cells > MAX_CELLS_IN_ALL:
            message = f"from here on, all tables together have more than {MAX_CELLS_IN_ALL:,} cells"
            names.findings.report(("behaviors", name, "inputs"), "BB039", message, KEY)
            return


def act(now: Stored, modules: tuple[Module, ...], choices: tuple[Node, ...], names: Names) -> Stored:
    """Return state after the controlling actions' assignments; what is not set stays."""
    graph, acted = names.graph, slots_of_state(now, names)
    every_action = [sets for module in modules for sets in module.actions.values()]
    for action, sets in enumerate(every_action, start=1):
        for (name, place), values in sets.items():
            for robot, value in enumerate(values):
                slot, controls = (
                    Slot(name, robot, place),
                    graph.apply("==", choices[robot], graph.cell(action)),
                )
                acted[slot] = graph.apply("select", controls, value, acted[slot])
    nodes = iter(acted.values())
    return {name: tuple(refilled(value, nodes) for value in values) for name, values in now.items()}


def apply_dynamics(acted: Stored, scope: Scope, forms: Mapping[str, Form], names: Names) -> Stored:
    """Return the next state and world, all at once, from the values after the actions and the snapshot's sensors."""
    environment = names.spec.environment
    given = names_outside(environment)
    then = dict(acted)
    for name in given:
        then[name] = tuple(value_outside(name, robot, names.graph) for robot in names.robots)
    for name, expression in environment.dynamics.items():
        path: Path = ("environment", "dynamics", name)
        if name in given:
            message, advice = f"{what_sets(name)}, which has no dynamics", ONLY_OUTSIDE
            names.findings.report(path, "BB107", message, KEY, advice)
        elif name in acted:
            robots = [names.team] if name in environment.world else names.robots
            then[name] = tuple(
                _evaluate_as(forms[name], name, expression, scope.at(path, robot, draws=True))
                for robot in robots
            )
        elif name not in names.unusable:
            hint = did_you_mean(name, acted)
            message = f"{name} is neither world nor state, so it has no dynamics{hint}"
            names.findings.report(path, "BB033", message, KEY)
    return then


def _evaluate_as(form: Form, name: str, expression: Expression, scope: Scope) -> Value:
    if form.names:
        report_unknown_values(expression.tree, name, form.names, scope)
    value = elaboration.value(expression.tree, scope)
    return fitted(value, form, name, expression.tree.span, scope)
