"""Whether a header with sensing does what the design does: in recorded episodes, at edges of cells, and elsewhere."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bbsd.exports.sensing.header import sensing_of
from bbsd.exports.verification.compilers import STRICT
from bbsd.exports.verification.sensing import Driver, Memory, equal_rows
from bbsd.exports.verification.situations import other_steps, recorded_steps
from bbsd.exports.verification.tools import ToolFailed, ToolMissing

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bbsd.exports.exported import Exported, Files, Options
    from bbsd.exports.verification.situations import Step

FLAGS = (*STRICT, "-O2", "-ffp-contract=off")


@dataclass(frozen=True, slots=True)
class Followed:
    """What came of running a header with sensing beside the design, bit for bit.

    `steps` of `episodes` recorded, each robot's; `situations` at the edges of cells, with odd numbers, and drawn.
    """

    tool: str
    missing: bool
    failure: str
    episodes: int
    steps: int
    equal_steps: int
    situations: int
    equal_situations: int
    first_difference: str

    @property
    def is_equal(self) -> bool:
        """Whether it ran and did in all of them what the design does."""
        is_same = self.equal_steps == self.steps and self.equal_situations == self.situations
        return not self.missing and not self.failure and is_same


def follow(
    exported: Exported,
    options: Options,
    files: Files,
    episodes: int,
    compiler: str = "gcc",
    flags: Sequence[str] = FLAGS,
) -> Followed:
    """Compile a header with sensing and compare what it does with what the design does."""
    driver = Driver(sensing_of(exported, options))
    # An environment that is stepped in Python is not at hand here.
    episodes = 0 if exported.meaning.episode.outside else episodes
    recorded = list(recorded_steps(exported, driver, episodes))
    others = other_steps(driver, recorded, exported.controller.name)
    rows = [
        *(driver.row(step.situation, Memory.STARTED if step.is_first else Memory.KEPT) for step in recorded),
        *(driver.row(step.situation, Memory.GIVEN) for step in others),
    ]
    steps = [*recorded, *others]
    missing, failure, equal, difference = False, "", np.zeros(len(steps), np.bool_), ""
    try:
        answers = driver.run(files, rows, compiler, flags)
        equal = equal_rows(answers, [driver.expected(step.situation, step.answer) for step in steps])
        if not equal.all():
            wrong = int(np.flatnonzero(~equal)[0])
            difference = _difference(driver, steps[wrong], answers[wrong].tolist())
    except ToolMissing:
        missing = True
    except ToolFailed as error:
        failure = str(error)
    of_steps, of_others = equal[: len(recorded)], equal[len(recorded) :]
    return Followed(
        compiler,
        missing,
        failure,
        episodes,
        len(recorded),
        int(of_steps.sum()),
        len(others),
        int(of_others.sum()),
        difference,
    )


def _difference(driver: Driver, step: Step, answer: Sequence[float]) -> str:
    """Return in words where a header first differs: the situation, what the design does, and what it does."""
    names = ["action", *(each.place for each in driver.outputs), *(each.place for each in driver.memory)]
    expected = driver.expected(step.situation, step.answer)
    differs = [
        f"{name} {wanted!r}, and there {got!r}"
        for name, wanted, got in zip(names, expected, answer, strict=True)
        if wanted is not None and repr(wanted) != repr(got)
    ]
    given = [
        f"{each.place} {step.situation.given[each.of(step.situation.robot)]!r}" for each in driver.inputs
    ]
    where = f"robot {step.situation.robot}, step {step.situation.step}, {', '.join(given)}"
    return f"{where}: the design has {'; '.join(differs)}"
