"""Finds folds in which each robot looks at the others, or at all of the team: they can be loops over pairs of robots.

`min(hypot(x[r] - x, y[r] - y) for r in others)` is, for each robot, a chain of as many operations as there are others.
The operands are a matrix, a row for each robot, a column for each robot that it looks at. Where a matrix is the same
expression of the two robots throughout, a loop over the robots looked at can write it once.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

from bbsd.expression.graph import Level, Node

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence

    from bbsd.expression.node_data import Variable

MOST_PAIRS_WRITTEN_OUT = 8
"""Folds over up to so many robots are written out, which runs faster (decision 22, loops over pairs)."""
FOLDABLE = frozenset({"+", "*", "minimum", "maximum", "&", "|"})
"""Operations that may fold the values of robots."""
SELECT = "select"
CHAINS = FOLDABLE | {SELECT}
"""Operations whose chains may be loops over pairs."""
PREVIOUS, TERM, CONDITION = 0, 1, 0
"""Positions of operands in a link, `previous + term` or `select(condition, term, previous)`."""
PREVIOUS_IN_SELECT = 2

Rows = tuple[tuple[Node, ...], ...]


@dataclass(frozen=True, slots=True)
class Pairs:
    """The nodes of one expression of pairs: (robots, robots looked at), without the first few robots looked at."""

    rows: Rows
    others: bool
    """Whether a robot looks at the others, else at all of the team."""
    first: int = 0
    """How many robots looked at are left out."""

    @property
    def corner(self) -> Node:
        """The node of the first pair."""
        return self.rows[0][0]

    @property
    def are_too_few(self) -> bool:
        """Whether a robot looks at too few others to tell a pattern."""
        return len(self.rows[0]) < 2

    def every(self) -> Iterator[Node]:
        """Yield all nodes."""
        for row in self.rows:
            yield from row

    def with_robots(self) -> Iterator[tuple[Node, int]]:
        """Yield all nodes, each with the robot looked at."""
        for robot, row in enumerate(self.rows):
            for column, node in enumerate(row, start=self.first):
                yield node, column + (robot <= column) if self.others else column

    def operand(self, position: int) -> Pairs:
        """Return the operands of all nodes at a position."""
        rows = tuple(tuple(node.operands[position] for node in row) for row in self.rows)
        return Pairs(rows, self.others, self.first)

    def own(self) -> list[Node] | None:
        """Return each robot's value if it is the same whomever it looks at, else None."""
        if self.rows[0][0] is not self.rows[0][-1] or any(len(set(row)) > 1 for row in self.rows):
            return None
        return [row[0] for row in self.rows]

    def are_theirs(self, robot_of: Callable[[Node], int | None]) -> bool:
        """Return whether each node is a value of the robot looked at, given a function from nodes to robots."""
        return all(robot_of(node) == robot for node, robot in self.with_robots())

    def by_robot(self) -> list[Node] | None:
        """Return the value of each robot looked at if it is the same whoever looks, else None.

        For a robot that nobody looks at it is any literal or constant, if the values of the others are such.
        """
        values: dict[int, Node] = {}
        for node, robot in self.with_robots():
            if values.setdefault(robot, node) is not node:
                return None
        if len(values) < len(self.rows) and not all(
            node.literal or node.operation == "constant" for node in values.values()
        ):
            return None
        return [values.get(robot, self.corner) for robot in range(len(self.rows))]

    def are_alike(self) -> bool:
        """Return whether all nodes are one operation on operands."""
        first = self.corner
        form = first.operation, first.kind, first.data, len(first.operands)
        return bool(first.operands) and all(
            (node.operation, node.kind, node.data, len(node.operands)) == form for node in self.every()
        )


@dataclass(frozen=True, slots=True)
class Chain:
    """A fold of each robot, link by link: (robots, links); the first link is the first term."""

    links: Pairs

    @property
    def operation(self) -> str:
        """The operation that joins a term to the link before."""
        return self.links.rows[0][1].operation

    def begins(self, other: Chain) -> bool:
        """Return whether another chain is this one or its beginning."""
        rows = zip(self.links.rows, other.links.rows, strict=True)
        return self.links.others == other.links.others and all(
            row[: len(begun)] == begun for row, begun in rows
        )

    @property
    def terms(self) -> Pairs:
        """The terms that are folded: (robots, links)."""
        rows = tuple((row[0], *(link.operands[TERM] for link in row[1:])) for row in self.links.rows)
        return Pairs(rows, self.links.others)

    @property
    def conditions(self) -> Pairs | None:
        """The conditions under which a term replaces the link before, in a chain of selects: (robots, links - 1)."""
        if self.operation != SELECT:
            return None
        rows = tuple(tuple(link.operands[CONDITION] for link in row[1:]) for row in self.links.rows)
        return Pairs(rows, self.links.others, 1)


def previous_link(node: Node, operation: str) -> Node | None:
    """Return the link before a link of a chain; None where the node is no link of one."""
    if node.operation != operation or operation not in CHAINS:
        return None
    return node.operands[PREVIOUS_IN_SELECT if operation == SELECT else PREVIOUS]


def chain_to(nodes: Sequence[Node], n_links: int, *, others: bool) -> Chain | None:
    """Return the chain of so many links that ends with a node for each robot; None where there is none."""
    rows = [row for node in nodes if (row := _links(node, nodes[0].operation, n_links)) is not None]
    return Chain(Pairs(tuple(rows), others)) if len(rows) == len(nodes) else None


def _links(node: Node, operation: str, n_links: int) -> tuple[Node, ...] | None:
    links = [node]
    while len(links) < n_links:
        previous = previous_link(links[-1], operation)
        if previous is None:
            return None
        links.append(previous)
    return tuple(reversed(links))


def chain_before(pairs: Pairs) -> Chain | None:
    """Return the chain of which pairs are the links but the last, so that each reads the link before; else None."""
    operation = pairs.rows[0][-1].operation
    if pairs.first != 1 or len(pairs.rows[0]) < 2:
        return None
    for row in pairs.rows:
        if any(previous_link(following, operation) is not link for link, following in pairwise(row)):
            return None
    return Chain(Pairs(pairs.rows, pairs.others))


def nodes_of_pairs(nodes: Iterable[Node]) -> list[Node]:
    """Return the nodes that a loop over pairs computes for some nodes, they themselves included."""
    computed: dict[int, Node] = {}
    waiting = list(nodes)
    while waiting:
        node = waiting.pop()
        if node.level is Level.PAIR and node.number not in computed:
            computed[node.number] = node
            waiting.extend(node.operands)
    return [*computed.values()]


def robot_of_slot(variable: Variable) -> Callable[[Node], int | None]:
    """Return the function that gives the robot whose slot of a variable a node reads; None for other nodes."""

    def robot_of(node: Node) -> int | None:
        if node.operation != "slot":
            return None
        return node.slot.robot if node.slot.variable == variable else None

    return robot_of
