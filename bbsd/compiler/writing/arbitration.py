"""The decision (1), (2) without branches: every activated behavior bids its layer, and the highest bid controls."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import accumulate
from typing import TYPE_CHECKING

from bbsd.compiler.details import DECIDED, Detail, first_decided_column
from bbsd.compiler.writing.emission import emitter_of
from bbsd.compiler.writing.loop_fission import loop_lines
from bbsd.compiler.writing.precedence import ATOM, Text, grouped, infix, name_text
from bbsd.compiler.writing.schedule import first_stage_with, stages_of
from bbsd.expression.graph import Level
from bbsd.expression.kinds import Kind
from bbsd.expression.operations import BINDING

if TYPE_CHECKING:
    from bbsd.compiler.writing.blocks import Block
    from bbsd.compiler.writing.emission import Emitter
    from bbsd.compiler.writing.practice import Practice
    from bbsd.compiler.writing.rollout_function import RolloutFunction
    from bbsd.expression.graph import Node

MOST_BIDS = 8
"""Bids compared in one expression, so that lines can be read."""
ACTION_BITS = 16
ACTION_MASK = (1 << ACTION_BITS) - 1
"""A priority is the layer shifted by so many bits, plus the number of actions of the behaviors before."""


@dataclass
class Arbitration:
    """The statements that find the action that controls each robot."""

    function: RolloutFunction
    practice: Practice | None = None
    """How robots stray from their tables, in a rollout for practice."""

    @cached_property
    def arrays(self) -> list[tuple[str, str]]:
        """For each behavior the arrays of its priority, and of its table: a word, or where its row of cells begins.

        The priority of a behavior with one action has that action's choice added already: it is all it can bid.
        """
        keep = self.function.keep
        return [
            (
                keep(f"priority_{shape.name}", Kind.CELL),
                keep(f"{'table' if shape.packed else 'row'}_{shape.name}", Kind.CELL),
            )
            for shape in self.function.shapes
        ]

    def start(self, block: Block) -> None:
        """Store every lane's priorities and tables: lanes refer to individuals of the pools."""
        for index, (shape, (priority, table)) in enumerate(
            zip(self.function.shapes, self.arrays, strict=True)
        ):
            individual = f"individuals[{index}, base + lane]"
            row = f"table_offsets[{index}] + {individual} * {shape.n_cells}"
            choice = " + 1" if shape.n_actions == 1 else ""
            block.store(f"{priority}[lane]", Text(f"priorities[{index}, base + lane]{choice}"))
            word = f"packed_tables[{index}, {individual}]"
            block.store(f"{table}[lane]", Text(word if shape.packed else row))

    def look_up(self) -> list[str]:
        """Return the lines that look up tables too large for a word.

        Their cells are found in one loop, the look-ups done in another that does not vectorize.
        """
        if not self._looked_up:
            return []
        function = self.function
        large = {index for index, _ in self._looked_up}
        cells = [node for index in large for robot in function.episode.modules[index].cells for node in robot]
        emitter = emitter_of(function, cells, hinted=False)
        block, cell_stores, look_ups = emitter.blocks.stage(self.stage), [], []
        for (index, robot), (cell, choice) in self._looked_up.items():
            cell_stores.append((function.at(cell), self._cell(index, robot, emitter, block)))
            row = f"{self.arrays[index][1]}[lane]"
            look_ups.append(f"{function.at(choice)} = tables[{row} + {function.at(cell)}]")
            if self.practice is not None:
                look_ups += self.practice.look_up(index, robot, function.at(cell))
        for element, text in cell_stores:
            block.store(element, text)
        return loop_lines(emitter.blocks, function, apart=look_ups)

    @cached_property
    def stage(self) -> int:
        """The stage of a step in which the robots decide."""
        level = Level.EACH if self.function.looped else Level.LANE
        return first_stage_with(self.sensed, stages_of(self.sensed, 0), level)

    @property
    def sensed(self) -> list[Node]:
        """The values that decisions depend on."""
        return [node for module in self.function.episode.modules for node in module.nodes]

    @cached_property
    def _looked_up(self) -> dict[tuple[int, int], tuple[str, str]]:
        """For each behavior with a large table and each robot, the arrays of its cell and its choice."""
        function = self.function
        return {
            (index, robot): (
                function.keep(function.robots_name(f"cell_{shape.name}", robot), Kind.CELL, Level.EACH),
                function.keep(function.robots_name(f"choice_{shape.name}", robot), Kind.CELL, Level.EACH),
            )
            for index, shape in enumerate(function.shapes)
            for robot in range(function.robots)
            if not shape.packed
        }

    def decide(self, robot: int, emitter: Emitter, block: Block) -> None:
        """Find the number of the action that controls a robot; 0 is nobody's."""
        function = self.function
        highest, last = Text("0"), len(function.shapes) - 1
        if self.practice is not None:
            self.practice.draw(robot, emitter, block)
            self.practice.record_joint(robot, emitter, block)
        for index in range(len(function.shapes)):
            active, bid = self._bid(index, robot, emitter, block)
            highest = function.call_of("maximum_where", highest, active, bid)
            if index % MOST_BIDS == MOST_BIDS - 1 and index < last:
                name = function.namer(function.robots_name("highest", robot))
                highest = block.define(name, highest, Kind.CELL)
        if self.practice is not None:
            highest = block.define(function.namer(function.robots_name("highest", robot)), highest, Kind.CELL)
            self._record_asked(self.practice, robot, highest, emitter, block)
        if function.detail is Detail.TRACE:
            self.record(robot, emitter, block)
        action = infix("&", highest, Text(str(ACTION_MASK)))
        block.define(function.actions[robot], action, Kind.CELL, function.episode.choices[robot])

    def record(self, robot: int, emitter: Emitter, block: Block) -> None:
        """Record whether each behavior is excited and which cell it is in, in the present step's row of a trace."""
        function, first = self.function, first_decided_column(self.function.meaning, robot)
        for index, module in enumerate(function.episode.modules):
            excited = emitter.text(module.excited[robot], block)
            cell = self._cell_asked(index, robot, emitter, block)
            for offset, text in enumerate((excited, cell)):
                column = first + len(DECIDED) * index + offset
                block.store(f"record[step - 1, {column}]", text)

    def _bid(self, index: int, robot: int, emitter: Emitter, block: Block) -> tuple[Text, Text]:
        """Return whether a behavior is activated, and what it then bids for control: its priority and its choice."""
        function, module = self.function, self.function.episode.modules[index]
        value = self._choice(index, robot, emitter, block)
        if self.practice is None:
            name = function.namer(function.robots_name(f"choice_{module.name}", robot))
            choice = block.define(name, value, Kind.CELL)
        else:
            cell = self._cell_asked(index, robot, emitter, block)
            choice = self.practice.choice(index, robot, cell, value, block)
        active, excited = infix(">", choice, Text("0")), emitter.text(module.excited[robot], block)
        if excited.source != "True":
            active = infix("&", active, excited)
        priority = Text(f"{self.arrays[index][0]}[lane]")
        return active, priority if function.shapes[index].n_actions == 1 else infix("+", priority, choice)

    def _record_asked(
        self, practice: Practice, robot: int, highest: Text, emitter: Emitter, block: Block
    ) -> None:
        """Record what behaviors were asked: a behavior of a layer up to the highest has a bid that is not lower."""
        for index, module in enumerate(self.function.episode.modules):
            excited = emitter.text(module.excited[robot], block)
            best = infix("|", Text(f"{self.arrays[index][0]}[lane]"), Text(str(ACTION_MASK)))
            practice.record_asked(index, robot, excited, best, highest, block)

    def _choice(self, index: int, robot: int, emitter: Emitter, block: Block) -> Text:
        """Return the value of the behavior's table at the robot's cell."""
        shape = self.function.shapes[index]
        if not shape.packed:
            return Text(self.function.at(self._looked_up[index, robot][1]))
        table, cell = f"{self.arrays[index][1]}[lane]", self._cell(index, robot, emitter, block)
        if cell.source == "0":
            return infix("&", Text(table), Text(str(shape.mask)))
        shift = cell if shape.bits == 1 else infix("*", cell, Text(str(shape.bits)))
        source = f"({table} >> {grouped(shift, ATOM)}) & {shape.mask}"
        return shift._replace(source=source, binds=BINDING["&"])

    def _cell_asked(self, index: int, robot: int, emitter: Emitter, block: Block) -> Text:
        """Return the index of the table's cell where choices are made: that of a large table was stored."""
        if (index, robot) in self._looked_up:
            return Text(self.function.at(self._looked_up[index, robot][0]))
        return self._cell(index, robot, emitter, block)

    def _cell(self, index: int, robot: int, emitter: Emitter, block: Block) -> Text:
        """Return the index of the table's cell: row-major over the inputs."""
        module, cell = self.function.episode.modules[index], Text("0")
        for node, labels in zip(module.cells[robot], module.inputs.values(), strict=True):
            part = emitter.text(node, block)
            rows = infix("*", cell, Text(str(len(labels))))
            cell = part if cell.source == "0" else infix("+", rows, part)
        return cell

    def controls(self, index: int, robot: int) -> Text:
        """Return whether a behavior controls a robot; the index after the last behavior's is nobody's."""
        counts = [shape.n_actions for shape in self.function.shapes]
        action = name_text(self.function.actions[robot])
        if index == len(counts):
            return infix("==", action, Text("0"))
        first = [1, *accumulate(counts, initial=1)][index + 1]
        if counts[index] == 1:
            return infix("==", action, Text(str(first)))
        from_first, before_end = Text(str(first)), Text(str(first + counts[index]))
        return infix("&", infix(">=", action, from_first), infix("<", action, before_end))
