"""What all parts of a rollout's text share: names, what is kept from step to step, and how leaves are read."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum
from functools import cached_property
from typing import TYPE_CHECKING, cast

from bbsd.compiler.emission import Block, Blocks, Emitter
from bbsd.compiler.looping import Loops
from bbsd.compiler.naming import Namer, slot_text
from bbsd.expression.graph import Kind, Level, Node, needed

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from bbsd.compiler.tables import TableShape
    from bbsd.spec.meaning import Meaning
    from bbsd.spec.meaning.episode import Episode
    from bbsd.spec.meaning.names import Slot


class Detail(Enum):
    """What a rollout tells besides returns and credit, as its function's name."""

    CREDIT = "rollout"
    TERMS = "rollout_detailed"
    TRACE = "rollout_traced"


@dataclass
class Frame:
    """One rollout function while it is written.

    What is kept from step to step lies in one scratch array of numbers and one of integers, cut into lanes: slices of
    one array vectorize, separate arrays might overlap as far as LLVM knows.
    """

    meaning: Meaning
    shapes: Sequence[TableShape]
    lanes: int
    detail: Detail
    tables: dict[str, str] = field(default_factory=dict)
    """Tables with an entry for each robot, source and name: they stand before the function."""
    namer: Namer = field(default_factory=Namer)
    numbers: list[str] = field(default_factory=list)
    integers: list[str] = field(default_factory=list)
    own_numbers: list[str] = field(default_factory=list)
    own_integers: list[str] = field(default_factory=list)
    """Those of each robot, where there are loops over robots."""
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
        return slot_text((stem, robot, ()), self.robots)

    def keep(self, wanted: str, kind: Kind = Kind.NUMBER, level: Level = Level.LANE) -> str:
        """An array of a value in every lane, or in every lane of each robot; truths are kept as 0 and 1."""
        return self._kept(self.namer(wanted), kind, level)

    def keep_numbered(self, stem: str, kind: Kind, level: Level) -> str:
        """The same by the stem and the first number that is free."""
        return self._kept(self.namer.numbered(stem), kind, level)

    def _kept(self, name: str, kind: Kind, level: Level) -> str:
        if level is Level.EACH and self.looped:
            arrays = self.own_integers if kind is Kind.CELL else self.own_numbers
        else:
            arrays = self.integers if kind is Kind.CELL else self.numbers
        arrays.append(name)
        return name

    def keep_own(self, wanted: str, kind: Kind = Kind.NUMBER) -> str:
        """An array of what each robot has of its own."""
        return self.keep(wanted, kind, Level.EACH)

    def at(self, array: str) -> str:
        """An array's element of the present lane and robot."""
        return f"{array}[own + lane]" if self.is_own(array) else f"{array}[lane]"

    def is_own(self, array: str) -> bool:
        """Whether an array holds a value of each robot."""
        return array in self.own_numbers or array in self.own_integers

    def store(self, array: str, text: str, kind: Kind, index: str = "") -> str:
        """The line that keeps a value: truths as 0 and 1."""
        kept = self.call_of("select", text, "1.0", "0.0") if kind is Kind.TRUTH else text
        return f"{f'{array}[{index}]' if index else self.at(array)} = {kept}"

    def scratch(self) -> list[str]:
        """The arrays of all that is kept: the team's in one piece of memory, the robots' in another.

        Few pieces, so that LLVM has few ranges to compare before it vectorizes a loop.
        """
        team = [("key", "streams"), *_kinds("", self.numbers, self.integers)]
        lines = [
            f"numbers = np.zeros({len(team) * self.lanes}, np.float64)",
            "streams = numbers.view(np.uint64)",
            *(["cells = numbers.view(np.int64)"] if self.integers else []),
            *(f"{name} = {view}[{self._span(k)}]" for k, (name, view) in enumerate(team)),
        ]
        return [*lines, *self._own_scratch()] if self.looped else lines

    def _own_scratch(self) -> list[str]:
        own = _kinds("own_", self.own_numbers, self.own_integers)
        stride = len(own) * self.lanes
        return [
            f"stride = {stride}",
            f"own_numbers = np.zeros({stride * self.team}, np.float64)",
            *(["own_cells = own_numbers.view(np.int64)"] if self.own_integers else []),
            *(f"{name} = {view}[{k * self.lanes}:]" for k, (name, view) in enumerate(own)),
        ]

    def _span(self, place: int) -> str:
        return f"{place * self.lanes}:{(place + 1) * self.lanes}"

    def lane_loop(self, lines: Iterable[str]) -> list[str]:
        """Lines done for every lane."""
        return [f"for lane in range({self.lanes}):", *indented(lines, 1)]

    def robot_loop(self, before: Iterable[str], loops: Iterable[Iterable[str]]) -> list[str]:
        """Lines done once for every robot, and then bodies of loops over its lanes."""
        inner = ["own = robot * stride", *before, *(line for body in loops for line in self.lane_loop(body))]
        return [f"for robot in range({self.team}):", *indented(inner, 1)]

    def emitter(self, step: str, *, hinted: bool = True) -> Emitter:
        """An emitter with fresh blocks for a step and a lane."""
        blocks = Blocks(self.call, self.looped)
        hints = self._hints if hinted else {}
        return Emitter(self.namer, Loops(self), self._leaf, "key[lane]", step, hints, blocks, self.used)

    def slot_of(self, node: Node) -> str:
        """The array of a slot that is read."""
        return self.slots[cast("Slot", node.data)]

    @cached_property
    def slots(self) -> dict[Slot, str]:
        """The arrays of the slots that a later step reads."""
        read = {node.data: node.level for node in needed(self.outputs) if node.operation == "slot"}
        return {
            slot: self.keep(slot_text(slot, self.robots), node.kind, read[slot])
            for slot, node in self.episode.after.items()
            if slot in read
        }

    @cached_property
    def outputs(self) -> list[Node]:
        """What a step computes: what is asked for, and every slot that this reads in a later step, and so on."""
        episode = self.episode
        wanted = [
            node for module in episode.modules for nodes in (module.excited, *module.cells) for node in nodes
        ]
        wanted += [node for nodes in episode.reward.values() for node in nodes]
        wanted += [] if episode.ends is None else [episode.ends]
        if self.detail is not Detail.CREDIT:
            wanted += [node for node in episode.after.values() if node.kind is Kind.NUMBER]
            wanted += [node for nodes in episode.expects.values() for node in nodes]
        if self.detail is Detail.TRACE:
            wanted += [*episode.after.values(), *self.traced_definitions.values()]
        kept: set[Slot] = set()
        while True:
            every = [*wanted, *(episode.after[slot] for slot in episode.after if slot in kept)]
            read = {cast("Slot", node.data) for node in needed(every) if node.operation == "slot"}
            if read == kept:
                return every
            kept = read

    @property
    def traced_definitions(self) -> dict[Slot, Node]:
        """The definitions that a trace shows."""
        return {
            slot: node for slot, node in self.episode.definitions.items() if node.kind is not Kind.UNKNOWN
        }

    @cached_property
    def _hints(self) -> dict[int, str]:
        """Names for nodes, the more telling one where a value means several things."""
        episode = self.episode
        return {
            node.number: "_".join(part for part in (prefix, slot_text(slot, self.robots)) if part)
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

    def _leaf(self, node: Node) -> str:
        match node.operation:
            case "slot":
                kept = self.at(self.slot_of(node))
                return f"({kept} != 0.0)" if node.kind is Kind.TRUTH else kept
            case "step":
                return "float(step)"
            case "start":
                return "float(key[lane])"
        return self._constant(node)

    def _constant(self, node: Node) -> str:
        if node.number not in self.call.names:
            name = self.namer(self._constant_names[cast("int", node.data)])
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


def _kinds(prefix: str, numbers: Iterable[str], integers: Iterable[str]) -> list[tuple[str, str]]:
    """Arrays, each with the view of the memory that it is a part of."""
    return [
        *((name, f"{prefix}numbers") for name in numbers),
        *((name, f"{prefix}cells") for name in integers),
    ]


def indented(lines: Iterable[str], depth: int) -> list[str]:
    """Lines deeper by so many levels."""
    return [f"{'    ' * depth}{line}" for line in lines]


def _places(value: object, place: tuple[int, ...] = ()) -> list[tuple[int, ...]]:
    if isinstance(value, tuple):
        return [found for index, item in enumerate(value) for found in _places(item, (*place, index))]
    return [place]
