"""What a spec's view shows, as nodes that read the values stored after a step."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from bbsd.expression.elaboration import elaboration
from bbsd.expression.elaboration.checks import require_kind
from bbsd.expression.graph import Node
from bbsd.expression.kinds import Kind
from bbsd.expression.syntax.mistakes import WHOLE
from bbsd.language.field_types import Expression

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping

    from bbsd.expression.scope import Scope, Value
    from bbsd.expression.syntax.tree import Span
    from bbsd.language.field_types import Nested
    from bbsd.language.meaning.moments import Moment
    from bbsd.language.view import View

Row = tuple[Node, ...]
"""A row of numbers: x, y and perhaps a radius of a place, or a row of a table."""

PLACE = "a place, [x, y] or [x, y, radius]"


class Picture(NamedTuple):
    """Places and headings robot by robot, marks and paths by name; area, circles, grid and paths once for all."""

    places: tuple[Row, ...]
    headings: tuple[Node, ...] | None
    area: Row | None
    circles: tuple[Row, ...]
    grid: tuple[Row, ...] | None
    marks: Mapping[str, Row]
    paths: Mapping[str, tuple[Row, ...]]


def elaborate_picture(view: View, moment: Moment) -> Picture:
    """Return what a view shows at a moment, and report its mistakes."""
    names = moment.names
    scopes = [moment.scope.at(("view",), robot) for robot in names.robots]
    team = moment.scope.at(("view",), names.team)
    return Picture(
        places=tuple(_place(_read(view.at, scope, "at")) for scope in scopes),
        headings=None
        if view.heading is None
        else tuple(_read(view.heading, scope, "heading").number() for scope in scopes),
        area=None if view.area is None else _area(_read(view.area, team, "area")),
        circles=() if view.circles is None else _circles(_read(view.circles, team, "circles")),
        grid=None if view.grid is None else _grid(_read(view.grid, team, "grid")),
        marks={name: _place(_read(place, team, "marks", name)) for name, place in view.marks.items()},
        paths={name: _path(_read(path, team, "paths", name)) for name, path in view.paths.items()},
    )


class _Read(NamedTuple):
    """A value and where to report its mistakes: at its own item of a list, or at the expression that gives it."""

    value: Value
    origin: Nested
    scope: Scope

    @property
    def span(self) -> Span:
        return self.origin.tree.span if isinstance(self.origin, Expression) else WHOLE

    @property
    def is_unknown(self) -> bool:
        return isinstance(self.value, Node) and self.value.kind is Kind.UNKNOWN

    def report_shape(self, needed: str) -> None:
        """Report that the value has another shape than needed."""
        given = f"a list of {len(self.value)}" if isinstance(self.value, tuple) else "one value"
        self.scope.mistake("BB049", f"this must be {needed}, not {given}", self.span)

    def number(self) -> Node:
        """Return the value as a number; report anything else."""
        return require_kind(self.value, Kind.NUMBER, self.span, self.scope)

    def rows(self, fewest: int = 0) -> tuple[_Read, ...]:
        """Return the items of a list; report anything else, or too short a list."""
        if isinstance(self.value, tuple) and len(self.value) >= fewest:
            return tuple(self._item(index, value) for index, value in enumerate(self.value))
        if not self.is_unknown:
            self.report_shape("a list of rows")
        return ()

    def _item(self, index: int, value: Value) -> _Read:
        if isinstance(self.origin, Expression):
            return _Read(value, self.origin, self.scope)
        scope = self.scope.at((*self.scope.path, index), self.scope.robot)
        return _Read(value, self.origin[index], scope)

    def row(self, lengths: Collection[int], needed: str) -> Row:
        """Return numbers, as many as one of the lengths; report anything else and return none."""
        if isinstance(self.value, tuple) and len(self.value) in lengths:
            return tuple(self._item(index, value).number() for index, value in enumerate(self.value))
        if not self.is_unknown:
            self.report_shape(needed)
        return ()


def _read(nested: Nested, scope: Scope, *keys: str | int) -> _Read:
    inner = scope.at((*scope.path, *keys), scope.robot)
    if isinstance(nested, tuple):
        items = tuple(_read(item, inner, index).value for index, item in enumerate(nested))
        return _Read(items, nested, inner)
    return _Read(elaboration.value(nested.tree, inner), nested, inner)


def _place(read: _Read) -> Row:
    return read.row((2, 3), PLACE)


def _circles(read: _Read) -> tuple[Row, ...]:
    return tuple(circle.row((3,), "[x, y, radius]") for circle in read.rows())


def _path(read: _Read) -> tuple[Row, ...]:
    return tuple(point.row((2,), "a point of a line, [x, y]") for point in read.rows(2))


def _area(read: _Read) -> Row | None:
    """Return the corners, and report them where they are known not to lie apart."""
    corners = read.row((4,), "[x, y, x, y], two corners")
    values = [read.scope.static_value(node) for node in corners if node.kind is not Kind.UNKNOWN]
    if len(values) == 4 and None not in values and (values[0] == values[2] or values[1] == values[3]):
        read.scope.mistake("BB049", "this area has no extent: its corners do not lie apart", read.span)
    return corners


def _grid(read: _Read) -> tuple[Row, ...]:
    """Return a table, whose rows must all be as long as the first."""
    rows = read.rows(1)
    first = rows[0].value if rows else ()
    length = len(first) if isinstance(first, tuple) and first else 1
    return tuple(row.row((length,), f"a row of {length} number{'s' * (length > 1)}") for row in rows)
