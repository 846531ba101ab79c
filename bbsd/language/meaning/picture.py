"""What a spec's view shows, as nodes that read what is stored after a step."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from bbsd.expression import elaboration
from bbsd.expression.checks import of_kind
from bbsd.expression.graph import Node
from bbsd.expression.kinds import Kind
from bbsd.expression.mistakes import WHOLE
from bbsd.language.field_types import Expression

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping

    from bbsd.expression.scope import Scope, Value
    from bbsd.expression.tree import Span
    from bbsd.language.field_types import Nested
    from bbsd.language.meaning.moments import Moment
    from bbsd.language.view import View

Row = tuple[Node, ...]
"""Numbers beside each other: a place as x, y and perhaps a radius, or a row of a table."""

PLACE = "a place, [x, y] or [x, y, radius]"


@dataclass(frozen=True, slots=True)
class Picture:
    """Places and headings robot by robot, marks by name; area, circles and grid once for all."""

    places: tuple[Row, ...]
    headings: tuple[Node, ...] | None
    area: Row | None
    circles: tuple[Row, ...]
    grid: tuple[Row, ...] | None
    marks: Mapping[str, Row]


def elaborate_picture(view: View, moment: Moment) -> Picture:
    """Elaborate a view at a moment; its mistakes are told."""
    names = moment.names
    scopes = [moment.scope.at(("view",), robot) for robot in names.robots]
    team = moment.scope.at(("view",), names.team)
    return Picture(
        places=tuple(_place(_read(view.at, each, "at")) for each in scopes),
        headings=None
        if view.heading is None
        else tuple(_read(view.heading, each, "heading").number() for each in scopes),
        area=None if view.area is None else _area(_read(view.area, team, "area")),
        circles=() if view.circles is None else _circles(_read(view.circles, team, "circles")),
        grid=None if view.grid is None else _grid(_read(view.grid, team, "grid")),
        marks={name: _place(_read(each, team, "marks", name)) for name, each in view.marks.items()},
    )


@dataclass(frozen=True, slots=True)
class _Read:
    """A value, and where its mistakes are told: at its own place in a list, or at the expression that it is of."""

    found: Value
    written: Nested
    scope: Scope

    @property
    def span(self) -> Span:
        return self.written.tree.span if isinstance(self.written, Expression) else WHOLE

    @property
    def is_unknown(self) -> bool:
        return isinstance(self.found, Node) and self.found.kind is Kind.UNKNOWN

    def tell(self, needed: str) -> None:
        """Say what is needed in the place of what is there."""
        is_list = isinstance(self.found, tuple)
        there = f"a list of {len(self.found)}" if is_list else "one value"  # type: ignore[arg-type]  # a list
        self.scope.mistake("BB049", f"this must be {needed}, not {there}", self.span)

    def number(self) -> Node:
        """A number; anything else is a mistake."""
        return of_kind(self.found, Kind.NUMBER, self.span, self.scope)

    def rows(self, fewest: int = 0) -> tuple[_Read, ...]:
        """The items of a list; anything else, or too short a one, is a mistake."""
        if isinstance(self.found, tuple) and len(self.found) >= fewest:
            return tuple(self._item(place, each) for place, each in enumerate(self.found))
        if not self.is_unknown:
            self.tell("a list of rows")
        return ()

    def _item(self, place: int, found: Value) -> _Read:
        if isinstance(self.written, Expression):
            return _Read(found, self.written, self.scope)
        here = self.scope.at((*self.scope.path, place), self.scope.robot)
        return _Read(found, self.written[place], here)

    def row(self, lengths: Collection[int], needed: str) -> Row:
        """Numbers, as many as one of the lengths; nothing after a mistake."""
        if isinstance(self.found, tuple) and len(self.found) in lengths:
            return tuple(self._item(place, each).number() for place, each in enumerate(self.found))
        if not self.is_unknown:
            self.tell(needed)
        return ()


def _read(written: Nested, scope: Scope, *keys: str | int) -> _Read:
    here = scope.at((*scope.path, *keys), scope.robot)
    if isinstance(written, tuple):
        items = tuple(_read(item, here, place).found for place, item in enumerate(written))
        return _Read(items, written, here)
    return _Read(elaboration.value(written.tree, here), written, here)


def _place(read: _Read) -> Row:
    return read.row((2, 3), PLACE)


def _circles(read: _Read) -> tuple[Row, ...]:
    return tuple(each.row((3,), "[x, y, radius]") for each in read.rows())


def _area(read: _Read) -> Row | None:
    """The corners, which must lie apart as far as that is known."""
    corners = read.row((4,), "[x, y, x, y], two corners")
    known = [read.scope.known(node) for node in corners if node.kind is not Kind.UNKNOWN]
    if len(known) == 4 and None not in known and (known[0] == known[2] or known[1] == known[3]):
        read.scope.mistake("BB049", "this area has no extent: its corners do not lie apart", read.span)
    return corners


def _grid(read: _Read) -> tuple[Row, ...]:
    """A table; all rows as long as the first."""
    rows = read.rows(1)
    first = rows[0].found if rows else ()
    length = len(first) if isinstance(first, tuple) and first else 1
    return tuple(each.row((length,), f"a row of {length} number{'s' * (length > 1)}") for each in rows)
