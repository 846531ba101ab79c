"""What the elements of a list have in common: a column of nodes, one for each element, as one value of the whole list.

The graph has a node for each element. Where they are the elements of a list that is kept, or of one in which an
element was set, or of one of two such lists by a condition, the column is a `ListValue`: it can be read at any index,
and stored, without a node for each element.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import product
from math import prod
from typing import TYPE_CHECKING

from bbsd.expression.graph import Node, value_of
from bbsd.expression.kinds import Kind

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from bbsd.expression.node_data import Slot

DEEPEST = 200
"""Lists that are made of one another, each with an element set or by a condition; deeper ones stay written out."""
MOST_APART = 8
"""Elements of a list that are set at places which are known; where there are more, the list stays written out."""


@dataclass(frozen=True, eq=False, slots=True)
class Held:
    """Elements of a list as a slot holds it: the first one's place in the whole list, and the steps to the next."""

    slot: Slot
    base: int
    strides: tuple[int, ...]
    depth: int = 0

    @property
    def below(self) -> tuple[ListValue, ...]:
        """The lists that it is made of."""
        return ()

    @property
    def nodes(self) -> tuple[Node, ...]:
        """The nodes that it depends on, besides those of other lists."""
        return ()


@dataclass(frozen=True, eq=False, slots=True)
class Chosen:
    """One of two lists."""

    condition: Node
    then: ListValue
    otherwise: ListValue
    depth: int

    @property
    def below(self) -> tuple[ListValue, ...]:
        """The lists that it is made of."""
        return self.then, self.otherwise

    @property
    def nodes(self) -> tuple[Node, ...]:
        """The nodes that it depends on, besides those of other lists."""
        return (self.condition,)


@dataclass(frozen=True, eq=False, slots=True)
class Put:
    """A list in which the elements at some indices have another value, where conditions hold."""

    conditions: tuple[Node, ...]
    indices: tuple[Node | int | None, ...]
    """For each dimension an index, which is clamped, or a place; None where all are set."""
    value: Node
    under: ListValue
    depth: int

    @property
    def below(self) -> tuple[ListValue, ...]:
        """The lists that it is made of."""
        return (self.under,)

    @property
    def nodes(self) -> tuple[Node, ...]:
        """The nodes that it depends on, besides those of other lists."""
        return (*self.conditions, *(index for index in self.indices if isinstance(index, Node)), self.value)


ListValue = Held | Chosen | Put


def in_order(value: ListValue) -> list[ListValue]:
    """Return a list and all that it is made of, each once, what is below others before them."""
    found: dict[int, ListValue] = {}

    def visit(each: ListValue) -> None:
        if id(each) not in found:
            for below in each.below:
                visit(below)
            found[id(each)] = each

    visit(value)
    return list(found.values())


@dataclass(frozen=True, slots=True)
class ListValues:
    """Finds the lists that columns of nodes are."""

    lengths: Mapping[Slot, tuple[int, ...]]
    """The lists that are kept in arrays, each a slot without a place."""
    known: dict[tuple[object, ...], ListValue | None] = field(default_factory=dict)

    def find(self, nodes: Sequence[Node], lengths: tuple[int, ...]) -> ListValue | None:
        """Return the list whose elements these nodes are, the last dimension's first; None where they are none."""
        key = (lengths, *(node.number for node in nodes))
        if key not in self.known:
            self.known[key] = self._find(nodes, lengths)
        return self.known[key]

    def _find(self, nodes: Sequence[Node], lengths: tuple[int, ...]) -> ListValue | None:
        operations = {node.operation for node in nodes}
        if operations == {"slot"}:
            return self._held(nodes, lengths)
        if operations == {"select"} and (value := self._alike(nodes, lengths)) is not None:
            return value
        return self._with_places_set(nodes, lengths) if "select" in operations else None

    def _held(self, nodes: Sequence[Node], lengths: tuple[int, ...]) -> Held | None:
        lists = {node.slot._replace(place=()) for node in nodes}
        slot = lists.pop()
        if lists or slot not in self.lengths:
            return None
        offsets = [offset_of(node.slot.place, self.lengths[slot]) for node in nodes]
        steps = strides_of(lengths)
        strides = tuple(
            offsets[step] - offsets[0] if length > 1 else 0
            for step, length in zip(steps, lengths, strict=True)
        )
        regular = [
            offsets[0] + sum(stride * index for stride, index in zip(strides, place, strict=True))
            for place in places_of(lengths)
        ]
        return Held(slot, offsets[0], strides) if offsets == regular else None

    def _alike(self, nodes: Sequence[Node], lengths: tuple[int, ...]) -> ListValue | None:
        """Return a list that is chosen, or in which an element is set at indices that are computed."""
        conditions, thens, others = zip(*(node.operands for node in nodes), strict=True)
        if _is_one(conditions):
            then, otherwise = self.find(thens, lengths), self.find(others, lengths)
            if then is None or otherwise is None or max(then.depth, otherwise.depth) >= DEEPEST:
                return None
            return Chosen(conditions[0], then, otherwise, 1 + max(then.depth, otherwise.depth))
        if not _is_one(thens) or (hits := _hits(conditions, lengths)) is None:
            return None
        under = self.find(others, lengths)
        if under is None or under.depth >= DEEPEST:
            return None
        return Put(*hits, thens[0], under, 1 + under.depth)

    def _with_places_set(self, nodes: Sequence[Node], lengths: tuple[int, ...]) -> ListValue | None:
        """Return a list some elements of which are set at places that are known: those nodes are deeper choices."""
        depths = [_choices_in(node) for node in nodes]
        usual = min(depths)
        apart = [position for position, depth in enumerate(depths) if depth > usual]
        if not 0 < len(apart) <= MOST_APART:
            return None
        below = list(nodes)
        for position in apart:
            below[position] = nodes[position].operands[2]
        value = self.find(below, lengths)
        places = list(places_of(lengths))
        for position in apart:
            if value is None or value.depth >= DEEPEST:
                return None
            condition, then, _ = nodes[position].operands
            value = Put((condition,), places[position], then, value, 1 + value.depth)
        return value


