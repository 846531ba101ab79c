"""One long loop over lanes as several short ones.

A loop as long as a processor's reorder buffer waits for its own chain of operations, since the next lanes do not fit
beside it. Cut where the decision ends and around expensive functions it runs almost twice as fast. What one loop
computes and another needs crosses in scratch arrays, so no bit changes.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from bbsd.compiler.emission import EXPENSIVE
from bbsd.expression.graph import Kind

if TYPE_CHECKING:
    from bbsd.compiler.emission import Block
    from bbsd.compiler.frame import Frame

COSTLY = re.compile(rf"\b({'|'.join([*sorted(EXPENSIVE), 'normal'])})\(")
DEFINED = re.compile(r"(\w+) = ")
NAME = re.compile(r"\b[a-z_]\w*\b")
ACT = "# Act"
SHORTEST, LONGEST = 12, 60
"""Lines of a loop: fewer are not worth one, more are cut anywhere."""


def loops(block: Block, frame: Frame) -> list[list[str]]:
    """The bodies of loops that do the same as one loop over the block's lines, in their order."""
    parts = _cut(block.lines)
    if len(parts) == 1:
        return parts
    born = {
        match[1]: place for place, part in enumerate(parts) for match in map(DEFINED.match, part) if match
    }
    used = [set(NAME.findall("\n".join(part))) for part in parts]
    kept = {
        name: _keep(name, block, frame)
        for name, place in born.items()
        if any(name in names for names in used[place + 1 :])
    }
    return [
        [
            *(_load(name, kept[name], block) for name in kept if born[name] < place and name in used[place]),
            *part,
            *(_store(name, kept[name], block, frame) for name in kept if born[name] == place),
        ]
        for place, part in enumerate(parts)
    ]


def _cut(lines: list[str]) -> list[list[str]]:
    parts: list[list[str]] = [[]]
    for line in lines:
        before = parts[-1][-1] if parts[-1] else ""
        expensive, was_expensive = bool(COSTLY.search(line)), bool(COSTLY.search(before))
        turns = line.startswith(ACT) or expensive != was_expensive
        if len(parts[-1]) >= LONGEST or (turns and len(parts[-1]) >= (1 if was_expensive else SHORTEST)):
            parts.append([])
        parts[-1].append(line)
    return parts


def _keep(name: str, block: Block, frame: Frame) -> str:
    wanted = f"{name}_kept"
    return frame.keep_integer(wanted) if block.kinds.get(name) is Kind.CELL else frame.keep(wanted)


def _store(name: str, kept: str, block: Block, frame: Frame) -> str:
    is_truth = block.kinds.get(name) is Kind.TRUTH
    return f"{kept}[lane] = {frame.call_of('select', name, '1.0', '0.0') if is_truth else name}"


def _load(name: str, kept: str, block: Block) -> str:
    return f"{name} = {kept}[lane]{' != 0.0' if block.kinds.get(name) is Kind.TRUTH else ''}"
