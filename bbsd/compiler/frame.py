"""What all parts of a rollout's text share: names, what is kept from step to step, and how leaves are read."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum
from functools import cached_property
from typing import TYPE_CHECKING, cast

from bbsd.compiler.emission import Block, Emitter
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
    namer: Namer = field(default_factory=Namer)
    numbers: list[str] = field(default_factory=list)
    integers: list[str] = field(default_factory=list)
    used: set[str] = field(default_factory=set)
    """Functions of the kernel that the text calls."""
    call: Block = field(default_factory=lambda: Block(Level.CALL))

    @property
    def episode(self) -> Episode:
        """The graph of the episode."""
        return self.meaning.episode

    @property
    def robots(self) -> int:
        """The number of robots."""
        return self.meaning.spec.environment.robots

    def call_of(self, function: str, *arguments: str) -> str:
        """The text of a call of a kernel's function."""
        self.used.add(function)
        return f"{function}({', '.join(arguments)})"

    def robots_name(self, stem: str, robot: int) -> str:
        """A name for something of one robot."""
        return slot_text((stem, robot, ()), self.robots)

    def keep(self, wanted: str) -> str:
        """An array of a number in every lane."""
        self.numbers.append(self.namer(wanted))
        return self.numbers[-1]

    def keep_integer(self, wanted: str) -> str:
        """An array of a whole number in every lane."""
        self.integers.append(self.namer(wanted))
        return self.integers[-1]

    def scratch(self) -> list[str]:
        """The arrays of all that is kept."""
        lines = [f"key = np.zeros({self.lanes}, np.uint64)"]
        for array, kind, names in (
            ("numbers", "np.float64", self.numbers),
            ("cells", "np.int64", self.integers),
        ):
            lines += [f"{array} = np.zeros({len(names) * self.lanes}, {kind})"] if names else []
            lines += [
                f"{name} = {array}[{k * self.lanes}:{(k + 1) * self.lanes}]" for k, name in enumerate(names)
            ]
        return lines

    def lane_loop(self, lines: Iterable[str]) -> list[str]:
        """Lines done for every lane."""
        return [f"for lane in range({self.lanes}):", *indented(lines, 1)]

    def emitter(self, step: str, *, hinted: bool = True) -> Emitter:
        """An emitter with fresh blocks for a step and a lane."""
        blocks = {Level.CALL: self.call, Level.STEP: Block(Level.STEP), Level.LANE: Block(Level.LANE)}
        return Emitter(
            self.namer, self._leaf, "key[lane]", step, self._hints if hinted else {}, blocks, self.used
        )

    @cached_property
    def slots(self) -> dict[Slot, str]:
        """The arrays of the slots that a later step reads."""
        read = {node.data for node in needed(self.outputs) if node.operation == "slot"}
        return {
            slot: (self.keep_integer if node.kind is Kind.CELL else self.keep)(slot_text(slot, self.robots))
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
                kept = f"{self.slots[cast('Slot', node.data)]}[lane]"
                return f"({kept} != 0.0)" if node.kind is Kind.TRUTH else kept
            case "step":
                return "float(step)"
            case "start":
                return "float(key[lane])"
            case "choice":
                return self.actions[cast("int", node.data)]
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


def indented(lines: Iterable[str], depth: int) -> list[str]:
    """Lines deeper by so many levels."""
    return [f"{'    ' * depth}{line}" for line in lines]


def _places(value: object, place: tuple[int, ...] = ()) -> list[tuple[int, ...]]:
    if isinstance(value, tuple):
        return [found for index, item in enumerate(value) for found in _places(item, (*place, index))]
    return [place]
