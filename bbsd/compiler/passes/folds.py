"""How loops over pairs of robots are made: each fold with those that it needs, and what it folds as families are."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from bbsd.compiler.passes.pairs import (
    CHAINS,
    MOST_PAIRS_WRITTEN_OUT,
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

    from bbsd.compiler.passes.robot_graph import RobotGraph
    from bbsd.expression.node_data import Variable


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

MOST_EFFORT = 1_500_000
"""Nodes of pairs that are looked at for one moment, in about a second; then folds stay written out."""

IMPOSSIBLE: Plan = (), lambda _: None


@dataclass
class Folds:
    """Plans loops over pairs for the families of one moment."""

    new: RobotGraph
    team_slots: frozenset[Variable]
    key: Callable[[Sequence[Node]], Family]
    """The key of a family, given for every robot."""
    owners: Mapping[int, tuple[tuple[int, ...], int]]
    """The family that a node belongs to, and whose value in it it is."""
    chains: dict[int, Chain] = field(default_factory=dict)
    """The folds by their numbers."""
    _begun: dict[tuple[Node, Node], int] = field(default_factory=dict)
    """The longest fold that begins with two links, of the first robot."""
    _tried: set[Pairs] = field(default_factory=set)
    _effort: int = 0
    """Nodes of pairs that were looked at."""
    _made: dict[int, tuple[Node, Node]] = field(default_factory=dict)
    """By number, what follows from what is folded so far, and what is first."""

    def plans_of_each(self, nodes: Sequence[Node]) -> Iterator[Plan]:
        """Ways of making a family that may be a fold of each robot over the others, or over the team."""
        if nodes[0].operation not in CHAINS or nodes[0].level is not Level.LANE:
            return
        for others in (True, False):
            n_links = self.new.robots - others
            if n_links > MOST_PAIRS_WRITTEN_OUT and (chain := chain_to(nodes, n_links, others=others)):
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
                if node.operation == "so_far" and node.index not in found:
                    found.append(node.index)
        return found

    def _number_of(self, chain: Chain) -> int:
        """The number of a fold, the same for all that are its beginning."""
        beginning = chain.links.rows[0][0], chain.links.rows[0][1]
        known = self._begun.get(beginning)
        if known is not None and self.chains[known].begins(chain):
            return known
        number = self._begun[beginning] = next(self.new.fold_numbers)
        self.chains[number] = chain
        return number

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

    def plans_of_pairs(self, pairs: Pairs) -> Iterator[Plan]:
        """Ways of making an expression of a robot and one that it looks at, the last one of which is none."""
        corner = pairs.corner
        if self._is_hopeful(pairs):
            if (own := pairs.own()) is not None:
                yield (self.key(own),), lambda made: made[0]
            elif (before := chain_of(pairs)) is not None:
                number = self._number_of(before)
                yield (), lambda _: self.new.so_far(number, corner.kind)
            else:
                yield from self._plans_of_theirs(pairs)
            if pairs.are_alike() and corner.operation != "draw":
                needs = [pairs.of(place) for place in range(len(corner.operands))]
                yield needs, lambda made: self.new.again([corner], made)
        yield IMPOSSIBLE

    def _is_hopeful(self, pairs: Pairs) -> bool:
        """Whether something can be said of whomever a robot looks at, and not too much was tried in vain."""
        if pairs not in self._tried:
            self._tried.add(pairs)
            self._effort += len(pairs.rows) * len(pairs.rows[0])
        return not pairs.are_too_few and self._effort <= MOST_EFFORT

    def _plans_of_theirs(self, pairs: Pairs) -> Iterator[Plan]:
        corner = pairs.corner
        if corner.operation == "slot" and (plan := self._plan_of_slots(pairs)) is not None:
            yield plan
        family, _ = self.owners.get(corner.number, (None, 0))
        if family is not None and pairs.are_theirs(lambda node: self._robot_in(family, node)):
            yield (family,), lambda made: self._theirs(made[0], others=pairs.others)
        elif (by_robot := pairs.by_robot()) is not None:
            yield (self.key(by_robot),), lambda made: self._theirs(made[0], others=pairs.others)

    def _plan_of_slots(self, pairs: Pairs) -> Plan | None:
        corner, new = pairs.corner, self.new
        variable = corner.slot.variable
        robot_of = robot_of_slot(variable)
        if variable in self.team_slots and all(robot_of(node) is not None for node in pairs.every()):
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
