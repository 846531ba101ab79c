"""An episode, step by step and robot after robot, as the language's reference tells it."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cache, partial, reduce
from operator import add
from typing import TYPE_CHECKING

from bbsd.expression.syntax.parsing import parse
from bbsd.expression.syntax.tree import Name
from bbsd.kernel.functions import divide
from bbsd.language.field_types import Expression
from tests.interpreter.cells import choices, labels, partitions, sensed
from tests.interpreter.draws import draws_of_episode
from tests.interpreter.expressions import (
    Definition,
    Moment,
    Scope,
    Value,
    evaluate,
    taken_apart,
    with_element,
)

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from bbsd.language.models import Spec
    from tests.interpreter.made_up_outside import Given, MadeUpWorld

NOBODY = -1


@dataclass
class Step:
    """What happened in one step: who controlled each robot, its terms, and the values after it.

    And whether what its controlling behavior expects holds; None where that is nothing.
    """

    controlling: list[int]
    terms: list[list[float]]
    expectations: list[bool | None]
    values: dict[str, list[Value]]


@dataclass
class Result:
    """What an episode brought: credit has one entry for each behavior and a last one for nobody."""

    return_: float
    credit: list[float]
    terms: list[float]
    steps: int = 0
    held: dict[str, int] = field(default_factory=dict)
    """By behavior that expects something: the robot-steps that it controlled and after which that held."""
    controlled: list[int] = field(default_factory=list)
    """Robot-steps by behavior, the last one nobody's."""
    trace: list[Step] = field(default_factory=list)


@dataclass(frozen=True)
class Design:
    """An architecture: a table for each behavior, and the behaviors of the layers, the lowest first."""

    tables: Sequence[Sequence[int]]
    structure: Sequence[int]


@dataclass(frozen=True)
class Episode:
    """What does not change in an episode."""

    spec: Spec
    constants: Mapping[str, Value]
    definitions: Mapping[str, Definition]
    key: int
    world: MadeUpWorld | None = None
    """The world, where it is stepped in Python."""

    @property
    def robots(self) -> range:
        return range(self.spec.environment.robots)

    def scope(self, place: str, expression: Expression, robot: int, moment: Moment) -> Scope:
        """What an expression at a place of the spec sees."""
        draw = draws_of_episode(place, expression.tree, robot, moment.step, self.key)
        return Scope(
            moment, len(self.robots), robot, draw, self.definitions, choices=choices(self.spec.environment)
        )

    def evaluate(self, place: str, expression: Expression, robot: int, moment: Moment) -> Value:
        return evaluate(expression.tree, self.scope(place, expression, robot, moment))

    def fixed(self) -> dict[str, Value]:
        """What is the same for all robots at all times."""
        sizes = {"robots": self.spec.environment.robots, "steps": self.spec.environment.steps}
        return {**self.constants, **{name: float(size) for name, size in sizes.items()}}


def definitions(spec: Spec) -> dict[str, Definition]:
    """The definitions by name, without what stands in parentheses."""
    found = {}
    for head, expression in spec.environment.definitions.items():
        name, _, parameters = head.replace(" ", "").rstrip(")").partition("(")
        found[name] = Definition(tuple(parameters.split(",")) if parameters else (), expression.tree)
    return found


def run_episode(
    spec: Spec,
    constants: Mapping[str, Value],
    tables: Sequence[Sequence[int]],
    structure: Sequence[int],
    lane_key: int,
    world: MadeUpWorld | None = None,
) -> Result:
    """One episode of a design; all that it draws follows from lane_key."""
    episode = Episode(spec, constants, definitions(spec), lane_key, world)
    design = Design(tables, structure)
    result = Result(0.0, [0.0] * (len(spec.behaviors) + 1), [0.0] * len(spec.reward))
    result.controlled = [0] * (len(spec.behaviors) + 1)
    result.held = {name: 0 for name, behavior in spec.behaviors.items() if behavior.expects is not None}
    moment = start(episode)
    for step in range(1, spec.environment.steps + 1):
        snapshot = replace(moment, step=step, before=None)
        controlling = [controls(episode, design, snapshot, robot) for robot in episode.robots]
        acted = act(episode, design, snapshot, controlling)
        given, is_over = outside(episode, acted)
        moved = move(episode, acted)
        moment = sense(episode, changed(moved, given, before=moved.before))
        terms = [reward_terms(episode, moment, robot) for robot in episode.robots]
        account(result, controlling, terms)
        result.steps = step
        came = [expectation(episode, moment, *pair) for pair in zip(controlling, episode.robots, strict=True)]
        count(result, list(spec.behaviors), controlling, came)
        result.trace.append(Step(controlling, terms, came, seen(episode, moment)))
        if is_over or ended(episode, moment):
            break
    mean_over_robots(result, float(len(episode.robots)))
    return result


