"""Elements as MATLAB has them: in parentheses, `lamp(1)`, and counted from 1."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from bbsd.expression.syntax.mistakes import ExpressionError, Rewriting
from bbsd.expression.syntax.parsing import parse
from bbsd.expression.syntax.tree import Call, Expr, Generator, Index, Name, Number, Span, parts
from bbsd.expression.vocabulary import AGGREGATES, DRAWS, FUNCTIONS
from bbsd.language.meant.edits.layout import correction

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bbsd.errors import Correction
    from bbsd.expression.scope import Path
    from bbsd.language.meant.reading import Reading
    from bbsd.text import Data

Shape = tuple[int | None, ...]
"""The number of elements of a list, and of each of its elements; None where it is not known."""
END = "end"
"""What MATLAB calls the last index."""


@dataclass(frozen=True, slots=True)
class Use:
    """An element of a list, as an expression at a path asks for it."""

    path: Path
    name: str
    indices: tuple[Expr, ...]
    span: Span
    is_call: bool


def elements_in_parentheses(reading: Reading) -> None:
    """Read `lamp(1)` as the element that it is, counted from 0 as here or, where no index is 0, from 1."""
    shapes = _shapes(reading)
    calls = [use for use in _uses(reading, shapes) if use.is_call] if shapes else []
    shifted = {use.name for use in calls if _may_count_from_one(use.name, calls, shapes)}
    for path in dict.fromkeys(use.path for use in calls):
        own = [use for use in calls if use.path == path]
        writing = _Writing(str(reading.at(path)), shapes, frozenset((name, True) for name in shifted))
        _tell_calls(reading, path, own, writing, {use.name for use in own} & shifted)


def _tell_calls(reading: Reading, path: Path, calls: list[Use], writing: _Writing, shifted: set[str]) -> None:
    text, new = writing.text, writing.all()
    start = min(use.span.start for use in calls)
    end = max(use.span.start + use.span.length for use in calls)
    first = min(calls, key=lambda use: use.span.start)
    moved = any(use.name in shifted and any(map(_literal, use.indices)) for use in calls)
    message = f"{first.name} is not a function: an element stands in [...]"
    message += ", and elements count from 0" if moved else ""
    advice = f"write {writing.element(first)}"
    if moved and not any(_is_beyond(use, writing.shapes[use.name]) for use in calls):
        as_written = _Writing(text, writing.shapes, frozenset()).element(first)
        advice += f", or {as_written} if the first is already 0"
    written = new[start : len(new) - (len(text) - end)]
    rewriting = Rewriting(written, Span(start, end - start), not moved)
    reading.tell(path, "BB053", message, advice, rewriting, first.span)
    reading.set(path, new)


def elements_from_one(reading: Reading) -> None:
    """Read `lamp[1]` and `lamp[2]` of a list of two elements as its first and its second."""
    shapes = _shapes(reading)
    uses = _uses(reading, shapes) if shapes else []
    for name in dict.fromkeys(use.name for use in uses if not use.is_call):
        own = [use for use in uses if use.name == name and not use.is_call]
        beyond = next((use for use in own if _is_beyond(use, shapes[name])), None)
        if beyond is not None and not _may_count_from_one(name, own, shapes):
            own = [use for use in own if use.path == beyond.path]
        different = {tuple(map(_literal, use.indices)) for use in own if any(map(_literal, use.indices))}
        if beyond is None or len(different) < 2 or not _may_count_from_one(name, own, shapes):
            continue
        length = next(
            n for index, n in zip(beyond.indices, shapes[name], strict=False) if n and _literal(index) == n
        )
        message = f"there is no element {length}; the {length} count from 0 to {length - 1}"
        advice = f"count all indices of {name} from 0"
        at = next(index for index in beyond.indices if _literal(index) == length)
        reading.tell(beyond.path, "BB057", message, advice, _all_shifted(reading, own, shapes), at.span)
        for path in dict.fromkeys(use.path for use in own):
            writing = _Writing(str(reading.at(path)), {name: shapes[name]}, frozenset({(name, False)}))
            reading.set(path, writing.all())


def _all_shifted(reading: Reading, uses: list[Use], shapes: dict[str, Shape]) -> Correction | None:
    """Return the correction that counts all indices of a name from 0, None where they stand in several files."""
    document = reading.document(uses[0].path)
    edits = []
    for use in uses:
        if not any(map(_literal, use.indices)):
            continue
        path = reading.origin(use.path)
        stretch = reading.document(use.path).stretch(path, use.span.start, use.span.length)
        if stretch is None or reading.document(use.path) is not document:
            return None
        writing = _Writing(str(reading.at(use.path)), shapes, frozenset({(use.name, False)}))
        edits.append(document.source.edit(*stretch, writing.element(use)))
    return correction(document, edits, is_certain=False)


def _may_count_from_one(name: str, uses: list[Use], shapes: dict[str, Shape]) -> bool:
    """Return whether all plain indices of a list are from 1 up to its length, and there are any."""
    found = [
        (value, length)
        for use in uses
        if use.name == name
        for index, length in zip(use.indices, (*shapes[name], *[None] * len(use.indices)), strict=False)
        if (value := _literal(index)) is not None
    ]
    is_ended = any(isinstance(each, Name) and each.name == END for use in uses for each in use.indices)
    return all(value >= 1 and (length is None or value <= length) for value, length in found) and (
        bool(found) or is_ended
    )


def _is_beyond(use: Use, shape: Shape) -> bool:
    return any(n and _literal(index) == n for index, n in zip(use.indices, shape, strict=False))


def _literal(index: Expr) -> int | None:
    """Return the whole number that an index is as it is written."""
    return int(index.value) if isinstance(index, Number) and index.value.is_integer() else None


@dataclass(frozen=True, slots=True)
class _Writing:
    """Writes elements of lists in brackets, counted from 0."""

    text: str
    shapes: dict[str, Shape]
    shifted: frozenset[tuple[str, bool]]
    """Names whose plain indices count from 1, and whether only those in parentheses do."""

    def all(self) -> str:
        """Return the whole text."""
        return self.part(parse(self.text), 0, len(self.text))

    def part(self, expr: Expr, start: int, end: int) -> str:
        """Return the characters of a text in which an expression stands."""
        new, at = "", start
        for use in sorted(_outer(expr, self.shapes, frozenset()), key=lambda use: use.span.start):
            new += self.text[at : use.span.start] + self.element(use)
            at = use.span.start + use.span.length
        return new + self.text[at:end]

    def element(self, use: Use) -> str:
        """Return an element."""
        lengths = (*self.shapes[use.name], *[None] * len(use.indices))
        written = (self._index(use, each, length) for each, length in zip(use.indices, lengths, strict=False))
        return use.name + "".join(f"[{each}]" for each in written)

    def _index(self, use: Use, index: Expr, length: int | None) -> str:
        value = _literal(index)
        if (use.name, use.is_call) in self.shifted and value is not None:
            return str(value - 1)
        if isinstance(index, Name) and index.name == END and length:
            return str(length - 1)
        return self.part(index, index.span.start, index.span.start + index.span.length)


def _outer(expr: Expr, shapes: dict[str, Shape], local: frozenset[str]) -> Iterator[Use]:
    """Yield elements in an expression, but for those in indices of others."""
    if isinstance(expr, Generator):
        local |= frozenset(expr.names)
    own = _use_of(expr, (), shapes, local)
    if own is not None:
        yield own
        return
    for part in parts(expr):
        yield from _outer(part, shapes, local)


def _uses(reading: Reading, shapes: dict[str, Shape]) -> list[Use]:
    """Return all uses of elements in a spec's expressions, in order."""
    found: list[Use] = []
    for path, text in _texts(reading):
        try:
            tree = parse(text)
        except ExpressionError:
            continue
        found += _uses_in(tree, path, shapes, frozenset())
    return found


