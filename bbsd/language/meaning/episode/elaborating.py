"""What happens in an episode: the start, and one step from decision to end, as one graph.

The phases are those of the language's definition: decide and act from one snapshot, dynamics from the values
after the actions with the sensors of the snapshot, then new sensors, reward and end. Since every value is a
node, what a phase reads is just which nodes its names stand for.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from bbsd.expression.graph import Level
from bbsd.expression.kinds import Kind
from bbsd.expression.syntax.mistakes import KEY
from bbsd.language.meaning.episode.acting import act, apply_dynamics, modules_at
from bbsd.language.meaning.episode.episode import Episode
from bbsd.language.meaning.episode.outcome import (
    definitions_at,
    ends_at,
    expectations_at,
    named_values,
    reward_at,
    scalars_defined,
)
from bbsd.language.meaning.episode.perceiving import Perceived, SensorFault, decision_perceived
from bbsd.language.meaning.episode.picture import Picture, elaborate_picture
from bbsd.language.meaning.episode.starting import forms_of, report_lengths_by_robot, starting_values
from bbsd.language.meaning.episode.stored import decision_at, slots_of_sensors, slots_of_state, slots_read
from bbsd.language.meaning.moments import Moment
from bbsd.language.meaning.outside.checking import report_sent
from bbsd.language.meaning.outside.exchange import fractions_outside, rows_of_outside, rows_of_sent

if TYPE_CHECKING:
    from bbsd.language.meaning.naming.names import Names, Stored

MAX_ACTIONS_IN_ALL = 50_000
"""An action's number, counted over all behaviors, has 16 bits in a kernel."""


def elaborate_episode(names: Names, fault: SensorFault | None = None) -> Episode | None:
    """Return what happens in an episode of a spec; None where a behavior could not be understood.

    The order of evaluation numbers the nodes, and with that fixes the kernel's text. With the fault of a sensor
    behaviors perceive something else than what is true, which is stored beside it.
    """
    first = starting_values(names)
    beginning = Moment(names, first, names.graph.number(0), starting=True)

    report_lengths_by_robot(first, beginning)
    now = slots_read(first, names)
    decision = decision_at(now, beginning, names)
    forms = forms_of(first)
    report_sent(names.spec.environment.outside, forms, names.findings)
    felt = None if fault is None else Perceived(names, first, names.graph.number(0), fault, starting=True)
    perceived = decision if felt is None else decision_perceived(now, felt, names)
    modules = tuple(modules_at(names, perceived, forms))
    if sum(len(module.actions) for module in modules) > MAX_ACTIONS_IN_ALL:
        message = f"more than {MAX_ACTIONS_IN_ALL} actions in all"
        names.findings.report(("behaviors",), "BB038", message, KEY)
    choices = tuple(names.graph.leaf("choice", robot, Kind.CELL, Level.LANE) for robot in names.robots)

    acted = act(now, modules, choices, names)
    acting = Moment(names, acted, names.step, sensed=decision.sensed, before=decision.scope)
    then = apply_dynamics(acted, acting.scope, forms, names)

    outcome = Moment(names, then, names.step, before=decision.scope)
    defined = definitions_at(outcome)
    episode = Episode(
        modules,
        start=slots_of_state(first, names) | slots_of_sensors(beginning),
        acted=slots_of_state(acted, names),
        after=slots_of_state(then, names) | slots_of_sensors(outcome),
        definitions=scalars_defined(defined),
        choices=choices,
        reward=reward_at(outcome),
        ends=ends_at(outcome),
        partitions={
            name: partition.cells
            for (name, robot), partition in beginning.sensed.partitions.items()
            if partition and not robot
        },
        expects=expectations_at(outcome, decision),
        picture=_picture(first, beginning, names),
        outside=rows_of_outside(names.spec.environment),
        sent=rows_of_sent(names.spec.environment),
        fractions=fractions_outside(names.spec.environment),
        named=named_values(first, beginning.sensed.values, defined),
    )
    if felt is not None and fault is not None:
        after = Perceived(names, then, names.step, fault, before=perceived.scope).slots()
        episode = replace(episode, start={**episode.start, **felt.slots()}, after={**episode.after, **after})
    return episode if len(modules) == len(names.spec.behaviors) else None


def _picture(first: Stored, beginning: Moment, names: Names) -> Picture | None:
    """Return what is drawn, in a fork of the graph: a view changes nothing of what is computed."""
    if names.spec.view is None:
        return None
    forked = replace(names, graph=names.graph.fork())
    return elaborate_picture(names.spec.view, decision_at(slots_read(first, forked), beginning, forked))
