"""Keeps a long list of state in one array: an element is read and set at its index, not by a choice for each element.

The graph has a slot for each element (decision 43, lists of state). Here those of a list become one slot, whose next
value is a `list_after`: for each way in which an element is set a condition, the indices and the value, in order. A
chain of choices that takes an element becomes an `element` of what the step before left, and, where the step sets
elements, choices whether it is this one. So all is read before anything is stored, and no bit changes.

Operations that exist only here:

- `element` (data: `Elements`): an element of a list as the step before left it;
- `same_place` (data: the last place): whether two indices, clamped, are the same;
- `list_start` (data: `ListShape`): the elements at the start, one alone where all are the same;
- `list_after` (data: `ListShape`): what a step sets, for each a condition, the indices and the value.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from dataclasses import dataclass, field, replace
from functools import partial
from math import prod
from typing import TYPE_CHECKING

from bbsd.compiler.passes.list_values import (
    Chosen,
    Held,
    ListValue,
    ListValues,
    Put,
    in_order,
    offset_of,
    places_of,
    reads_of,
    strides_of,
)
from bbsd.expression.graph import Graph, Level, Node, needed, value_of
from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import Elements, ListShape, Slot
from bbsd.kernel.functions import clamp_index

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping, Sequence

    from bbsd.language.meaning.episode.episode import Episode

MOST_ELEMENTS_WRITTEN_OUT = 12
"""Lists of up to so many elements have a variable for each, which runs as fast (decision 49, lists as arrays)."""
MOST_READ_ONE_BY_ONE = 8
"""How many times as long a list must be whose elements are mostly read one by one, as a sum over them does."""


@dataclass(frozen=True, slots=True)
class KeptList:
    """A list whose elements have one array, and what a step leaves of it."""

    lengths: tuple[int, ...]
    kind: Kind
    own: bool
    """Whether a loop over robots has one for each."""
    value: ListValue


def keep_lists_in_arrays(
    episode: Episode, to_prove: Sequence[Node] = (), most_written_out: int = MOST_ELEMENTS_WRITTEN_OUT
) -> tuple[Episode, tuple[Node, ...]]:
    """Return an episode with one slot for each list of more elements, if they are set at an index; and what to prove.

    Lists of which an element is computed in another way stay as they are.
    """
    lists = _lists(episode, most_written_out)
    if not lists:
        return episode, tuple(to_prove)
    rewriting = _Rewriting(episode, tuple(to_prove), lists)
    rewritten = rewriting.rewritten()
    alone = _read_one_by_one(rewritten)
    longest = most_written_out * MOST_READ_ONE_BY_ONE
    worth = {
        slot: kept
        for slot, kept in lists.items()
        if prod(kept.lengths) > longest or 2 * alone[slot] < prod(kept.lengths)
    }
    if len(worth) < len(lists):
        if not worth:
            return episode, tuple(to_prove)
        rewriting = _Rewriting(episode, tuple(to_prove), worth)
        rewritten = rewriting.rewritten()
    return rewritten, tuple(map(rewriting.new, to_prove))


def _read_one_by_one(episode: Episode) -> Counter[Slot]:
    """Return of how many elements of each list the value is read at a place that is known."""
    reads = (node.data for node in needed(episode.nodes) if not node.operands)
    return Counter(data.slot for data in reads if isinstance(data, Elements))


def _lists(episode: Episode, most_written_out: int) -> dict[Slot, KeptList]:
    """Return the lists that an array can keep."""
    elements: dict[Slot, dict[tuple[int, ...], Node]] = defaultdict(dict)
    for slot, node in episode.after.items():
        if slot.place:
            elements[slot._replace(place=())][slot.place] = node
    long = {slot: nodes for slot, nodes in elements.items() if len(nodes) > max(most_written_out, 1)}
    if not long:
        return {}
    read: dict[Slot, set[tuple[Kind, Level]]] = defaultdict(set)
    for node in needed(episode.nodes):
        if node.operation == "slot":
            read[node.slot._replace(place=())].add((node.kind, node.level))
    lengths = {slot: tuple(1 + index for index in max(nodes)) for slot, nodes in long.items()}
    regular = {
        slot: lengths[slot]
        for slot, nodes in long.items()
        if len(read[slot]) == 1 and len(nodes) == prod(lengths[slot])
    }
    values, lists = ListValues(regular), dict[Slot, KeptList]()
    for slot, shape in regular.items():
        ((kind, level),) = read[slot]
        value = values.find([long[slot][place] for place in places_of(shape)], shape)
        if value is not None and _is_kept(value, slot, shape):
            lists[slot] = KeptList(shape, kind, level is Level.EACH, value)
    return lists


def _is_kept(value: ListValue, slot: Slot, lengths: tuple[int, ...]) -> bool:
    """Return whether a list is made of what its slot holds, each element of its own, and of elements that are set."""
    strides = tuple(
        stride if length > 1 else 0 for stride, length in zip(strides_of(lengths), lengths, strict=True)
    )
    return all(
        None not in each.indices
        if isinstance(each, Put)
        else isinstance(each, Chosen) or (each.slot, each.base, each.strides) == (slot, 0, strides)
        for each in in_order(value)
    )


Step = tuple[list[Node], "Callable[[], Node]"]
"""The old nodes that must be rewritten before one, and what makes its new node of theirs."""


@dataclass
class _Rewriting:
    """An episode whose lists are arrays."""

    before: Episode
    to_prove: tuple[Node, ...]
    lists: Mapping[Slot, KeptList]
    made: dict[int, Node] = field(default_factory=dict)
    """The new nodes by the numbers of the old ones."""

    def __post_init__(self) -> None:
        nodes = needed([*self.before.nodes, *self.to_prove])
        self.graph = Graph(first=nodes[-1].number + 1, bounded=False)
        # What is made of a list that stays written out is none of an array.
        self.values = ListValues({slot: kept.lengths for slot, kept in self.lists.items()})

    def rewritten(self) -> Episode:
        """Return the episode."""
        before = self.before
        kept = replace(
            before,
            acted=self._without_elements(before.acted),
            after=self._without_elements(before.after),
        )
        episode = kept.with_nodes(self.new)
        start, after = self._without_elements(before.start), dict(episode.after)
        for slot, kept_list in self.lists.items():
            start[slot] = self._start(slot, kept_list)
            after[slot] = self._after(kept_list)
        return replace(episode, start=_ordered(start, before.start), after=_ordered(after, before.after))

    def _without_elements(self, slots: Mapping[Slot, Node]) -> dict[Slot, Node]:
        return {slot: node for slot, node in slots.items() if slot._replace(place=()) not in self.lists}

    def _start(self, slot: Slot, kept: KeptList) -> Node:
        nodes = [self.before.start[slot._replace(place=place)] for place in places_of(kept.lengths)]
        if all(node is nodes[0] for node in nodes):
            nodes = nodes[:1]
        return self._list("list_start", nodes, kept)

    def _after(self, kept: KeptList) -> Node:
        """Return all that a step sets, what is below first: each where the way down to it is the one that is taken."""
        graph, values = self.graph, in_order(kept.value)
        taken: dict[int, Node] = {id(kept.value): graph.truth(value=True)}

        def take(value: ListValue, condition: Node) -> None:
            before = taken.get(id(value))
            taken[id(value)] = condition if before is None else graph.apply("|", before, condition)

        for value in reversed(values):
            here = taken[id(value)]
            if isinstance(value, Chosen):
                condition = self.new(value.condition)
                take(value.then, graph.apply("&", here, condition))
                take(value.otherwise, graph.apply("&", here, graph.apply("not", condition)))
            elif isinstance(value, Put):
                take(value.under, here)
        operands = list[Node]()
        for value in values:
            if isinstance(value, Put):
                conditions = [taken[id(value)], *map(self.new, value.conditions)]
                indices = [self._index(index) for index in value.indices if index is not None]
                operands += [graph.fold("&", conditions), *indices, self.new(value.value)]
        return self._list("list_after", operands, kept)

    def _list(self, operation: str, operands: Sequence[Node], kept: KeptList) -> Node:
        level = Level.EACH if kept.own else Level.LANE
        return self.graph.make(operation, tuple(operands), ListShape(kept.lengths), kept.kind, level)

    def _index(self, index: Node | int) -> Node:
        return self.graph.number(index) if isinstance(index, int) else self.new(index)

    def new(self, node: Node) -> Node:
        """Return the new node of an old one; what it needs is made first, without recursion: graphs are deep."""
        waiting = [node]
        while waiting:
            needs, make = self._step(waiting[-1])
            missing = [need for need in needs if need.number not in self.made]
            if missing:
                waiting += missing
                continue
            done = waiting.pop()
            if done.number not in self.made:
                self.made[done.number] = make()
        return self.made[node.number]

    def _step(self, node: Node) -> Step:
        if node.number in self.made or (not node.operands and node.operation != "slot"):
            return [], lambda: node
        if node.operation == "slot":
            return [], lambda: self._slot(node)
        for indices, nodes, lengths in reads_of(node):
            value = self.values.find(nodes, lengths)
            if value is not None:
                needs = [*indices, *(each for inner in in_order(value) for each in inner.nodes)]
                return needs, partial(self._read, value, indices, lengths)
        return list(node.operands), lambda: self._copy(node)

    def _slot(self, node: Node) -> Node:
        slot = node.slot._replace(place=())
        if slot not in self.lists:
            return node
        return self._element(slot, offset_of(node.slot.place, self.lists[slot].lengths), (), (), ())

    def _copy(self, node: Node) -> Node:
        operands = tuple(self.made[operand.number] for operand in node.operands)
        if all(one is other for one, other in zip(operands, node.operands, strict=True)):
            return node
        return self.graph.make(node.operation, operands, node.data, node.kind, node.level)

    def _read(self, value: ListValue, indices: Sequence[Node], lengths: tuple[int, ...]) -> Node:
        """Return the element of a list at some indices, given as old nodes."""
        graph, read = self.graph, dict[int, Node]()
        indices = list(map(self.new, indices))
        for each in in_order(value):
            match each:
                case Held(slot, base, strides):
                    read[id(each)] = self._element(slot, base, strides, lengths, indices)
                case Chosen(condition, then, otherwise):
                    branches = read[id(then)], read[id(otherwise)]
                    read[id(each)] = graph.apply("select", self.new(condition), *branches)
                case Put():
                    branches = self.new(each.value), read[id(each.under)]
                    read[id(each)] = self._choose(self._hit(each, indices, lengths), *branches)
        return read[id(value)]

    def _hit(self, put: Put, indices: Sequence[Node], lengths: tuple[int, ...]) -> Node:
        """Return whether the element at some indices is the one that is set."""
        conditions = [*map(self.new, put.conditions)]
        for index, place, length in zip(indices, put.indices, lengths, strict=True):
            if place is not None:
                conditions.append(self._same_place(index, self._index(place), length - 1))
        return self.graph.fold("&", conditions)

    def _choose(self, hit: Node, then: Node, otherwise: Node) -> Node:
        """Return a choice. Where it is certain, it stands all the same: indices are counted that are not finite."""
        if hit.literal and value_of(hit):
            return self.graph.make(
                "select", (hit, then, otherwise), None, then.kind, _level([then, otherwise])
            )
        return self.graph.apply("select", hit, then, otherwise)

    def _same_place(self, one: Node, other: Node, last: int) -> Node:
        if one is other:
            return self.graph.truth(value=True)
        if one.literal and other.literal:
            same = clamp_index(value_of(one), last) == clamp_index(value_of(other), last)
            return self.graph.truth(value=same)
        level = _level([one, other])
        return self.graph.make("same_place", (one, other), last, Kind.TRUTH, level)

    def _element(
        self, slot: Slot, base: int, strides: Sequence[int], lengths: Sequence[int], indices: Sequence[Node]
    ) -> Node:
        kept = self.lists[slot]
        free = list[tuple[int, int, Node]]()
        for stride, length, index in zip(strides, lengths, indices, strict=True):
            if index.literal:
                base += stride * clamp_index(value_of(index), length - 1)
            else:
                free.append((stride, length, index))
        data = Elements(
            slot,
            kept.own,
            base,
            tuple(stride for stride, _, _ in free),
            tuple(length for _, length, _ in free),
        )
        operands = tuple(index for _, _, index in free)
        level = _level(operands, Level.EACH if kept.own else Level.LANE)
        return self.graph.make("element", operands, data, kept.kind, level)


def _level(nodes: Iterable[Node], *levels: Level) -> Level:
    """Return how often a value changes that is made of others, as the graph has it."""
    found = {*levels, *(node.level for node in nodes)}
    return Level.EACH if {Level.LANE, Level.ROBOT} <= found else max(found)


def _ordered(slots: Mapping[Slot, Node], before: Mapping[Slot, Node]) -> dict[Slot, Node]:
    """Return slots in the order that they had before, a list where its first element was."""
    order = dict.fromkeys(slot if slot in slots else slot._replace(place=()) for slot in before)
    return {slot: slots[slot] for slot in order}
