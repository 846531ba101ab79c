"""Folds in which each robot looks at the others, or at all of the team, found again as loops over pairs of robots.

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
"""Robots looked at up to this number are written out, which runs faster."""
FOLDS = frozenset({"+", "*", "minimum", "maximum", "&", "|"})
SELECT = "select"
CHAINS = FOLDS | {SELECT}
PREVIOUS, TERM, CONDITION = 0, 1, 0
"""Operands of a fold; a choice such as `select(condition, term, previous)` has them elsewhere."""
PREVIOUS_CHOICE = 2

Rows = tuple[tuple[Node, ...], ...]


@dataclass(frozen=True, slots=True)
class Pairs:
    """The nodes of one expression of pairs: (robots, robots looked at), the first so many of those left out."""

    rows: Rows
    others: bool
    """Whether a robot looks at the others, else at all of the team."""
    first: int = 0

    @property
    def corner(self) -> Node:
        """The node of the first pair."""
        return self.rows[0][0]

    @property
    def are_too_few(self) -> bool:
        """Whether nothing can be said of whomever a robot looks at."""
        return len(self.rows[0]) < 2

    def every(self) -> Iterator[Node]:
        """All nodes."""
        for row in self.rows:
            yield from row

    def seen(self) -> Iterator[tuple[Node, int]]:
        """All nodes, each with the robot looked at."""
        for robot, row in enumerate(self.rows):
            for column, node in enumerate(row, start=self.first):
                yield node, column + (robot <= column) if self.others else column

    def of(self, place: int) -> Pairs:
        """Operands of all nodes."""
        rows = tuple(tuple(node.operands[place] for node in row) for row in self.rows)
        return Pairs(rows, self.others, self.first)

    def own(self) -> list[Node] | None:
        """Each robot's value, where it is the same whomever it looks at."""
        if self.rows[0][0] is not self.rows[0][-1] or any(len(set(row)) > 1 for row in self.rows):
            return None
        return [row[0] for row in self.rows]

    def are_theirs(self, robot_of: Callable[[Node], int | None]) -> bool:
        """Whether each node is a value of the robot looked at, given whose values nodes are."""
        return all(robot_of(node) == robot for node, robot in self.seen())

    def by_robot(self) -> list[Node] | None:
        """What is looked at in each robot, where it is the same whoever looks.

        Of a robot that nobody looks at it is any literal or constant, if that is what the others are.
        """
        found: dict[int, Node] = {}
        for node, robot in self.seen():
            if found.setdefault(robot, node) is not node:
                return None
        if len(found) < len(self.rows) and not all(
            node.literal or node.operation == "constant" for node in found.values()
        ):
            return None
        return [found.get(robot, self.corner) for robot in range(len(self.rows))]

    def are_alike(self) -> bool:
        """Whether all nodes are one operation on operands."""
        first = self.corner
        same = first.operation, first.kind, first.data, len(first.operands)
        return bool(first.operands) and all(
            (node.operation, node.kind, node.data, len(node.operands)) == same for node in self.every()
        )


@dataclass(frozen=True, slots=True)
class Chain:
    """A fold of each robot, link by link: (robots, links); the first link is the first term itself."""

    links: Pairs

    @property
    def operation(self) -> str:
        """What joins a term to the link before."""
        return self.links.rows[0][1].operation

    def begins(self, other: Chain) -> bool:
        """Whether another chain is this one or its beginning."""
        rows = zip(self.links.rows, other.links.rows, strict=True)
        return self.links.others == other.links.others and all(
            row[: len(begun)] == begun for row, begun in rows
        )

    @property
    def terms(self) -> Pairs:
        """What is folded: (robots, links)."""
        rows = tuple((row[0], *(link.operands[TERM] for link in row[1:])) for row in self.links.rows)
        return Pairs(rows, self.links.others)

    @property
    def conditions(self) -> Pairs | None:
        """Where a term takes the place of those before, in a chain of choices: (robots, links - 1)."""
        if self.operation != SELECT:
            return None
        rows = tuple(tuple(link.operands[CONDITION] for link in row[1:]) for row in self.links.rows)
        return Pairs(rows, self.links.others, 1)


def previous_link(node: Node, operation: str) -> Node | None:
    """The link before one of such a chain; None for another operation."""
    if node.operation != operation or operation not in CHAINS:
        return None
    return node.operands[PREVIOUS_CHOICE if operation == SELECT else PREVIOUS]


def chain_to(nodes: Sequence[Node], n_links: int, *, others: bool) -> Chain | None:
    """The chain of so many links that ends with a node for each robot; None where they are none."""
    rows = [row for node in nodes if (row := _links(node, nodes[0].operation, n_links)) is not None]
    return Chain(Pairs(tuple(rows), others)) if len(rows) == len(nodes) else None


def _links(node: Node, operation: str, n_links: int) -> tuple[Node, ...] | None:
    found = [node]
    while len(found) < n_links:
        previous = previous_link(found[-1], operation)
        if previous is None:
            return None
        found.append(previous)
    return tuple(reversed(found))


def chain_of(before: Pairs) -> Chain | None:
    """The chain whose links, but for the last, are what pairs need from the one before; None where there is none."""
    operation = before.rows[0][-1].operation
    if before.first != 1 or len(before.rows[0]) < 2:
        return None
    for row in before.rows:
        if any(previous_link(following, operation) is not link for link, following in pairwise(row)):
            return None
    return Chain(Pairs(before.rows, before.others))


def of_pairs(nodes: Iterable[Node]) -> list[Node]:
    """What a loop over pairs computes for some nodes."""
    found: dict[int, Node] = {}
    waiting = list(nodes)
    while waiting:
        node = waiting.pop()
        if node.level is Level.PAIR and node.number not in found:
            found[node.number] = node
            waiting.extend(node.operands)
    return [*found.values()]


def robot_of_slot(variable: Variable) -> Callable[[Node], int | None]:
    """Whose slot of a variable a node is; None for all other nodes."""

    def robot_of(node: Node) -> int | None:
        if node.operation != "slot":
            return None
        return node.slot.robot if node.slot.variable == variable else None

    return robot_of
