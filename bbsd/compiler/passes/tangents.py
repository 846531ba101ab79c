"""Keeps angles that are only compared with constants as their tangents: no arctangent has to be computed.

For numbers of any size, atan(u) < c where u < tan(c); and for u, v >= 0, atan(u) - atan(v) < c where

    (u - v) - tan(c) * (1 + u * v) < 0,

as the left side is (tan(atan(u) - atan(v)) - tan(c)) * (1 + u * v). Both sides are rounded, and so is the arctangent
that the language means. So there is a slack: a comparison is *proven* where the difference of the sides exceeds it,
and the arctangents then compare alike. Where one is not proven, an episode that computes arctangents must replace this
one. By chance that happens once in a million million times; where values are whole or on a grid, an angle may equal a
bound exactly.

The pass is optional: its only contract is the list of truths that must be proven.
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
    from bbsd.language.meaning.episode.episode import Episode

ORDERINGS = frozenset({"<", "<=", ">", ">="})
VARYING = (Level.LANE, Level.EACH)
"""The levels of values that differ between lanes."""
NEVER_NEGATIVE = frozenset({"sqrt", "hypot", "abs"})


@dataclass(frozen=True, slots=True)
class Angle:
    """The arctangent of a value, in radians or in degrees."""

    tangent: Node
    in_degrees: bool
    acute: bool
    """Whether it is certainly from 0 to a right angle."""


def compare_tangents(episode: Episode) -> tuple[Episode, tuple[Node, ...]]:
    """Return an episode that compares tangents, not arctangents, and the truths that must be proven.

    If all of them hold in every step, returns and credit have the same bits. The episode is the given one where nothing
    can be gained.
    """
    outputs = with_slots_read(credit_outputs(episode), episode)
    if not any(node.operation == "atan" for node in needed(outputs)):
        return episode, ()
    rewriting = _Rewriting(episode, outputs)
    while left := rewriting.arctangents & {node.number for node in needed(rewriting.outputs)}:
        # Something else needs these angles; then comparing them costs nothing more.
        rewriting = _Rewriting(episode, outputs, rewriting.computed | left)
    return (rewriting.episode, rewriting.to_prove) if rewriting.to_prove else (episode, ())


@dataclass
class _Rewriting:
    """An episode rewritten without arctangents, except those `computed`, given by their nodes' numbers."""

    before: Episode
    wanted: list[Node]
    """What a step of that episode computes."""
    computed: frozenset[int] = frozenset()
    new: dict[int, Node] = field(default_factory=dict)
    """The new nodes by the numbers of the old nodes."""
    angles: dict[int, Angle] = field(default_factory=dict)
    """The arctangents by the numbers of the old nodes."""
    proofs: dict[int, Node] = field(default_factory=dict)
    """Whether comparisons are proven: truths by their numbers."""

    def __post_init__(self) -> None:
        nodes = needed(self.wanted)
        # New numbers must differ from those of all old nodes: even one that is not needed may give its name to others.
        self.graph = Graph(first=1 + max(node.number for node in self.before.nodes), bounded=False)
        self.slots = self._find_slots(nodes)
        for node in nodes:
            self._rewrite(node)
        self.episode = self._rewrite_episode()

    @property
    def to_prove(self) -> tuple[Node, ...]:
        """The truths that must be proven."""
        return tuple(self.proofs.values())

    @property
    def outputs(self) -> list[Node]:
        """The nodes that a step computes now."""
        return with_slots_read(credit_outputs(self.episode), self.episode)

    @property
    def arctangents(self) -> frozenset[int]:
        """The nodes to get rid of, by number: arctangents, and slots that are now kept as tangents."""
        return frozenset(self.angles)

    def _find_slots(self, nodes: list[Node]) -> dict[Slot, Angle]:
        """Return the slots that can be kept as tangents: they are arctangents at the start and after each step."""
        angles: dict[Slot, Angle] = {}
        taken = {name for name, _, _ in self.before.after}
        new_names: dict[str, str] = {}
        for node in nodes:
            if node.operation != "slot" or node.number in self.computed or node.level not in VARYING:
                continue
            slot = node.slot
            start, after = _angle(self.before.start[slot]), self._angle(self.before.after[slot])
            if start is None or after is None or start.in_degrees is not after.in_degrees:
                continue
            name, robot, place = slot
            if name not in new_names:
                new_names[name] = _free_name(f"tangent_of_{name}", taken)
                taken.add(new_names[name])
            tangent = self.graph.leaf("slot", Slot(new_names[name], robot, place), Kind.NUMBER, node.level)
            angles[slot] = Angle(tangent, after.in_degrees, start.acute and after.acute)
            self.angles[node.number] = angles[slot]
        return angles

    def _angle(self, node: Node) -> Angle | None:
        """Return the angle that a node of a step is, of new nodes where there are any; None if it is computed."""
        angle = _angle(node)
        if angle is None or (node.operands[0] if angle.in_degrees else node).number in self.computed:
            return None
        return replace(angle, tangent=self.new.get(angle.tangent.number, angle.tangent))

    def _rewrite(self, node: Node) -> None:
        angle = self._angle(node)
        if angle is not None:
            self.angles[node.number] = angle
        operands = tuple(self.new[operand.number] for operand in node.operands)
        comparison = self._compare(node)
        if comparison is not None:
            self.new[node.number] = comparison
        elif operands == node.operands:
            self.new[node.number] = node
        else:
            self.new[node.number] = self.graph.make(
                node.operation, operands, node.data, node.kind, node.level
            )

    def _compare(self, node: Node) -> Node | None:
        """Return the comparison of tangents for one of an angle, or of two angles' difference, with a constant."""
        if node.operation not in ORDERINGS or node.level not in VARYING:
            return None
        operation, (side, other) = node.operation, node.operands
        if side.level is Level.CALL:
            operation, side, other = MIRRORED[operation], other, side
        if other.level is not Level.CALL:
            return None
        if side.number in self.angles:
            return self._compare_angle(operation, self.angles[side.number], other)
        if side.operation == "-" and all(operand.number in self.angles for operand in side.operands):
            one, another = (self.angles[operand.number] for operand in side.operands)
            return self._compare_difference(operation, one, another, other)
        return None

    def _compare_angle(self, operation: str, angle: Angle, bound: Node) -> Node | None:
        tangent, slack = self._tangent(bound, angle)
        if slack is None:
            return None
        apply, nothing = self.graph.apply, self.graph.number(0.0)
        # The arctangent has its argument's sign, so with 0 everything but NaN compares as it does.
        needed_slack = apply("select", apply("==", bound, nothing), nothing, slack)
        self._prove(">=", apply("-", angle.tangent, tangent), needed_slack)
        return apply(operation, angle.tangent, tangent)

    def _compare_difference(self, operation: str, one: Angle, other: Angle, bound: Node) -> Node | None:
        tangent, slack = self._tangent(bound, one)
        if slack is None or not (one.acute and other.acute) or one.in_degrees is not other.in_degrees:
            return None
        if bound.literal and value_of(bound) == 0.0:
            return None  # an angle that does not change differs by 0, which is never proven
        apply, u, v = self.graph.apply, one.tangent, other.tangent
        scale = apply("+", self.graph.number(1.0), apply("*", u, v))
        excess = apply("-", apply("-", u, v), apply("*", tangent, scale))
        self._prove(">", excess, apply("*", slack, scale))  # never where the product overflowed
        return apply(operation, excess, self.graph.number(0.0))

    def _tangent(self, bound: Node, angle: Angle) -> tuple[Node, Node | None]:
        """Return the tangent of a bound and its slack; no slack where no comparison with it can ever be proven."""
        radians = self.graph.apply("radians", bound) if angle.in_degrees else bound
        tangent, slack = (self.graph.apply(name, radians) for name in ("tan", "tangent_slack"))
        return tangent, None if slack.literal and isnan(value_of(slack)) else slack

    def _prove(self, exceeds: str, excess: Node, slack: Node) -> None:
        proof = self.graph.apply(exceeds, self.graph.apply("abs", excess), slack)
        self.proofs[proof.number] = proof

    def _rewrite_episode(self) -> Episode:
        changed = self.before.with_nodes(lambda node: self.new.get(node.number, node))
        # Nothing is proven at the start, so there all stays as it was.
        start, after = (
            dict(self._keep(slot, node) for slot, node in slots.items())
            for slots in (self.before.start, changed.after)
        )
        return replace(changed, start=start, after=after)

    def _keep(self, slot: Slot, node: Node) -> tuple[Slot, Node]:
        """Return a slot and its value, or instead the slot of its tangent and the tangent."""
        kept, angle = self.slots.get(slot), _angle(node)
        return (slot, node) if kept is None or angle is None else (kept.tangent.slot, angle.tangent)


def _free_name(wanted: str, taken: set[str]) -> str:
    """Return the name wanted, with underscores behind it if a slot of the spec has it."""
    while wanted in taken:
        wanted += "_"
    return wanted


def _angle(node: Node) -> Angle | None:
    """Return the angle that a node is, if it is an arctangent."""
    in_degrees = node.operation == "degrees"
    inner = node.operands[0] if in_degrees else node
    if inner.operation != "atan":
        return None
    (tangent,) = inner.operands
    return Angle(tangent, in_degrees, _never_negative(tangent))


def _never_negative(node: Node) -> bool:
    """Return whether a value is certainly not below zero; it may be NaN."""
    if node.literal:
        return not value_of(node) < 0.0
    return node.operation in NEVER_NEGATIVE
