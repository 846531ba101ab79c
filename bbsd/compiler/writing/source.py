"""One rollout per spec: the source of a function that lives an episode in a batch of lanes.

The loop over steps is outside, the loop over lanes inside, and its body is straight and free of branches, so it
vectorizes. A lane is an agent in an episode. `docs/rollout.md` states the function's arguments.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from bbsd.compiler.details import Detail
from bbsd.compiler.passes.robot_loops import MOST_WRITTEN_OUT, rolled
from bbsd.compiler.passes.tangents import by_tangents
from bbsd.compiler.writing.deciding import Decision
from bbsd.compiler.writing.loop_fission import written
from bbsd.compiler.writing.naming import slot_text
from bbsd.compiler.writing.rollout_function import OWN, Frame, indented
from bbsd.compiler.writing.schedule import Closing, closing
from bbsd.compiler.writing.totals import DETAILED, Reckoning
from bbsd.kernel import functions, memory, streams
from bbsd.version import __version__

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bbsd.compiler.tables import TableShape
    from bbsd.compiler.writing.emission import Emitter
    from bbsd.language.meaning import Meaning
    from bbsd.language.meaning.names import Slot

ARGUMENTS = (
    "first", "last", "numbers", "keys", "individuals", "words", "tables", "origins", "priorities", "constants",
    "returns", "credit",
)  # fmt: skip


def module_source(
    meaning: Meaning,
    shapes: Sequence[TableShape],
    lanes: int,
    details: Sequence[Detail],
    written_out: int = MOST_WRITTEN_OUT,
) -> str:
    """The source of a module with a rollout for each detail asked for, and how much memory they want.

    More robots than are to be written out stand in loops; those of a trace never do.
    """
    texts, used, tables, memory_size = [], set(), dict[str, str](), 0
    short = rolled(meaning, written_out)
    for detail in details:
        meant = meaning if detail is Detail.TRACE else short
        episode, certain = by_tangents(meant.episode) if detail is Detail.CREDIT else (meant.episode, ())
        frame = Frame(replace(meant, episode=episode), shapes, lanes, detail, certain, tables)
        texts.append(f"\n{rollout_source(frame)}")
        used |= frame.used
        memory_size = max(memory_size, frame.size)
    title = f'"""Episodes of {meaning.spec.name!r}, {lanes} at a time. Written by bbsd {__version__} from the spec."""'
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


def rollout_source(frame: Frame) -> str:
    """The text of one rollout function."""
    decision = Decision(frame)
    reckoning = Reckoning(frame, decision)
    start = _start(frame, decision, reckoning)
    step = _step(frame, decision, reckoning)
    finish = reckoning.finish()
    arguments = [*ARGUMENTS, *(DETAILED if frame.detail is not Detail.CREDIT else ())]
    arguments += ["record"] if frame.detail is Detail.TRACE else []
    return "\n".join(
        [
            f"def {frame.detail.value}({', '.join(arguments)}):",
            *indented(frame.scratch(), 1),
            *indented(frame.call.lines, 1),
            f"    for base in range(first, last, {frame.lanes}):",
            *indented(start, 2),
            f"        for step in range(1, {frame.meaning.spec.environment.steps + 1}):",
            *indented(step, 3),
            *indented(finish, 2),
            *([] if frame.doubt is None else _ends_in_doubt(frame.doubt)),
        ]
    )


def _ends_in_doubt(doubt: str) -> list[str]:
    """The lines that tell the caller whether a lane was in doubt, as soon as one was."""
    return [f"        if {doubt}.sum() > 0.0:", "            return True", "    return False"]


def _start(frame: Frame, decision: Decision, reckoning: Reckoning) -> list[str]:
    """Every lane's key, tables, starting values and sums."""
    emitter = frame.emitter("0", hinted=False)
    wanted = {slot: frame.episode.start[slot] for slot in frame.slots}
    emitter.prepare(wanted.values())
    first = emitter.blocks.stage(0)
    first.lines += ["key[lane] = keys[base + lane]", *decision.start()]
    end = closing(emitter, wanted.values())
    blocks = {slot: end.knowing(own=frame.is_own(array)) for slot, array in frame.slots.items()}
    texts = {slot: emitter.value(node, blocks[slot]) for slot, node in wanted.items()}
    for slot, text in texts.items():
        blocks[slot].lines.append(frame.store(frame.slots[slot], text, wanted[slot].kind))
    team, own = reckoning.start()
    first.lines += [*team, *([] if frame.running is None else [f"{frame.running}[lane] = 1.0"])]
    first.lines += [] if frame.doubt is None else [f"{frame.doubt}[lane] = 0.0"]
    end.each.lines += own
    return written(emitter.blocks, frame, split=frame.looped)


def _step(frame: Frame, decision: Decision, reckoning: Reckoning) -> list[str]:
    """A step of every lane, in the order of the language's definition."""
    emitter = frame.emitter("step")
    emitter.prepare([*frame.outputs, *frame.episode.choices], decision.stage)
    deciding, end = emitter.blocks.stage(decision.stage), closing(emitter, frame.outputs)
    deciding.lines.append(
        "# Decide: the highest layer that is excited and whose cell is not No Action controls."
    )
    for robot in range(frame.robots):
        decision.decide(robot, emitter, deciding)
    deciding.lines.append("# Act, then dynamics and sensors.")
    after = _after(frame, emitter, end)
    end.each.lines.append("# Reward: what each robot earned goes to what controlled it.")
    reckoning.add(emitter, end)
    if frame.doubt is not None:
        reckoning.add_doubt(frame.doubt, emitter, end)
    if frame.detail is not Detail.CREDIT:
        end.each.lines.append("# What an evaluation adds up.")
        reckoning.add_details(emitter, end)
    if frame.detail is Detail.TRACE:
        reckoning.record(emitter, end)
    if frame.episode.ends is not None:
        ended = emitter.value(frame.episode.ends, end.team)
        end.team.lines.append(
            f"{frame.running}[lane] = {frame.call_of('select', ended, '0.0', f'{frame.running}[lane]')}"
        )
    for slot, text in after.items():
        array = frame.slots[slot]
        block = end.storing(own=frame.is_own(array))
        block.lines.append(frame.store(array, text, frame.episode.after[slot].kind))
    all_over = [] if frame.running is None else [f"if {frame.running}.sum() == 0.0:", "    break"]
    return [*decision.look_up(), *written(emitter.blocks, frame), *all_over]


def _after(frame: Frame, emitter: Emitter, end: Closing) -> dict[Slot, str]:
    """What each slot that changes will hold, by names that stay true while slots are stored one after the other."""
    found = {}
    for slot, array in frame.slots.items():
        node, wanted = frame.episode.after[slot], f"next_{slot_text(slot, frame.robots)}"
        if node.operation == "slot" and node.data == slot:
            continue
        block = end.storing(own=frame.is_own(array))
        if node.operation == "slot":
            now = end.knowing(own=node.level in OWN)
            found[slot] = emitter.copied(node, wanted, now, block)
        else:
            found[slot] = emitter.named(node, wanted, block)
    return found
