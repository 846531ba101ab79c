"""One long loop over lanes as several short ones.

A loop as long as a processor's reorder buffer waits for its own chain of operations, since the next lanes do not fit
beside it. Cut where the decision ends and around expensive functions it runs almost twice as fast. What one loop
computes and another needs crosses in arrays, so no bit changes.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.compiler.writing.blocks import Comment, definitions_of
from bbsd.compiler.writing.precedence import name_text
from bbsd.expression.graph import Level

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bbsd.compiler.writing.blocks import Assignment, Block, Blocks, Statement
    from bbsd.compiler.writing.rollout_function import RolloutFunction

MOST_SEEN = 2
"""Other robots whose values one loop may read.

For more of them LLVM does not compare all ranges of memory that might overlap, and the loop is not vectorized.
"""
SHORTEST_LOOP, LONGEST_LOOP = 12, 60
"""Statements of a loop: fewer are not worth one, more are cut anywhere.

A step of lifting as one loop had some 400 instructions, which fill a reorder buffer: 3.0 ns a robot-step, 1.65 ns cut.
"""
LONGEST_ONCE = 240
"""Statements of a loop that runs once an episode: cutting it saves no time but LLVM's, which grows with its square."""


def loop_lines(
    blocks: Blocks, function: RolloutFunction, *, split: bool = True, apart: Sequence[str] = ()
) -> list[str]:
    """Return the lines of all stages' loops in their order.

    `apart` are the lines of one more loop over lanes behind the last one.
    """
    lines = [*blocks.step.lines]
    stages = [stage for stage in blocks.in_order() if not stage.is_empty]
    for stage in stages:
        block = stage.block
        bodies = [body for body in (split_loop(block, function) if split else [block.lines]) if body]
        bodies += [[*apart]] if apart and stage is stages[-1] else []
        if block.level is Level.EACH:
            before = [*(stage.robot.lines if stage.robot else ())]
            for others, pair in stage.pairs.items():
                shared = [definition.line for definition in pair.before]
                before += function.pair_loop(shared, split_loop(pair, function), others=others)
            lines += function.robot_loop(before, bodies)
        else:
            lines += [line for body in bodies for line in function.lane_loop(body)]
    return lines


def split_loop(block: Block, function: RolloutFunction) -> list[list[str]]:
    """Return the bodies of loops that together do what one loop over a block's statements does.

    Each begins with reading the values that others computed and ends with storing those that others need.
    """
    parts = _cut([*block.statements, *block.after], block.robots_seen)
    uses = [frozenset[str]().union(*(statement.uses for statement in part)) for part in parts]
    definitions = [definitions_of(part) for part in parts]
    kept, read = dict(block.kept), dict(block.read)
    for index, defined in enumerate(definitions):
        used_later = frozenset[str]().union(*uses[index + 1 :])
        for definition in defined:
            name, kind = definition.target, definition.kind
            if name in used_later:
                kept[name] = kept.get(name) or function.keep(f"{name}_kept", kind)
                read[name] = function.read(kept[name], kind).source
    return [
        [
            *_reads(read, used.difference(definition.target for definition in defined)),
            *(statement.line for statement in part),
            *_stores(kept, defined, function),
        ]
        for part, used, defined in zip(parts, uses, definitions, strict=True)
    ]


def once_loops(lines: Sequence[str], function: RolloutFunction) -> list[str]:
    """Return loops over lanes that do lines which need nothing of one another: one, or several where they are many."""
    length = len(lines) if len(lines) <= LONGEST_ONCE else LONGEST_LOOP
    parts = [lines[first : first + length] for first in range(0, len(lines), length)]
    return [line for part in parts for line in function.lane_loop(part)]


def _reads(read: dict[str, str], names: frozenset[str]) -> list[str]:
    return [f"{name} = {element}" for name, element in read.items() if name in names]


def _stores(kept: dict[str, str], definitions: list[Assignment], function: RolloutFunction) -> list[str]:
    return [
        f"{function.at(kept[name])} = {function.as_stored(name_text(name), kind).source}"
        for name, _, kind, _ in definitions
        if name in kept
    ]


def _cut(statements: Sequence[Statement], robots_seen: set[str]) -> list[list[Statement]]:
    """Cut statements into the parts that get a loop each."""
    parts: list[list[Statement]] = [[]]
    seen: set[str] = set()
    for statement in statements:
        part, sees = parts[-1], statement.uses & robots_seen
        was_expensive = bool(part) and part[-1].is_expensive
        turns = statement.starts_phase or statement.is_expensive != was_expensive
        turns = turns and len(part) >= (1 if was_expensive else SHORTEST_LOOP)
        crowded, long = len(seen | sees) > MOST_SEEN, len(part) >= LONGEST_LOOP
        if (crowded or long or turns) and not all(isinstance(before, Comment) for before in part):
            parts.append([])
            seen.clear()
        seen |= sees
        parts[-1].append(statement)
    return parts
