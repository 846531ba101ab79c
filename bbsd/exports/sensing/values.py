"""The values that the C of a design has members for: what it is given, what it keeps, what it sets."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from bbsd.architecture.needs import BEFORE
from bbsd.exports.sensing.text import TYPES

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from bbsd.exports.sensing.naming import Namer
    from bbsd.expression.kinds import Kind
    from bbsd.expression.node_data import Slot

Shape = tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Member:
    """A member of a struct: one number, truth or cell, or an array of them; of the team, one for each robot first."""

    identifier: str
    kind: Kind
    shape: Shape = ()
    comment: str = ""

    @property
    def declaration(self) -> str:
        """What declares it, without the comment."""
        return f"{TYPES[self.kind]} {self.identifier}{''.join(f'[{length}]' for length in self.shape)};"


@dataclass(frozen=True, slots=True)
class Values:
    """Members by the name of a value, and for lists that are no arrays by their slot (of robot 0, or the world)."""

    members: Mapping[Slot, Member]
    """For each scalar its member, whose array it may be in."""
    of_team: frozenset[str]
    """Names whose members have an element for each robot."""

    @property
    def declared(self) -> list[Member]:
        """Each member once."""
        return list(dict.fromkeys(self.members.values()))

    def place(self, slot: Slot, robot: str) -> str | None:
        """Return the member of a scalar with its indices, `robot` is that of the robot; None where it has none."""
        member = self.members.get(_of_any(slot))
        if member is None:
            return None
        indices = [robot] if slot.name in self.of_team and slot.robot is not None else []
        if len(member.shape) > len(indices):
            indices += map(str, slot.place)
        return member.identifier + "".join(f"[{index}]" for index in indices)


class Scalar(NamedTuple):
    """One number, truth or cell of the members: where it stands, and its slot; robot 0 where it is the robot's own."""

    place: str
    slot: Slot
    is_own: bool
    kind: Kind

    def of(self, robot: int) -> Slot:
        """Return the slot for a robot that has these members."""
        return self.slot._replace(robot=robot) if self.is_own else self.slot


def scalars_of(values: Values) -> list[Scalar]:
    """Return all scalars of members."""
    scalars = list[Scalar]()
    for slot, member in values.members.items():
        if slot.name in values.of_team and slot.robot is not None:
            for robot in range(member.shape[0]):
                place = str(values.place(slot, str(robot)))
                scalars.append(Scalar(place, slot._replace(robot=robot), is_own=False, kind=member.kind))
        else:
            place = str(values.place(slot, "0"))
            scalars.append(Scalar(place, slot, is_own=slot.robot is not None, kind=member.kind))
    return scalars


def values_of(
    slots: Iterable[Slot],
    kinds: Mapping[Slot, Kind],
    namer: Namer,
    n_robots: int = 0,
    of_team: frozenset[str] = frozenset(),
    comments: Mapping[str, str] | None = None,
) -> Values:
    """Return the members for some scalars; all elements of a list are given, each value's together."""
    groups: dict[str, list[Slot]] = {}
    for slot in slots:
        group = groups.setdefault(slot.name, [])
        if _of_any(slot) not in group:
            group.append(_of_any(slot))
    members: dict[Slot, Member] = {}
    for name, group in groups.items():
        team = (n_robots,) if name in of_team else ()
        comment = (comments or {}).get(name, "")
        shape = _shape([slot.place for slot in group])
        if shape is not None and len({kinds[slot] for slot in group}) == 1:
            member = Member(namer(_plain(name)), kinds[group[0]], team + shape, comment)
            members |= dict.fromkeys(group, member)
        else:
            for slot in group:
                identifier = namer("_".join([_plain(name), *map(str, slot.place)]))
                members[slot] = Member(identifier, kinds[slot], team, comment)
    return Values(members, of_team)


def _of_any(slot: Slot) -> Slot:
    return slot if slot.robot is None else slot._replace(robot=0)


def _plain(name: str) -> str:
    return name.replace(BEFORE, BEFORE.strip() + "_")


def _shape(places: Sequence[tuple[int, ...]]) -> Shape | None:
    """Return the lengths of an array that has exactly these places; None where there is none."""
    if len({len(place) for place in places}) > 1:
        return None
    shape = tuple(1 + max(indices) for indices in zip(*places, strict=True))
    size = 1
    for length in shape:
        size *= length
    return shape if size == len(places) else None
