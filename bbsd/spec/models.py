"""A spec as read: the manual of the language, one class a block, one sentence a key."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field
from pydantic_core import PydanticCustomError

from bbsd.spec.base import Part
from bbsd.spec.design import Design
from bbsd.spec.written import CellText, Expression, ExpressionText, NameText, expression, kind_of

OPEN = "open"
NO_ACTION_TEXT = "no action"
OTHERWISE = "otherwise"

ConstantValue = Expression | tuple["ConstantValue", ...]
"""An expression, or a nested list of numbers."""


def _constant(value: object) -> ConstantValue:
    if isinstance(value, list | tuple):
        return tuple(_constant(item) for item in value)
    return expression(value)




NamedCells = dict[CellText, ExpressionText]
"""Named cells: the first condition that holds; `otherwise` as the last one's condition."""

PartitionText = ExpressionText | NamedCells
"""A condition, cut(...), values(...), or named cells."""


def _partition(value: object) -> object:
    if isinstance(value, dict):
        return value
    return expression(value)


class Environment(Part):
    """The world, the robots in it, and what they sense."""

    robots: int = Field(1, ge=1, le=64, description="Robots that carry the architecture.")
    steps: int = Field(ge=1, le=10_000_000, description="Steps of an episode at most.")
    world: dict[NameText, ExpressionText] = Field({}, description="Values the team has once: name and starting value.")
    state: dict[NameText, ExpressionText] = Field({}, description="Values each robot has: name and starting value.")
    definitions: dict[str, ExpressionText] = Field({}, description="Names for expressions, with or without parameters.")
    dynamics: dict[NameText, ExpressionText] = Field({}, description="The next value of world and state names; others stay.")
    sensors: dict[NameText, Annotated[PartitionText, BeforeValidator(_partition)]] = Field(
        {}, description="What a robot senses: an expression, or a partition that behaviors share."
    )
    ends: ExpressionText | None = Field(None, description="The episode is over after a step in which this holds.")


Decision = Annotated[str, BeforeValidator(lambda value: _decision(value))]
"""An action's name, `no action`, or `open`."""


def _decision(value: object) -> str:
    if not isinstance(value, str):
        raise PydanticCustomError("not_a_decision", "an action, no action or open is needed here, not {what}", {"what": kind_of(value)})
    return " ".join(value.split())


def _cells(value: object) -> object:
    return value if isinstance(value, list) else [value]


class When(Part):
    """A rule for some cells: what to do where every named input is in one of the cells given."""

    when: dict[str, Annotated[list[CellText], BeforeValidator(_cells), Field(min_length=1)]] = Field(
        description="For each named input, its cell or cells; an input not named matches all."
    )
    do: Decision = Field(description="An action, no action, or open.")


class Otherwise(Part):
    """A rule for every cell that no rule before it matches."""

    otherwise: Decision = Field(description="An action, no action, or open.")


Rule = When | Otherwise


def _rule(value: object) -> Any:  # noqa: ANN401 - what pydantic is to read on
    if isinstance(value, Part):
        return value
    if not isinstance(value, dict):
        raise PydanticCustomError("not_a_rule", "a rule is needed here (when and do, or otherwise), not {what}", {"what": kind_of(value)})
    return (Otherwise if "otherwise" in value and "when" not in value else When).model_validate(value)


class Behavior(Part):
    """A behavior module (1): what it sees, when it is excited, what it may do, and what it does."""

    excited: ExpressionText | None = Field(None, description="Where the behavior is excited; by default always.")
    inputs: dict[NameText, Annotated[PartitionText, BeforeValidator(_partition)]] | list[str] = Field(
        {}, description="Its own partitions, or the names of sensors that are partitions; none: a table of one cell."
    )
    actions: dict[NameText, dict[str, ExpressionText]] = Field(description="For each action, the state it sets and the value.")
    rules: list[Annotated[Rule, BeforeValidator(_rule)]] | None = Field(None, description="What to do where; the first match decides. None: all open.")


class Spec(Part):
    """A design with holes."""

    bbsd: Literal[1] = Field(description="Version of the language.")
    name: str = Field(min_length=1, max_length=100, description="What the design is called.")
    summary: str = Field("", description="One sentence about it.")
    constants: dict[NameText, Annotated[Any, BeforeValidator(_constant)]] = Field({}, description="Numbers, lists and tables that do not change in a run.")
    environment: Environment = Field(description="The world, the robots, and what they sense.")
    behaviors: dict[NameText, Behavior] = Field(min_length=1, description="The behavior modules.")
    structure: list[str] | None = Field(None, description="Behaviors from the highest layer down, or open; none: to be learned.")
    reward: dict[NameText, ExpressionText] = Field(min_length=1, description="The terms of the reinforcement, summed at each step.")
    design: Design = Field(Design(), description="How the holes are filled.")
