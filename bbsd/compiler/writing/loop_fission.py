"""One long loop over lanes as several short ones.

A loop as long as a processor's reorder buffer waits for its own chain of operations, since the next lanes do not fit
beside it. Cut where the decision ends and around expensive functions it runs almost twice as fast. What one loop
computes and another needs crosses in scratch arrays, so no bit changes.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from bbsd.expression.graph import Level
from bbsd.expression.operations import EXPENSIVE

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bbsd.compiler.writing.blocks import Block, Blocks
    from bbsd.compiler.writing.rollout_function import RolloutFunction

COSTLY = re.compile(rf"\b({'|'.join([*sorted(EXPENSIVE), 'normal'])})\(")
DEFINED = re.compile(r"(\w+) = ")
NAME = re.compile(r"\b[a-z_]\w*\b")
SEEN = re.compile(r"\bseen_\d+\b")
MOST_SEEN = 2
"""Other robots whose values a loop reads: with more of them LLVM does not compare all ranges that might overlap."""
ACT = "# Act"
SHORTEST, LONGEST = 12, 60
"""Lines of a loop: fewer are not worth one, more are cut anywhere."""


def written(
    blocks: Blocks, function: RolloutFunction, *, split: bool = True, apart: Sequence[str] = ()
) -> list[str]:
    """The lines of all stages' loops, in their order; those `apart` in one more loop over lanes behind the last one."""
    lines = [*blocks.step.lines]
    every = [stage for stage in blocks.every() if not stage.is_empty]
    for stage in every:
        block = stage.block
        bodies = [body for body in (loops(block, function) if split else [block.lines]) if body]
        bodies += [[*apart]] if apart and stage is every[-1] else []
        if block.level is Level.EACH:
            before = [*(stage.robot.lines if stage.robot else ())]
            for others, pair in stage.pairs.items():
                before += function.pair_loop(pair.head, loops(pair, function), others=others)
            lines += function.robot_loop(before, bodies)
        else:
            lines += [line for body in bodies for line in function.lane_loop(body)]
    return lines


def loops(block: Block, function: RolloutFunction) -> list[list[str]]:
    """The bodies of loops that do the same as one loop over the block's lines, in their order.

    Each begins with the values that others computed and ends with storing those that others need.
    """
    parts = _cut([*block.lines, *block.last])
    used = [set(NAME.findall("\n".join(part))) for part in parts]
    born = [[match[1] for match in map(DEFINED.match, part) if match] for part in parts]
    kept, read = dict(block.kept), dict(block.read)
    for place, names in enumerate(born):
        for name in names:
            if any(name in others for others in used[place + 1 :]):
                kind = block.kind_of(name)
                kept[name] = kept.get(name) or function.keep(f"{name}_kept", kind)
                read[name], _ = function.read(kept[name], kind)
    return [
        [
            *(f"{name} = {source}" for name, source in read.items() if name in names - set(here)),
            *part,
            *(function.store(kept[name], name, block.kind_of(name)) for name in here if name in kept),
        ]
        for part, names, here in zip(parts, used, born, strict=True)
    ]


def _cut(lines: list[str]) -> list[list[str]]:
    parts: list[list[str]] = [[]]
    seen: set[str] = set()
    for line in lines:
        before = parts[-1][-1] if parts[-1] else ""
        expensive, was_expensive = bool(COSTLY.search(line)), bool(COSTLY.search(before))
        turns = line.startswith(ACT) or expensive != was_expensive
        crowded = len({*seen, *SEEN.findall(line)}) > MOST_SEEN
        long = len(parts[-1]) >= LONGEST
        turns = turns and len(parts[-1]) >= (1 if was_expensive else SHORTEST)
        if (crowded or long or turns) and not all(each.startswith("#") for each in parts[-1]):
            parts.append([])
            seen.clear()
        seen.update(SEEN.findall(line))
        parts[-1].append(line)
    return parts
