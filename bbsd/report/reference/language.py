"""The parts of the language's reference that are generated from the code: keys, functions, words, mistakes, warnings.

`docs/language.md` holds them between marks; a test compares them, and updates them with --update-golden.
"""

from __future__ import annotations

import re
from inspect import getdoc
from types import UnionType
from typing import TYPE_CHECKING, Annotated, Any, Literal, Union, get_args, get_origin

from pydantic_core import PydanticUndefined

from bbsd.errors import Severity
from bbsd.errors.catalog import KINDS
from bbsd.expression.reserved import RESERVED, Use
from bbsd.expression.vocabulary import AGGREGATES, DRAWS, FUNCTIONS
from bbsd.language import design, models, outside, view
from bbsd.language.base import Part
from bbsd.language.field_types import Expression

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from pydantic.fields import FieldInfo

BLOCKS: Mapping[str, tuple[type[Part], ...]] = {
    "The top level": (models.Spec,),
    "environment": (models.Environment,),
    "behaviors": (models.Behavior,),
    "rules": (models.When, models.Otherwise),
    "view": (view.View,),
    "design": (design.Design,),
    "design.stop": (design.Stop,),
    "design.coevolution": (design.Coevolution,),
    "design.learning": (design.Learning,),
    "design.culture": (design.CultureSettings,),
    "design.answer": (design.Answer,),
}
"""Headings, with the models that are described under each."""

RESERVED_FOR = (
    ("anything", Use.ANY, None),
    ("behaviors", Use.BEHAVIOR, Use.ANY),
    ("actions", Use.ACTION, Use.ANY),
    ("what expressions use", Use.VALUE, Use.ANY),
    ("definitions with parameters", Use.FUNCTION, Use.VALUE),
)
"""What names are for, in the order of the reference; each with what it has in common with others."""

MARKED = re.compile(r"(<!-- generated: (\w+) -->\n).*?(<!-- end -->)", re.DOTALL)


def regenerate(document: str) -> str:
    """Return a document with the text between its marks generated again; KeyError for an unknown mark."""
    return MARKED.sub(lambda match: f"{match[1]}\n{SECTIONS[match[2]]()}\n{match[3]}", document)


def keys_text() -> str:
    """Return tables of all keys of a spec, block by block."""
    return "\n".join(_block_text(title, parts) for title, parts in BLOCKS.items())


def functions_text() -> str:
    """Return a table of the functions of numbers."""
    rows = ((f"`{name}`", str(function.arity), function.meaning) for name, function in FUNCTIONS.items())
    return _table(("function", "arguments", "value"), rows)


def aggregates_text() -> str:
    """Return a table of the aggregates, which make one value of several."""
    return _table(("aggregate", "value"), ((f"`{name}`", meaning) for name, meaning in AGGREGATES.items()))


def draws_text() -> str:
    """Return a table of the random draws."""
    rows = ((f"`{name}`", str(arity), meaning) for name, (arity, meaning) in DRAWS.items())
    return _table(("draw", "arguments", "value"), rows)


def reserved_text() -> str:
    """Return a table of the words that cannot be names, by the things that they cannot name, and why."""
    rows: list[tuple[str, str, str]] = []
    for things, uses, beside in RESERVED_FOR:
        words = RESERVED[uses].items() - (RESERVED[beside].items() if beside else ())
        by_reason: dict[str, list[str]] = {}
        for word, reason in sorted(words):
            by_reason.setdefault(reason.replace(f"{word}(...)", "it"), []).append(f"`{word}`")
        rows += [(things, " ".join(taken), reason) for reason, taken in by_reason.items()]
    return _table(("names of", "cannot be", "as"), rows)


def mistakes_text() -> str:
    """Return a table of the codes of mistakes."""
    return _kinds_text("mistake", Severity.MISTAKE)


def warnings_text() -> str:
    """Return a table of the codes of warnings."""
    return _kinds_text("warning", Severity.WARNING)


def _kinds_text(word: str, severity: Severity) -> str:
    kinds = (kind for kind in KINDS.values() if kind.severity is severity)
    return _table(("code", word), ((kind.code, _cell(kind.title)) for kind in kinds))


SECTIONS: Mapping[str, Callable[[], str]] = {
    "keys": keys_text,
    "functions": functions_text,
    "aggregates": aggregates_text,
    "draws": draws_text,
    "reserved": reserved_text,
    "mistakes": mistakes_text,
    "warnings": warnings_text,
}


def _block_text(title: str, parts: Iterable[type[Part]]) -> str:
    sections = [f"### {title}\n"]
    for part in parts:
        rows = (
            (f"`{name}`", _kind(field.annotation) + _bounds(field), _default(field), field.description or "")
            for name, field in part.fields_by_key().items()
        )
        table = _table(("key", "value", "default", "meaning"), (map(_cell, row) for row in rows))
        sections.append(f"{getdoc(part)}\n\n{table}")
    return "\n".join(sections)


def _table(head: Iterable[str], rows: Iterable[Iterable[str]]) -> str:
    lines = [list(head)]
    lines += [["---"] * len(lines[0]), *(list(row) for row in rows)]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def _cell(text: str) -> str:
    return text.replace("|", "\\|")


def _kind(annotation: Any) -> str:  # noqa: ANN401 - a type, of any kind
    """Return the kind of value that a key takes, in the words of the language."""
    origin, arguments = get_origin(annotation), get_args(annotation)
    if annotation == models.PartitionText:
        return "partition"
    if annotation == outside.ArgumentText:
        return "plain data"
    if origin is Annotated:
        return _kind(arguments[0])
    if origin is Literal:
        return " or ".join(f"`{argument}`" for argument in arguments)
    if origin is dict:
        return f"NAME: {_kind(arguments[1])}"
    if origin is list:
        return f"list of {_kind(arguments[0])}s"
    if origin in (Union, UnionType):
        kinds = [_kind(argument) for argument in arguments if argument is not type(None)]
        return ", or ".join(dict.fromkeys(kinds))
    if isinstance(annotation, type) and issubclass(annotation, Part):
        return "block"
    return KIND_NAMES[annotation]


KIND_NAMES: Mapping[Any, str] = {
    Any: "expression or table",
    Expression: "expression",
    float: "number",
    int: "whole number",
    str: "text",
}


def _bounds(field: FieldInfo) -> str:
    """Return the least and the greatest number that a key takes, or ""."""
    low, high = (
        next((getattr(rule, name) for rule in field.metadata if hasattr(rule, name)), None)
        for name in ("ge", "le")
    )
    if low is None:
        return ""
    return f", at least {low:,}" if high is None else f", {low:,} to {high:,}"


def _default(field: FieldInfo) -> str:
    match field.default:
        case _ if field.default is PydanticUndefined:
            return "required"
        case None | "" | Part() | {}:
            return ""
        case Expression(text=text):
            return f"`{text}`"
        case float() | int() as number:
            return f"{number:,}"
        case text:
            return f"`{text}`"