def _uses_in(expr: Expr, path: Path, shapes: dict[str, Shape], local: frozenset[str]) -> Iterator[Use]:
    if isinstance(expr, Generator):
        local |= frozenset(expr.names)
    own = _use_of(expr, path, shapes, local)
    if own is not None:
        yield own
    for part in own.indices if own is not None else parts(expr):
        yield from _uses_in(part, path, shapes, local)


def _use_of(expr: Expr, path: Path, shapes: dict[str, Shape], local: frozenset[str]) -> Use | None:
    """Return what an expression asks for if it is an element of a known list, else None."""
    if isinstance(expr, Call):
        is_list = expr.function in shapes and expr.function not in local
        if not is_list or not expr.arguments or any(isinstance(each, Generator) for each in expr.arguments):
            return None
        return Use(path, expr.function, expr.arguments, expr.span, is_call=True)
    indices: list[Expr] = []
    of: Expr = expr
    while isinstance(of, Index):
        indices.insert(0, of.index)
        of = of.of
    if not indices or not isinstance(of, Name) or of.name not in shapes or of.name in local:
        return None
    return Use(path, of.name, tuple(indices), expr.span, is_call=False)


def _texts(reading: Reading) -> Iterator[tuple[Path, str]]:
    """Yield the texts of a spec that are expressions, and where they stand."""
    blocks: list[Path] = [
        ("environment", key) for key in ("world", "state", "definitions", "dynamics", "sensors", "ends")
    ]
    for name in reading.mapping(("behaviors",)):
        blocks += [("behaviors", name, key) for key in ("inputs", "excited", "actions", "expects")]
    for block in [*blocks, ("reward",)]:
        yield from _leaves(block, reading.at(block))


