"""A design as one C99 header that decides from what a robot measures: sensors, cells, the decision, assignments."""

from __future__ import annotations

import re
from textwrap import wrap
from typing import TYPE_CHECKING

from bbsd.architecture.needs import needs_of
from bbsd.exports import c
from bbsd.exports.c import comment
from bbsd.exports.names import Names
from bbsd.exports.sensing.functions import functions_text
from bbsd.exports.sensing.head import head_of
from bbsd.exports.sensing.playing import Player
from bbsd.exports.sensing.program import Program
from bbsd.exports.sensing.statements import INDENT, names_in, statements_of
from bbsd.exports.sensing.values import Member
from bbsd.expression.kinds import Kind

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from bbsd.exports.c import Writing
    from bbsd.exports.exported import Exported, Files, Options

LINE_WIDTH = 100
IN_HEADERS = {
    "math.h": r"\b(NAN|INFINITY|fabs|floor|ceil|sqrt|copysign)\b",
    "stdbool.h": r"\b(bool|true|false)\b",
    "string.h": r"\bmemcpy\b",
}
"""What is included where its names occur."""
CHECKS = """
#if DBL_MANT_DIG != 53 || DBL_MAX_EXP != 1024
#error "double is not binary64 here: use the header without sensing, and compute the cells in your own program"
#endif
#if defined(__FAST_MATH__)
#error "-ffast-math would change results"
#endif
#if defined(FLT_EVAL_METHOD) && FLT_EVAL_METHOD != 0 && FLT_EVAL_METHOD != 1
#error "each operation must be rounded to binary64: for x86 compile with -msse2 -mfpmath=sse"
#endif
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#endif
"""
"""What must hold of the compiler so that all results have the tool's bits."""


def write(exported: Exported, options: Options) -> Files:
    """Return the header's text by its file's name, with sensing if that is asked for."""
    files = c.write(exported, options)
    if not options.sensing:
        return files
    ((name, text),) = files.items()
    return {name: f"{text}\n{sensing_of(exported, options).text()}"}


def sensing_of(exported: Exported, options: Options) -> Sensing:
    """Return the second part of the header, which calls the function that decides in the first."""
    meaning, controller = exported.meaning, exported.controller
    measured, remembered = options.measured, options.remembered
    needs = needs_of(meaning, controller, measured=measured, remembered=remembered, definitions=True)
    generation = meaning.spec.design.coevolution.generations
    program = Program(meaning, controller, needs, meaning.constants.vector(generation), measured)
    return Sensing(program, c.named(controller))


