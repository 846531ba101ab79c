"""Between which numbers the values of an episode certainly lie: intervals that rounding cannot leave."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import exp, inf, isfinite, isnan
from typing import TYPE_CHECKING, NamedTuple

from bbsd.compiler.passes.outputs import with_slots_read
from bbsd.expression import intervals
from bbsd.expression.graph import needed, value_of
from bbsd.kernel import functions

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from bbsd.expression.graph import Node
    from bbsd.expression.intervals import Interval
    from bbsd.expression.node_data import Slot
    from bbsd.language.meaning import Meaning

ROUNDS = 8
"""Steps in which a slot's range may widen; a bound that still moves is given up."""
MOST_NODES = 20_000
"""Values of a step beyond which slots that grow from step to step are not looked at."""
MOST_DEVIATIONS = 64.0
"""More standard deviations than a draw can be away from its mean."""


class Range(NamedTuple):
    """A value is NaN, if it may be, or from `low` to `high`."""

    low: float = -inf
    high: float = inf
    may_be_nan: bool = True

    @property
    def bounds(self) -> Interval:
        """Both bounds."""
        return self.low, self.high

    @property
    def is_known(self) -> bool:
        """Whether both bounds are finite."""
        return isfinite(self.low) and isfinite(self.high)

    @property
    def size(self) -> float:
        """The greatest magnitude."""
        return intervals.size(self.bounds)

    def joined(self, other: Range) -> Range:
        """Return the range of what may lie in either."""
        return Range(*intervals.hull(self.bounds, other.bounds), self.may_be_nan or other.may_be_nan)


ANYTHING = Range()
SURE: Mapping[str, Range] = {
    "sin": Range(-2.0, 2.0),
    "cos": Range(-2.0, 2.0),
    "tanh": Range(-2.0, 2.0),
    "sign": Range(-1.0, 1.0),
    "asin": Range(-2.0, 2.0),
    "atan": Range(-2.0, 2.0),
    "acos": Range(-4.0, 4.0),
    "atan2": Range(-4.0, 4.0),
    "wrap": Range(-4.0, 4.0),
    "cell_of": Range(0.0, 1.0, may_be_nan=False),
}
GROWING = {**intervals.GROWING, "round_half_even": functions.round_half_even}
SLACK = 1.0 + 1e-9
"""By which a bound is moved where roundings add up."""


def ranges_of(meaning: Meaning, wanted: Iterable[Node]) -> dict[int, Range]:
    """Return by the node's number between which numbers values of an episode lie, and all that they need.

    All robots share the range of a state or sensor, so what is proven of one of them is proven of all.
    """
    return _Ranges(meaning, list(wanted)).of_nodes()