def start(episode: Episode) -> Moment:
    """Starting values and sensors, each computed when another first asks for it."""
    environment, fixed = episode.spec.environment, episode.fixed()
    given = episode.world.begin() if episode.world else {}

    @cache
    def value(name: str, robot: int) -> Value:
        if name in fixed:
            return fixed[name]
        if (name, robot) in given:
            return given[name, robot]
        now = Moment(value)
        if name in environment.world:
            return episode.evaluate(f"environment.world.{name}", environment.world[name], 0, now)
        if name in environment.state:
            return episode.evaluate(f"environment.state.{name}", environment.state[name], robot, now)
        return sensor(episode, name, robot, now)

    return settled(episode, Moment(value))


def sensor(episode: Episode, name: str, robot: int, moment: Moment) -> Value:
    """What a robot's sensor shows."""
    return sensed(
        episode.spec.environment.sensors[name],
        f"environment.sensors.{name}",
        partial(scope_of, episode, robot, moment),
    )


def scope_of(episode: Episode, robot: int, moment: Moment, place: str, expression: Expression) -> Scope:
    """What an expression sees, for `sensed`."""
    return episode.scope(place, expression, robot, moment)


def controls(episode: Episode, design: Design, snapshot: Moment, robot: int) -> int:
    """The behavior of the highest layer that is excited and whose cell is not No Action, or NOBODY."""
    behaviors = list(episode.spec.behaviors.items())
    for index in reversed(design.structure):
        name, behavior = behaviors[index]
        place, condition = f"behaviors.{name}.excited", behavior.excited
        excited = condition is None or episode.evaluate(place, condition, robot, snapshot)
        if excited and decision(episode, design, snapshot, robot, index) != 0:
            return index
    return NOBODY


def decision(episode: Episode, design: Design, snapshot: Moment, robot: int, index: int) -> int:
    """What a behavior's table says in the cell that a robot is in."""
    name, behavior = list(episode.spec.behaviors.items())[index]
    row = 0
    for given, partition in partitions(behavior, episode.spec).items():
        if isinstance(behavior.inputs, dict):
            place = f"behaviors.{name}.inputs.{given}"
            cell = sensed(partition, place, partial(scope_of, episode, robot, snapshot))
        else:
            cell = snapshot.value(given, robot)
        names = labels(partition, episode.constants)
        row = row * len(names) + (names.index(cell) if isinstance(cell, str) else int(cell))
    return design.tables[index][row]


def act(episode: Episode, design: Design, snapshot: Moment, controlling: Sequence[int]) -> Moment:
    """The controlling actions, all from the snapshot; what they do not set stays."""
    assigned = {}
    for robot, index in zip(episode.robots, controlling, strict=True):
        if index != NOBODY:
            name, behavior = list(episode.spec.behaviors.items())[index]
            number = decision(episode, design, snapshot, robot, index)
            action, settings = list(behavior.actions.items())[number - 1]
            for key, expression in settings.items():
                place = f"behaviors.{name}.actions.{action}.{key}"
                value = episode.evaluate(place, expression, robot, snapshot)
                state, at = key_of(episode, place, key, robot, snapshot)
                held = assigned.get((state, robot), snapshot.value(state, robot))
                assigned[state, robot] = with_element(held, at, value)
    return changed(snapshot, assigned, before=snapshot)


def key_of(episode: Episode, place: str, key: str, robot: int, snapshot: Moment) -> tuple[str, list[Value]]:
    """The state that a key of an action names, and its indices; what the k-th draws stands at the place and [k]."""
    of, indices = taken_apart(parse(key))
    assert isinstance(of, Name)
    at = [
        episode.evaluate(f"{place}[{number}]", Expression("", index), robot, snapshot)
        for number, index in enumerate(indices)
    ]
    return of.name, at