class Sensing:
    """The second part of a header."""

    def __init__(self, program: Program, writing: Writing) -> None:
        self.program, self.writing = program, writing
        self.statements = statements_of(program, writing)
        self.members = {
            "inputs": [*program.inputs.declared, *program.draws.values()],
            "memory": [*program.memory.declared, *self._own_memory()],
            "outputs": program.outputs.declared,
        }
        """The members of each struct; of those that have none, there is no struct."""

    @property
    def player(self) -> Player:
        """The same robot in plain Python."""
        return Player(self.program.controller, self.program.needs, self.program.constants)

    def text(self) -> str:
        """Return the text."""
        upper = self.writing.upper
        body = [*self._structs(), *self._start(), *self._step()]
        functions = functions_text(self.program.emitter.used)
        code = "\n".join([*functions, *body])
        lines = [
            *head_of(self.writing.prefix, self.program, self.members, self.statements),
            f"#ifndef {upper}_SENSING_H",
            f"#define {upper}_SENSING_H",
            "",
            "#include <float.h>",
            *(f"#include <{header}>" for header, names in IN_HEADERS.items() if re.search(names, code)),
            CHECKS,
            *(line for text in functions for line in (text, "")),
            *body,
            "",
            f"#endif /* {upper}_SENSING_H */",
        ]
        return "\n".join(lines) + "\n"

    def _own_memory(self) -> Iterator[Member]:
        if self.statements.steps_use_robot:
            robots = len(self.program.needs.robots)
            yield Member("robot", Kind.CELL, comment=f"which one of the team it is, 0 to {robots - 1}")
        if self.statements.counts_steps:
            yield Member("step", Kind.NUMBER, comment="steps until now")

    def _structs(self) -> Iterator[str]:
        """Yield the types of what is given, kept and set."""
        prefix = self.writing.prefix
        yield from self._enums()
        said = {
            "inputs": "What the robot is given before each step.",
            "memory": f"What the robot keeps from step to step; {prefix}_start() writes it first.",
            "outputs": "What state that actions set is after the action; what none set stays.",
        }
        for name, members in self.members.items():
            if members:
                yield from comment(said[name])
                yield f"struct {prefix}_{name} {{"
                for member in members:
                    yield from _declared(member)
                yield "};"
                yield ""

    def _enums(self) -> Iterator[str]:
        """Yield the names of values as constants, where the first part has none of them for an input's cells."""
        taken = Names({*self.writing.actions, *(name for cells in self.writing.cells for name in cells)})
        for name, values in self.program.named.items():
            own = Names(())
            wanted = [own.new(f"{self.writing.prefix} {name} {value}", upper=True) for value in values]
            if wanted in [[*cells] for cells in self.writing.cells]:
                continue
            yield from comment(f"The values of {name}.")
            yield f"enum {self.writing.prefix}_values_of_{name} {{"
            for number, text in enumerate(wanted):
                constant = taken.new(text)
                yield f"{INDENT}{constant} = {number}{',' if number < len(values) - 1 else ''}"
            yield "};"
            yield ""

    def _start(self) -> Iterator[str]:
        """Yield the function that writes the memory before the first step."""
        if not self.members["memory"]:
            return
        prefix = self.writing.prefix
        robot = ", int robot" if self.statements.uses_robot else ""
        yield f"static inline void {prefix}_start(struct {prefix}_memory *memory{robot})"
        yield "{"
        if self.statements.uses_robot:
            self.program.emitter.used.add("bbsd_clamp_cell")
            yield f"{INDENT}robot = bbsd_clamp_cell(robot, {len(self.program.needs.robots) - 1});"
        if self.statements.steps_use_robot:
            yield f"{INDENT}memory->robot = robot;"
        if self.statements.counts_steps:
            yield f"{INDENT}memory->step = 0.0;"
        yield from self._constants(self.statements.start)
        yield from _indented(self.statements.start)
        yield from _indented(self._zeros())
        yield "}"
        yield ""

    def _zeros(self) -> Iterator[str]:
        """Yield what writes zeros where nothing else was written: what is not read before the second step."""
        written = {name for line in self.statements.start for name in re.findall(r"^memory->(\w+)", line)}
        for member in self.program.memory.declared:
            if member.identifier not in written:
                yield from _zeroed(member)

    def _step(self) -> Iterator[str]:
        """Yield the function that takes a step."""
        prefix, upper = self.writing.prefix, self.writing.upper
        pointers = [
            f"{'const ' if name == 'inputs' else ''}struct {prefix}_{name} *{name}"
            for name, members in self.members.items()
            if members
        ]
        yield from comment(
            f"Take a step: return the controlling action, or {upper}_NOBODY, and do what it does."
        )
        yield f"static inline enum {prefix}_action {prefix}_step("
        yield f"{INDENT}{f',{chr(10)}{INDENT}'.join(pointers) or 'void'})"
        yield "{"
        if self.statements.steps_use_robot:
            yield f"{INDENT}const int robot = memory->robot;"
        if self.statements.counts_steps:
            yield f"{INDENT}const double step = (memory->step += 1.0);"
        yield from self._constants(self.statements.step)
        yield from _indented(self.statements.step)
        yield "}"

    def _constants(self, statements: Sequence[str]) -> Iterator[str]:
        """Yield the declarations of the constants that statements read."""
        read = names_in(statements)
        declared = {**dict(self.program.tables.values()), **self.program.constant_lines}
        yield from _indented(line for name, line in declared.items() if name in read)


def _declared(member: Member) -> Iterator[str]:
    """Yield the declaration of a member with what is said of it, behind it if that is short."""
    remark = comment(member.comment) if member.comment else [""]
    if len(remark) == 1:
        yield f"{INDENT}{member.declaration} {remark[0]}".rstrip()
    else:
        yield from _indented(remark)
        yield f"{INDENT}{member.declaration}"


def _zeroed(member: Member) -> Iterator[str]:
    zero = "false" if member.kind is Kind.TRUTH else "0" if member.kind is Kind.CELL else "0.0"
    places = [""]
    for length in member.shape:
        places = [f"{place}[{index}]" for place in places for index in range(length)]
    for place in places:
        yield f"memory->{member.identifier}{place} = {zero};"


def _indented(lines: Iterable[str]) -> Iterator[str]:
    """Yield lines one level deeper; long ones go on deeper still, broken at blanks, which texts of C here allow."""
    for line in lines:
        own = len(line) - len(line.lstrip())
        deeper = " " * own + 2 * INDENT
        yield from wrap(
            line.lstrip(),
            LINE_WIDTH,
            initial_indent=INDENT + " " * own,
            subsequent_indent=INDENT + (" " * own + " " if line.lstrip().startswith(("/*", "*")) else deeper),
            break_long_words=False,
            break_on_hyphens=False,
        ) or [""]