@dataclass
class _Ranges:
    meaning: Meaning
    wanted: list[Node]
    slots: dict[tuple[str, tuple[int, ...]], Range] = field(default_factory=dict)
    proven: dict[tuple[str, tuple[int, ...]], Range] = field(default_factory=dict)
    """Of variables that grow by so much in a step at most."""

    def __post_init__(self) -> None:
        episode = self.meaning.episode
        self.steps = float(self.meaning.spec.environment.steps)
        outputs = with_slots_read(self.wanted, episode)
        read = {node.slot for node in needed(outputs) if node.operation == "slot"}
        self.start = {slot: node for slot, node in episode.start.items() if slot in read}
        self.after = {slot: node for slot, node in episode.after.items() if slot in read}
        self.nodes = needed([*outputs, *self.start.values()])
        self.of_constants = [
            Range(value_of(node), value_of(node), may_be_nan=False) if node.literal else ANYTHING
            for node in self.meaning.constants.scalars
        ]
        self._settle()
        while len(self.nodes) <= MOST_NODES and self._prove_growing():
            self._settle()

    def of_nodes(self) -> dict[int, Range]:
        """Return the ranges of all values, given those of slots."""
        known: dict[int, Range] = {}
        for node in self.nodes:
            known[node.number] = self._of(node, [known[operand.number] for operand in node.operands])
        return known

    def _settle(self) -> None:
        """Widen the ranges of slots until each holds what the slot starts with and what every step makes of it."""
        self.slots = {}
        self._widen(self.start, give_up=False)
        for turn in range(3 * ROUNDS + 2 * len(self.after)):
            if not self._widen(self.after, give_up=turn >= ROUNDS):
                return
        self.slots = dict.fromkeys(self.slots, ANYTHING)

    def _widen(self, values: Mapping[Slot, Node], *, give_up: bool) -> bool:
        """Join what slots hold next to their ranges; return whether a range became wider."""
        known, wider = self.of_nodes(), False
        for slot, node in values.items():
            variable = slot.variable
            before, new = self.slots.get(variable), known[node.number]
            after = self.proven.get(variable) or (new if before is None else before.joined(new))
            if after != before:
                wider = True
                self.slots[variable] = _without_moving(before, after) if give_up and before else after
        return wider

    def _of(self, node: Node, operands: Sequence[Range]) -> Range:
        match node.operation:
            case "literal":
                value = float(value_of(node))
                return ANYTHING if isnan(value) else Range(value, value, may_be_nan=False)
            case "slot":
                return self.slots.get(node.slot.variable, ANYTHING)
            case "step":
                return Range(0.0, self.steps, may_be_nan=False)
            case "constant":
                return self.of_constants[node.index]
            case "gather":
                return _joined(self.of_constants[place] for place in node.gather.places)
            case "draw":
                return _drawn(node.draw.distribution, operands)
        return _computed(node, operands)

    def _prove_growing(self) -> bool:
        """Bound what grows by no more than a known amount in each step; return whether more is known now."""
        known, found = self.of_nodes(), False
        after: dict[tuple[str, tuple[int, ...]], list[Node]] = {}
        for slot, node in self.after.items():
            after.setdefault(slot.variable, []).append(node)
        starts = [(slot.variable, known[node.number]) for slot, node in self.start.items()]
        for variable, nodes in after.items():
            if self.slots[variable].is_known:
                continue
            growth = _most(_growths(node, variable, known) for node in nodes)
            size = max(start.size for name, start in starts if name == variable)
            if growth is not None and isfinite(size):
                bound = SLACK * (max(size, growth.alone) + self.steps * growth.more)
                self.proven[variable] = Range(-bound, bound)
                found = True
        return found


def _without_moving(before: Range, after: Range) -> Range:
    """Return a range without the bounds that moved."""
    return Range(*intervals.without_moving(before.bounds, after.bounds), after.may_be_nan)


def _joined(ranges: Iterable[Range]) -> Range:
    first, *rest = ranges
    for other in rest:
        first = first.joined(other)
    return first


def _drawn(distribution: str, operands: Sequence[Range]) -> Range:
    match distribution, operands:
        case "uniform" | "integers", (one, other) if one.is_known and other.is_known:
            size = SLACK * (one.size + other.size)
            return Range(-size, size, one.may_be_nan or other.may_be_nan)
        case "normal", (mean, deviation) if mean.is_known and deviation.is_known:
            size = mean.size + MOST_DEVIATIONS * deviation.size
            return Range(-size, size, mean.may_be_nan or deviation.may_be_nan)
    return ANYTHING


def _computed(node: Node, operands: Sequence[Range]) -> Range:
    """Return the range of an operation's value."""
    if node.operation in SURE:
        return SURE[node.operation]
    may_be_nan = any(operand.may_be_nan for operand in operands)
    match node.operation, operands:
        case "select", (_, one, other):
            return one.joined(other)
        case "minimum", (one, other):  # the first where they do not compare
            least = intervals.lesser(one.bounds, other.bounds)
            return Range(*(intervals.hull(least, one.bounds) if other.may_be_nan else least), may_be_nan)
        case "maximum", (one, other):
            most = intervals.greater(one.bounds, other.bounds)
            return Range(*(intervals.hull(most, one.bounds) if other.may_be_nan else most), may_be_nan)
        case "negate", (one,):
            return Range(*intervals.negated(one.bounds), may_be_nan)
        case "abs", (one,):
            return Range(*intervals.magnitude(one.bounds), may_be_nan)
        case "modulo" | "quick_modulo", (_, divisor):
            return Range(*intervals.remainder(divisor.bounds))
        case "clamp_index", _:
            return Range(0.0, float(node.index), may_be_nan=False)
        case "sqrt", (one,) if one.high >= 0.0:
            return Range(0.0, functions.sqrt(one.high), may_be_nan or one.low < 0.0)
        case "exp", (one,):
            return Range(0.0, SLACK * exp(one.high) if one.high < 700.0 else inf, may_be_nan)
    if node.operation in GROWING:
        low, high = map(GROWING[node.operation], operands[0].bounds)
        return Range(low, high, may_be_nan)
    return _from_corners(node, operands, may_be_nan)


