"""An episode as comma-separated values: a line for each step, or for each value of each step."""

from __future__ import annotations

import csv
from enum import StrEnum
from io import StringIO
from typing import TYPE_CHECKING

from bbsd.evaluation.traced import trace_columns
from bbsd.expression.node_data import Slot

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bbsd.evaluation import Trace
    from bbsd.evaluation.traced import Value


class TraceFormat(StrEnum):
    """How a trace is laid out: a column for each value, or a line for each value of each step."""

    WIDE = "wide"
    LONG = "long"


def csv_text(trace: Trace, form: TraceFormat = TraceFormat.WIDE) -> str:
    """Return a trace as CSV; step 0 is the start. Numbers have all their digits, truths are true and false."""
    lines = _wide(trace) if form is TraceFormat.WIDE else _long(trace)
    text = StringIO()
    csv.writer(text, lineterminator="\n").writerows(lines)
    return text.getvalue()


def _wide(trace: Trace) -> Iterator[list[object]]:
    """Yield the columns' names, which end in the robot's index where there are several, then a line for each step."""
    columns = list(trace_columns(trace))
    yield ["step", *(slot.text(trace.robots) for slot, _ in columns)]
    for step, row in enumerate(zip(*(values for _, values in columns), strict=True)):
        yield [step, *map(_text, row)]


def _long(trace: Trace) -> Iterator[list[object]]:
    """Yield a line for each value of each step, without what is not known; the world's values have no robot."""
    yield ["step", "robot", "name", "value"]
    columns = [(slot.robot, slot.variable, values) for slot, values in trace_columns(trace)]
    for step in range(len(trace.steps) + 1):
        for robot, (name, place), values in columns:
            if values[step] != "":
                whose = "" if robot is None else robot
                yield [step, whose, Slot(name, None, place).text(1), _text(values[step])]


def _text(value: Value) -> object:
    return str(value).lower() if isinstance(value, bool) else value
