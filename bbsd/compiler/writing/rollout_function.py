"""What all parts of a rollout's source share: names, arrays kept from step to step, and how leaves are read."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from math import prod
from typing import TYPE_CHECKING

from bbsd.compiler.details import IN_DETAIL, Detail, traced_definitions
from bbsd.compiler.passes.outputs import credit_outputs, slots_read, with_slots_read
from bbsd.compiler.writing.blocks import Block
from bbsd.compiler.writing.memory import Memory
from bbsd.compiler.writing.naming import Namer
from bbsd.compiler.writing.precedence import COMPARISON, Text, call, infix, name_text, sum_of
from bbsd.compiler.writing.schedule import FIRST
from bbsd.expression.graph import Level, Node
from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import ListShape, Slot

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from bbsd.compiler.tables import TableShape
    from bbsd.expression.scope import Plain
    from bbsd.language.meaning import Meaning
    from bbsd.language.meaning.episode.episode import Episode

OWN = (Level.ROBOT, Level.EACH)
"""The levels of values that each robot has of its own."""
ZERO, ONE = Text("0.0"), Text("1.0")


@dataclass
class RolloutFunction:
    """One rollout function while it is written."""

    meaning: Meaning
    shapes: Sequence[TableShape]
    lanes: int
    detail: Detail
    to_prove: tuple[Node, ...] = ()
    """Truths that must hold; where one does not, the episode must be run again in detail."""
    observed: tuple[Node, ...] = ()
    """What another program observes of a world before each choice: values of the snapshot."""
    tables: dict[str, str] = field(default_factory=dict)
    """Tables with an entry for each robot, their source and name: they stand before the function."""
    namer: Namer = field(default_factory=Namer)
    memory: Memory = field(default_factory=Memory)
    used: set[str] = field(default_factory=set)
    """Functions of the kernel that the source calls."""
    call: Block = field(default_factory=lambda: Block(Level.CALL))
    """What is computed once a call."""

    @property
    def episode(self) -> Episode:
        """The graph of the episode."""
        return self.meaning.episode

    @property
    def robots(self) -> int:
        """The number of robots that are written one after the other: 1 where there are loops over robots."""
        return len(self.episode.choices)

    @property
    def team(self) -> int:
        """The number of robots."""
        return self.meaning.spec.environment.robots

    @property
    def looped(self) -> bool:
        """Whether there are loops over robots."""
        return self.robots < self.team

    def call_of(self, function: str, *arguments: Text) -> Text:
        """Return the source of a call of a kernel's function."""
        self.used.add(function)
        return call(function, arguments)

    def robots_name(self, stem: str, robot: int) -> str:
        """Return a name for a value of one robot."""
        return Slot(stem, robot).text(self.robots)

    def keep(self, name: str, kind: Kind = Kind.NUMBER, level: Level = Level.LANE, length: int = 1) -> str:
        """Add an array for a value or a list in every lane, or in every lane of each robot; return its name."""
        return self._kept(self.namer(name), kind, level, length)

    def keep_numbered(self, stem: str, kind: Kind, level: Level) -> str:
        """Add an array that is named by the stem and the first number that is free; return its name."""
        return self._kept(self.namer.numbered(stem), kind, level)

    def _kept(self, name: str, kind: Kind, level: Level, length: int = 1) -> str:
        return self.memory.add(name, kind, own=self.looped and level in OWN, length=length)

    def is_own(self, array: str) -> bool:
        """Return whether an array holds a value of each robot."""
        return self.memory.is_own(array)

    def at(self, array: str) -> str:
        """Return an array's element of the present lane and robot."""
        return f"{array}[own + lane]" if self.is_own(array) else f"{array}[lane]"

    def in_list(self, array: str, offset: Text) -> str:
        """Return an element of an array that keeps a list, of the present lane and robot."""
        first = [Text("own")] if self.is_own(array) else []
        return f"{array}[{sum_of([*first, offset, Text('lane')]).source}]"

    def read(self, array: str, kind: Kind = Kind.NUMBER, index: Text | None = None) -> Text:
        """Return an array's value of the present lane and robot, or at an index; truths are kept as 0 and 1."""
        element = Text(self.at(array)) if index is None else Text(f"{array}[{index.source}]", uses=index.uses)
        return as_read(element, kind)

    def as_stored(self, text: Text, kind: Kind) -> Text:
        """Return a value as arrays keep it."""
        if kind is not Kind.TRUTH:
            return text
        literals = {"True": ONE, "False": ZERO}
        return literals.get(text.source) or self.call_of("select", text, ONE, ZERO)

    @property
    def size(self) -> int:
        """The number of numbers that all arrays take."""
        return self.memory.size(self.lanes, self.team)

    def scratch(self) -> list[str]:
        """Return the lines that set up the arrays."""
        self.used |= self.memory.functions
        own = self.memory.own_lines(self.lanes, self.team) if self.looped else []
        return [*self.memory.lines(self.lanes), *own]

    def lane_loop(self, lines: Iterable[str]) -> list[str]:
        """Return a loop that does lines for every lane."""
        return [f"for lane in range({self.lanes}):", *indent(lines, 1)]

    def robot_loop(self, before: Iterable[str], bodies: Iterable[Iterable[str]]) -> list[str]:
        """Return a loop that does lines, and then loops over lanes with these bodies, for every robot."""
        inner = ["own = robot * stride", *before, *(line for body in bodies for line in self.lane_loop(body))]
        return [f"for robot in range({self.team}):", *indent(inner, 1)]

    def pair_loop(self, before: Iterable[str], bodies: Iterable[Iterable[str]], *, others: bool) -> list[str]:
        """Return a loop that does lines, and then loops over lanes, for every robot that the present one looks at."""
        other = f"pair + {self.call_of('cell_of', Text('robot <= pair')).source}" if others else "pair"
        inner = [f"other = {other}", "theirs = other * stride", *before]
        inner += [line for body in bodies for line in self.lane_loop(body)]
        return [f"for pair in range({self.team - others}):", *indent(inner, 1)]

    def slot_of(self, node: Node) -> str:
        """Return the array of a slot that is read."""
        return self.slots[node.slot]

    @cached_property
    def slots(self) -> dict[Slot, str]:
        """The arrays of the slots that a later step reads."""
        read = slots_read(self.outputs)
        return {
            slot: self.keep(slot.text(self.robots), node.kind, read[slot], length_of(node))
            for slot, node in self.episode.after.items()
            if slot in read
        }

    @cached_property
    def outputs(self) -> list[Node]:
        """What a step computes: what is asked for, and every slot that this reads in a later step, and so on."""
        episode = self.episode
        outputs = [*credit_outputs(episode), *self.to_prove, *self.observed]
        if self.detail in IN_DETAIL:
            outputs += [node for node in episode.after.values() if node.kind is Kind.NUMBER]
            outputs += [node for nodes in episode.expects.values() for node in nodes]
        if self.detail is Detail.TRACE:
            outputs += [*episode.after.values(), *traced_definitions(episode).values()]
        return with_slots_read(outputs, episode)

    @cached_property
    def hints(self) -> dict[int, str]:
        """Names for nodes, by number; the more telling one where a value means several things."""
        episode = self.episode
        return {
            node.number: "_".join(part for part in (prefix, slot.text(self.robots)) if part)
            for prefix, group in (
                ("acted", episode.acted),
                ("", episode.definitions),
                ("next", episode.after),
            )
            for slot, node in group.items()
            if not node.literal and node.operation not in ("slot", "constant", "step", "list_after")
        }

    @cached_property
    def running(self) -> str | None:
        """The array that is 1 while a lane's episode goes on; None where episodes do not end early."""
        return None if self.episode.ends is None else self.keep("running_")

    @cached_property
    def uncertain(self) -> str | None:
        """The array that is 1 once a truth of a lane did not hold; None where there is nothing to prove."""
        return self.keep("uncertain") if self.to_prove else None

    def while_running(self, text: Text, otherwise: Text = ZERO) -> Text:
        """Return a value, or another one once the lane's episode is over."""
        if self.running is None:
            return text
        return self.call_of("select", infix(">", self.read(self.running), ZERO), text, otherwise)

    @property
    def first_stage(self) -> int:
        """The stage of a step in which the first loop over its robots stands."""
        return FIRST[Level.EACH if self.looped else Level.LANE]

    def chosen(self, robot: int) -> str:
        """Return the element that keeps a robot's choice between the phases of a step."""
        return f"chosen[{'robot' if self.looped else robot}, lane]"

    @cached_property
    def actions(self) -> list[str]:
        """The names of the controlling action's number, robot by robot."""
        return [self.namer(self.robots_name("action", robot)) for robot in range(self.robots)]

    def leaf(self, node: Node) -> Text:
        """Return the source of a slot, a constant, the step or the key."""
        match node.operation:
            case "slot":
                return self.read(self.slot_of(node), node.kind)
            case "step":
                return Text("float(step)")
            case "start":
                return Text("float(key[lane])")
            case "outside":
                element = f"outside[{self._outside_rows[node.slot]}, lane]"
                return as_read(Text(element), node.kind)
        return self._constant(node)

    @cached_property
    def _outside_rows(self) -> dict[Slot, int]:
        return {slot: row for row, slot in enumerate(self.episode.outside)}

    def _constant(self, node: Node) -> Text:
        if node.number not in self.call.names:
            name = self.namer(self._constant_names[node.index])
            self.call.define(name, Text(f"constants[{node.data}]"), node=node)
        return name_text(self.call.names[node.number])

    @cached_property
    def _constant_names(self) -> dict[int, str]:
        """The names of scalars by their positions; columns of numbers, which stand between, have none."""
        return {
            node.index: "_".join([name, *map(str, place)])
            for name, leaves in self.meaning.constants.leaves.items()
            for place, node in _elements(leaves)
        }


def length_of(node: Node) -> int:
    """Return how many elements a slot keeps for every lane, given its next value: 1 where it is no list."""
    return prod(node.data.lengths) if isinstance(node.data, ListShape) else 1


def as_read(element: Text, kind: Kind) -> Text:
    """Return an element of an array as the value that it holds: truths are kept as 0 and 1."""
    return Text(f"{element.source} != 0.0", COMPARISON, element.uses) if kind is Kind.TRUTH else element


def indent(lines: Iterable[str], depth: int) -> list[str]:
    """Return lines deeper by so many levels."""
    return [f"{'    ' * depth}{line}" for line in lines]


def _elements(leaves: Plain, place: tuple[int, ...] = ()) -> Iterator[tuple[tuple[int, ...], Node]]:
    """Yield all leaves in a nested tuple with their places."""
    if isinstance(leaves, tuple):
        for at, item in enumerate(leaves):
            yield from _elements(item, (*place, at))
    else:
        yield place, leaves