def _leaves(path: Path, data: Data) -> Iterator[tuple[Path, str]]:
    if isinstance(data, str):
        yield path, data
    elif isinstance(data, dict):
        for key, value in data.items():
            yield from _leaves((*path, key), value)


def _shapes(reading: Reading) -> dict[str, Shape]:
    """Return the shapes of constants, and of what robots and the world have, that are lists."""
    known = FUNCTIONS.keys() | {*AGGREGATES, *DRAWS}
    constants = reading.mapping(("constants",))
    robots = reading.at(("environment", "robots"))
    several = (robots,) if isinstance(robots, int) and robots > 1 else ()
    found: dict[str, Shape] = {name: _shape(value, constants) for name, value in constants.items()}
    for block in ("world", "state", "sensors"):
        first: Shape = () if block == "world" else several
        for name, value in reading.mapping(("environment", block)).items():
            found[name] = (*first, *_shape(value, constants))
    return {name: shape for name, shape in found.items() if shape and name not in known}


def _shape(value: Data, constants: dict[str, Data]) -> Shape:
    if isinstance(value, list):
        return (len(value), *(_shape(value[0], constants) if value else ()))
    if not isinstance(value, str):
        return ()
    try:
        return _shape_of(parse(value), constants)
    except ExpressionError:
        return ()


def _shape_of(tree: Expr, constants: dict[str, Data]) -> Shape:
    match tree:
        case Call(function="list", arguments=(Generator(element=element, source=source),)):
            return (_length(source, constants), *_shape_of(element, constants))
        case Call(function="list", arguments=(first, *others)):
            return (1 + len(others), *_shape_of(first, constants))
        case Name(name=name) if isinstance(constants.get(name), list):
            return _shape(constants[name], {})
    return ()


def _length(source: Expr, constants: dict[str, Data]) -> int | None:
    match source:
        case Call(function="range", arguments=(Number(value=value),)):
            return int(value) if value.is_integer() else None
        case Call(function="range", arguments=(Name(name=name),)):
            length = constants.get(name)
            return length if isinstance(length, int) else None
        case Name(name=name):
            listed = constants.get(name)
            return len(listed) if isinstance(listed, list) else None
    return None
