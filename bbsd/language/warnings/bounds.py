"""Between which bounds values stay, as far as follows from how they are computed.

A truth is a number here too: false is 0, true is 1. Values that are no numbers (NaN) are left out, as in other proofs,
and so are roundings.
"""

from __future__ import annotations

from functools import partial
from math import inf, isnan, pi, sqrt
from typing import TYPE_CHECKING

from bbsd.expression.graph import compute, needed, value_of
from bbsd.expression.intervals import (
    ALL,
    GROWING,
    Interval,
    greater,
    hull,
    hull_of,
    lesser,
    magnitude,
    minus,
    negated,
    plus,
    product,
    quotient,
    remainder,
    without_moving,
)
from bbsd.expression.kinds import Kind
from bbsd.expression.operations import COMPARISONS
from bbsd.expression.syntax.tree import functions_called, names_used
from bbsd.expression.vocabulary import DRAWS
from bbsd.kernel.functions import ceil, floor
from bbsd.language.field_types import expressions_in
from bbsd.language.meaning.naming.constants import GENERATION

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping, Sequence

    from bbsd.expression.graph import Node
    from bbsd.expression.node_data import Slot
    from bbsd.expression.scope import Plain
    from bbsd.language.meaning.meaning import Meaning

TRUTH: Interval = (0.0, 1.0)
MOST_NODES = 6_000
"""Nodes of a step up to which bounds are looked for."""
STEPWISE = 3
"""Passes in which bounds may grow step by step, before one that still grows counts as unlimited."""
MOST_PASSES = 12


class Bounds:
    """The bounds of what an episode computes, whatever behaviors choose."""

    def __init__(self, meaning: Meaning) -> None:
        self._steps = float(meaning.spec.environment.steps)
        self._constants = _constants(meaning)
        self._known: dict[int, Interval] = {}
        self._fixed: dict[int, bool] = {}
        """Whether a value follows from constants alone, which a designer may change to switch something."""
        episode = meaning.episode
        self._slots: Mapping[Slot, Interval] = {}
        order = needed([*episode.start.values(), *episode.after.values()])
        later = {node.number for node in needed(episode.after.values())}
        self._at_start = {node.number for node in order} - later
        """What is computed at the start alone: there all state follows from constants, and is no switch."""
        self._is_looked_for = len(order) <= MOST_NODES
        if self._is_looked_for:
            self._slots = self._stable(episode.start, episode.after, order)

    def of(self, node: Node) -> Interval:
        """Return the bounds of a node."""
        if not self._is_looked_for:
            return _of_kind(node.kind)
        if node.number not in self._known:
            self._evaluate(needed([node]), self._slots, self._known)
        return self._known[node.number]

    def _stable(
        self, start: Mapping[Slot, Node], after: Mapping[Slot, Node], order: Sequence[Node]
    ) -> Mapping[Slot, Interval]:
        """Return bounds of all slots that hold at the start and, where they hold, after the next step."""
        first: dict[int, Interval] = {}
        self._evaluate(needed(start.values()), {}, first)
        slots = {slot: first[node.number] for slot, node in start.items()}
        then: dict[int, Interval] = {}
        self._evaluate(order, slots, then)
        for number in range(MOST_PASSES):
            self._evaluate_again(order, slots, then)
            grown = {slot: hull(bounds, then[after[slot].number]) for slot, bounds in slots.items()}
            if grown == slots:
                return {slot: hull(first[start[slot].number], then[after[slot].number]) for slot in slots}
            slots = (
                grown
                if number < STEPWISE
                else {slot: without_moving(slots[slot], grown[slot]) for slot in slots}
            )
        return {}

    def _evaluate(
        self, order: Iterable[Node], slots: Mapping[Slot, Interval], known: dict[int, Interval]
    ) -> None:
        for node in order:
            if node.number not in self._fixed:
                leaf = node.operation in ("literal", "constant")
                self._fixed[node.number] = (
                    all(self._fixed[each.number] for each in node.operands) if node.operands else leaf
                )
            if node.number not in known:
                known[node.number] = self._bounds(node, slots, [known[each.number] for each in node.operands])

    def _evaluate_again(
        self, order: Iterable[Node], slots: Mapping[Slot, Interval], known: dict[int, Interval]
    ) -> None:
        """Bring known bounds in line with those of the slots: of most values, nothing changes from pass to pass."""
        changed = set[int]()
        for node in order:
            if node.operation == "slot" or not changed.isdisjoint([each.number for each in node.operands]):
                bounds = self._bounds(node, slots, [known[each.number] for each in node.operands])
                if bounds != known[node.number]:
                    known[node.number] = bounds
                    changed.add(node.number)

    def _bounds(self, node: Node, slots: Mapping[Slot, Interval], operands: list[Interval]) -> Interval:
        operation = node.operation
        match operation:
            case "literal":
                return (float(value_of(node)),) * 2
            case "slot":
                return _within_kind(slots.get(node.slot, _of_kind(node.kind)), node.kind)
            case "constant":
                return self._constants[node.index]
            case "gather":
                return hull_of([self._constants[place] for place in node.gather.places])
            case "step":
                return (1.0, self._steps)
            case "draw" if node.draw.distribution in ("uniform", "integers"):
                return hull_of(operands)
        if operation in COMPARISONS:
            return TRUTH if self._is_switch(node) else _compared(operation, *operands)
        rule = RULES.get(operation)
        if rule is None or any(map(_is_unknown, operands)):
            return _of_kind(node.kind)
        found = rule(node, *operands)
        return _of_kind(node.kind) if _is_unknown(found) else found

    def _is_switch(self, node: Node) -> bool:
        return self._fixed[node.number] and node.number not in self._at_start


