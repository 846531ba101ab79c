"""Plans loops over pairs of robots: each fold with those that it needs, from terms that are made as families are."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from bbsd.compiler.passes.pairs import (
    CHAINS,
    MOST_PAIRS_WRITTEN_OUT,
    Chain,
    Pairs,
    chain_before,
    chain_to,
    nodes_of_pairs,
    robot_of_slot,
)
from bbsd.expression.graph import Level, Node

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from bbsd.compiler.passes.robot_graph import RobotGraph
    from bbsd.expression.node_data import Variable


@dataclass(frozen=True, slots=True)
class FoldKey:
    """A fold over pairs of robots, by its number."""

    number: int


Family = int | tuple[int, ...]
"""A value of the team by its node's number; a family by the numbers of its nodes."""

Key = Family | Pairs | FoldKey
"""What a new node is made for."""

Plan = tuple[Sequence[Key], Callable[[Sequence[Node]], Node | None]]
"""What a new node needs, and the function that makes it of that, or returns None where the plan fails."""

MOST_EFFORT = 1_500_000
"""The most nodes of pairs that are examined for one moment, which takes about a second; then folds stay written out."""

IMPOSSIBLE: Plan = (), lambda _: None


@dataclass
class FoldPlanner:
    """Plans loops over pairs for the families of one moment."""

    robots: RobotGraph
    team_slots: frozenset[Variable]
    key: Callable[[Sequence[Node]], Family]
    """The function that gives the key of a family, given for every robot."""
    owners: Mapping[int, tuple[tuple[int, ...], int]]
    """For the number of a node, the family that it belongs to, and its robot."""
    chains: dict[int, Chain] = field(default_factory=dict)
    """The folds by their numbers."""
    _number_by_beginning: dict[tuple[Node, Node], int] = field(default_factory=dict)
    """The number of the longest fold that begins with two links, of the first robot."""
    _examined: set[Pairs] = field(default_factory=set)
    _effort: int = 0
    """The number of nodes of pairs that were examined."""
    _made: dict[int, tuple[Node, Node]] = field(default_factory=dict)
    """For the number of a fold, the node of its next value and that of its first term."""

    def plans_for_family(self, nodes: Sequence[Node]) -> Iterator[Plan]:
        """Yield plans for a family that may be a fold of each robot over the others, or over the team."""
        if nodes[0].operation not in CHAINS or nodes[0].level is not Level.LANE:
            return
        for others in (True, False):
            n_links = self.robots.n_robots - others
            if n_links > MOST_PAIRS_WRITTEN_OUT and (chain := chain_to(nodes, n_links, others=others)):
                yield self._plan_for_loop(self._number_of(chain))

    def _plan_for_loop(self, number: int) -> Plan:
        needs = [FoldKey(needed) for needed in self._numbers_in_loop(number)]
        return needs, lambda _: self._make_loop(number)

    def _make_loop(self, number: int) -> Node:
        folds = [(needed, *self._made[needed]) for needed in self._numbers_in_loop(number)]
        return self.robots.among(folds, others=self.chains[number].links.others)

    def _numbers_in_loop(self, number: int) -> list[int]:
        """Return a fold and those that it needs in its loop, as far as they were made."""
        numbers = [number]
        for needing in numbers:
            for node in nodes_of_pairs(self._made.get(needing, ())):
                if node.operation == "so_far" and node.index not in numbers:
                    numbers.append(node.index)
        return numbers

    def _number_of(self, chain: Chain) -> int:
        """Return the number of a fold; a fold and its beginnings have the same."""
        beginning = chain.links.rows[0][0], chain.links.rows[0][1]
        longest = self._number_by_beginning.get(beginning)
        if longest is not None and self.chains[longest].begins(chain):
            return longest
        number = self._number_by_beginning[beginning] = next(self.robots.fold_numbers)
        self.chains[number] = chain
        return number

    def plan_for_fold(self, number: int) -> Plan:
        """Return the plan that makes the next value of a fold of its present one and a term."""
        chain = self.chains[number]
        conditions = chain.conditions

        def build(operands: Sequence[Node]) -> Node:
            term, *condition = operands
            so_far = self.robots.so_far(number, term.kind)
            inputs = (*condition, term, so_far) if condition else (so_far, term)
            following = self.robots.graph.apply(chain.operation, *inputs)
            self._made[number] = following, term
            return following

        return [chain.terms, *([conditions] if conditions else [])], build

    def plans_for_pairs(self, pairs: Pairs) -> Iterator[Plan]:
        """Yield plans for an expression of a robot and the one that it looks at, best first; the last is IMPOSSIBLE."""
        corner = pairs.corner
        if self._is_promising(pairs):
            if (own := pairs.own()) is not None:
                yield (self.key(own),), lambda operands: operands[0]
            elif (before := chain_before(pairs)) is not None:
                number = self._number_of(before)
                yield (), lambda _: self.robots.so_far(number, corner.kind)
            else:
                yield from self._plans_for_theirs(pairs)
            if pairs.are_alike() and corner.operation != "draw":
                needs = [pairs.operand(position) for position in range(len(corner.operands))]
                yield needs, lambda operands: self.robots.copy([corner], operands)
        yield IMPOSSIBLE

    def _is_promising(self, pairs: Pairs) -> bool:
        """Return whether there are enough pairs to tell a pattern, and not too many nodes were examined before."""
        if pairs not in self._examined:
            self._examined.add(pairs)
            self._effort += len(pairs.rows) * len(pairs.rows[0])
        return not pairs.are_too_few and self._effort <= MOST_EFFORT

    def _plans_for_theirs(self, pairs: Pairs) -> Iterator[Plan]:
        """Yield plans for a value that is the looked-at robot's, whoever looks."""
        corner = pairs.corner
        if corner.operation == "slot" and (plan := self._plan_for_slots(pairs)) is not None:
            yield plan
        family, _ = self.owners.get(corner.number, (None, 0))
        if family is not None and pairs.are_theirs(lambda node: self._robot_in(family, node)):
            yield (family,), lambda operands: self._read_theirs(operands[0], others=pairs.others)
        elif (by_robot := pairs.by_robot()) is not None:
            yield (self.key(by_robot),), lambda operands: self._read_theirs(operands[0], others=pairs.others)

    def _plan_for_slots(self, pairs: Pairs) -> Plan | None:
        corner, robots = pairs.corner, self.robots
        variable = corner.slot.variable
        robot_of = robot_of_slot(variable)
        if variable in self.team_slots and all(robot_of(node) is not None for node in pairs.every()):
            return (), lambda _: robots.slot(corner, Level.LANE)
        if pairs.are_theirs(robot_of):
            return (), lambda _: robots.theirs(robots.slot(corner, Level.EACH), others=pairs.others)
        return None

    def _robot_in(self, family: tuple[int, ...], node: Node) -> int | None:
        owner, robot = self.owners.get(node.number, (None, None))
        return robot if owner == family else None

    def _read_theirs(self, family: Node, *, others: bool) -> Node | None:
        """Return the value of the robot looked at; a value that all robots have alike is the node itself."""
        if family.level is Level.EACH or family.operation in ("table", "pick"):
            return self.robots.theirs(family, others=others)
        return None if family.level is Level.ROBOT else family