def _from_corners(node: Node, operands: Sequence[Range], may_be_nan: bool) -> Range:
    """Return the range of a value that is least and greatest at the ends of its operands' ranges."""
    if not all(operand.is_known for operand in operands):
        return ANYTHING
    match node.operation, operands:
        case "+", (one, other):
            bounds = intervals.plus(one.bounds, other.bounds)
        case "-", (one, other):
            bounds = intervals.minus(one.bounds, other.bounds)
        case "*", (one, other):
            bounds = intervals.product(one.bounds, other.bounds)
        case "divide", (one, other):
            bounds = intervals.quotient(one.bounds, other.bounds)
        case "floor_divide", (one, other):
            low, high = intervals.quotient(one.bounds, other.bounds)
            bounds = low - 1.0, high
        case "hypot", (one, other):
            bounds = 0.0, SLACK * (one.size + other.size)
        case "whole_power", (one,) if node.index >= 0:
            size = SLACK * functions.whole_power(one.size, node.index)
            bounds = -size, size
        case _:
            return ANYTHING
    known = Range(*bounds, may_be_nan)
    return known if known.is_known else ANYTHING


class _Growth(NamedTuple):
    """A value has at most the magnitude of a variable and `more`, or it is `alone` at most."""

    more: float
    alone: float


def _growths(node: Node, variable: tuple[str, tuple[int, ...]], known: Mapping[int, Range]) -> _Growth | None:
    """Return by how much a value's magnitude can exceed a variable's; None where that is not known."""
    found: dict[int, _Growth | None] = {}
    for each in needed([node]):
        found[each.number] = _growth(each, variable, known, found)
    return found[node.number]


def _growth(
    node: Node,
    variable: tuple[str, tuple[int, ...]],
    known: Mapping[int, Range],
    found: Mapping[int, _Growth | None],
) -> _Growth | None:
    if node.operation == "slot" and node.slot.variable == variable:
        return _Growth(0.0, 0.0)
    if known[node.number].is_known:
        return _Growth(-inf, known[node.number].size)
    operands = [(found[operand.number], known[operand.number]) for operand in node.operands]
    match node.operation, operands:
        case (("+" | "-"), ((one, one_range), (other, other_range))):
            growth, added = (one, other_range) if other_range.is_known else (other, one_range)
            if growth is None or not added.is_known:
                return None
            return _Growth(growth.more + added.size, growth.alone + added.size)
        case "*", ((one, one_range), (other, other_range)):
            growth, factor = (one, other_range) if other_range.is_known else (other, one_range)
            return growth if factor.size <= 1.0 else None
        case "select", (_, (one, _), (other, _)):
            return _most([one, other])
        case (("minimum" | "maximum"), ((one, _), (other, _))):
            return _most([one, other])
        case (("negate" | "abs"), ((one, _),)):
            return one
        case (("floor" | "ceil" | "round_half_even"), ((one, _),)) if one is not None:
            return _Growth(one.more + 1.0, one.alone + 1.0)
    return None


def _most(growths: Iterable[_Growth | None]) -> _Growth | None:
    """Return what bounds all of them, or None where one has no bound."""
    more, alone = 0.0, 0.0
    for growth in growths:
        if growth is None:
            return None
        more, alone = max(more, growth.more), max(alone, growth.alone)
    return _Growth(more, alone)
