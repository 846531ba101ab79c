"""The source of a spec's rollouts: functions that run an episode in each lane of a batch.

The loop over steps is outside, the loop over lanes inside, and its body has no branches, so it vectorizes. A lane is an
agent in an episode. `docs/rollout.md` states the function's arguments.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from bbsd.compiler.details import IN_DETAIL, PHASES, WORLD_PHASES, Detail
from bbsd.compiler.writing.naming import PHASED
from bbsd.compiler.writing.parts import parts_of
from bbsd.compiler.writing.practice import PRACTICE
from bbsd.compiler.writing.rollout_function import RolloutFunction, indent
from bbsd.compiler.writing.totals import DETAILED
from bbsd.kernel import functions, memory, streams
from bbsd.version import __version__

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from bbsd.compiler.joint import JointPartition
    from bbsd.compiler.passes.pipeline import Program
    from bbsd.compiler.tables import TableShape
    from bbsd.expression.graph import Node

SPAN = ("first", "last")
"""The arguments that say which lanes a whole rollout runs."""
ARGUMENTS = (
    *SPAN, "numbers", "keys", "individuals", "packed_tables", "tables", "table_offsets", "priorities",
    "constants", "returns", "credit",
)  # fmt: skip
WORLD = ("numbers", "keys", "constants", "returns", "earned", "observed")
"""The arguments of a world: what each robot earned in a step, (n_robots, lanes), and what is observed, (n, lanes)."""


def module_source(
    programs: Mapping[Detail, Program],
    shapes: Sequence[TableShape],
    lanes: int,
    joint: JointPartition | None = None,
    *,
    in_phases: bool = False,
    observed: Sequence[Node] = (),
) -> str:
    """Return the source of a module with the rollouts of these programs, and how much memory they need.

    A rollout for practice needs the joint partition. In phases, there are functions for each rollout's parts; a world
    is always in phases, and needs what is observed of it.
    """
    write = phases_source if in_phases else rollout_source
    texts, used, tables, memory_size = [], set(), dict[str, str](), 0
    for detail, program in programs.items():
        function = RolloutFunction(
            program.meaning, shapes, lanes, detail, program.to_prove, tuple(observed), tables
        )
        practiced = joint if detail is Detail.PRACTICE else None
        texts.append(f"\n{write(function, practiced)}")
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
    parts = parts_of(function, joint)
    start, step, finish = parts.start(), parts.step(), parts.finish()
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


def _ends_uncertain(uncertain: str) -> list[str]:
    """Return the lines that return whether a comparison of some lane was uncertain, as soon as one was."""
    return [f"        if {uncertain}.sum() > 0.0:", "            return True", "    return False"]


def phases_source(function: RolloutFunction, joint: JointPartition | None = None) -> str:
    """Return the source of a rollout in phases: functions that do its parts in one batch of lanes.

    What a lane is between them stays in `numbers`; its choices, what it sends and gets, and whether it lives in arrays.
    """
    arguments = [*_arguments(function.detail)[len(SPAN) :], *PHASED]
    function.namer.reserve(arguments)
    parts = parts_of(function, joint)
    bodies = dict[str, list[str]]()
    for phase in WORLD_PHASES if function.detail is Detail.WORLD else PHASES:
        bodies[phase] = getattr(parts, phase)()
        function.namer.forget_all_but([*arguments, *parts.lasting_names])
    if function.uncertain is not None:
        bodies["finish"].append(f"return {function.uncertain}.sum() > 0.0")
    setup = [*function.scratch(), *function.call.lines]
    declared = ", ".join(["base", "step", *arguments])
    return "\n\n\n".join(
        "\n".join(
            [f"def {function.detail.value}_{phase}({declared}):", *indent([*_used(setup, body), *body], 1)]
        )
        for phase, body in bodies.items()
    )


def _used(setup: Sequence[str], body: Sequence[str]) -> list[str]:
    """Return those lines of a setup, each `name = ...`, whose names a body needs."""
    names, lines = _words(body), list[str]()
    for line in reversed(setup):
        if line.partition(" = ")[0] in names:
            names |= _words([line])
            lines.append(line)
    return lines[::-1]


def _words(lines: Iterable[str]) -> set[str]:
    return {word for line in lines for word in re.findall(r"\w+", line)}


def _arguments(detail: Detail) -> list[str]:
    """Return the names of a rollout's arguments."""
    if detail is Detail.PRACTICE:
        return [*(name for name in ARGUMENTS if name != "credit"), *PRACTICE]
    if detail is Detail.WORLD:
        return [*SPAN, *WORLD]
    further = DETAILED if detail in IN_DETAIL else ()
    return [*ARGUMENTS, *further, *(["record"] if detail is Detail.TRACE else [])]
