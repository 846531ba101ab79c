"""One rollout per spec: the source of a function that runs an episode for a batch of lanes, as `docs/rollout.md` describes.

The loop over steps is outside, the loop over lanes inside, and its body is straight and free of branches, so it
vectorizes. A lane is an agent in an episode.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from enum import Enum
from functools import cached_property

from bbsd import __version__
from bbsd.compiler.emission import Block, Emitter
from bbsd.compiler.naming import Namer, slot_text
from bbsd.compiler.tables import TableShape
from bbsd.expression.graph import Kind, Level, Node, needed
from bbsd.kernel import functions, streams
from bbsd.spec.meaning import Meaning
from bbsd.spec.meaning.names import Slot

ACTION_BITS = 16
"""A priority is the layer shifted by so many bits, plus what makes a choice the action's number."""


class Detail(Enum):
    """What a rollout tells besides returns and credit."""

    CREDIT = "rollout"
    TERMS = "rollout_detailed"
    TRACE = "rollout_traced"


ARGUMENTS = (
    "first", "last", "keys", "individuals", "words", "tables", "origins", "priorities", "constants", "returns", "credit",
)  # fmt: skip
DETAILED = ("terms", "control", "taken", "odd")


def module_source(meaning: Meaning, shapes: Sequence[TableShape], lanes: int, details: Sequence[Detail]) -> str:
    """The source of a module with a rollout for each detail asked for."""
    made = [Rollout(meaning, tuple(shapes), lanes, detail) for detail in details]
    texts = [rollout.text() for rollout in made]
    used = set().union(*(rollout.used for rollout in made)) | {"select"}
    title = f'"""Episodes of {meaning.spec.name!r}, {lanes} at a time. Written by bbsd {__version__} from the spec."""'
    imports = [
        "import numpy as np",
        *_imports("bbsd.kernel.functions", sorted(used & vars(functions).keys())),
        *_imports("bbsd.kernel.streams", sorted(used & vars(streams).keys() - vars(functions).keys())),
    ]
    return "\n\n".join([title, "\n".join(imports), *(f"\n{text}" for text in texts)]) + "\n"


def _imports(module: str, names: Sequence[str]) -> list[str]:
    return [f"from {module} import {', '.join(names)}"] if names else []


def traced_columns(meaning: Meaning) -> list[tuple[str, Slot]]:
    """The columns of a trace after `step`: what each holds, and whose it is."""
    episode, robots = meaning.episode, range(meaning.spec.environment.robots)
    return [
        *(("slot", slot) for slot in episode.after),
        *(("definition", slot) for slot, node in episode.definitions.items() if node.kind is not Kind.UNKNOWN),
        *(("choice", ("controlling", robot, ())) for robot in robots),
        *(("reward", (term, robot, ())) for term in episode.reward for robot in robots),
    ]


