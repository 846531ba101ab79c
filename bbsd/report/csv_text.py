"""Comma-separated values: of an episode a line for each step or value, of an evaluation a line for each episode."""

from __future__ import annotations

import csv
from io import StringIO
from typing import TYPE_CHECKING

from bbsd.errors import inert_cell
from bbsd.evaluation.tracing.traced import trace_columns
from bbsd.expression.node_data import variable_text

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bbsd.evaluation import EachEpisode, Trace
    from bbsd.evaluation.tracing.traced import Value


def csv_text(trace: Trace, *, long: bool = False) -> str:
    """Return a trace as CSV, a column for each value, or a line for each value of each step (`long`).

    Step 0 is the start. Numbers have all their digits, truths are true and false.
    """
    lines = _long(trace) if long else _wide(trace)
    text = StringIO()
    csv.writer(text, lineterminator="\n").writerows(lines)
    return text.getvalue()


def returns_text(each: EachEpisode) -> str:
    """Return a line for each episode: its number, its return, each reward term, its steps.

    Of several agents it begins with the agent; where every possible start was run, its probability follows the number.
    """
    n_episodes = len(each.returns) // each.agents
    columns: dict[str, list[object]] = {}
    if each.agents > 1:
        columns["agent"] = [index // n_episodes for index in range(len(each.returns))]
    columns["episode"] = [index % n_episodes for index in range(len(each.returns))]
    if each.probabilities is not None:
        columns["probability"] = each.probabilities.tolist()
    columns["return"] = each.returns.tolist()
    columns |= {f"reward_{name}": values.tolist() for name, values in each.terms.items()}
    columns["steps"] = each.steps.astype(int).tolist()
    text = StringIO()
    csv.writer(text, lineterminator="\n").writerows([[*columns], *zip(*columns.values(), strict=True)])
    return text.getvalue()


def _wide(trace: Trace) -> Iterator[list[object]]:
    """Yield the columns' names, which end in the robot's index where there are several, then a line for each step."""
    columns = list(trace_columns(trace))
    yield ["step", *(slot.label(trace.robots) for slot, _ in columns)]
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
                yield [step, whose, variable_text((name, place)), _text(values[step])]


def _text(value: Value) -> object:
    if isinstance(value, str):
        return inert_cell(value)
    return str(value).lower() if isinstance(value, bool) else value
