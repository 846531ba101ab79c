"""The model of a spec, and the manual of the language: one class for each block, one sentence for each key."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import BeforeValidator, Discriminator, Field, Tag
from pydantic_core import PydanticCustomError

from bbsd.language.base import Entries, Part
from bbsd.language.design import Design
from bbsd.language.field_types import (
    ActionNameText,
    BehaviorNameText,
    CellText,
    DefinitionText,
    ExpressionText,
    NameText,
    TableText,
    ValueNameText,
    Whole,
    kind_of,
    shape,
)
from bbsd.language.outside import (
    OUTSIDE_KINDS,
    ActionText,
    ArgumentsText,
    GymnasiumText,
    ObservationText,
    Outside,
    PettingZooText,
    PythonText,
    read_fields,
)
from bbsd.language.view import View  # noqa: TC001 - pydantic reads annotations

OPEN = "open"
NO_ACTION_TEXT = "no action"
OTHERWISE = "otherwise"

NamedCells = Entries[CellText, ExpressionText]
"""Named cells: the first condition that holds; `otherwise` as the last one's condition."""

PartitionText = Annotated[
    Annotated[ExpressionText, Tag("<other>")] | Annotated[NamedCells, Tag("<mapping>")], Discriminator(shape)
]
"""A condition, cut(...), values(...), or named cells."""


class Environment(Part):
    """The world, the robots in it, and what they sense; or, by one of the first three keys, somebody else's world."""

    gymnasium: GymnasiumText | None = Field(
        None, description="The id of a Gymnasium environment that is the world, such as CartPole-v1."
    )
    pettingzoo: PettingZooText | None = Field(
        None, description="A PettingZoo environment that is the world; its agents are the robots."
    )
    python: PythonText | None = Field(
        None, description="A class of one's own that is the world, as module:Class."
    )
    arguments: ArgumentsText = Field(
        {}, alias="with", description="Keyword arguments with which that environment is made: plain data."
    )
    observation: ObservationText | None = Field(
        None, description="Names for what that environment shows: a list, or sizes or paths by name."
    )
    action: ActionText | None = Field(
        None,
        description="State whose value that environment is told at each step: a name, or a list of names.",
    )
    robots: Whole = Field(1, ge=1, le=64, description="Robots that carry the architecture.")
    steps: Whole = Field(ge=1, le=10_000_000, description="The greatest number of steps in an episode.")
    world: Entries[ValueNameText, ExpressionText] = Field(
        {}, description="Values the team has once: name and starting value, a number, a truth, or a list."
    )
    state: Entries[ValueNameText, ExpressionText] = Field(
        {}, description="Values each robot has: name and starting value, a number, a truth, or a list."
    )
    definitions: Entries[DefinitionText, ExpressionText] = Field(
        {}, description="Names for expressions, with or without parameters."
    )
    dynamics: Entries[ValueNameText, ExpressionText] = Field(
        {}, description="The next value of world and state names, of lists as a whole; others stay."
    )
    sensors: Entries[ValueNameText, PartitionText] = Field(
        {}, description="What a robot senses: an expression, or a partition that behaviors share."
    )
    ends: ExpressionText | None = Field(
        None, description="The episode is over after a step in which this holds."
    )

    @property
    def of_each_robot(self) -> tuple[str, ...]:
        """The names of what each robot has from step to step: its state, and what an environment in Python gives it."""
        return (*self.state, *(self.outside.names if self.outside else ()))

    @property
    def outside(self) -> Outside | None:
        """The environment in Python that is the world; None where the world is the spec's own."""
        targets = {kind: getattr(self, kind) for kind in OUTSIDE_KINDS}
        actions = [self.action] if isinstance(self.action, str) else self.action or []
        for kind, target in targets.items():
            if target is not None:
                return Outside(
                    kind, target, self.arguments, read_fields(self.observation or []), tuple(actions)
                )
        return None


def _decision(value: object) -> str:
    if not isinstance(value, str):
        message = "an action, no action or open is needed here, not {what}"
        raise PydanticCustomError("not_a_decision", message, {"what": kind_of(value)})
    return " ".join(value.split())


DecisionText = Annotated[str, BeforeValidator(_decision)]
"""An action's name, `no action`, or `open`."""


def _cells(value: object) -> object:
    return value if isinstance(value, list) else [value]


class When(Part):
    """A rule for some cells: what to do where every named input is in one of the cells given."""

    when: Entries[str, Annotated[list[CellText], BeforeValidator(_cells), Field(min_length=1)]] = Field(
        description="For each named input, its cell or cells; an input not named matches all."
    )
    do: DecisionText = Field(description="An action, no action, or open.")


class Otherwise(Part):
    """A rule for every cell that no rule before it matches."""

    otherwise: DecisionText = Field(description="An action, no action, or open.")


def _kind_of_rule(value: object) -> str:
    is_last = isinstance(value, Otherwise) or (isinstance(value, dict) and "otherwise" in value)
    return "<otherwise>" if is_last else "<when>"


Rule = When | Otherwise
RuleText = Annotated[
    Annotated[When, Tag("<when>")] | Annotated[Otherwise, Tag("<otherwise>")], Discriminator(_kind_of_rule)
]


class Behavior(Part):
    """A behavior module (1): what it sees, when it is excited, what it may do, and what it does."""

    excited: ExpressionText | None = Field(
        None, description="Where the behavior is excited; by default always."
    )
    inputs: Annotated[
        Annotated[list[str], Tag("<other>")] | Annotated[Entries[NameText, PartitionText], Tag("<mapping>")],
        Discriminator(shape),
    ] = Field(
        {},
        description="Its own partitions, or names: of sensors that are, of truths in the state; none: one cell.",
    )
    actions: Entries[ActionNameText, Entries[str, ExpressionText]] = Field(
        description="For each action, the state it sets, or an element as name[index], and the value."
    )
    rules: list[RuleText] | None = Field(
        None, description="What to do where; the first match decides. None: all open."
    )
    table: str | None = Field(
        None,
        description="Instead of rules, a character for each cell; for tables that nobody reads as rules.",
    )
    expects: ExpressionText | None = Field(
        None, description="What should hold after each step in which it controls; measured, never learned."
    )


class Spec(Part):
    """A design with holes."""

    bbsd: Literal[1] = Field(description="Version of the language.")
    name: str = Field(min_length=1, max_length=100, description="What the design is called.")
    summary: str = Field("", description="One sentence about it.")
    extends: str | None = Field(
        None, description="A spec in this folder or below that this one is laid over; null there takes away."
    )
    constants: Entries[ValueNameText, TableText] = Field(
        {}, description="Numbers, lists and tables that do not change in a run."
    )
    environment: Environment = Field(description="The world, the robots, and what they sense.")
    view: View | None = Field(None, description="How an episode is drawn from above; none: as lines only.")
    behaviors: Entries[BehaviorNameText, Behavior] = Field(min_length=1, description="The behavior modules.")
    structure: list[str] | None = Field(
        None, description="Behaviors from the highest layer down, or open; none: to be learned."
    )
    reward: Entries[NameText, ExpressionText] = Field(
        min_length=1, description="The terms of the reinforcement, summed at each step."
    )
    design: Design = Field(Design(), description="How the holes are filled.")
