"""What the C of a design computes: its members, and the statements that start a robot and take a step."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

from bbsd.architecture.needs import ACTED, BEFORE, plain_name
from bbsd.architecture.sayings import mapping_text, one_line, start_text
from bbsd.exports.sensing.emission import PLAIN, Emitter, Reading
from bbsd.exports.sensing.naming import Namer
from bbsd.exports.sensing.team import Team
from bbsd.exports.sensing.text import number
from bbsd.exports.sensing.values import Member, Values, values_of
from bbsd.expression.graph import needed
from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import Slot
from bbsd.language.field_types import Expression, signature
from bbsd.language.meaning.partitions import is_partition

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator, Mapping, Sequence

    from bbsd.architecture.controller import Controller
    from bbsd.architecture.needs import Needs
    from bbsd.expression.node_data import RobotDraws
    from bbsd.expression.scope import Value
    from bbsd.language.meaning import Meaning

LOCALS = ("inputs", "memory", "outputs", "robot", "step", "action")
"""The names that every function uses."""
STANDARD = {
    "chance": "uniform from 0 up to, not including, 1",
    "integers": "uniform from 0 up to, not including, 1",
    "uniform": "uniform from 0 up to, not including, 1",
    "normal": "normal with mean 0 and standard deviation 1",
}
"""What the random number is of which a draw is made."""


@dataclass
class Program:
    """The statements of a design, for whichever robot of the team runs them."""

    meaning: Meaning
    controller: Controller
    needs: Needs
    constants: Sequence[float]
    measured: Collection[str] = ()
    draws: dict[RobotDraws, Member] = field(default_factory=dict)
    """The names of the random numbers that the robot must be given."""
    constant_lines: dict[str, str] = field(default_factory=dict)
    """Declarations of the constants that are read, by their names."""
    tables: dict[str, tuple[str, str]] = field(default_factory=dict)
    """By its name in the spec, the name and the declaration of a constant from which elements are picked."""

    @cached_property
    def team(self) -> Team:
        """What merges the nodes of all robots."""
        return Team(len(self.needs.robots))

    @cached_property
    def emitter(self) -> Emitter:
        """What writes nodes."""
        reading = Reading(self._place, self._random, self._constant, self._table)
        hints, comments = self._hints()
        return Emitter(reading, hints, comments)

    @cached_property
    def namer(self) -> Namer:
        """Names within functions, of which constants are given theirs first."""
        namer = Namer()
        for name in LOCALS:
            namer(name)
        return namer

    # --- Members

    @cached_property
    def input_namer(self) -> Namer:
        """Names of what the robot is given."""
        return Namer()

    @cached_property
    def inputs(self) -> Values:
        """What the robot is given."""
        of_team = frozenset(each.name for each in self.needs.given if each.of_team)
        slots = [slot for each in self.needs.given for slot in each.slots]
        n_robots, comments = len(self.needs.robots), self._given_comments()
        return values_of(slots, self._kinds, self.input_namer, n_robots, of_team, comments)

    @cached_property
    def memory(self) -> Values:
        """What the robot keeps."""
        kept = [(robot, slot) for robot, needs in enumerate(self.needs.robots) for slot in needs.next]
        of_team = frozenset(slot.name for robot, slot in kept if slot.robot not in (None, robot))
        slots = dict.fromkeys(_any_robots(slot) for _, slot in kept)
        comments = {slot.name: self._memory_comment(slot.name) for slot in slots}
        kinds = {slot: self.kind_of(slot) for slot in slots}
        return values_of(slots, kinds, Namer(), len(self.needs.robots), of_team, comments)

    @cached_property
    def outputs(self) -> Values:
        """What the robot's actions set."""
        slots = [Slot(name, 0, place) for name, place in self.needs.robots[0].held]
        return values_of(slots, self._kinds, Namer({*Namer().taken, "action"}))

    def kind_of(self, slot: Slot) -> Kind:
        """Return the kind of a value, at whichever moment."""
        return self._kinds[slot._replace(name=plain_name(slot.name))]

    @cached_property
    def _kinds(self) -> Mapping[Slot, Kind]:
        return {slot: node.kind for slot, node in self.meaning.episode.after.items()}

    def _given_comments(self) -> dict[str, str]:
        environment, comments = self.meaning.spec.environment, dict[str, str]()
        for each in self.needs.given:
            if each.block == "sensors":
                sensor = environment.sensors[each.name]
                written = one_line(sensor) if isinstance(sensor, Expression) else mapping_text(sensor)
                comments[each.name] = f"sensor{self._numbers_of(each.name)}: {written}"
                if is_partition(sensor):
                    labels = ", ".join(f"{k}: {cell}" for k, cell in enumerate(self._cells(each.name)))
                    comments[each.name] = f"cell of the sensor, {labels}: {written}"
            else:
                whose = "of each robot of the team" if each.of_team else "of the robot"
                what = "of the world" if each.block == "world" else f"state {whose}"
                comments[each.name] = what + self._numbers_of(each.name)
        return comments

    @property
    def named(self) -> dict[str, tuple[str, ...]]:
        """The names of the values that the robot is given, keeps or sets, by what has them."""
        used = {each.name for each in self.needs.given}
        used |= {plain_name(slot.name) for robot in self.needs.robots for slot in robot.next}
        used |= {name for name, _ in self.needs.robots[0].held}
        return {name: names for name, names in self.meaning.episode.named.items() if name in used}

    def _numbers_of(self, name: str) -> str:
        """Return what the numbers of a value with names mean; nothing for other values."""
        names = self.meaning.episode.named.get(plain_name(name), ())
        return "".join(f", {number}: {each}" for number, each in enumerate(names))

    def draws_itself(self, name: str) -> bool:
        """Return whether a value is given as it is a sensor that draws."""
        nodes = [node for slot, node in self.meaning.episode.after.items() if slot.name == name]
        is_sensor = name in self.meaning.spec.environment.sensors
        return (
            is_sensor
            and name not in self.measured
            and any(each.operation == "draw" for each in needed(nodes))
        )

    def n_cells(self, sensor: str) -> int:
        """Return the number of cells of a sensor that is a partition."""
        return len(self.meaning.episode.partitions[sensor])

    def _cells(self, sensor: str) -> Sequence[str]:
        return [str(cell) for cell in self.meaning.episode.partitions[sensor]]

    def _memory_comment(self, name: str) -> str:
        if name.startswith(BEFORE):
            return f"{plain_name(name)} at the step before{self._numbers_of(name)}"
        return start_text(self.meaning.spec.environment.state[name])

    # --- How leaves are read

    def _place(self, slot: Slot, robot: str) -> str:
        if slot.name.startswith(ACTED):
            return (
                f"outputs->{self.outputs.place(Slot(plain_name(slot.name), slot.robot, slot.place), robot)}"
            )
        if (given := self.inputs.place(slot, robot)) is not None:
            if self._kinds[slot] is Kind.CELL:
                self.emitter.used.add("bbsd_clamp_cell")
                return f"bbsd_clamp_cell(inputs->{given}, {self.n_cells(slot.name) - 1})"
            return f"inputs->{given}"
        return f"memory->{self.memory.place(slot, robot)}"

    def _random(self, draw: RobotDraws) -> str:
        if draw not in self.draws:
            identifier = self.input_namer.numbered("random")
            self.draws[draw] = Member(identifier, Kind.NUMBER, comment=STANDARD[draw.distribution])
        return f"inputs->{self.draws[draw].identifier}"

    def _constant(self, place: int) -> str:
        name = self._constant_names[place]
        self.constant_lines[name] = f"const double {name} = {number(self.constants[place]).source};"
        return name

    def _table(self, place: int) -> tuple[str, int]:
        first, size, name = next(
            (first, size, name)
            for first, size, name in self._constant_ranges
            if first <= place < first + size
        )
        if name not in self.tables:
            values = ", ".join(number(value).source for value in self.constants[first : first + size])
            identifier = self.namer(f"{name}_table")
            self.tables[name] = identifier, f"static const double {identifier}[{size}] = {{{values}}};"
        return self.tables[name][0], place - first

    @cached_property
    def _constant_names(self) -> list[str]:
        return [
            self.namer("_".join([name, *map(str, place)]))
            for name, value in self.meaning.constants.values.items()
            for place in _places(value)
        ]

    @cached_property
    def _constant_ranges(self) -> list[tuple[int, int, str]]:
        ranges, first = list[tuple[int, int, str]](), 0
        for name, value in self.meaning.constants.values.items():
            size = len(list(_places(value)))
            ranges.append((first, size, name))
            first += size
        return ranges

    # --- Names and comments for values

    def _hints(self) -> tuple[dict[int, str], dict[str, str]]:
        """Return names for nodes, by number, and what the spec says under these names."""
        environment = self.meaning.spec.environment
        hints, comments = dict[int, str](), dict[str, str]()
        written = {signature(key)[0]: one_line(text) for key, text in environment.definitions.items()}
        for name, sensor in environment.sensors.items():
            written[name] = one_line(sensor) if isinstance(sensor, Expression) else mapping_text(sensor)
        for slot in self.needs.named:
            if slot.robot != 0:
                continue
            family = [self.needs.named[slot._replace(robot=robot)] for robot in range(len(self.needs.robots))]
            node = self.team.node(family)
            if node.operation not in PLAIN and node.number not in hints:
                name = hints[node.number] = "_".join([slot.name, *map(str, slot.place)])
                if slot.name not in comments and not any(slot.place):
                    comments[name] = f"{slot.name}: {written[slot.name]}"
        return hints, comments


def _any_robots(slot: Slot) -> Slot:
    return slot if slot.robot is None else slot._replace(robot=0)


def _places(value: Value, place: tuple[int, ...] = ()) -> Iterator[tuple[int, ...]]:
    """Yield the places of all numbers in a nested tuple."""
    if isinstance(value, tuple):
        for at, item in enumerate(value):
            yield from _places(item, (*place, at))
    else:
        yield place
