"""The source of a spec's rollouts: functions that run an episode in each lane of a batch.

The loop over steps is outside, the loop over lanes inside, and its body has no branches, so it vectorizes. A lane is an
agent in an episode. `docs/rollout.md` states the function's arguments.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.compiler.details import IN_DETAIL, Detail
from bbsd.compiler.writing.arbitration import Arbitration
from bbsd.compiler.writing.emission import emitter_of
from bbsd.compiler.writing.loop_fission import loop_lines
from bbsd.compiler.writing.practice import PRACTICE, Practice
from bbsd.compiler.writing.precedence import Text
from bbsd.compiler.writing.rollout_function import ONE, OWN, ZERO, RolloutFunction, indent
from bbsd.compiler.writing.schedule import Closing, closing_of
from bbsd.compiler.writing.totals import DETAILED, Totals
from bbsd.kernel import functions, memory, streams
from bbsd.version import __version__

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from bbsd.compiler.joint import JointPartition
    from bbsd.compiler.passes.pipeline import Program
    from bbsd.compiler.tables import TableShape
    from bbsd.compiler.writing.blocks import Block
    from bbsd.compiler.writing.emission import Emitter
    from bbsd.expression.node_data import Slot

ARGUMENTS = (
    "first", "last", "numbers", "keys", "individuals", "packed_tables", "tables", "table_offsets", "priorities",
    "constants", "returns", "credit",
)  # fmt: skip


def module_source(
    programs: Mapping[Detail, Program],
    shapes: Sequence[TableShape],
    lanes: int,
    joint: JointPartition | None = None,
) -> str:
    """Return the source of a module with the rollouts of these programs, and how much memory they need.

    A rollout for practice needs the joint partition.
    """
    texts, used, tables, memory_size = [], set(), dict[str, str](), 0
    for detail, program in programs.items():
        function = RolloutFunction(program.meaning, shapes, lanes, detail, program.to_prove, tables)
        practiced = joint if detail is Detail.PRACTICE else None
        texts.append(f"\n{rollout_source(function, practiced)}")
        used |= function.used
        memory_size = max(memory_size, function.size)
    name = next(iter(programs.values())).meaning.spec.name
    title = f'"""Episodes of {name!r}, {lanes} at a time. Written by bbsd {__version__} from the spec."""'
    imports = [
        *(["import numpy as np"] if any("np." in text for text in (*tables, *texts)) else []),
        *_imports("bbsd.kernel.functions", sorted(used & vars(functions).keys())),
        *_imports("bbsd.kernel.memory", sorted(used & vars(memory).keys())),
        *_imports("bbsd.kernel.streams", sorted(used & vars(streams).keys() - vars(functions).keys())),
    ]
    by_robot = ["\n".join(f"{name} = {text}" for text, name in tables.items())] if tables else []
    return "\n\n".join([title, "\n".join(imports), f"MEMORY = {memory_size}", *by_robot, *texts]) + "\n"


def _imports(module: str, names: Sequence[str]) -> list[str]:
    return [f"from {module} import {', '.join(names)}"] if names else []


def rollout_source(function: RolloutFunction, joint: JointPartition | None = None) -> str:
    """Return the source of one rollout function; that of practice records cells of a joint partition."""
    practice = None if joint is None else Practice(function, joint)
    arbitration = Arbitration(function, practice)
    totals = Totals(function, arbitration, practice)
    start = _start(function, arbitration, totals)
    step = _step(function, arbitration, totals)
    finish = totals.finish()
    return "\n".join(
        [
            f"def {function.detail.value}({', '.join(_arguments(function.detail))}):",
            *indent(function.scratch(), 1),
            *indent(function.call.lines, 1),
            f"    for base in range(first, last, {function.lanes}):",
            *indent(start, 2),
            f"        for step in range(1, {function.meaning.spec.environment.steps + 1}):",
            *indent(step, 3),
            *indent(finish, 2),
            *([] if function.uncertain is None else _ends_uncertain(function.uncertain)),
        ]
    )


def _arguments(detail: Detail) -> list[str]:
    """Return the names of a rollout's arguments."""
    if detail is Detail.PRACTICE:
        return [*(name for name in ARGUMENTS if name != "credit"), *PRACTICE]
    further = DETAILED if detail in IN_DETAIL else ()
    return [*ARGUMENTS, *further, *(["record"] if detail is Detail.TRACE else [])]


