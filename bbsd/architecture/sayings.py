"""What a spec says of an input or an action, as text on one line."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.syntax.tree import OneOf

if TYPE_CHECKING:
    from collections.abc import Mapping

    from bbsd.language.field_types import Expression
    from bbsd.language.models import Behavior, PartitionText, Spec


def input_texts(spec: Spec, behavior: Behavior) -> dict[str, str]:
    """Return for each input of a behavior what gives its cell: its partition, or the name of what it reads.

    What it reads by name without a partition is a truth of the state, or a discrete number of an observation.
    """
    if isinstance(behavior.inputs, dict):
        return {name: partition_text(written) for name, written in behavior.inputs.items()}
    sensors = spec.environment.sensors
    return {name: partition_text(sensors[name]) if name in sensors else name for name in behavior.inputs}


def mapping_text(written: Mapping[str, Expression]) -> str:
    """Return what an action sets, or named cells with their conditions; `nothing` where there is nothing."""
    return "; ".join(f"{name}: {one_line(expression)}" for name, expression in written.items()) or "nothing"


def start_text(start: Expression) -> str:
    """Return what a sentence says of how a value starts: `starts as 0`, or `one of [idle, home]`."""
    return one_line(start) if isinstance(start.tree, OneOf) else f"starts as {one_line(start)}"


def one_line(expression: Expression) -> str:
    """Return an expression as it is written, without line breaks."""
    return " ".join(expression.text.split())


def partition_text(written: PartitionText) -> str:
    """Return a partition or an expression, without line breaks."""
    return mapping_text(written) if isinstance(written, dict) else one_line(written)
