"""What the names of a spec stand for, and the slots that store values from one step to the next."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from bbsd.expression.graph import Graph, Level, Node, value_of
from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import Slot
from bbsd.expression.scope import (
    Binding,
    Definition,
    Findings,
    Named,
    PerRobot,
    Scope,
    Shared,
    Unusable,
    Value,
)
from bbsd.expression.syntax.tree import OneOf
from bbsd.language.meaning.naming.choices import choices_of
from bbsd.language.meaning.outside.exchange import size_of_field
from bbsd.language.outside import EARNED

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bbsd.expression.scope import Names as ValueNames
    from bbsd.language.meaning.naming.constants import Constants
    from bbsd.language.models import Spec

Stored = Mapping[str, tuple[Value, ...]]
"""The values of state (one a robot) and of the world (one) at some moment of a step."""

MOST_VALUES = 1_000_000
"""Whole numbers from 0 on that are told apart in proofs."""

NOT_EARNED = Unusable(
    "BB112",
    f"{EARNED} is what an environment in Python rewards, and this world is the spec's own",
    "write what a step earns under reward, as an expression of state, world and sensors",
)


@dataclass(frozen=True, slots=True)
class Names:
    """What a spec's names stand for at every moment of an episode."""

    spec: Spec
    graph: Graph
    findings: Findings
    constants: Constants
    definitions: Mapping[str, Definition]
    unusable: Mapping[str, Unusable]
    """Names whose own mistakes were reported already."""

    @property
    def robots(self) -> range:
        """The robots' indices."""
        return range(self.spec.environment.robots)

    @property
    def team(self) -> int | None:
        """The robot that a team-level expression is for: the only one, or none."""
        return 0 if len(self.robots) == 1 else None

    def size(self, node: Node) -> int | None:
        """Return how many values a node has that are 0, 1, and so on; None where that is not known.

        It is of observations with a size, of what has names, and of whole numbers from 0 on that are written or drawn.
        """
        match node.operation, node.operands:
            case (("slot" | "outside"), _):
                return size_of_field(self.spec.environment, node.slot.name) or self._n_names(node.slot.name)
            case "literal", _:
                return _size_up_to(value_of(node))
            case "draw", (first, last) if node.draw.distribution == "integers" and first.literal:
                return _size_up_to(value_of(last)) if last.literal and not value_of(first) else None
            case "select", (_, then, otherwise):
                sizes = [size for arm in (then, otherwise) if (size := self.size(arm)) is not None]
                return max(sizes) if len(sizes) == 2 else None
        return None

    def _n_names(self, name: str) -> int | None:
        environment = self.spec.environment
        start = environment.state.get(name) or environment.world.get(name)
        return len(start.tree.names) if start and isinstance(start.tree, OneOf) else None

    @property
    def choices(self) -> Mapping[str, tuple[ValueNames, ...]]:
        """For each name that a state or a value of the world can be one of, the lists of names that have it."""
        return choices_of(self.spec.environment)

    @property
    def step(self) -> Node:
        """The number of the present step."""
        return self.graph.leaf("step", None, Kind.NUMBER, Level.STEP)

    def scope(
        self,
        bindings: Mapping[str, Binding],
        step: Node,
        *,
        starting: bool = False,
        before: Scope | None = None,
    ) -> Scope:
        """Return the scope of a moment: constants, definitions and positions, then the moment's own names."""
        graph = self.graph
        names: dict[str, Binding] = {
            "step": Shared(step),
            "steps": Shared(graph.number(self.spec.environment.steps)),
            "robots": Shared(graph.number(len(self.robots))),
            "robot": PerRobot(graph.number),
            "generation": Unusable(
                "BB066", "generation is known only in constants", "make a constant of it and use that"
            ),
            **({} if self.spec.environment.outside else {EARNED: NOT_EARNED}),
            **{name: Shared(leaves) for name, leaves in self.constants.leaves.items()},
            **self.definitions,
            **bindings,
            **self.unusable,
        }
        return Scope(
            graph,
            names,
            self.findings,
            robots=len(self.robots),
            static=self.constants.static,
            size=self.size,
            choices=self.choices,
            starting=starting,
            before=before,
        )


def _size_up_to(last: float) -> int | None:
    """Return the size of 0, 1, ... up to a number; None where it is no such whole number."""
    return int(last) + 1 if 0 <= last < MOST_VALUES and float(last).is_integer() else None


def read_slot(slot: Slot, like: Node, graph: Graph) -> Node:
    """Return the leaf that reads a stored value of the same kind as `like`."""
    return like if like.kind is Kind.UNKNOWN else graph.leaf("slot", slot, like.kind, Level.LANE)


def read_slots(
    name: str, robot: int | None, like: Value, graph: Graph, position: tuple[int, ...] = ()
) -> Value:
    """Return the leaves that read a stored value of the same shape and kinds as `like`."""
    if isinstance(like, tuple):
        return tuple(
            read_slots(name, robot, item, graph, (*position, index)) for index, item in enumerate(like)
        )
    slot = Slot(name, robot, position)
    if isinstance(like, Named):
        return like.with_nodes(lambda node: read_slot(slot, node, graph))
    return read_slot(slot, like, graph)


def refilled(shape: Value, nodes: Iterator[Node]) -> Value:
    """Return a value of the same shape and names made of other nodes."""
    if isinstance(shape, tuple):
        return tuple(refilled(item, nodes) for item in shape)
    node = next(nodes)
    return shape.with_nodes(lambda _: node) if isinstance(shape, Named) else node


def scalars_by_slot(
    value: Value, name: str, robot: int | None, position: tuple[int, ...] = ()
) -> dict[Slot, Node]:
    """Return the scalars of a value by the slots that store them."""
    if isinstance(value, tuple):
        return {
            slot: node
            for index, item in enumerate(value)
            for slot, node in scalars_by_slot(item, name, robot, (*position, index)).items()
        }
    return {Slot(name, robot, position): value.node if isinstance(value, Named) else value}


def names_in(value: Value) -> ValueNames | None:
    """Return the names of which a value is one, or the elements of a list are; None for other values."""
    if isinstance(value, tuple):
        return names_in(value[0]) if value else None
    return value.names if isinstance(value, Named) else None
