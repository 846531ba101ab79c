"""From the parser's events to a tree of nodes, within bounds that hold with aliases expanded."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, NamedTuple

from yaml import MarkedYAMLError

from bbsd.errors import Correction, Diagnosis, character_name
from bbsd.text.core_schema import is_text, meaning
from bbsd.text.nodes import Alias, Mapping, Node, Scalar, Sequence
from bbsd.text.reading.events import Event, events
from bbsd.text.reading.mapping_keys import entries_of
from bbsd.text.reading.traps import NOTHING, Piece, comma_mistakes, empty_block_mistake, glued, join_at_commas
from bbsd.text.source import MAX_BYTES

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bbsd.text.source import Source

# The bounds keep a small hostile file, with its aliases expanded, from exhausting the machine.
MAX_NODES = 50_000  # keys and values
MAX_DEPTH = 40  # levels
MAX_TEXT = 10_000  # characters
CHARACTERS_OF_A_NODE = 1000  # a longer text counts as several values
LONG_KEYS = frozenset({"table"})  # keys whose texts may be as long as the file
MAX_NUMBER = 100  # characters
LEADING_ZERO = re.compile("[-+]?0[0-9]")
TOO_DEEP = f"this is nested more than {MAX_DEPTH} levels deep"
UNPRINTABLE = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\u2028\u2029\ud800-\udfff\ufffe\uffff]")
LINE_SEPARATORS = frozenset("\x85\u2028\u2029")  # new lines for the parser, and for nobody who reads the text


class _RefusedError(Exception):
    """A mistake after which reading cannot continue."""

    def __init__(self, diagnosis: Diagnosis) -> None:
        super().__init__(diagnosis)
        self.diagnosis = diagnosis


class _Anchored(NamedTuple):
    """A node that an anchor names."""

    node: Scalar | Sequence | Mapping
    size: int  # nodes, aliases expanded
    height: int  # levels below it, aliases expanded


@dataclass(slots=True)
class _Reading:
    """The state of reading one text: its events, the anchors and mistakes so far, and what counts for the bounds."""

    source: Source
    events: Iterator[Event]
    anchors: dict[str, _Anchored] = field(default_factory=dict)
    mistakes: list[Diagnosis] = field(default_factory=list)
    size: int = 0
    deepest: int = 0

    def diagnosis(self, code: str, message: str, event: Event, advice: str = "") -> Diagnosis:
        return Diagnosis(code, message, self.source.place(event.start, event.end), advice)

    def report(self, code: str, message: str, event: Event, advice: str = "") -> None:
        self.mistakes.append(self.diagnosis(code, message, event, advice))

    def count(self, event: Event, size: int, depth: int) -> None:
        self.size += size
        self.deepest = max(self.deepest, depth)
        if self.size > MAX_NODES:
            message = f"there are more than {MAX_NODES} keys and values, with aliases expanded"
            raise _RefusedError(self.diagnosis("BB011", message, event))
        if self.deepest > MAX_DEPTH:
            raise _RefusedError(self.diagnosis("BB012", TOO_DEEP, event))


def compose(source: Source) -> tuple[Mapping | None, list[Diagnosis]]:
    """Return the mapping that a text consists of, None if it is no mapping, and all its mistakes as YAML."""
    if match := UNPRINTABLE.search(source.text):
        return None, [_unprintable(source, match)]
    reading = _Reading(source, events(source.text))
    try:
        return _document(reading), reading.mistakes
    except _RefusedError as refused:
        return None, [*reading.mistakes, refused.diagnosis]
    except MarkedYAMLError as error:
        from bbsd.text.reading.syntax import explain_syntax_error

        last = _too_deep(source, error) or explain_syntax_error(source, error)
        return None, [*(mistake for mistake in reading.mistakes if not _same_start(mistake, last)), last]


def _unprintable(source: Source, match: re.Match[str]) -> Diagnosis:
    what = "hidden line break" if match[0] in LINE_SEPARATORS else "control character"
    message = f"the {what} {character_name(match[0])} cannot stand in a spec"
    return Diagnosis("BB003", message, source.place(match.start()))


def _too_deep(source: Source, error: MarkedYAMLError) -> Diagnosis | None:
    """Return the diagnosis if the parser gave up on the depth: PyYAML from 6.0.4 on may do so before our bound."""
    if "nesting depth" not in (error.problem or "") or error.problem_mark is None:
        return None
    return Diagnosis("BB012", TOO_DEEP, source.place(error.problem_mark.index))


def _same_start(one: Diagnosis, other: Diagnosis) -> bool:
    return (one.place.line, one.place.column) == (other.place.line, other.place.column)


def _document(reading: _Reading) -> Mapping:
    next(reading.events)  # the stream's start
    event = next(reading.events)
    if event.kind != "document":
        raise _RefusedError(Diagnosis("BB014", "the file says nothing", reading.source.place(0)))
    event = next(reading.events)
    root = _node(reading, event, 1)
    next(reading.events)  # the document's end
    if (more := next(reading.events)).kind == "document":
        reading.mistakes.append(_second_document(reading.source, more))
    if isinstance(root, Mapping):
        return root
    raise _RefusedError(_not_a_mapping(reading, root, event))


def _second_document(source: Source, event: Event) -> Diagnosis:
    """Return the mistake of a second document: another spec, or the rest of this one, which a line cuts off."""
    place, rest = source.place(event.start, event.end), source.text[event.start :]
    if not rest.startswith("---"):
        return Diagnosis("BB015", "a second document begins here", place, "give each spec a file of its own")
    message = '"---" begins a second document, and a spec is one'
    if re.search(r"^bbsd *:", rest, re.MULTILINE):
        return Diagnosis("BB015", message, place, "give what follows a file of its own")
    advice = "remove this line (or, if what follows is another spec, give it a file of its own)"
    line, line_break, _ = rest.partition("\n")
    if line.strip() != "---" or not line_break:
        return Diagnosis("BB015", message, place, advice)
    edit = source.edit(event.start, event.start + len(line) + 1, "")
    return Diagnosis("BB015", message, place, advice, Correction((edit,), is_certain=False))


def _not_a_mapping(reading: _Reading, root: Node, event: Event) -> Diagnosis:
    if isinstance(root, Scalar) and root.is_plain and (diagnosis := glued(reading.source, root.start)):
        return diagnosis
    what = "a list" if isinstance(root, Sequence) else "a single value"
    return reading.diagnosis("BB014", f"a spec is a mapping of keys to values, not {what}", event)


def _node(reading: _Reading, event: Event, depth: int, longest: int = MAX_TEXT) -> Node:
    if event.kind == "alias":
        return _alias(reading, event, depth, longest)
    reading.count(event, _size(event), depth)
    if event.tag is not None:
        reading.mistakes.append(_tag(reading.source, event, event.tag))
    if event.anchor is None:
        return _unanchored(reading, event, depth, longest)
    return _anchored(reading, event, event.anchor, depth, longest)


NEGATED = re.compile(
    r"!\s*(?=[a-z_(][\w.()\[\]]*[ \t]*(?:$|#|and\b|or\b|if\b|[-+*/%<>=!&|?)]))", re.MULTILINE
)
"""The sign of `!docked` and of what may follow it in an expression."""


def _tag(source: Source, event: Event, tag: str) -> Diagnosis:
    """Return the mistake of a tag, which where it looks like `!docked` is the sign of other languages for not."""
    place, match = source.place(event.start, event.end), NEGATED.match(source.text, event.start)
    if match is None:
        advice = "remove it; if an expression is meant, write not ..."
        return Diagnosis("BB009", f'a spec has no tags such as "{tag}"', place, advice)
    sign = source.place(event.start, event.start + 1)
    correction = Correction((source.edit(event.start, match.end(), "not "),))
    advice = f'write not (for YAML, "{tag}" is a tag)'
    return Diagnosis("BB009", 'there is no "!" in expressions', sign, advice, correction)


def _unanchored(reading: _Reading, event: Event, depth: int, longest: int) -> Scalar | Sequence | Mapping:
    match event.kind:
        case "scalar":
            return _scalar(reading, event, longest)
        case "list":
            return _sequence(reading, event, depth)
        case _:
            return _mapping(reading, event, depth)


def _anchored(reading: _Reading, event: Event, anchor: str, depth: int, longest: int) -> Node:
    size, deepest = reading.size - _size(event), reading.deepest
    reading.anchors.pop(
        anchor, None
    )  # within the node its name is unknown, also where it named an older node
    reading.deepest = depth
    node = _unanchored(reading, event, depth, longest)
    reading.anchors[anchor] = _Anchored(node, reading.size - size, reading.deepest - depth)
    reading.deepest = max(deepest, reading.deepest)
    return node


def _size(event: Event) -> int:
    return 1 + len(event.text) // CHARACTERS_OF_A_NODE


def _alias(reading: _Reading, event: Event, depth: int, longest: int) -> Node:
    name = reading.source.text[event.start + 1 : event.end]
    anchored = reading.anchors.get(name)
    if anchored is None:
        advice = "put the value in quotes, if an expression is meant"
        reading.report("BB010", f'no value before this one is marked with "&{name}"', event, advice)
        return Scalar(event.start, event.end, "", f"*{name}", f"*{name}")
    reading.count(event, anchored.size, depth + anchored.height)
    if isinstance(anchored.node, Scalar) and len(anchored.node.text) > longest:
        return _shortened(reading, anchored.node, event, longest)
    return Alias(event.start, event.end, anchored.node)


def _shortened(reading: _Reading, node: Scalar, event: Event, longest: int) -> Scalar:
    """Return a copy of a scalar for an alias that stands where so long a text is not allowed."""
    text = _cut(reading, node.text, event, longest)
    return Scalar(event.start, event.end, "*", text, text)


def _scalar(reading: _Reading, event: Event, longest: int) -> Scalar:
    text = _cut(reading, event.text, event, longest)
    data = text if event.style or event.tag else _meaning(reading, event, text, longest)
    scalar = Scalar(event.start, event.end, event.style, text, data)
    if diagnosis := empty_block_mistake(reading.source, scalar):
        reading.mistakes.append(diagnosis)
    return scalar


def _cut(reading: _Reading, text: str, event: Event, longest: int) -> str:
    """Return a text, one that is too long cut, so that its aliases cannot multiply it."""
    if len(text) > longest:
        message = f"a text of {len(text)} characters; the longest may have {longest}"
        reading.report("BB013", message, event)
    return text[:longest]


def _meaning(reading: _Reading, event: Event, text: str, longest: int) -> str | int | float | bool | None:
    if len(text) <= MAX_NUMBER:
        value = meaning(text)
        is_table = longest > MAX_TEXT  # told of where tables are read: it needs quotes, whatever it is
        if LEADING_ZERO.match(text) and not isinstance(value, str) and not is_table:
            plain = re.sub("0+(?=[0-9])", "", text, count=1)
            octal = f", or 0o{plain} if octal is meant" if re.fullmatch("[0-7]+", plain) else ""
            reading.report("BB125", "a number does not begin with a zero", event, f"write {plain}{octal}")
        return value
    if not is_text(text):
        message = f"a number of {len(text)} characters; the longest may have {MAX_NUMBER}"
        reading.report("BB013", message, event, "put it in quotes, if a text is meant")
    return text


def _sequence(reading: _Reading, event: Event, depth: int) -> Sequence:
    pieces: list[Piece] = []
    while (item := next(reading.events)).kind != "end":
        pieces.append((_node(reading, item, depth + 1), NOTHING))
    items = tuple(node for node, _ in _rejoined(reading, event, pieces))
    return Sequence(event.start, item.end if event.flow else items[-1].end, event.flow, items)


def _mapping(reading: _Reading, event: Event, depth: int) -> Mapping:
    pieces: list[Piece] = []
    while (item := next(reading.events)).kind != "end":
        key = _node(reading, item, depth + 1)
        pieces.append((key, _node(reading, next(reading.events), depth + 1, _longest(key))))
    # The parser's own end of a block lies behind the comments that follow it.
    end = item.end if event.flow else pieces[-1][1].end
    entries, mistakes = entries_of(reading.source, _rejoined(reading, event, pieces), event.flow)
    reading.mistakes += mistakes
    return Mapping(event.start, end, event.flow, entries)


def _longest(key: Node) -> int:
    """Return the greatest length of a text under a key."""
    return MAX_BYTES if isinstance(key, Scalar) and key.text in LONG_KEYS else MAX_TEXT


def _rejoined(reading: _Reading, event: Event, pieces: list[Piece]) -> list[Piece]:
    """Return the pieces of a collection; those in brackets rejoined where a comma between parentheses cut them."""
    if not event.flow:
        return pieces
    rejoined, joined = join_at_commas(reading.source.text, pieces)
    reading.mistakes += comma_mistakes(reading.source, joined)
    return rejoined