def outside(episode: Episode, acted: Moment) -> tuple[Given, bool]:
    """What an environment in Python gives when it is told the state after the actions, and whether it ends."""
    if episode.world is None:
        return {}, False
    names = episode.world.sent_names
    return episode.world.step(
        {(name, robot): float(acted.value(name, robot)) for name in names for robot in episode.robots}
    )


def move(episode: Episode, moment: Moment) -> Moment:
    """The dynamics, all at once."""
    moved = {}
    for name, expression in episode.spec.environment.dynamics.items():
        for robot in episode.robots:
            owner = 0 if name in episode.spec.environment.world else robot
            moved[name, robot] = episode.evaluate(f"environment.dynamics.{name}", expression, owner, moment)
    return changed(moment, moved, before=moment.before)


def sense(episode: Episode, moment: Moment) -> Moment:
    """The sensors again, of the values after the dynamics."""

    @cache
    def value(name: str, robot: int) -> Value:
        if name in episode.spec.environment.sensors:
            return sensor(episode, name, robot, replace(moment, value=value))
        return moment.value(name, robot)

    return settled(episode, replace(moment, value=value))


def settled(episode: Episode, moment: Moment) -> Moment:
    """The same moment, all its values worked out."""
    names = [*episode.fixed(), *seen_names(episode)]
    values = {(name, robot): moment.value(name, robot) for name in names for robot in episode.robots}
    return replace(moment, value=lambda name, robot: values[name, robot])


def seen_names(episode: Episode) -> list[str]:
    environment = episode.spec.environment
    given = [*episode.world.sizes, "earned"] if episode.world else []
    return [*environment.world, *environment.state, *given, *environment.sensors]


def changed(moment: Moment, values: Mapping[tuple[str, int], Value], before: Moment | None) -> Moment:
    """A moment with some values replaced."""

    def value(name: str, robot: int) -> Value:
        return values[name, robot] if (name, robot) in values else moment.value(name, robot)

    return replace(moment, value=value, before=before)


def reward_terms(episode: Episode, moment: Moment, robot: int) -> list[float]:
    return [
        episode.evaluate(f"reward.{term}", expression, robot, moment)
        for term, expression in episode.spec.reward.items()
    ]


def account(result: Result, controlling: Sequence[int], terms: Sequence[Sequence[float]]) -> None:
    """Add a step's reinforcement to the return, to the credit of what controlled, and to each term's."""
    earned = [reduce(add, of_robot) for of_robot in terms]
    result.return_ += reduce(add, earned)
    for index, each in zip(controlling, earned, strict=True):
        result.credit[index] += each
    for of_robot in terms:
        for number, term in enumerate(of_robot):
            result.terms[number] += term


def expectation(episode: Episode, moment: Moment, index: int, robot: int) -> bool | None:
    """Whether what the behavior that controlled a robot expects holds after the step."""
    name, behavior = "", None
    if index != NOBODY:
        name, behavior = list(episode.spec.behaviors.items())[index]
    if behavior is None or behavior.expects is None:
        return None
    return bool(episode.evaluate(f"behaviors.{name}.expects", behavior.expects, robot, moment))


def count(
    result: Result, names: Sequence[str], controlling: Sequence[int], came: Sequence[bool | None]
) -> None:
    """Count who controlled, and where what it expects held."""
    for index, held in zip(controlling, came, strict=True):
        result.controlled[index] += 1
        if held:
            result.held[names[index]] += 1


def mean_over_robots(result: Result, n_robots: float) -> None:
    """The team's reinforcement is the mean of the robots'; taken once, of an episode's sums."""
    result.return_ = divide(result.return_, n_robots)
    result.credit = [divide(each, n_robots) for each in result.credit]
    result.terms = [divide(each, n_robots) for each in result.terms]


def ended(episode: Episode, moment: Moment) -> bool:
    ends = episode.spec.environment.ends
    return ends is not None and episode.evaluate("environment.ends", ends, 0, moment)


def seen(episode: Episode, moment: Moment) -> dict[str, list[Value]]:
    """All values of a moment, for the trace."""
    return {name: [moment.value(name, robot) for robot in episode.robots] for name in seen_names(episode)}
