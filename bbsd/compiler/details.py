"""How much a rollout reports: returns and credit alone, more for an evaluation, a trace or practice."""

from __future__ import annotations

from enum import Enum
from typing import TYPE_CHECKING, Literal, NamedTuple

from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import Slot

if TYPE_CHECKING:
    from bbsd.expression.graph import Node
    from bbsd.language.meaning import Meaning
    from bbsd.language.meaning.episode.episode import Episode


class Detail(Enum):
    """What a rollout reports besides returns and credit; the values are the names of its functions."""

    CREDIT = "rollout"
    TERMS = "rollout_detailed"
    TRACE = "rollout_traced"
    PRACTICE = "rollout_practice"
    WORLD = "world"
    """Not a rollout: a world that another program steps, by its own choices."""


PHASES = ("start", "decide", "outcome", "finish")
"""The parts of a rollout that is printed in phases: its functions are called `rollout_start`, and so on."""
WORLD_PHASES = ("start", "outcome", "observe", "finish")
"""The functions of a world."""

IN_DETAIL = frozenset({Detail.TERMS, Detail.TRACE})
"""The rollouts that report what an evaluation adds up."""

DECIDED: tuple[Literal["excited", "cell"], ...] = ("excited", "cell")
"""What is recorded of every behavior's decision."""


class Column(NamedTuple):
    """A column of a trace's record: the kind of its values, and the name, robot and element that they belong to."""

    content: Literal["slot", "definition", "choice", "expectation", "reward", "excited", "cell"]
    slot: Slot


def traced_columns(meaning: Meaning) -> list[Column]:
    """Return the columns of a trace's record in their order."""
    episode, robots = meaning.episode, range(meaning.spec.environment.robots)
    return [
        *(Column("slot", slot) for slot in traced_slots(episode)),
        *(Column("definition", slot) for slot in traced_definitions(episode)),
        *(Column("choice", Slot("controlling", robot)) for robot in robots),
        *(Column("expectation", Slot("expectation", robot)) for robot in robots if episode.expects),
        *(Column("reward", Slot(term, robot)) for term in episode.reward for robot in robots),
        *(
            Column(content, Slot(module.name, robot))
            for robot in robots
            for module in episode.modules
            for content in DECIDED
        ),
    ]


def first_decided_column(meaning: Meaning, robot: int) -> int:
    """Return where in a record the columns of a robot's decisions begin; all robots' decisions stand last."""
    robots = meaning.spec.environment.robots
    n_decided = len(DECIDED) * len(meaning.episode.modules)
    return len(traced_columns(meaning)) - (robots - robot) * n_decided


def traced_slots(episode: Episode) -> dict[Slot, Node]:
    """Return what a trace shows of all that is kept from step to step."""
    return {slot: node for slot, node in episode.after.items() if not slot.is_hidden}


def traced_definitions(episode: Episode) -> dict[Slot, Node]:
    """Return the definitions that a trace shows."""
    return {slot: node for slot, node in episode.definitions.items() if node.kind is not Kind.UNKNOWN}


def checked_slots(episode: Episode) -> list[Slot]:
    """Return the slots of which a detailed rollout counts the steps with a value that is not finite."""
    return [slot for slot, node in traced_slots(episode).items() if node.kind is Kind.NUMBER]
