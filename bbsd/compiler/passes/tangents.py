"""Angles that are only compared with constants are kept as their tangents: no arctangent has to be computed.

For numbers of any size, atan(u) < c where u < tan(c); and for u, v >= 0, atan(u) - atan(v) < c where

    (u - v) - tan(c) * (1 + u * v) < 0,

as the left side is (tan(atan(u) - atan(v)) - tan(c)) * (1 + u * v). Both sides are rounded, and so is the arctangent
that the language means. So there is a slack: a comparison is *certain* where the difference of the sides exceeds it,
and the arctangents then compare alike. Where one is not, the rollout says so, and the detailed one, which computes
arctangents, takes its place. Every bit is as it was. By chance that happens once in a million million times; where
values are whole or on a grid, an angle may be a bound's very own.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from math import isnan
from typing import TYPE_CHECKING

from bbsd.compiler.passes.outputs import credit_outputs, with_slots_read
from bbsd.expression.graph import Graph, Level, Node, needed, value_of
from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import Slot
from bbsd.expression.operations import MIRRORED

if TYPE_CHECKING:
    from bbsd.language.meaning.episode import Episode

ORDERINGS = frozenset({"<", "<=", ">", ">="})
VARYING = (Level.LANE, Level.EACH)
NEVER_NEGATIVE = frozenset({"sqrt", "hypot", "abs"})


@dataclass(frozen=True, slots=True)
class Angle:
    """The arctangent of a value, in radians or in degrees."""

    tangent: Node
    in_degrees: bool
    acute: bool
    """Whether it is certainly from 0 to a right angle."""


def compare_tangents(episode: Episode) -> tuple[Episode, tuple[Node, ...]]:
    """The same episode with as few arctangents as possible, and truths: whether its comparisons are certain.

    Holds for what is needed of a step for returns and credit. Without such comparisons the episode is as it was.
    """
    outputs = with_slots_read(credit_outputs(episode), episode)
    if not any(node.operation == "atan" for node in needed(outputs)):
        return episode, ()
    rewriting = _Rewriting(episode, outputs)
    while left := rewriting.arctangents & {node.number for node in needed(rewriting.outputs)}:
        # Something else needs these angles; then comparing them costs nothing more.
        rewriting = _Rewriting(episode, outputs, rewriting.computed | left)
    return (rewriting.episode, rewriting.certain) if rewriting.certain else (episode, ())


@dataclass
class _Rewriting:
    """An episode written anew without arctangents but for those `computed`, given by their nodes' numbers."""

    before: Episode
    wanted: list[Node]
    computed: frozenset[int] = frozenset()
    found: dict[int, Node] = field(default_factory=dict)
    """By number, what stands for a node."""
    angles: dict[int, Angle] = field(default_factory=dict)
    """By number, nodes that are arctangents."""
    comparisons: dict[int, Node] = field(default_factory=dict)
    """Whether comparisons are certain, by number."""

    def __post_init__(self) -> None:
        every = needed(self.wanted)
        # No number of a node that lends its name to others, and is not needed, may come again.
        self.graph = Graph(first=1 + max(node.number for node in self.before.nodes), bounded=False)
        self.slots = self._slots(every)
        for node in every:
            self._write(node)
        self.episode = self._episode()

    @property
    def certain(self) -> tuple[Node, ...]:
        """Whether each comparison is certain."""
        return tuple(self.comparisons.values())

    @property
    def outputs(self) -> list[Node]:
        """What a step computes now."""
        return with_slots_read(credit_outputs(self.episode), self.episode)

    @property
    def arctangents(self) -> frozenset[int]:
        """The nodes that are to be no more, and slots that are now kept as tangents."""
        return frozenset(self.angles)

    def _slots(self, every: list[Node]) -> dict[Slot, Angle]:
        """Slots that can be kept as tangents: they are arctangents at the start and after each step."""
        found: dict[Slot, Angle] = {}
        taken = {name for name, _, _ in self.before.after}
        kept: dict[str, str] = {}
        for node in every:
            if node.operation != "slot" or node.number in self.computed or node.level not in VARYING:
                continue
            slot = node.slot
            start, after = _angle(self.before.start[slot]), self._angle(self.before.after[slot])
            if start is None or after is None or start.in_degrees is not after.in_degrees:
                continue
            name, robot, place = slot
            if name not in kept:
                kept[name] = _free(f"tangent_of_{name}", taken)
                taken.add(kept[name])
            tangent = self.graph.leaf("slot", Slot(kept[name], robot, place), Kind.NUMBER, node.level)
            found[slot] = Angle(tangent, after.in_degrees, start.acute and after.acute)
            self.angles[node.number] = found[slot]
        return found

    def _angle(self, node: Node) -> Angle | None:
        """What a node of a step is the arctangent of, if that is not computed; in new nodes as far as there are any."""
        angle = _angle(node)
        if angle is None or (node.operands[0] if angle.in_degrees else node).number in self.computed:
            return None
        return replace(angle, tangent=self.found.get(angle.tangent.number, angle.tangent))

    def _write(self, node: Node) -> None:
        angle = self._angle(node)
        if angle is not None:
            self.angles[node.number] = angle
        operands = tuple(self.found[operand.number] for operand in node.operands)
        compared = self._compared(node)
        if compared is not None:
            self.found[node.number] = compared
        elif operands == node.operands:
            self.found[node.number] = node
        else:
            self.found[node.number] = self.graph.make(
                node.operation, operands, node.data, node.kind, node.level
            )

    def _compared(self, node: Node) -> Node | None:
        """The comparison of an angle, or of the difference of two, with a constant."""
        if node.operation not in ORDERINGS or node.level not in VARYING:
            return None
        operation, (side, other) = node.operation, node.operands
        if side.level is Level.CALL:
            operation, side, other = MIRRORED[operation], other, side
        if other.level is not Level.CALL:
            return None
        if side.number in self.angles:
            return self._alone(operation, self.angles[side.number], other)
        if side.operation == "-" and all(operand.number in self.angles for operand in side.operands):
            one, another = (self.angles[operand.number] for operand in side.operands)
            return self._difference(operation, one, another, other)
        return None

    def _alone(self, operation: str, angle: Angle, bound: Node) -> Node | None:
        tangent, slack = self._tangent(bound, angle)
        if slack is None:
            return None
        apply, nothing = self.graph.apply, self.graph.number(0.0)
        # The arctangent has its argument's sign, so with 0 everything but NaN compares as it does.
        needed_slack = apply("select", apply("==", bound, nothing), nothing, slack)
        self._certain_where(">=", apply("-", angle.tangent, tangent), needed_slack)
        return apply(operation, angle.tangent, tangent)

    def _difference(self, operation: str, one: Angle, other: Angle, bound: Node) -> Node | None:
        tangent, slack = self._tangent(bound, one)
        if slack is None or not (one.acute and other.acute) or one.in_degrees is not other.in_degrees:
            return None
        if bound.literal and value_of(bound) == 0.0:
            return None  # what does not change would never be certain
        apply, u, v = self.graph.apply, one.tangent, other.tangent
        scale = apply("+", self.graph.number(1.0), apply("*", u, v))
        excess = apply("-", apply("-", u, v), apply("*", tangent, scale))
        self._certain_where(">", excess, apply("*", slack, scale))  # never where the product was too large
        return apply(operation, excess, self.graph.number(0.0))

    def _tangent(self, bound: Node, angle: Angle) -> tuple[Node, Node | None]:
        """The tangent of a bound and its slack; no slack where no comparison with it is ever certain."""
        radians = self.graph.apply("radians", bound) if angle.in_degrees else bound
        tangent, slack = (self.graph.apply(name, radians) for name in ("tan", "tangent_slack"))
        return tangent, None if slack.literal and isnan(value_of(slack)) else slack

    def _certain_where(self, exceeds: str, excess: Node, slack: Node) -> None:
        certain = self.graph.apply(exceeds, self.graph.apply("abs", excess), slack)
        self.comparisons[certain.number] = certain

    def _episode(self) -> Episode:
        changed = self.before.with_nodes(lambda node: self.found.get(node.number, node))
        # Nothing notes whether a comparison at the start is certain, so there all is as it was.
        start, after = (
            dict(self._kept(slot, node) for slot, node in slots.items())
            for slots in (self.before.start, changed.after)
        )
        return replace(changed, start=start, after=after)

    def _kept(self, slot: Slot, node: Node) -> tuple[Slot, Node]:
        """A slot and its value as they are kept."""
        kept, angle = self.slots.get(slot), _angle(node)
        return (slot, node) if kept is None or angle is None else (kept.tangent.slot, angle.tangent)


def _free(wanted: str, taken: set[str]) -> str:
    """The name wanted, with underscores behind it if a slot of the designer's has it."""
    while wanted in taken:
        wanted += "_"
    return wanted


def _angle(node: Node) -> Angle | None:
    """What a node is the arctangent of."""
    in_degrees = node.operation == "degrees"
    inner = node.operands[0] if in_degrees else node
    if inner.operation != "atan":
        return None
    (tangent,) = inner.operands
    return Angle(tangent, in_degrees, _never_negative(tangent))


def _never_negative(node: Node) -> bool:
    """Whether a value is certainly not below zero; it may be NaN."""
    if node.literal:
        return not value_of(node) < 0.0
    return node.operation in NEVER_NEGATIVE
