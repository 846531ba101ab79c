"""What a rollout for practice does besides: robots stray from their tables, and what they were asked is recorded."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from itertools import accumulate
from typing import TYPE_CHECKING

from bbsd.compiler.joint import HASH_BITS
from bbsd.compiler.writing.precedence import SIGN, Text, grouped, infix, sum_of, times
from bbsd.expression.graph import Level
from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import TOP_BIT
from bbsd.expression.operations import BINDING
from bbsd.kernel.streams import name_word
from bbsd.language.meaning.tables.table import OPEN_CELL

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

    from bbsd.compiler.joint import JointPartition
    from bbsd.compiler.writing.blocks import Block
    from bbsd.compiler.writing.emission import Emitter
    from bbsd.compiler.writing.rollout_function import RolloutFunction
    from bbsd.compiler.writing.schedule import Closing

PRACTICE = ("open_cells", "rates", "asked", "joint_cells", "gains", "steps_taken")
"""The arguments that a rollout for practice has besides."""
RECORDS = ("asked", "joint_cells", "gains")
"""Those of them that have a part for each step; the last one is known only after the step."""
STREAM = name_word("practice") | TOP_BIT
LARGEST_MASK = 63
"""Cells of which a number in the source can say which ones are open."""
HASHED_BITS = 31
MULTIPLIER = 0x5BD1E995
"""An odd number of 31 bits: its product with another such number fits into 64 bits."""
SHIFT = (BINDING["&"] + BINDING["+"]) // 2
"""How tightly `>>` binds."""


@dataclass
class Practice:
    """How robots stray, and the record of a step, in a function that is written."""

    function: RolloutFunction
    joint: JointPartition
    drawn: dict[int, tuple[Text, Text, Text]] = field(default_factory=dict)
    """By robot: whether it strays, which of the explorers does, and a number in [0, 1) that says how."""
    codes: dict[tuple[int, int], Text] = field(default_factory=dict)
    """By behavior and robot, what is recorded of the behavior if it is asked."""

    @cached_property
    def explorers(self) -> list[int]:
        """The behaviors that have open cells."""
        return [index for index, shape in enumerate(self.function.shapes) if shape.n_open]

    @cached_property
    def first_pairs(self) -> list[int]:
        """The number of each behavior's first pair of a cell and a choice."""
        return [*accumulate((s.n_cells * (s.n_actions + 1) for s in self.function.shapes), initial=0)]

    @cached_property
    def rates(self) -> tuple[str, str]:
        """The arrays of the rate at which a lane strays, and of the number of explorers over that rate."""
        return self.function.keep("rate_of_straying"), self.function.keep("explorers_per_rate")

    @cached_property
    def records(self) -> tuple[str, str, str]:
        """The names of the present step's part of `asked`, `joint_cells` and `gains`."""
        namer = self.function.namer
        return namer("asked_now"), namer("joint_now"), namer("gains_now")

    @cached_property
    def open_flags(self) -> dict[tuple[int, int], str]:
        """For each behavior too large for a mask and each robot, the array that is 1 where the robot's cell is open."""
        function = self.function
        return {
            (index, robot): function.keep(
                function.robots_name(f"open_{shape.name}", robot), Kind.CELL, Level.EACH
            )
            for index, shape in enumerate(function.shapes)
            for robot in range(function.robots)
            if 0 < shape.n_open < shape.n_cells and shape.n_cells > LARGEST_MASK
        }

    def start(self, block: Block) -> None:
        """Store every lane's rate."""
        rate, per_rate = self.rates
        block.store(f"{rate}[lane]", Text("rates[base + lane]"))
        explorers = Text(f"{len(self.explorers)}.0")
        block.store(
            f"{per_rate}[lane]", self.function.call_of("divide", explorers, Text("rates[base + lane]"))
        )

    def look_up(self, index: int, robot: int, cell: str) -> list[str]:
        """Return the lines that find out whether a cell is open, for a behavior too large for a mask."""
        if (index, robot) not in self.open_flags:
            return []
        first = sum(shape.n_cells for shape in self.function.shapes[:index])
        element = sum_of([Text(str(first)), Text(cell)])
        return [f"{self.function.at(self.open_flags[index, robot])} = open_cells[{element.source}]"]

    def begin_step(self, emitter: Emitter, records: Collection[str] = RECORDS) -> None:
        """Find the present step's parts of these records."""
        function = self.function
        numbers = function.team * function.lanes
        sizes = (numbers * len(function.shapes), numbers, numbers)
        for argument, name, size in zip(RECORDS, self.records, sizes, strict=True):
            if argument not in records:
                continue
            first = infix("*", Text("step - 1", BINDING["-"]), Text(str(size)))
            step_part = function.call_of("part", Text(argument), first, Text(str(size)))
            emitter.blocks.step.define(name, step_part)

    def draw(self, robot: int, emitter: Emitter, block: Block) -> None:
        """Draw whether a robot strays, and how: the digits of one number decide all of it."""
        if not self.explorers:
            return
        call = self.function.call_of
        stream = self._stream(robot, emitter, block)
        number = self._define("drawn", robot, call("unit", call("fold", Text("key[lane]"), stream)), block)
        rate, per_rate = (self.function.read(array) for array in self.rates)
        strays = self._define("strays", robot, infix("<", number, rate), block, Kind.TRUTH)
        digits = self._define("digits", robot, infix("*", number, per_rate), block)
        if len(self.explorers) == 1:
            self.drawn[robot] = strays, Text("0.0"), digits
        else:
            which = self._define("explorer", robot, call("floor", digits), block)
            self.drawn[robot] = (
                strays,
                which,
                self._define("digits_left", robot, infix("-", digits, which), block),
            )

    def _stream(self, robot: int, emitter: Emitter, block: Block) -> Text:
        """Return the word of a robot's draw in the present step, the same in all lanes."""
        function, call, step = self.function, self.function.call_of, emitter.blocks.step
        of_step = call("fold", Text(hex(STREAM)), call("word_of", Text("step")))
        into = emitter.blocks.robot(block.stage) if function.looped else step
        which = Text("robot") if function.looped else Text(str(robot))
        stream = call("fold", of_step, call("word_of", which))
        return into.define(function.namer.numbered("draw"), stream)

    def choice(self, index: int, robot: int, cell: Text, tabled: Text, block: Block) -> Text:
        """Return what a behavior chooses: what its table says, or anything where the robot strays from it."""
        function, shape = self.function, self.function.shapes[index]
        name, n_choices = f"choice_{shape.name}", shape.n_actions + 1
        strayed = Text("0")
        if shape.n_open:
            strays, which, digits = self.drawn[robot]
            other = function.call_of(
                "clamp_index", infix("*", digits, Text(f"{n_choices}.0")), Text(str(shape.n_actions))
            )
            if len(self.explorers) > 1:
                number = Text(f"{self.explorers.index(index)}.0")
                strays = infix("&", strays, infix("==", which, number))
            if shape.n_open < shape.n_cells:
                strays = infix("&", strays, self._is_open(index, robot, cell))
            tabled = self._define(f"tabled_{shape.name}", robot, tabled, block, Kind.CELL)
            chosen = function.call_of("select", strays, other, tabled)
            choice = self._define(name, robot, chosen, block, Kind.CELL)
            strayed = function.call_of("cell_of", infix("!=", choice, tabled))
        else:
            choice = self._define(name, robot, tabled, block, Kind.CELL)
        row = cell if cell.source == "0" else times(n_choices, cell)
        pair = sum_of([row, choice, Text(str(self.first_pairs[index]))])
        code = sum_of([times(2, pair), strayed])
        self.codes[index, robot] = self._define(f"code_{shape.name}", robot, code, block, Kind.CELL)
        return choice

    def _is_open(self, index: int, robot: int, cell: Text) -> Text:
        """Return whether a cell of a behavior with given cells is open."""
        if (index, robot) in self.open_flags:
            return infix(">", Text(self.function.at(self.open_flags[index, robot])), Text("0"))
        given = self.function.shapes[index].given
        mask = sum(1 << number for number, choice in enumerate(given) if choice == OPEN_CELL)
        shifted = Text(f"{mask} >> {grouped(cell, SHIFT + 1)}", SHIFT, cell.uses)
        return infix(">", infix("&", shifted, Text("1")), Text("0"))

    def record_asked(
        self, index: int, robot: int, excited: Text, priority: Text, highest: Text, block: Block
    ) -> None:
        """Record a behavior's code where the behavior was asked: from the top layer down to the one that controls."""
        function = self.function
        asked = infix(">=", priority, highest)
        if excited.source != "True":
            asked = infix("&", asked, excited)
        code = function.call_of("select", asked, self.codes[index, robot], Text("-1", SIGN))
        block.store(self._element(0, robot, len(function.shapes), index), code)

    def record_joint(self, robot: int, emitter: Emitter, block: Block) -> None:
        """Record the number of a robot's joint cell."""
        block.store(self._element(1, robot), self._joint_cell(robot, emitter, block))

    def _joint_cell(self, robot: int, emitter: Emitter, block: Block) -> Text:
        function, cell = self.function, Text("0")
        for digit in self.joint.digits:
            node = digit.node(function.episode.modules, robot)
            value = emitter.repeatable(node, block)
            if node.kind is Kind.TRUTH:
                value = function.call_of("cell_of", value)
            if self.joint.is_exact:
                row = cell if cell.source == "0" else times(digit.size, cell)
                cell = sum_of([row, value])
            else:
                product = infix("*", sum_of([cell, value]), Text(str(MULTIPLIER)))
                mixed = infix("&", product, Text(str((1 << HASHED_BITS) - 1)))
                cell = self._define("mixed", robot, mixed, block, Kind.CELL)
        if self.joint.is_exact:
            return cell
        return Text(f"{cell.source} >> {HASHED_BITS - HASH_BITS}", SHIFT, cell.uses)

    def record_gains(self, earned: Sequence[Text], end: Closing) -> None:
        """Record what each robot earned."""
        for robot, text in enumerate(earned):
            end.each.store(self._element(2, robot), text)

    def _element(self, record: int, robot: int, columns: int = 1, column: int = 0) -> str:
        """Return the element of a record for a robot in the present lane."""
        lanes = self.function.lanes
        which = times(columns * lanes, Text("robot" if self.function.looped else str(robot)))
        if self.function.looped:
            index = sum_of([which, Text(str(column * lanes)), Text("lane")])
        else:
            index = sum_of([Text(str((robot * columns + column) * lanes)), Text("lane")])
        return f"{self.records[record]}[{index.source}]"

    def _define(self, stem: str, robot: int, text: Text, block: Block, kind: Kind = Kind.NUMBER) -> Text:
        return block.define(self.function.namer(self.function.robots_name(stem, robot)), text, kind)
