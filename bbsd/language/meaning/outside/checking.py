"""Mistakes in the use of an environment that is stepped in Python, found without importing anything."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.errors import did_you_mean
from bbsd.expression.kinds import Kind
from bbsd.expression.syntax.mistakes import KEY
from bbsd.language.field_types import signature
from bbsd.language.meaning.outside.exchange import names_outside
from bbsd.language.outside import EARNED, OUTSIDE_KINDS

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping

    from bbsd.expression.scope import Findings, Path
    from bbsd.language.meaning.forms import Form
    from bbsd.language.models import Environment, Spec
    from bbsd.language.outside import Outside

OF_OUTSIDE = ("with", "observation", "action")
"""Keys that only an environment stepped in Python has."""


def report_outside(spec: Spec, findings: Findings) -> bool:
    """Report mistakes in the use of the keys of an environment in Python; return whether its names can be known."""
    environment = spec.environment
    kinds = [kind for kind in OUTSIDE_KINDS if getattr(environment, kind) is not None]
    for second in kinds[1:]:
        message = f"the world is already named by {kinds[0]}"
        advice = "keep one of gymnasium, pettingzoo and python; what a spec extends is taken away by null"
        findings.report(("environment", second), "BB101", message, KEY, advice)
    outside = environment.outside
    if outside is None:
        return _report_own(environment, findings)
    _report_missing(environment, kinds[0], findings)
    _report_mixed(environment, findings)
    _report_actions(spec, outside, findings)
    if outside.kind == "gymnasium" and environment.robots > 1:
        message = f"a Gymnasium environment has one robot, not {environment.robots}"
        advice = (
            "several robots are the agents of a PettingZoo environment: pettingzoo: mpe2.simple_spread_v3"
        )
        findings.report(("environment", "robots"), "BB111", message, advice=advice)
    return bool(outside.fields)


def _report_own(environment: Environment, findings: Findings) -> bool:
    """Report keys without effect on a world of the spec's own; return whether there are none that make names."""
    values = environment.values_by_key()
    for key in OF_OUTSIDE:
        if values[key]:
            message = f"{key} is of a world that is stepped in Python, and this world is the spec's own"
            advice = (
                "name that world, such as gymnasium: CartPole-v1; or write state, dynamics and sensors alone"
            )
            findings.report(("environment", key), "BB105", message, KEY, advice)
    return not environment.observation


def _report_missing(environment: Environment, kind: str, findings: Findings) -> None:
    for key, what in (("observation", "names for what it shows"), ("action", "the state that it is told")):
        if not environment.values_by_key()[key]:
            message = f'an environment in Python needs the key "{key}": {what}'
            advice = "bbsd spaces SPEC --allow-import NAME shows what it has, and proposes names"
            findings.report(("environment", kind), "BB104", message, KEY, advice)


def _report_mixed(environment: Environment, findings: Findings) -> None:
    """Report the first field that is written in another way than those before it: sizes and paths do not mix."""
    observation = environment.observation
    fields = list(observation.items()) if isinstance(observation, dict) else []
    for name, source in fields:
        if isinstance(source, str) != isinstance(fields[0][1], str):
            ways = ("a path", "a size") if isinstance(source, str) else ("a size", "a path")
            message = f"{name} has {ways[0]}, and {fields[0][0]} has {ways[1]}"
            advice = "sizes take a discrete observation apart, paths lead into a mapping: give one or the other to all"
            findings.report(("environment", "observation", name), "BB109", message, advice=advice)
            return


def _report_actions(spec: Spec, outside: Outside, findings: Findings) -> None:
    is_one = isinstance(spec.environment.action, str)
    for index, name in enumerate(outside.actions):
        path: Path = ("environment", "action") if is_one else ("environment", "action", index)
        if name in outside.actions[:index]:
            findings.report(
                path, "BB106", f"{name} is listed twice", advice="each number that is sent has a state"
            )
        elif name not in spec.environment.state:
            message, advice = _no_state(name, spec), f"add state: {{{name}: 0}}, which behaviors' actions set"
            findings.report(path, "BB106", message, advice=advice)


def _no_state(name: str, spec: Spec) -> str:
    environment = spec.environment
    others: dict[str, Collection[str]] = {
        "an observation": [other for other in names_outside(environment) if other != EARNED],
        "what the environment rewards": [EARNED],
        "a value of the world": environment.world,
        "a sensor": environment.sensors,
        "a constant": spec.constants,
        "a definition": [names[0] for names in map(signature, environment.definitions) if names],
        "a behavior": spec.behaviors,
    }
    for kind, its_names in others.items():
        if name in its_names:
            return f"{name} is {kind}; what is sent is a robot's state"
    return f'"{name}" is not state{did_you_mean(name, environment.state)}'


def report_sent(outside: Outside | None, forms: Mapping[str, Form], findings: Findings) -> None:
    """Report state that is sent though it is a truth or a list: what is sent are numbers."""
    for name in outside.actions if outside else ():
        form = forms.get(name)
        if form and form.lengths:
            message, advice = (
                f"{name} is {form.text}, and what is sent are numbers",
                "send its elements as states",
            )
            findings.report(("environment", "state", name), "BB106", message, advice=advice)
        elif form and form.kind is Kind.TRUTH:
            message = f"{name} is a truth, and what is sent are numbers"
            findings.report(("environment", "state", name), "BB106", message, advice="start it with 0 or 1")