def _ends_uncertain(uncertain: str) -> list[str]:
    """Return the lines that return whether a comparison of some lane was uncertain, as soon as one was."""
    return [f"        if {uncertain}.sum() > 0.0:", "            return True", "    return False"]


def _start(function: RolloutFunction, arbitration: Arbitration, totals: Totals) -> list[str]:
    """Return the lines that set every lane's key, tables, starting values and sums."""
    start = {slot: function.episode.start[slot] for slot in function.slots}
    emitter = emitter_of(function, start.values(), step="0", hinted=False)
    first = emitter.blocks.stage(0)
    first.store("key[lane]", Text("keys[base + lane]"))
    arbitration.start(first)
    if arbitration.practice is not None:
        arbitration.practice.start(first)
    end = closing_of(emitter.blocks, emitter.stage_of, start.values())
    blocks = {slot: end.knowing(own=function.is_own(array)) for slot, array in function.slots.items()}
    texts = {slot: emitter.text(node, blocks[slot]) for slot, node in start.items()}
    for slot, text in texts.items():
        _store_slot(function, slot, text, blocks[slot])
    totals.start(first, end.each)
    if function.running is not None:
        first.store(function.at(function.running), ONE)
    if function.uncertain is not None:
        first.store(function.at(function.uncertain), ZERO)
    return loop_lines(emitter.blocks, function, split=function.looped)


def _step(function: RolloutFunction, arbitration: Arbitration, totals: Totals) -> list[str]:
    """Return the lines of a step of every lane, in the order of the language's definition."""
    emitter = emitter_of(function, [*function.outputs, *function.episode.choices], arbitration.stage)
    deciding = emitter.blocks.stage(arbitration.stage)
    end = closing_of(emitter.blocks, emitter.stage_of, function.outputs)
    if arbitration.practice is not None:
        arbitration.practice.begin_step(emitter)
    deciding.comment("Decide: the highest layer that is excited and whose cell is not No Action controls.")
    for robot in range(function.robots):
        arbitration.decide(robot, emitter, deciding)
    deciding.comment("Act, then dynamics and sensors.", starts_phase=True)
    after = _after(function, emitter, end)
    end.each.comment("Reward: what each robot earned goes to what controlled it.")
    totals.add(emitter, end)
    if function.uncertain is not None:
        totals.add_uncertain(function.uncertain, emitter, end)
    if function.detail in IN_DETAIL:
        end.each.comment("What an evaluation adds up.")
        totals.add_details(emitter, end)
    if function.detail is Detail.TRACE:
        totals.record(emitter, end)
    if function.detail is Detail.PRACTICE:
        totals.add_step(end)
    if function.running is not None and function.episode.ends is not None:
        ended = emitter.text(function.episode.ends, end.team)
        running = function.call_of("select", ended, ZERO, function.read(function.running))
        end.team.store(function.at(function.running), running)
    for slot, text in after.items():
        _store_slot(function, slot, text, end.storing(own=function.is_own(function.slots[slot])))
    all_over = [] if function.running is None else [f"if {function.running}.sum() == 0.0:", "    break"]
    return [*arbitration.look_up(), *loop_lines(emitter.blocks, function), *all_over]


def _after(function: RolloutFunction, emitter: Emitter, end: Closing) -> dict[Slot, Text]:
    """Return what each slot that changes will hold, by names that stay true while slots are stored one by one."""
    texts = {}
    for slot, array in function.slots.items():
        node, name = function.episode.after[slot], f"next_{slot.text(function.robots)}"
        if node.operation == "slot" and node.data == slot:
            continue
        block = end.storing(own=function.is_own(array))
        if node.operation == "slot":
            now = end.knowing(own=node.level in OWN)
            texts[slot] = emitter.copy(node, name, now, block)
        else:
            texts[slot] = emitter.repeatable(node, block, name)
    return texts


def _store_slot(function: RolloutFunction, slot: Slot, text: Text, block: Block) -> None:
    array, kind = function.slots[slot], function.episode.after[slot].kind
    block.store(function.at(array), function.as_stored(text, kind))