def places_of(lengths: Sequence[int]) -> Iterator[tuple[int, ...]]:
    """Yield the places of a list, the last index first."""
    return product(*map(range, lengths))


def strides_of(lengths: Sequence[int]) -> list[int]:
    """Return for each dimension how many elements further on the next one stands."""
    return [prod(lengths[dimension + 1 :]) for dimension in range(len(lengths))]


def offset_of(place: Sequence[int], lengths: Sequence[int]) -> int:
    """Return how many elements stand before a place."""
    return sum(stride * index for stride, index in zip(strides_of(lengths), place, strict=True))


def _is_one(nodes: Sequence[Node]) -> bool:
    return all(node is nodes[0] for node in nodes)


def _choices_in(node: Node) -> int:
    depth = 0
    while node.operation == "select":
        depth, node = depth + 1, node.operands[2]
    return depth


def _hits(
    conditions: Sequence[Node], lengths: tuple[int, ...]
) -> tuple[tuple[Node, ...], tuple[Node | int | None, ...]] | None:
    """Return what all conditions ask for, and the indices that must be an element's place; None where they are others.

    They are what `language.meaning.setting.targets` makes.
    """
    columns = [_parts(condition) for condition in conditions]
    if len({len(parts) for parts in columns}) > 1:
        return None
    common, indices = list[Node](), list[Node | None]([None] * len(lengths))
    places = list(places_of(lengths))
    for parts in zip(*columns, strict=True):
        if _is_one(parts):
            common.append(parts[0])
            continue
        found = _index_of(parts, places, lengths)
        if found is None or indices[found[0]] is not None:
            return None
        indices[found[0]] = found[1]
    return tuple(common), tuple(indices)


def _parts(condition: Node) -> list[Node]:
    """Return what must hold, all of it, for a condition to hold."""
    parts, rest = list[Node](), condition
    while rest.operation == "&":
        rest, last = rest.operands
        parts.append(last)
    return [rest, *reversed(parts)]


def _index_of(
    parts: Sequence[Node], places: Sequence[tuple[int, ...]], lengths: tuple[int, ...]
) -> tuple[int, Node] | None:
    """Return the dimension and the index for which each condition asks whether the index is the element's place."""
    for dimension, length in enumerate(lengths):
        by_place: dict[int, Node] = {}
        if length > 1 and all(
            by_place.setdefault(place[dimension], part) is part
            for part, place in zip(parts, places, strict=True)
        ):
            index = by_place[length - 1].operands[0] if by_place[length - 1].operands else None
            if index is not None and all(
                _asks_for(part, index, place, length - 1) for place, part in by_place.items()
            ):
                return dimension, index
    return None


def _asks_for(condition: Node, index: Node, place: int, last: int) -> bool:
    """Return whether a condition says that an index, clamped, is a place."""
    if place == 0:
        return condition.operation == "not" and _compares(condition.operands[0], ">=", index, 1)
    return _compares(condition, ">=" if place == last else "==", index, place)


def _compares(condition: Node, operation: str, index: Node, number: int) -> bool:
    if condition.operation != operation:
        return False
    left, right = condition.operands
    return left is index and right.literal and right.kind is Kind.NUMBER and value_of(right) == number


# --- Elements that are read at an index


def reads_of(node: Node) -> Iterator[tuple[tuple[Node, ...], list[Node], tuple[int, ...]]]:
    """Yield how a node is the element of a list at some indices: these, the elements and the lengths.

    It is a chain of choices, as `expression.picking` makes them; by two indices comes before by one.
    """
    chain = _chain(node)
    if chain is None:
        return
    index, items = chain
    inner = [_chain(item) for item in items]
    found = [each for each in inner if each is not None]
    if len(found) == len(items) and len({(at.number, len(row)) for at, row in found}) == 1:
        first, rows = found[0][0], [row for _, row in found]
        yield (
            (first, index),
            [row[place] for place in range(len(rows[0])) for row in rows],
            (len(rows[0]), len(items)),
        )
    yield (index,), items, (len(items),)


def _chain(node: Node) -> tuple[Node, list[Node]] | None:
    """Return the index and the elements of a chain: is the index at least the last place, at least the one before?"""
    if not _asks_at_least(node):
        return None
    index, place = node.operands[0].operands[0], value_of(node.operands[0].operands[1])
    items = list[Node]()
    while place >= 1:
        if not _asks_at_least(node) or not _compares(node.operands[0], ">=", index, int(place)):
            return None
        _, item, node = node.operands
        items.append(item)
        place -= 1
    return (index, [node, *reversed(items)]) if place == 0 else None


def _asks_at_least(node: Node) -> bool:
    if node.operation != "select" or node.operands[0].operation != ">=":
        return False
    bound = node.operands[0].operands[1]
    return bound.literal and bound.kind is Kind.NUMBER
