"""What an action of a behavior sets: the robot's own state, as a whole or element by element."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from bbsd.errors import nearest
from bbsd.expression.elaboration import elaboration
from bbsd.expression.elaboration.naming import report_unknown_values
from bbsd.expression.graph import Node
from bbsd.expression.syntax.mistakes import KEY, WHOLE, Mistake, Rewriting
from bbsd.expression.syntax.tree import Name
from bbsd.language.meaning.forms import fitted, scalars_of
from bbsd.language.meaning.outside.exchange import ONLY_OUTSIDE, names_outside, what_sets
from bbsd.language.meaning.setting.targets import (
    Target,
    certainly_meet,
    indices_of,
    places_set,
    read_target,
    with_element,
)

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping, Sequence

    from bbsd.expression.node_data import Variable
    from bbsd.expression.scope import Path, Scope, Value
    from bbsd.language.field_types import Expression
    from bbsd.language.meaning.forms import Form
    from bbsd.language.meaning.naming.names import Names

Assignments = dict["Variable", tuple[Node, ...]]
"""What each scalar of state that an action may change is after it, robot by robot."""


def assignments(
    sets: Mapping[str, Expression], names: Names, scope: Scope, path: Path, forms: Mapping[str, Form]
) -> Assignments:
    """Return what an action sets, for each robot; only the robot's own state can be set.

    Elements of one list are set in the order in which they are written: where two are the same, the later one stays.
    """
    by_name: dict[str, list[tuple[Path, Target, Expression]]] = {}
    for key, expression in sets.items():
        target = read_target(key)
        if isinstance(target, Mistake):
            names.findings.mistakes[(*path, key), target] = None
        else:
            by_name.setdefault(target.name, []).append(((*path, key), target, expression))
    nodes: Assignments = {}
    for name, written in by_name.items():
        if name not in names.spec.environment.state:
            for target_path, *_ in written:
                _report_no_state(name, target_path, names)
        elif name in names.unusable:
            for target_path, target, expression in written:
                _look_for_mistakes(target_path, target, expression, names, scope)
        else:
            nodes |= _Setting(name, forms[name], names, scope).nodes(written)
    return nodes


def _look_for_mistakes(
    path: Path, target: Target, expression: Expression, names: Names, scope: Scope
) -> None:
    for robot in names.robots:
        inner = scope.at(path, robot, draws=True)
        for index in target.indices:
            elaboration.number(index, inner)
        elaboration.value(expression.tree, inner)


class _Setting:
    """Sets one name of state, for all robots."""

    def __init__(self, name: str, form: Form, names: Names, scope: Scope) -> None:
        self.name, self.form, self.names, self.scope = name, form, names, scope
        self.places: dict[tuple[int, ...], None] = {}
        """The scalars that may change."""
        self.ambiguous: list[Path] = []

    def nodes(self, written: Sequence[tuple[Path, Target, Expression]]) -> Assignments:
        after = [dict(scalars_of(self._after(written, robot))) for robot in self.names.robots]
        return {(self.name, place): tuple(values[place] for values in after) for place in sorted(self.places)}

    def _after(self, written: Sequence[tuple[Path, Target, Expression]], robot: int) -> Value:
        """Return a robot's value after all keys of its name."""
        value: Value | None = None
        if self.form.lengths:
            value = elaboration.value(Name(self.name, WHOLE), self.scope.at(written[0][0], robot))
        earlier: list[tuple[Node, ...]] = []
        for path, target, expression in written:
            inner, key = self.scope.at(path, robot, draws=True), str(path[-1])
            indices = indices_of(target, self.form, inner)
            form = self.form
            if target.indices:
                form = replace(form, lengths=form.lengths[len(target.indices) :])
            if form.names:
                report_unknown_values(expression.tree, key, form.names, inner)
            value_set = elaboration.value(expression.tree, inner)
            instead = "" if isinstance(value_set, tuple) else f", or set an element: {key}[0]: ..."
            new = fitted(value_set, form, key, expression.tree.span, inner, instead)
            if indices is None:
                continue
            if any(certainly_meet(indices, others) for others in earlier):
                self._report_twice(path, indices)
            earlier.append(indices)
            self.places |= dict.fromkeys(places_set(self.form, indices))
            value = new if value is None else with_element(value, indices, new, self.scope.graph)
        return self.form.unknown(self.scope.graph) if value is None else value

    def _report_twice(self, path: Path, indices: Sequence[Node]) -> None:
        what = f"this element of {self.name}" if indices else self.name
        message = f"{what} is set twice by this action"
        advice = "set a list as a whole, or each of its elements once"
        self.names.findings.report(path, "BB135", message, KEY, advice)


MAX_LISTED = 8
"""Names of state that an advice lists."""


def _report_no_state(name: str, path: Path, names: Names) -> None:
    if name in names_outside(names.spec.environment) and name not in names.unusable:
        message = f"{what_sets(name)}, and an action cannot set it"
        names.findings.report(path, "BB107", message, KEY, ONLY_OUTSIDE)
    elif name not in names.unusable:
        message, near = _not_state(name, path, names)
        correction = Rewriting(near, KEY, is_certain=False) if near else None
        advice = f"actions set a robot's own state: {', '.join([*names.spec.environment.state][:MAX_LISTED])}"
        if name in names.spec.environment.world:
            advice += f"; {name} gets its value in dynamics, which read what actions set"
        names.findings.report(path, "BB033", message, KEY, advice, correction)


def _not_state(target: str, path: Path, names: Names) -> tuple[str, str]:
    """Return what is wrong with what an action sets, and the state that is probably meant, or ''."""
    environment = names.spec.environment
    others: dict[str, Collection[str]] = {
        "a value of the world": environment.world,
        "a sensor": environment.sensors,
        "a constant": names.spec.constants,
        "a definition": names.definitions,
    }
    for kind, its_names in others.items():
        if target in its_names:
            return f"{target} is {kind}, and an action cannot set it", ""
    near = nearest(target, environment.state) or _set_by_all_others(path, names)
    hint = f'; did you mean "{near}"?' if near else ""
    return f'"{target}" is not state{hint}', near


def _set_by_all_others(path: Path, names: Names) -> str:
    """Return the only state that the other actions of a behavior set, '' if there is none or more."""
    match path:
        case ("behaviors", str(behavior), "actions", str(own), *_):
            actions = names.spec.behaviors[behavior].actions
            effects = {key for action, sets in actions.items() if action != own for key in sets}
            state = effects & names.spec.environment.state.keys()
            return next(iter(state)) if len(state) == 1 else ""
    return ""
