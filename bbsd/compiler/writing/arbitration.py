"""The decision (1), (2) without branches: every activated behavior bids its layer, and the highest bid controls."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import accumulate
from typing import TYPE_CHECKING

from bbsd.compiler.writing.loop_fission import written
from bbsd.compiler.writing.precedence import ATOM, COMPARISON, Text, grouped, infix
from bbsd.compiler.writing.schedule import last, stages
from bbsd.expression.graph import Level
from bbsd.expression.kinds import Kind

if TYPE_CHECKING:
    from bbsd.compiler.writing.blocks import Block
    from bbsd.compiler.writing.emission import Emitter
    from bbsd.compiler.writing.rollout_function import RolloutFunction
    from bbsd.expression.graph import Node

MOST_NESTED = 8
"""Bids compared in one expression."""
ACTION_BITS = 16
"""A priority is the layer shifted by so many bits, plus what makes a choice the action's number."""


@dataclass
class Arbitration:
    """Writes how each robot's controlling action is found."""

    function: RolloutFunction

    @cached_property
    def kept(self) -> list[tuple[str, str]]:
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

    def start(self) -> list[str]:
        """Every lane's priorities and tables: lanes refer to individuals of the pools."""
        lines = []
        for index, (shape, (priority, table)) in enumerate(zip(self.function.shapes, self.kept, strict=True)):
            individual = f"individuals[{index}, base + lane]"
            row = f"table_offsets[{index}] + {individual} * {shape.n_cells}"
            offer = " + 1" if shape.n_actions == 1 else ""
            lines.append(f"{priority}[lane] = priorities[{index}, base + lane]{offer}")
            lines.append(
                f"{table}[lane] = {f'packed_tables[{index}, {individual}]' if shape.packed else row}"
            )
        return lines

    def look_up(self) -> list[str]:
        """Tables too large for a word: their cells in one loop, the look-ups in another that does not vectorize."""
        if not self._looked_up:
            return []
        function, emitter = self.function, self.function.emitter("step", hinted=False)
        large = {index for index, _ in self._looked_up}
        cells = [node for index in large for robot in function.episode.modules[index].cells for node in robot]
        emitter.prepare(cells)
        block, stores, looks = emitter.blocks.stage(self.stage), [], []
        for (index, robot), (cell, choice) in self._looked_up.items():
            stores.append(f"{function.at(cell)} = {self._cell(index, robot, emitter, block)[0]}")
            row = f"{self.kept[index][1]}[lane]"
            looks.append(f"{function.at(choice)} = tables[{row} + {function.at(cell)}]")
        block.lines += stores
        return written(emitter.blocks, function, apart=looks)

    @cached_property
    def stage(self) -> int:
        """The stage of a step in which the robots decide."""
        level = Level.EACH if self.function.looped else Level.LANE
        return last(self.sensed, stages(self.sensed, 0), level)

    @property
    def sensed(self) -> list[Node]:
        """What decisions depend on."""
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
        highest, last_one = "0", len(self.function.shapes) - 1
        for index in range(len(self.function.shapes)):
            active, bid = self._bid(index, robot, emitter, block)
            highest = self.function.call_of("maximum_where", highest, active, bid)
            if index % MOST_NESTED == MOST_NESTED - 1 and index < last_one:
                name = self.function.namer(self.function.robots_name("highest", robot))
                block.assign(name, highest, Kind.CELL)
                highest = name
        mask = (1 << ACTION_BITS) - 1
        block.assign(self.function.actions[robot], f"{highest} & {mask}", Kind.CELL)
        block.names[self.function.episode.choices[robot].number] = self.function.actions[robot]

    def _bid(self, index: int, robot: int, emitter: Emitter, block: Block) -> tuple[str, str]:
        """Whether a behavior is activated, and what it then bids for control: its priority and its choice."""
        function, module = self.function, self.function.episode.modules[index]
        looked = self._choice(index, robot, emitter, block)
        choice = function.namer(function.robots_name(f"choice_{module.name}", robot))
        block.assign(choice, looked, Kind.CELL)
        active, excited = (f"{choice} > 0", COMPARISON), emitter.text(module.excited[robot], block)
        if excited[0] != "True":
            active = infix("&", active, excited)
        priority = f"{self.kept[index][0]}[lane]"
        return active[0], priority if function.shapes[index].n_actions == 1 else f"{priority} + {choice}"

    def _choice(self, index: int, robot: int, emitter: Emitter, block: Block) -> str:
        """The value of the behavior's table at the robot's cell."""
        shape = self.function.shapes[index]
        if not shape.packed:
            return self.function.at(self._looked_up[index, robot][1])
        table, cell = self.kept[index][1], self._cell(index, robot, emitter, block)
        if cell[0] == "0":
            return f"{table}[lane] & {shape.mask}"
        shift = cell if shape.bits == 1 else infix("*", cell, (str(shape.bits), ATOM))
        return f"({table}[lane] >> {grouped(shift, ATOM)}) & {shape.mask}"

    def _cell(self, index: int, robot: int, emitter: Emitter, block: Block) -> Text:
        """The index of the table's cell: row-major over the inputs."""
        module, cell = self.function.episode.modules[index], ("0", ATOM)
        for node, labels in zip(module.cells[robot], module.inputs.values(), strict=True):
            part = emitter.text(node, block)
            rows = infix("*", cell, (str(len(labels)), ATOM))
            cell = part if cell[0] == "0" else infix("+", rows, part)
        return cell

    def controls(self, index: int, robot: int) -> str:
        """Whether a behavior controls a robot; the index after the last behavior's is nobody's."""
        counts = [shape.n_actions for shape in self.function.shapes]
        action = self.function.actions[robot]
        if index == len(counts):
            return f"{action} == 0"
        first = [1, *accumulate(counts, initial=1)][index + 1]
        return (
            f"{action} == {first}"
            if counts[index] == 1
            else f"({action} >= {first}) & ({action} < {first + counts[index]})"
        )
