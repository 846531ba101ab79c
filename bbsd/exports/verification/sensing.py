"""A header with sensing, compiled and run beside recorded episodes and at the edges of cells."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from bbsd.exports.sensing.values import scalars_of
from bbsd.exports.verification.tools import ToolFailed, folder_of, found, run_in
from bbsd.expression.kinds import Kind

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bbsd.exports.exported import Files
    from bbsd.exports.sensing.header import Sensing
    from bbsd.exports.sensing.playing import Answer, Situation
    from bbsd.exports.sensing.values import Scalar

Floats = npt.NDArray[np.float64]

DRIVER = """
#include "{header}"
#include <stdio.h>

static int truth_of(double x)
{{
    return x != 0.0;
}}

int main(void)
{{
    double row[{width}], out[{answers}];
    FILE *rows = fopen("rows", "rb");
    FILE *answers = fopen("answers", "wb");
{declarations}
    (void)truth_of;
{first}
    if (rows == NULL || answers == NULL) {{
        return 1;
    }}
    while (fread(row, sizeof(double), {width}, rows) == {width}) {{
{statements}
        if (fwrite(out, sizeof(double), {answers}, answers) != {answers}) {{
            return 1;
        }}
    }}
    return fclose(answers) == 0 && fclose(rows) == 0 ? 0 : 1;
}}
"""


FIRST = 3
"""Where the memory begins in a row."""


class Memory(Enum):
    """What a robot's memory is before a step."""

    KEPT = 0.0
    """As the situation before left it."""
    STARTED = 1.0
    """As an episode starts."""
    GIVEN = 2.0
    """As the situation says."""


@dataclass(frozen=True, slots=True)
class Driver:
    """A program that takes a header's steps: rows of numbers in, rows of numbers out.

    A row is: what the memory is, the robot, the step before; the memory; the inputs; random numbers. An answer is the
    action, the outputs, the memory.
    """

    sensing: Sensing

    @property
    def memory(self) -> list[Scalar]:
        """The scalars of the memory."""
        return scalars_of(self.sensing.program.memory)

    @property
    def inputs(self) -> list[Scalar]:
        """The scalars that are given."""
        return scalars_of(self.sensing.program.inputs)

    @property
    def outputs(self) -> list[Scalar]:
        """The scalars that are set."""
        return scalars_of(self.sensing.program.outputs)

    def row(self, situation: Situation, memory: Memory) -> list[float]:
        """Return a situation as a row."""
        robot = situation.robot
        program, player = self.sensing.program, self.sensing.player
        randoms = list[float]()
        for draw in program.draws:
            own = draw.words[robot] if len(draw.words) == len(player.needs.robots) else draw.words[0]
            found_draw = [each for each in situation.random if each.word == own]
            randoms.append(situation.random[found_draw[0]] if found_draw else 0.5)
        return [
            memory.value,
            float(robot),
            float(situation.step - 1),
            *(float(situation.kept.get(each.of(robot), 0.0)) for each in self.memory),
            *(float(situation.given[each.of(robot)]) for each in self.inputs),
            *randoms,
        ]

    def expected(self, situation: Situation, answer: Answer) -> list[float | None]:
        """Return an answer as a row; None for what other robots of the team keep, but not this one."""
        return [
            float(answer.action),
            *(float(answer.set_values[each.slot.variable]) for each in self.outputs),
            *(_float(answer.kept.get(each.of(situation.robot))) for each in self.memory),
        ]

    def run(
        self, files: Files, rows: Sequence[Sequence[float]], compiler: str, flags: Sequence[str]
    ) -> Floats:
        """Return the answers (n, width) to rows. Raises ToolMissing, ToolFailed."""
        header = next(iter(files))
        program = found(compiler)
        with folder_of({**files, "driver.c": self._text(header)}) as folder:
            (folder / "rows").write_bytes(np.array(rows, "<f8").tobytes())
            run_in(folder, program, *flags, "-o", "driver", "driver.c", "-lm")
            run_in(folder, folder / "driver")
            answers = np.frombuffer((folder / "answers").read_bytes(), "<f8")
        width = 1 + len(self.outputs) + len(self.memory)
        if answers.size != len(rows) * width:
            raise ToolFailed(f"{answers.size // width} answers for {len(rows)} situations")
        return answers.reshape(len(rows), width)

    def _text(self, header: str) -> str:
        prefix, parts = header.removesuffix(".h"), self.sensing
        declarations, statements, arguments = list[str](), list[str](), list[str]()
        for name, members in parts.members.items():
            if members:
                arguments.append(f"&{name}")
                declarations.append(f"struct {prefix}_{name} {name};")
        first = ""
        if parts.members["memory"]:
            uses_robot = parts.statements.uses_robot
            first = f"    {prefix}_start(&memory{', 0' if uses_robot else ''});"
            robot = ", (int)row[1]" if uses_robot else ""
            statements += [f"if (row[0] > 0.0) {{ {prefix}_start(&memory{robot});"]
            statements.append("} if (row[0] > 1.0) {")
            if parts.statements.counts_steps:
                statements.append("memory.step = row[2];")
            for place, each in enumerate(self.memory, FIRST):
                statements.append(f"memory.{each.place} = {_cast(each.kind, place)};")
            statements.append("}")
        for place, each in enumerate(self.inputs, FIRST + len(self.memory)):
            statements.append(f"inputs.{each.place} = {_cast(each.kind, place)};")
        for place, member in enumerate(
            self.sensing.program.draws.values(), FIRST + len(self.memory) + len(self.inputs)
        ):
            statements.append(f"inputs.{member.identifier} = row[{place}];")
        statements.append(f"out[0] = (double){prefix}_step({', '.join(arguments)});")
        for place, each in enumerate(self.outputs, 1):
            statements.append(f"out[{place}] = (double)outputs.{each.place};")
        for place, each in enumerate(self.memory, 1 + len(self.outputs)):
            statements.append(f"out[{place}] = (double)memory.{each.place};")
        return DRIVER.format(
            header=header,
            width=FIRST + len(self.memory) + len(self.inputs) + len(self.sensing.program.draws),
            answers=1 + len(self.outputs) + len(self.memory),
            first=first,
            declarations="\n".join(f"    {line}" for line in declarations),
            statements="\n".join(f"        {line}" for line in statements),
        )


def _cast(kind: Kind, place: int) -> str:
    if kind is Kind.TRUTH:
        return f"truth_of(row[{place}])"
    return f"(int)row[{place}]" if kind is Kind.CELL else f"row[{place}]"


def _float(value: float | None) -> float | None:
    return None if value is None else float(value)


def equal_rows(answers: Floats, expected: Sequence[Sequence[float | None]]) -> npt.NDArray[np.bool_]:
    """Return which answers (n, width) have the bits of all that is expected; NaN is NaN whatever its bits."""
    unknown = np.array([[value is None for value in row] for row in expected], np.bool_)
    numbers = np.array([[0.0 if value is None else value for value in row] for row in expected], np.float64)
    same = answers.view(np.int64) == numbers.view(np.int64)
    equal: npt.NDArray[np.bool_] = (unknown | same | (np.isnan(answers) & np.isnan(numbers))).all(axis=1)
    return equal
