"""The comment above the sensing part of a header: how it is used, what it needs, how it is compiled."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.exports.c import comment
from bbsd.exports.sensing.statements import INDENT

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from bbsd.exports.sensing.program import Program
    from bbsd.exports.sensing.statements import Statements
    from bbsd.exports.sensing.values import Member

    Members = Mapping[str, Sequence[Member]]
    """The members of each struct: inputs, memory, outputs."""


def head_of(prefix: str, program: Program, members: Members, statements: Statements) -> list[str]:
    """Return the lines of the comment."""
    first, *others = _said(prefix, program)
    example = _example(prefix, members, uses_robot=statements.uses_robot)
    lines = [line for text in others for line in (" *", *_open(text))]
    opened = [f"/*{_open(first)[0][2:]}", *_open(first)[1:]]
    return [*opened, " *", *(f" *     {line}" for line in example), *lines, " */"]


def _said(prefix: str, program: Program) -> Iterator[str]:
    yield (
        f"From what a robot measures to what it does: {prefix}_step() computes sensors and excitation, decides by "
        f"{prefix}_command(), and computes what the action sets:"
    )
    drawn = [each.name for each in program.needs.given if program.draws_itself(each.name)]
    if drawn:
        one = len(drawn) == 1
        what = "is a sensor that draws, so it is given" if one else "are sensors that draw, so they are given"
        yield f"{_joined(drawn)} {what}."
    kept = [member.identifier for member in program.memory.declared]
    if kept:
        yield f"The robot keeps {_joined(kept)} itself; what it measures of that can be written over before a step."
    yield (
        "All is computed in binary64, bit for bit as the design does, where every operation is rounded: compile "
        "without -ffast-math and with -ffp-contract=off, and link with -lm."
    )


def _example(prefix: str, members: Members, *, uses_robot: bool) -> Iterator[str]:
    names = [name for name, each in members.items() if each]
    for name in names:
        yield f"struct {prefix}_{name} {name};"
    if members["memory"]:
        yield f"{prefix}_start(&memory{', 0' if uses_robot else ''});"
    yield "for (;;) {"
    for member in members["inputs"][:1]:
        yield f"{INDENT}inputs.{member.identifier} = ...;"
    yield f"{INDENT}{prefix}_step({', '.join(f'&{name}' for name in names)});"
    for member in members["outputs"][:1]:
        yield f"{INDENT}... outputs.{member.identifier} ..."
    yield "}"


def _joined(names: Sequence[str]) -> str:
    """Return names as a sentence has them."""
    *most, last = names
    return f"{', '.join(most)} and {last}" if most else last


def _open(text: str) -> list[str]:
    """Return the lines of a paragraph within a comment that goes on."""
    first, *rest = comment(text)
    lines = [f" *{first[2:]}", *rest]
    return [*lines[:-1], lines[-1].removesuffix(" */")]