def _constants(meaning: Meaning) -> list[Interval]:
    """Return the bounds of each scalar of the constants: its value, unless it is drawn or depends on the generation."""
    spec, bounds = meaning.spec, [ALL] * len(meaning.constants.scalars)
    users: dict[str, list[str]] = {}
    for name, value in spec.constants.items():
        trees = [each.tree for each in expressions_in(value)]
        for used in frozenset[str]().union(*map(names_used, trees), *map(functions_called, trees)):
            users.setdefault(used, []).append(name)
    uncertain, waiting = set[str](), [GENERATION, *DRAWS]
    while waiting:
        name = waiting.pop()
        waiting += [user for user in users.get(name, ()) if user not in uncertain]
        uncertain.update(users.get(name, ()))
    for name, value in meaning.constants.leaves.items():
        for node in _scalars(value) if name not in uncertain else ():
            scalar = meaning.constants.scalars[node.index]
            bounds[node.index] = (float(value_of(scalar)),) * 2 if scalar.literal else ALL
    return bounds


def _scalars(value: Plain) -> list[Node]:
    return [node for item in value for node in _scalars(item)] if isinstance(value, tuple) else [value]


def _is_unknown(interval: Interval) -> bool:
    return isnan(interval[0]) or isnan(interval[1])


def _of_kind(kind: Kind) -> Interval:
    return TRUTH if kind is Kind.TRUTH else ALL


def _within_kind(interval: Interval, kind: Kind) -> Interval:
    """Return bounds within those of a kind: what grows step by step counts as unlimited, and a truth does not grow."""
    low, high = interval
    return (max(low, 0.0), min(high, 1.0)) if kind is Kind.TRUTH else interval


def _compared(operation: str, left: Interval, right: Interval) -> Interval:
    """Return the truths that a comparison may have."""
    below, above = left[1] < right[0], left[0] > right[1]
    at_most, at_least = left[1] <= right[0], left[0] >= right[1]
    are_equal = left == right and left[0] == left[1]
    always, never = {
        "<": (below, at_least),
        "<=": (at_most, above),
        ">": (above, at_most),
        ">=": (at_least, below),
        "==": (are_equal, below or above),
        "!=": (below or above, are_equal),
    }[operation]
    return (float(always), float(not never))


def _whole_quotient(_: Node, left: Interval, right: Interval) -> Interval:
    low, high = quotient(left, right)
    return floor(low), floor(high)


def _remainder(_: Node, __: Interval, divisor: Interval) -> Interval:
    return remainder(divisor) if divisor[0] > 0 else ALL


def _raised(node: Node, base: Interval) -> Interval:
    if node.index < 0:
        return ALL
    ends = [compute("whole_power", [bound], node.index) for bound in base]
    if node.index % 2:
        return ends[0], ends[1]
    return (0.0 if base[0] <= 0 <= base[1] else min(ends)), max(ends)


def _chosen(_: Node, condition: Interval, then: Interval, otherwise: Interval) -> Interval:
    return then if condition[0] else otherwise if not condition[1] else hull(then, otherwise)


def _clamped(node: Node, index: Interval, last: Interval | None = None) -> Interval:
    most = float(node.index) if last is None else last[1]
    return min(max(floor(index[0]), 0.0), most), min(max(ceil(index[1]), 0.0), most)


def _growing(operation: str, _: Node, value: Interval) -> Interval:
    return GROWING[operation](value[0]), GROWING[operation](value[1])


def _root(_: Node, value: Interval) -> Interval:
    return sqrt(max(value[0], 0.0)), sqrt(max(value[1], 0.0))


def _within(low: float, high: float, *_: object) -> Interval:
    return low, high


def _of(rule: Callable[..., Interval], _: Node, *operands: Interval) -> Interval:
    """Return the bounds by a rule that needs the operands' alone."""
    return rule(*operands)


RULES: Mapping[str, Callable[..., Interval]] = {
    "+": partial(_of, plus),
    "-": partial(_of, minus),
    "*": partial(_of, product),
    "negate": partial(_of, negated),
    "divide": partial(_of, quotient),
    "floor_divide": _whole_quotient,
    "modulo": _remainder,
    "whole_power": _raised,
    "minimum": partial(_of, lesser),
    "maximum": partial(_of, greater),
    "select": _chosen,
    "&": partial(_of, lesser),
    "|": partial(_of, greater),
    "not": lambda _, truth: (1.0 - truth[1], 1.0 - truth[0]),
    "cell_of": lambda _, truth: truth,
    "clamp_index": _clamped,
    "abs": partial(_of, magnitude),
    "sqrt": _root,
    "hypot": partial(_within, 0.0, inf),
    "sin": partial(_within, -1.0, 1.0),
    "cos": partial(_within, -1.0, 1.0),
    "tanh": partial(_within, -1.0, 1.0),
    "exp": partial(_within, 0.0, inf),
    "atan": partial(_within, -pi / 2, pi / 2),
    "asin": partial(_within, -pi / 2, pi / 2),
    "acos": partial(_within, 0.0, pi),
    "atan2": partial(_within, -pi, pi),
    "wrap": partial(_within, -pi, pi),
    "sign": partial(_within, -1.0, 1.0),
    "round_half_even": lambda _, value: (floor(value[0]), ceil(value[1])),
    **{operation: partial(_growing, operation) for operation in GROWING},
}
"""How the bounds of an operation follow from those of its operands; of all others nothing is known."""
