"""The trace of one episode, step by step: stored and defined values, controlling behaviors, reward terms."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
import numpy.typing as npt

from bbsd.evaluation.frames import frame
from bbsd.expression.node_data import Slot

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from bbsd.evaluation.tracing.decisions import Decisions, Layer
    from bbsd.evaluation.tracing.scene import Scene

    Column = tuple[Slot, list["Value"]]
    """A name with its robot, and a value before the first step and after each."""

Floats = npt.NDArray[np.float64]
Value: TypeAlias = float | int | bool | str
"""A number, a whole number, a truth, or the label of a cell or the name of a value."""


@dataclass(frozen=True, slots=True, eq=False)
class Trace:
    """An episode as columns of equal length, one entry a step.

    `values` are world, state, sensors and definitions after the step, `controlling[robot]` the names of the controlling
    behaviors, `actions[robot]` their actions, `rewards[term][robot]` what each term gave, `decisions` what every
    behavior perceived and wanted, `layers` the names that belong to it. Truths and whole numbers are values as such.
    """

    steps: npt.NDArray[np.int64]
    values: dict[Slot, list[Value]]
    start: dict[Slot, Value]
    """The same values before the first step."""
    controlling: list[list[str]]
    actions: list[list[str]]
    rewards: dict[str, list[Floats]]
    robots: int
    decisions: Decisions
    layers: tuple[Layer, ...]
    """Highest first."""
    expectations: list[list[str]] = field(default_factory=list)
    """For each robot whether the expectation of its controlling behavior `held` or `failed`, '' where it has none.

    Empty where no behavior of the spec expects anything.
    """
    named: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    """All names that a value can be one of, by what has them, where a value is one of several names."""
    scene: Scene | None = None
    """The scene of the spec's view, if it has one."""

    def before(self, step: int) -> dict[Slot, Value]:
        """Return the values on which the decisions of a step are made; steps are counted from 1."""
        return self.start if step == 1 else {slot: column[step - 2] for slot, column in self.values.items()}

    def to_frame(self) -> Any:  # noqa: ANN401 - pandas is optional
        """Return a pandas DataFrame with a row for each step, the start first, as the CSV of a trace.

        Raises NoPandas where pandas is not installed.
        """
        columns = {slot.label(self.robots): values for slot, values in trace_columns(self)}
        return frame({"step": range(len(self.steps) + 1), **columns}, index="step")

    def __repr__(self) -> str:
        total = sum(float(earned.sum()) for robots in self.rewards.values() for earned in robots)
        robots = f", {self.robots} robots" if self.robots > 1 else ""
        return f"<Trace of {len(self.steps)} steps{robots}, return {total / self.robots:.6g}>"


def trace_columns(trace: Trace) -> Iterator[Column]:
    """Yield all that a trace tells, one column after another; what is not known at the start is ''.

    A column of the trace's own whose name a value of the spec has too, such as `action`, has an underscore behind it.
    """
    for slot, values in trace.values.items():
        yield slot, [trace.start[slot], *values]
    taken = {slot.name for slot in trace.values}
    for slot, values in _columns_of_decisions(trace):
        name = slot.name
        while name in taken:
            name += "_"
        yield slot._replace(name=name), values


def _columns_of_decisions(trace: Trace) -> Iterator[Column]:
    """Yield who controlled and what was done, what was expected and earned, and what every behavior wanted."""
    for robot in range(trace.robots):
        yield Slot("controlling", robot), ["", *trace.controlling[robot]]
        yield Slot("action", robot), ["", *trace.actions[robot]]
    for robot, expectations in enumerate(trace.expectations):
        yield Slot("expectation", robot), ["", *expectations]
    for term, robots in trace.rewards.items():
        for robot, earned in enumerate(robots):
            yield Slot(f"reward_{term}", robot), ["", *earned.tolist()]
    for robot in range(trace.robots):
        for layer in trace.layers:
            yield from _decisions(trace, layer, robot)


def _decisions(trace: Trace, layer: Layer, robot: int) -> Iterator[Column]:
    """Yield whether a layer's behavior was excited, the cell that it was in, and what it wanted."""
    excited, cells, wishes = (
        decided[:, robot, layer.index].tolist()
        for decided in (trace.decisions.excited, trace.decisions.cells, trace.decisions.wishes)
    )
    yield Slot(f"excited_{layer.behavior}", robot), ["", *excited]
    if layer.inputs:
        yield Slot(f"cell_{layer.behavior}", robot), ["", *_cells(layer, cells)]
    yield Slot(f"wish_{layer.behavior}", robot), ["", *map(layer.wish, wishes)]


def _cells(layer: Layer, cells: Iterable[int]) -> list[Value]:
    return [", ".join(f"{name}={label}" for name, label in layer.cell_labels(cell).items()) for cell in cells]
