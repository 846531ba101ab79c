"""What all parts of a rollout's text share: names, what is kept from step to step, and how leaves are read."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

from bbsd.compiler.details import Detail, traced_definitions
from bbsd.compiler.passes.outputs import credit_outputs, with_slots_read
from bbsd.compiler.writing.blocks import Block, Blocks
from bbsd.compiler.writing.emission import Emitter
from bbsd.compiler.writing.looping import Loops
from bbsd.compiler.writing.memory import Memory
from bbsd.compiler.writing.naming import Namer
from bbsd.compiler.writing.precedence import ATOM, COMPARISON, Text
from bbsd.expression.graph import Level, Node, needed
from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import Slot

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from bbsd.compiler.tables import TableShape
    from bbsd.language.meaning import Meaning
    from bbsd.language.meaning.episode import Episode

OWN = (Level.ROBOT, Level.EACH)
"""The levels of what each robot has of its own."""


@dataclass
class RolloutFunction:
    """One rollout function while it is written."""

    meaning: Meaning
    shapes: Sequence[TableShape]
    lanes: int
    detail: Detail
    proven: tuple[Node, ...] = ()
    """Truths that must hold; where one does not, the episode must be run again in detail."""
    tables: dict[str, str] = field(default_factory=dict)
    """Tables with an entry for each robot, source and name: they stand before the function."""
    namer: Namer = field(default_factory=Namer)
    memory: Memory = field(default_factory=Memory)
    used: set[str] = field(default_factory=set)
    """Functions of the kernel that the text calls."""
    call: Block = field(default_factory=lambda: Block(Level.CALL))

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

    def call_of(self, function: str, *arguments: str) -> str:
        """The text of a call of a kernel's function."""
        self.used.add(function)
        return f"{function}({', '.join(arguments)})"

    def robots_name(self, stem: str, robot: int) -> str:
        """A name for something of one robot."""
        return Slot(stem, robot).text(self.robots)

    def keep(self, wanted: str, kind: Kind = Kind.NUMBER, level: Level = Level.LANE) -> str:
        """An array of a value in every lane, or in every lane of each robot."""
        return self._kept(self.namer(wanted), kind, level)

    def keep_numbered(self, stem: str, kind: Kind, level: Level) -> str:
        """The same by the stem and the first number that is free."""
        return self._kept(self.namer.numbered(stem), kind, level)

    def _kept(self, name: str, kind: Kind, level: Level) -> str:
        return self.memory.add(name, kind, own=self.looped and level in OWN)

    def is_own(self, array: str) -> bool:
        """Whether an array holds a value of each robot."""
        return self.memory.is_own(array)

    def at(self, array: str) -> str:
        """An array's element of the present lane and robot."""
        return f"{array}[own + lane]" if self.is_own(array) else f"{array}[lane]"

    def read(self, array: str, kind: Kind, index: str = "") -> Text:
        """What an array holds, of the present lane and robot or at an index; truths are kept as 0 and 1."""
        element = f"{array}[{index}]" if index else self.at(array)
        return (f"{element} != 0.0", COMPARISON) if kind is Kind.TRUTH else (element, ATOM)

    def store(self, array: str, text: str, kind: Kind, index: str = "") -> str:
        """The line that puts a value there."""
        kept = self._as_number(text) if kind is Kind.TRUTH else text
        return f"{f'{array}[{index}]' if index else self.at(array)} = {kept}"

    def _as_number(self, truth: str) -> str:
        known = {"True": "1.0", "False": "0.0"}
        return known.get(truth) or self.call_of("select", truth, "1.0", "0.0")

    @property
    def size(self) -> int:
        """How many numbers all that is kept takes."""
        return self.memory.size(self.lanes, self.team)

    def scratch(self) -> list[str]:
        """The lines that set up the memory of all that is kept."""
        self.used |= self.memory.functions
        own = self.memory.own_lines(self.lanes, self.team) if self.looped else []
        return [*self.memory.lines(self.lanes), *own]

    def lane_loop(self, lines: Iterable[str]) -> list[str]:
        """Lines done for every lane."""
        return [f"for lane in range({self.lanes}):", *indented(lines, 1)]

    def robot_loop(self, before: Iterable[str], loops: Iterable[Iterable[str]]) -> list[str]:
        """Lines done once for every robot, and then bodies of loops over its lanes."""
        inner = ["own = robot * stride", *before, *(line for body in loops for line in self.lane_loop(body))]
        return [f"for robot in range({self.team}):", *indented(inner, 1)]

    def pair_loop(self, head: Iterable[str], loops: Iterable[Iterable[str]], *, others: bool) -> list[str]:
        """Lines and then bodies of loops over lanes, done for every robot that the present one looks at."""
        looked = f"pair + {self.call_of('cell_of', 'robot <= pair')}" if others else "pair"
        inner = [f"other = {looked}", "theirs = other * stride", *head]
        inner += [line for body in loops for line in self.lane_loop(body)]
        return [f"for pair in range({self.team - others}):", *indented(inner, 1)]

    def emitter(self, step: str, *, hinted: bool = True) -> Emitter:
        """An emitter with fresh blocks for a step and a lane."""
        blocks = Blocks(self.call, self.looped)
        hints = self._hints if hinted else {}
        return Emitter(self.namer, Loops(self), self._leaf, "key[lane]", step, hints, blocks, self.used)

    def slot_of(self, node: Node) -> str:
        """The array of a slot that is read."""
        return self.slots[node.slot]

    @cached_property
    def slots(self) -> dict[Slot, str]:
        """The arrays of the slots that a later step reads."""
        read = {node.slot: node.level for node in needed(self.outputs) if node.operation == "slot"}
        return {
            slot: self.keep(slot.text(self.robots), node.kind, read[slot])
            for slot, node in self.episode.after.items()
            if slot in read
        }

    @cached_property
    def outputs(self) -> list[Node]:
        """What a step computes: what is asked for, and every slot that this reads in a later step, and so on."""
        episode = self.episode
        wanted = [*credit_outputs(episode), *self.proven]
        if self.detail is not Detail.CREDIT:
            wanted += [node for node in episode.after.values() if node.kind is Kind.NUMBER]
            wanted += [node for nodes in episode.expects.values() for node in nodes]
        if self.detail is Detail.TRACE:
            wanted += [*episode.after.values(), *traced_definitions(episode).values()]
        return with_slots_read(wanted, episode)

    @cached_property
    def _hints(self) -> dict[int, str]:
        """Names for nodes, the more telling one where a value means several things."""
        episode = self.episode
        return {
            node.number: "_".join(part for part in (prefix, slot.text(self.robots)) if part)
            for prefix, group in (
                ("acted", episode.acted),
                ("", episode.definitions),
                ("next", episode.after),
            )
            for slot, node in group.items()
            if not node.literal and node.operation not in ("slot", "constant", "step")
        }

    @cached_property
    def running(self) -> str | None:
        """The array that is 1 while a lane's episode goes on; None where episodes do not end early."""
        return None if self.episode.ends is None else self.keep("running_")

    @cached_property
    def uncertain(self) -> str | None:
        """The array that is 1 once something of a lane was uncertain; None where nothing can be."""
        return self.keep("uncertain") if self.proven else None

    def while_running(self, text: str, otherwise: str = "0.0") -> str:
        """A value, or 0 once the lane's episode is over."""
        return (
            text
            if self.running is None
            else self.call_of("select", f"{self.running}[lane] > 0.0", text, otherwise)
        )

    @cached_property
    def actions(self) -> list[str]:
        """The names of the controlling action's number, robot by robot."""
        return [self.namer(self.robots_name("action", robot)) for robot in range(self.robots)]

    def _leaf(self, node: Node) -> Text:
        match node.operation:
            case "slot":
                return self.read(self.slot_of(node), node.kind)
            case "step":
                return "float(step)", ATOM
            case "start":
                return "float(key[lane])", ATOM
        return self._constant(node), ATOM

    def _constant(self, node: Node) -> str:
        if node.number not in self.call.names:
            name = self.namer(self._constant_names[node.index])
            self.call.lines.append(f"{name} = constants[{node.data}]")
            self.call.names[node.number] = name
        return self.call.names[node.number]

    @cached_property
    def _constant_names(self) -> list[str]:
        return [
            "_".join([name, *(str(part) for part in place)])
            for name, value in self.meaning.constants.values.items()
            for place in _places(value)
        ]


def indented(lines: Iterable[str], depth: int) -> list[str]:
    """Lines deeper by so many levels."""
    return [f"{'    ' * depth}{line}" for line in lines]


def _places(value: object, place: tuple[int, ...] = ()) -> list[tuple[int, ...]]:
    if isinstance(value, tuple):
        return [found for index, item in enumerate(value) for found in _places(item, (*place, index))]
    return [place]
