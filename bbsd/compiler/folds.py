"""How loops over pairs of robots are made: each fold with those that it needs, and what it folds as families are."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, cast

from bbsd.compiler.pairs import (
    CHAINS,
    MOST_WRITTEN_OUT,
    Chain,
    Pairs,
    chain_of,
    chain_to,
    of_pairs,
    robot_of_slot,
)
from bbsd.expression.graph import Level, Node

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from bbsd.compiler.robot_graph import RobotGraph
    from bbsd.spec.meaning.names import Slot


@dataclass(frozen=True, slots=True)
class Fold:
    """A fold over pairs of robots, by its number."""

    number: int


Family = int | tuple[int, ...]
"""A value of the team by its node's number; a family by those of its nodes."""

Key = Family | Pairs | Fold
"""What a node is made for."""

Plan = tuple[Sequence[Key], Callable[[Sequence[Node]], Node | None]]
"""What a node needs, and what makes it of that: None where this way does not do."""

IMPOSSIBLE: Plan = (), lambda _: None


@dataclass
class Folds:
    """Plans loops over pairs for the families of one moment."""

    new: RobotGraph
    team_slots: frozenset[tuple[str, tuple[int, ...]]]
    key: Callable[[Sequence[Node]], Family]
    """The key of a family, given for every robot."""
    owners: Mapping[int, tuple[tuple[int, ...], int]]
    """The family that a node belongs to, and whose value in it it is."""
    chains: list[Chain] = field(default_factory=list)
    """The folds by their numbers."""
    _begun: dict[tuple[Node, Node], int] = field(default_factory=dict)
    """The longest fold that begins with two links, of the first robot."""
    _made: dict[int, tuple[Node, Node]] = field(default_factory=dict)
    """By number, what follows from what is folded so far, and what is first."""

    def plans_of_each(self, nodes: Sequence[Node]) -> Iterator[Plan]:
        """Ways of making a family that may be a fold of each robot over the others, or over the team."""
        if nodes[0].operation not in CHAINS or nodes[0].level is not Level.LANE:
            return
        for others in (True, False):
            n_links = self.new.robots - others
            if n_links > MOST_WRITTEN_OUT and (chain := chain_to(nodes, n_links, others=others)):
                yield self._plan_of_among(self._number_of(chain))

    def _plan_of_among(self, number: int) -> Plan:
        return [Fold(each) for each in self._together(number)], lambda _: self._among(number)

    def _among(self, number: int) -> Node:
        folds = [(each, *self._made[each]) for each in self._together(number)]
        return self.new.among(folds, others=self.chains[number].links.others)

    def _together(self, number: int) -> list[int]:
        """A fold and those that it needs, as far as they are known."""
        found = [number]
        for each in found:
            for node in of_pairs(self._made.get(each, ())):
                if node.operation == "so_far" and node.data not in found:
                    found.append(cast("int", node.data))
        return found

    def _number_of(self, chain: Chain) -> int:
        """The number of a fold, the same for all that are its beginning."""
        beginning = chain.links.rows[0][0], chain.links.rows[0][1]
        known = self._begun.get(beginning)
        if known is not None and self.chains[known].begins(chain):
            return known
        self._begun[beginning] = len(self.chains)
        self.chains.append(chain)
        return self._begun[beginning]

    def plan_of_fold(self, number: int) -> Plan:
        """How what follows is made of what is folded so far."""
        chain = self.chains[number]
        conditions = chain.conditions

        def build(made: Sequence[Node]) -> Node:
            term, *condition = made
            so_far = self.new.so_far(number, term.kind)
            operands = (*condition, term, so_far) if condition else (so_far, term)
            following = self.new.graph.apply(chain.operation, *operands)
            self._made[number] = following, term
            return following

        return [chain.terms, *([conditions] if conditions else [])], build

    def plan_of_pairs(self, pairs: Pairs) -> Plan:
        """How an expression of a robot and one that it looks at is made."""
        corner = pairs.corner
        if pairs.are_too_few:
            return IMPOSSIBLE
        if (own := pairs.own()) is not None:
            return (self.key(own),), lambda made: made[0]
        if (before := chain_of(pairs)) is not None:
            number = self._number_of(before)
            return (), lambda _: self.new.so_far(number, corner.kind)
        if corner.operation == "slot" and (plan := self._plan_of_slots(pairs)) is not None:
            return plan
        family, _ = self.owners.get(corner.number, (None, 0))
        if family is not None and pairs.are_theirs(lambda node: self._robot_in(family, node)):
            return (family,), lambda made: self._theirs(made[0], others=pairs.others)
        if (by_robot := pairs.by_robot()) is not None:
            return (self.key(by_robot),), lambda made: self._theirs(made[0], others=pairs.others)
        if pairs.are_alike() and corner.operation != "draw":
            needs = [pairs.of(place) for place in range(len(corner.operands))]
            return needs, lambda made: self.new.again([corner], made)
        return IMPOSSIBLE

    def _plan_of_slots(self, pairs: Pairs) -> Plan | None:
        corner, new = pairs.corner, self.new
        name, _, place = cast("Slot", corner.data)
        robot_of = robot_of_slot(name, place)
        if (name, place) in self.team_slots and all(robot_of(node) is not None for node in pairs.every()):
            return (), lambda _: new.slot(corner, Level.LANE)
        if pairs.are_theirs(robot_of):
            return (), lambda _: new.theirs(new.slot(corner, Level.EACH), others=pairs.others)
        return None

    def _robot_in(self, family: tuple[int, ...], node: Node) -> int | None:
        owner, robot = self.owners.get(node.number, (None, None))
        return robot if owner == family else None

    def _theirs(self, family: Node, *, others: bool) -> Node | None:
        """The value of the robot looked at; what all have alike is that of any."""
        if family.level is Level.EACH or family.operation in ("table", "pick"):
            return self.new.theirs(family, others=others)
        return None if family.level is Level.ROBOT else family