@dataclass
class Rollout:
    """The text of one rollout function, made block by block."""

    meaning: Meaning
    shapes: tuple[TableShape, ...]
    lanes: int
    detail: Detail

    def __post_init__(self) -> None:
        self.namer = Namer()
        self.episode = self.meaning.episode
        self.robots = self.meaning.spec.environment.robots
        self.numbers: list[str] = []
        self.integers: list[str] = []
        self.used: set[str] = set()
        self.call = Block(Level.CALL)

    # Names of what is kept from step to step: one scratch array of numbers and one of integers, cut into lanes.

    def _kept(self, wanted: str, *, integer: bool = False) -> str:
        name = self.namer(wanted)
        (self.integers if integer else self.numbers).append(name)
        return name

    @cached_property
    def slots(self) -> dict[Slot, str]:
        """The arrays of the slots that a later step reads, or that a trace shows."""
        read = {node.data for node in needed(self._outputs(everything=True)) if node.operation == "slot"}
        return {
            slot: self._kept(slot_text(slot, self.robots), integer=node.kind is Kind.CELL)
            for slot, node in self.episode.after.items()
            if slot in read
        }

    def _outputs(self, *, everything: bool) -> list[Node]:
        """What a step computes; the slots to be kept depend on what is read, until nothing more is."""
        episode = self.episode
        wanted = [node for behavior in episode.modules for nodes in (behavior.excited, *behavior.cells) for node in nodes]
        wanted += [node for nodes in episode.reward.values() for node in nodes]
        wanted += [episode.ends] if episode.ends is not None else []
        if self.detail is Detail.TRACE:
            wanted += self._traced_nodes()
        if self.detail is not Detail.CREDIT:
            wanted += [node for node in episode.after.values() if node.kind is Kind.NUMBER]
        kept: set[Slot] = set()
        while everything:
            read = {node.data for node in needed([*wanted, *(episode.after[slot] for slot in kept)]) if node.operation == "slot"}
            if read == kept:
                break
            kept = read  # type: ignore[assignment]
        return wanted + [episode.after[slot] for slot in sorted(kept, key=list(episode.after).index)]

    def _traced_nodes(self) -> list[Node]:
        definitions = [node for node in self.episode.definitions.values() if node.kind is not Kind.UNKNOWN]
        return [*self.episode.after.values(), *definitions]

    @cached_property
    def hints(self) -> dict[int, str]:
        """Names for nodes, the more telling one where a value means several things."""
        episode, found = self.episode, {}
        for prefix, group in (("acted", episode.acted), ("", episode.definitions), ("next", episode.after)):
            for slot, node in group.items():
                if not node.literal and node.operation not in ("slot", "constant", "step"):
                    found[node.number] = "_".join(part for part in (prefix, slot_text(slot, self.robots)) if part)
        return found

    def emitter(self, step: str, hints: dict[int, str] | None = None) -> Emitter:
        """An emitter with fresh blocks for a step and a lane."""
        blocks = {Level.CALL: self.call, Level.STEP: Block(Level.STEP), Level.LANE: Block(Level.LANE)}
        hints = self.hints if hints is None else hints
        return Emitter(self.namer, self._leaf, "key[lane]", step, hints, blocks, self.used)

    def _leaf(self, node: Node) -> str:
        match node.operation:
            case "slot":
                kept = f"{self.slots[node.data]}[lane]"  # type: ignore[index]
                return f"({kept} != 0.0)" if node.kind is Kind.TRUTH else kept
            case "step":
                return "float(step)"
            case "choice":
                return self.choices[int(str(node.data))]
        return self._constant(node)

    def _constant(self, node: Node) -> str:
        if node.number not in self.call.names:
            name = self.namer(self.constant_names[int(str(node.data))])
            self.call.lines.append(f"{name} = constants[{node.data}]")
            self.call.names[node.number] = name
        return self.call.names[node.number]

    @cached_property
    def constant_names(self) -> list[str]:
        """What each scalar of the constants is called."""
        return [
            "_".join([name, *(str(part) for part in place)])
            for name, value in self.meaning.constants.values.items()
            for place in _places(value)
        ]

    @cached_property
    def choices(self) -> list[str]:
        """The names of the controlling action's number, robot by robot."""
        return [self.namer(slot_text(("action", robot, ()), self.robots)) for robot in range(self.robots)]

    # The text.

    def text(self) -> str:
        """The whole function."""
        start = self._start()
        step = self._step()
        finish = self._finish()
        arguments = [*ARGUMENTS, *(DETAILED if self.detail is not Detail.CREDIT else ())]
        arguments += ["record"] if self.detail is Detail.TRACE else []
        steps = self.meaning.spec.environment.steps
        return "\n".join(
            [
                f"def {self.detail.value}({', '.join(arguments)}):",
                *_indent(self._scratch(), 1),
                *_indent(self.call.lines, 1),
                f"    for base in range(first, last, {self.lanes}):",
                *_indent(start, 2),
                f"        for step in range(1, {steps + 1}):",
                *_indent(step, 3),
                *_indent(finish, 2),
            ]
        )

    def _scratch(self) -> list[str]:
        lines = []
        for array, kind, names in (("numbers", "np.float64", self.numbers), ("cells", "np.int64", self.integers)):
            if names:
                lines.append(f"{array} = np.zeros({len(names) * self.lanes}, {kind})")
            lines += [f"{name} = {array}[{k * self.lanes}:{(k + 1) * self.lanes}]" for k, name in enumerate(names)]
        return [f"key = np.zeros({self.lanes}, np.uint64)", *lines]

    def _lane_loop(self, lines: Iterable[str]) -> list[str]:
        return [f"for lane in range({self.lanes}):", *_indent(lines, 1)]

    def _start(self) -> list[str]:
        """The table, the priority and the starting values of every lane."""
        self.kept_tables = self._keep_tables()
        emitter = self.emitter("0", hints={})
        wanted = {slot: self.episode.start[slot] for slot in self.slots}
        emitter.prepare(wanted.values())
        stores = [f"{self.slots[slot]}[lane] = {_stored(emitter.value(node), node)}" for slot, node in wanted.items()]
        zeros = [f"{name}[lane] = 0.0" for name in self.totals]
        running = [f"{self.running}[lane] = 1.0"] if self.episode.ends is not None else []
        lane = emitter.blocks[Level.LANE].lines
        return [
            *emitter.blocks[Level.STEP].lines,
            *self._lane_loop(["key[lane] = keys[base + lane]", *self.kept_tables, *lane, *stores, *zeros, *running]),
        ]

    def _keep_tables(self) -> list[str]:
        lines = []
        for index, (behavior, shape) in enumerate(zip(self.episode.modules, self.shapes, strict=True)):
            priority, table = self.table_names[index]
            individual = f"individuals[{index}, base + lane]"
            lines.append(f"{priority}[lane] = priorities[{index}, base + lane]")
            if shape.packed:
                lines.append(f"{table}[lane] = words[{index}, {individual}]")
            else:
                lines.append(f"{table}[lane] = origins[{index}] + {individual} * {behavior.n_cells}")
        return lines

    @cached_property
    def table_names(self) -> list[tuple[str, str]]:
        """For each behavior, the arrays of its priority and of its table (a word) or table's row."""
        return [
            (
                self._kept(f"priority_{behavior.name}", integer=True),
                self._kept(f"{'table' if shape.packed else 'row'}_{behavior.name}", integer=True),
            )
            for behavior, shape in zip(self.episode.modules, self.shapes, strict=True)
        ]

    @cached_property
    def running(self) -> str:
        """The array that is 1 while a lane's episode goes on."""
        return self._kept("running_", integer=False)

    @cached_property
    def credit_names(self) -> list[str]:
        """The arrays of each behavior's credit, the last one nobody's."""
        names = [behavior.name for behavior in self.episode.modules]
        return [self._kept(f"credit_{name}") for name in (*names, "nobody")]

    @cached_property
    def total(self) -> str:
        """The array of the return."""
        return self._kept("total")

    @cached_property
    def detail_names(self) -> dict[str, list[str]]:
        """Arrays of what a detailed rollout adds up, by the argument they are written to."""
        if self.detail is Detail.CREDIT:
            return {}
        names = [behavior.name for behavior in self.episode.modules]
        return {
            "terms": [self._kept(f"sum_{term}") for term in self.episode.reward],
            "control": [self._kept(f"steps_{name}") for name in (*names, "nobody")],
            "odd": [self._kept(f"odd_{slot_text(slot, self.robots)}") for slot in odd_slots(self.meaning)],
            "taken": [self._kept("taken_")],
        }

    @cached_property
    def totals(self) -> list[str]:
        """All arrays that start at 0 and are added to."""
        return [self.total, *self.credit_names, *(name for names in self.detail_names.values() for name in names)]

    def _step(self) -> list[str]:
        emitter = self.emitter("step")
        lane = emitter.blocks[Level.LANE].lines
        emitter.prepare(self._outputs(everything=True))
        lines = self._looked_up()
        lane.append("# Decide: the highest layer that is excited and whose cell is not No Action controls.")
        for robot in range(self.robots):
            self._decide(robot, emitter)
        lane.append("# Act, then dynamics and sensors.")
        next_values = self._next_values(emitter)
        lane.append("# Reward: each robot's share goes to what controlled it.")
        shares = self._rewards(emitter)
        self._credit(shares, lane)
        if self.detail is not Detail.CREDIT:
            self._details(emitter)
        if self.episode.ends is not None:
            ended = emitter.value(self.episode.ends)
            lane.append(f"{self.running}[lane] = {self._used('select')}({ended}, 0.0, {self.running}[lane])")
        if self.detail is Detail.TRACE:
            self._traced(emitter)
        lane += [f"{self.slots[slot]}[lane] = {_stored(text, self.episode.after[slot])}" for slot, text in next_values.items()]
        return [*emitter.blocks[Level.STEP].lines, *lines, *self._lane_loop(lane), *self._end_of_all()]

    def _next_values(self, emitter: Emitter) -> dict[Slot, str]:
        """What each slot will hold, by names that do not change while slots are stored one after the other."""
        found = {}
        for slot in self.slots:
            node = self.episode.after[slot]
            if node.operation == "slot" and node.data == slot:
                continue
            wanted = f"next_{slot_text(slot, self.robots)}"
            text = emitter.named(node, wanted)
            if node.operation == "slot":
                name = self.namer(wanted)
                emitter.blocks[Level.LANE].lines.append(f"{name} = {text}")
                text = name
            found[slot] = text
        return found

    def _used(self, function: str) -> str:
        self.used.add(function)
        return function

    def _looked_up(self) -> list[str]:
        """Tables too large for a word: their cells in one loop, the look-ups in another that does not vectorize."""
        emitter = self.emitter("step", hints={})
        places, looks = [], []
        nodes = [
            node for b, shape in enumerate(self.shapes) if not shape.packed for node in self._cell_nodes(b)
        ]
        emitter.prepare(nodes)
        for index, shape in enumerate(self.shapes):
            if shape.packed:
                continue
            row = self.table_names[index][1]
            for robot in range(self.robots):
                cell, choice = self.lookup_names[index, robot]
                places.append((cell, self._cell(index, robot, emitter)))
                looks.append(f"{choice}[lane] = tables[{row}[lane] + {cell}[lane]]")
        if not looks:
            return []
        stores = [f"{cell}[lane] = {text}" for cell, text in places]
        lane = [*emitter.blocks[Level.LANE].lines, *stores]
        return [*emitter.blocks[Level.STEP].lines, *self._lane_loop(lane), *self._lane_loop(looks)]

    @cached_property
    def lookup_names(self) -> dict[tuple[int, int], tuple[str, str]]:
        """For each behavior with a large table and each robot, the arrays of its cell and its choice."""
        return {
            (index, robot): (
                self._kept(slot_text((f"cell_{behavior.name}", robot, ()), self.robots), integer=True),
                self._kept(slot_text((f"choice_{behavior.name}", robot, ()), self.robots), integer=True),
            )
            for index, (behavior, shape) in enumerate(zip(self.episode.modules, self.shapes, strict=True))
            for robot in range(self.robots)
            if not shape.packed
        }

    def _cell_nodes(self, index: int) -> list[Node]:
        return [node for cells in self.episode.modules[index].cells for node in cells]

    def _cell(self, index: int, robot: int, emitter: Emitter) -> str:
        """The index of the table's cell: row-major over the inputs."""
        behavior = self.episode.modules[index]
        text = ""
        for node, labels in zip(behavior.cells[robot], behavior.inputs.values(), strict=True):
            part = emitter.operand(node, tight=bool(text))
            text = f"{_grouped(text)} * {len(labels)} + {part}" if text else part
        return text or "0"

    def _decide(self, robot: int, emitter: Emitter) -> None:
        lane = emitter.blocks[Level.LANE].lines
        bids = [self._bid(index, robot, emitter) for index in range(len(self.shapes))]
        highest = bids[0]
        for bid in bids[1:]:
            highest = f"{self._used('maximum')}({highest}, {bid})"
        mask = (1 << ACTION_BITS) - 1
        lane.append(f"{self.choices[robot]} = {self._used('maximum')}({highest}, 0) & {mask}")

    def _bid(self, index: int, robot: int, emitter: Emitter) -> str:
        """What a behavior bids for control: its priority and its choice; 0 where it is not activated."""
        behavior, shape = self.episode.modules[index], self.shapes[index]
        lane = emitter.blocks[Level.LANE].lines
        priority, table = self.table_names[index]
        if shape.packed:
            cell = self._cell(index, robot, emitter)
            shift = cell if shape.bits == 1 else f"{_grouped(cell)} * {shape.bits}"
            looked = f"{table}[lane] & {shape.mask}" if cell == "0" else f"({table}[lane] >> {_grouped(shift)}) & {shape.mask}"
        else:
            looked = f"{self.lookup_names[index, robot][1]}[lane]"
        choice = self.namer(slot_text((f"choice_{behavior.name}", robot, ()), self.robots))
        lane.append(f"{choice} = {looked}")
        excited = emitter.value(behavior.excited[robot])
        active = f"{choice} > 0" if excited == "True" else f"({choice} > 0) & ({excited})"
        bid = self.namer(slot_text((f"bid_{behavior.name}", robot, ()), self.robots))
        lane.append(f"{bid} = {self._used('select')}({active}, {priority}[lane] + {choice}, 0)")
        return bid

    def _rewards(self, emitter: Emitter) -> list[str]:
        """Each robot's share of the team's reinforcement, by name."""
        lane = emitter.blocks[Level.LANE].lines
        self.term_values = {
            (term, robot): emitter.named(nodes[robot], f"reward_{slot_text((term, robot, ()), self.robots)}")
            for robot in range(self.robots)
            for term, nodes in self.episode.reward.items()
        }
        shares = []
        for robot in range(self.robots):
            earned = " + ".join(self.term_values[term, robot] for term in self.episode.reward)
            share = f"{self._used('divide')}({earned}, {float(self.robots)})" if self.robots > 1 else earned
            if self.episode.ends is not None:
                share = f"{self._used('select')}({self.running}[lane] > 0.0, {share}, 0.0)"
            name = self.namer(slot_text(("share", robot, ()), self.robots))
            lane.append(f"{name} = {share}")
            shares.append(name)
        return shares

    def _controls(self, index: int, robot: int) -> str:
        """Whether a behavior (the last index: nobody) controls a robot."""
        action = self.choices[robot]
        if index == len(self.shapes):
            return f"{action} == 0"
        first = 1 + sum(len(behavior.actions) for behavior in self.episode.modules[:index])
        count = len(self.episode.modules[index].actions)
        return f"{action} == {first}" if count == 1 else f"({action} >= {first}) & ({action} < {first + count})"

    def _credit(self, shares: list[str], lane: list[str]) -> None:
        lane.append(f"{self.total}[lane] = {self.total}[lane] + {_sum(shares)}")
        for index, name in enumerate(self.credit_names):
            parts = [f"{self._used('select')}({self._controls(index, robot)}, {share}, 0.0)" for robot, share in enumerate(shares)]
            lane.append(f"{name}[lane] = {' + '.join([f'{name}[lane]', *parts])}")

    def _details(self, emitter: Emitter) -> None:
        """Sums by term, steps of control, steps taken, and values that are not finite."""
        lane = emitter.blocks[Level.LANE].lines
        weight = f"{self.running}[lane]" if self.episode.ends is not None else "1.0"
        lane.append("# What an evaluation adds up.")
        for term, name in zip(self.episode.reward, self.detail_names["terms"], strict=True):
            parts = [self._while_running(self._part(term, robot)) for robot in range(self.robots)]
            lane.append(f"{name}[lane] = {' + '.join([f'{name}[lane]', *parts])}")
        for index, name in enumerate(self.detail_names["control"]):
            parts = [f"{self._used('select')}({self._controls(index, robot)}, {weight}, 0.0)" for robot in range(self.robots)]
            lane.append(f"{name}[lane] = {' + '.join([f'{name}[lane]', *parts])}")
        for slot, name in zip(odd_slots(self.meaning), self.detail_names["odd"], strict=True):
            text = emitter.value(self.episode.after[slot])
            lane.append(f"{name}[lane] = {name}[lane] + {self._used('select')}({self._used('is_finite')}({text}), 0.0, {weight})")
        (taken,) = self.detail_names["taken"]
        lane.append(f"{taken}[lane] = {taken}[lane] + {weight}")

    def _part(self, term: str, robot: int) -> str:
        value = self.term_values[term, robot]
        return f"{self._used('divide')}({value}, {float(self.robots)})" if self.robots > 1 else value

    def _while_running(self, text: str) -> str:
        if self.episode.ends is None:
            return text
        return f"{self._used('select')}({self.running}[lane] > 0.0, {text}, 0.0)"

    def _traced(self, emitter: Emitter) -> None:
        lane = emitter.blocks[Level.LANE].lines
        for column, (what, slot) in enumerate(traced_columns(self.meaning)):
            name, robot, _ = slot
            if what == "choice":
                text = self.choices[robot or 0]
            elif what == "reward":
                text = self.term_values[name, robot or 0]
            else:
                group = self.episode.after if what == "slot" else self.episode.definitions
                text = emitter.value(group[slot])
            lane.append(f"record[step - 1, {column}] = {text}")

    def _end_of_all(self) -> list[str]:
        if self.episode.ends is None:
            return []
        return [f"if {self.running}.sum() == 0.0:", "    break"]

    def _finish(self) -> list[str]:
        lines = [f"returns[base + lane] = {self.total}[lane]"]
        lines += [f"credit[{index}, base + lane] = {name}[lane]" for index, name in enumerate(self.credit_names)]
        for argument, names in self.detail_names.items():
            for index, name in enumerate(names):
                place = "base + lane" if argument == "taken" else f"{index}, base + lane"
                lines.append(f"{argument}[{place}] = {name}[lane]")
        return self._lane_loop(lines)


def odd_slots(meaning: Meaning) -> list[Slot]:
    """The places at which a detailed rollout counts values that are not finite."""
    return [slot for slot, node in meaning.episode.after.items() if node.kind is Kind.NUMBER]


def _stored(text: str, node: Node) -> str:
    """What is kept of a value: truths as 0 and 1."""
    return f"select({text}, 1.0, 0.0)" if node.kind is Kind.TRUTH else text


def _grouped(text: str) -> str:
    """The text as an operand of whatever binds more tightly."""
    return f"({text})" if " + " in text or " * " in text else text


def _sum(shares: Sequence[str]) -> str:
    return shares[0] if len(shares) == 1 else f"({' + '.join(shares)})"


def _indent(lines: Iterable[str], depth: int) -> list[str]:
    return [f"{'    ' * depth}{line}" for line in lines]


def _places(value: object, place: tuple[int, ...] = ()) -> list[tuple[int, ...]]:
    if isinstance(value, tuple):
        return [found for index, item in enumerate(value) for found in _places(item, (*place, index))]
    return [place]
