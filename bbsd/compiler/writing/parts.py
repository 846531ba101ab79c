"""The parts that a rollout is made of: the start, a step from decision to outcome, and what is written at the end.

A whole rollout has them in its loops; printed in phases, each is a function of its own.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from bbsd.compiler.details import IN_DETAIL, Detail
from bbsd.compiler.writing.arbitration import Arbitration
from bbsd.compiler.writing.emission import emitter_of
from bbsd.compiler.writing.lists import Lists
from bbsd.compiler.writing.loop_fission import LONGEST_ONCE, loop_lines
from bbsd.compiler.writing.practice import RECORDS, Practice
from bbsd.compiler.writing.precedence import Text, name_text
from bbsd.compiler.writing.rollout_function import ONE, OWN, ZERO
from bbsd.compiler.writing.schedule import closing_of
from bbsd.compiler.writing.totals import Totals
from bbsd.expression.kinds import Kind

if TYPE_CHECKING:
    from collections.abc import Collection

    from bbsd.compiler.joint import JointPartition
    from bbsd.compiler.writing.blocks import Block
    from bbsd.compiler.writing.emission import Emitter
    from bbsd.compiler.writing.rollout_function import RolloutFunction
    from bbsd.compiler.writing.schedule import Closing
    from bbsd.expression.graph import Node
    from bbsd.expression.node_data import Slot


@dataclass(frozen=True, slots=True)
class Parts:
    """The lines of the parts of one rollout; each may be asked for once."""

    function: RolloutFunction
    arbitration: Arbitration
    totals: Totals
    lists: Lists

    def start(self) -> list[str]:
        """Return the lines that set every lane's key, tables, starting values and sums."""
        function, arbitration = self.function, self.arbitration
        start = {slot: function.episode.start[slot] for slot in function.slots}
        emitter = emitter_of(function, start.values(), step="0", hinted=False)
        first = emitter.blocks.stage(0)
        first.store("key[lane]", Text("keys[base + lane]"))
        if function.detail is not Detail.WORLD:
            arbitration.start(first)
        if arbitration.practice is not None:
            arbitration.practice.start(first)
        end = closing_of(emitter.blocks, emitter.stage_of, start.values())
        blocks = {slot: end.knowing(own=function.is_own(array)) for slot, array in function.slots.items()}
        texts = {
            slot: emitter.text(node, blocks[slot])
            for slot, node in start.items()
            if node.operation != "list_start"
        }
        for slot, text in texts.items():
            self._store_slot(slot, text, blocks[slot])
        for slot, node in start.items():
            if node.operation == "list_start":
                self.lists.start(slot, node, emitter, blocks[slot])
        self.totals.start(first, end.each, self.lists)
        if function.running is not None:
            first.store(function.at(function.running), ONE)
        if function.uncertain is not None:
            first.store(function.at(function.uncertain), ZERO)
        is_long = len(first.statements) > LONGEST_ONCE
        lines = loop_lines(emitter.blocks, function, split=function.looped or is_long)
        return [*lines, *self.lists.written()]

    def step(self) -> list[str]:
        """Return the lines of a step of every lane, in the order of the language's definition."""
        function, arbitration = self.function, self.arbitration
        emitter = emitter_of(function, [*function.outputs, *function.episode.choices], arbitration.stage)
        deciding = emitter.blocks.stage(arbitration.stage)
        end = closing_of(emitter.blocks, emitter.stage_of, function.outputs)
        self._begin_step(emitter, RECORDS)
        self._write_decision(emitter, deciding)
        self._write_outcome(emitter, deciding, end)
        all_over = [] if function.running is None else [f"if {function.running}.sum() == 0.0:", "    break"]
        lines = loop_lines(emitter.blocks, function)
        return [*arbitration.look_up(), *lines, *self.lists.written(), *all_over]

    def decide(self) -> list[str]:
        """Return the lines that decide a step and keep the choices, and what the robots send outside."""
        function, arbitration = self.function, self.arbitration
        episode = function.episode
        sent = [episode.acted[slot] for slot in episode.sent]
        outputs = [*arbitration.sensed, *sent, *episode.choices]
        emitter = emitter_of(function, outputs, arbitration.stage)
        deciding = emitter.blocks.stage(arbitration.stage)
        end = closing_of(emitter.blocks, emitter.stage_of, outputs)
        self._begin_step(emitter, RECORDS[:-1])
        self._write_decision(emitter, deciding)
        for robot, action in enumerate(function.actions):
            deciding.store(function.chosen(robot), name_text(action))
        for row, node in enumerate(sent):
            end.team.store(f"sent[{row}, lane]", function.as_stored(emitter.text(node, end.team), node.kind))
        return [*arbitration.look_up(), *loop_lines(emitter.blocks, function)]

    def outcome(self) -> list[str]:
        """Return the lines of the rest of a step, by the choices that were kept."""
        function = self.function
        outputs = [*function.outputs, *function.episode.choices]
        emitter = emitter_of(function, outputs, function.first_stage)
        first = emitter.blocks.stage(function.first_stage)
        end = closing_of(emitter.blocks, emitter.stage_of, outputs)
        self._begin_step(emitter, RECORDS[-1:])
        for robot, action in enumerate(function.actions):
            first.define(action, Text(function.chosen(robot)), Kind.CELL, function.episode.choices[robot])
        self._write_outcome(emitter, first, end)
        lives = [] if function.running is None else [f"living[lane] = {function.running}[lane]"]
        lines = [*loop_lines(emitter.blocks, function), *self.lists.written()]
        return [*lines, *(function.lane_loop(lives) if lives else [])]

    @property
    def lasting_names(self) -> list[str]:
        """The names that mean the same in all parts: of arrays, choices and what is computed once a call."""
        function, practice = self.function, self.arbitration.practice
        return [
            *function.memory.names,
            *(definition.target for definition in function.call.definitions),
            *function.actions,
            *(() if practice is None else practice.records),
        ]

    def observe(self) -> list[str]:
        """Return the lines that write what another program observes of the snapshot."""
        function = self.function
        emitter = emitter_of(function, function.observed)
        block = emitter.blocks.stage(0)
        for row, node in enumerate(function.observed):
            text = function.as_stored(emitter.text(node, block), node.kind)
            block.store(f"observed[{row}, lane]", text)
        return loop_lines(emitter.blocks, function)

    def finish(self) -> list[str]:
        """Return loops that write the sums to where the caller reads them."""
        return self.totals.finish(self.lists)

    def _begin_step(self, emitter: Emitter, records: Collection[str]) -> None:
        if self.arbitration.practice is not None:
            self.arbitration.practice.begin_step(emitter, records)

    def _write_decision(self, emitter: Emitter, deciding: Block) -> None:
        deciding.comment(
            "Decide: the highest layer that is excited and whose cell is not No Action controls."
        )
        for robot in range(self.function.robots):
            self.arbitration.decide(robot, emitter, deciding)

    def _write_outcome(self, emitter: Emitter, deciding: Block, end: Closing) -> None:
        """Write what follows from the choices, which the block `deciding` knows."""
        function, totals = self.function, self.totals
        deciding.comment("Act, then dynamics and sensors.", starts_phase=True)
        after = self._after(emitter, end)
        for slot, node in self._lists_after.items():
            self.lists.store(slot, node, emitter, end.knowing(own=function.is_own(function.slots[slot])))
        end.each.comment("Reward: what each robot earned goes to what controlled it.")
        totals.add(emitter, end)
        if function.uncertain is not None:
            totals.add_uncertain(function.uncertain, emitter, end)
        if function.detail in IN_DETAIL:
            end.each.comment("What an evaluation adds up.")
            totals.add_details(emitter, end, self.lists)
        if function.detail is Detail.TRACE:
            totals.record(emitter, end)
        if function.detail is Detail.PRACTICE:
            totals.add_step(end)
        if function.running is not None and function.episode.ends is not None:
            ended = emitter.text(function.episode.ends, end.team)
            running = function.call_of("select", ended, ZERO, function.read(function.running))
            end.team.store(function.at(function.running), running)
        for slot, text in after.items():
            self._store_slot(slot, text, end.storing(own=function.is_own(function.slots[slot])))

    def _after(self, emitter: Emitter, end: Closing) -> dict[Slot, Text]:
        """Return what each slot that changes will hold, by names that stay true while slots are stored one by one."""
        function, texts = self.function, {}
        for slot, array in function.slots.items():
            node, name = function.episode.after[slot], f"next_{slot.text(function.robots)}"
            if (node.operation == "slot" and node.data == slot) or node.operation == "list_after":
                continue
            block = end.storing(own=function.is_own(array))
            if node.operation == "slot":
                now = end.knowing(own=node.level in OWN)
                texts[slot] = emitter.copy(node, name, now, block)
            else:
                texts[slot] = emitter.repeatable(node, block, name)
        return texts

    @property
    def _lists_after(self) -> dict[Slot, Node]:
        """What a step sets of the lists that arrays keep."""
        nodes = {slot: self.function.episode.after[slot] for slot in self.function.slots}
        return {slot: node for slot, node in nodes.items() if node.operation == "list_after"}

    def _store_slot(self, slot: Slot, text: Text, block: Block) -> None:
        function = self.function
        array, kind = function.slots[slot], function.episode.after[slot].kind
        block.store(function.at(array), function.as_stored(text, kind))


def parts_of(function: RolloutFunction, joint: JointPartition | None = None) -> Parts:
    """Return the parts of a rollout; that of practice records cells of a joint partition."""
    practice = None if joint is None else Practice(function, joint)
    arbitration = Arbitration(function, practice)
    return Parts(function, arbitration, Totals(function, arbitration, practice), Lists(function))
