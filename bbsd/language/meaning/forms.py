"""The form of a stored value: a number, a truth, or a list whose lengths stay as they are at the start."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from bbsd.expression.elaboration.checks import require_kind
from bbsd.expression.elaboration.naming import settled
from bbsd.expression.kinds import Kind
from bbsd.expression.scope import Named

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bbsd.expression.graph import Graph, Node
    from bbsd.expression.scope import Names, Scope, Value
    from bbsd.expression.syntax.tree import Span

PLURAL = {Kind.NUMBER: "numbers", Kind.TRUTH: "truths", Kind.NAMED: "named values"}


@dataclass(frozen=True, slots=True)
class Form:
    """What a stored value is; all robots' values of one name are of one form."""

    kind: Kind
    """The kind of the value, or of all elements of a list."""
    lengths: tuple[int, ...] = ()
    """The length of a list, then of the lists in it, and so on; none for a single value."""
    names: Names = ()
    """What the value, or each element, is one of; empty where these have no names."""

    @property
    def element(self) -> Form:
        """The form of a list's elements."""
        return replace(self, lengths=self.lengths[1:])

    @property
    def text(self) -> str:
        """What a message calls a value of this form: `a list of 9 lists of 9 truths`."""
        if not self.lengths:
            return self.kind.value
        return f"a list of {' lists of '.join(map(str, self.lengths))}{_of_what(self.kind, self.lengths[-1])}"

    @property
    def example(self) -> str:
        """How a value of this form is written."""
        element = self.names[0] if self.names else "false" if self.kind is Kind.TRUTH else "0"
        for name, length in zip("kji"[-len(self.lengths) :], reversed(self.lengths), strict=False):
            element = f"list({element} for {name} in range({length}))"
        return element

    def unknown(self, graph: Graph) -> Value:
        """Return a value of this form that could not be understood."""
        if not self.lengths:
            return graph.unknown
        return (self.element.unknown(graph),) * self.lengths[0]


def _of_what(kind: Kind, count: int) -> str:
    word = PLURAL.get(kind, "")
    return f" {word.removesuffix('s') if count == 1 else word}" if word else ""


def form_of(value: Value) -> Form | None:
    """Return the form of a value; None where its lists are empty, differ in length, or mix numbers and truths."""
    if isinstance(value, Named):
        return Form(Kind.NAMED, names=value.names)
    if not isinstance(value, tuple):
        return Form(value.kind)
    forms = [form_of(item) for item in value]
    known = {form for form in forms if form is not None}
    lengths, kinds = {form.lengths for form in known}, {(form.kind, form.names) for form in known}
    kinds.discard((Kind.UNKNOWN, ()))
    if len(lengths) != 1 or len(kinds) > 1 or None in forms:
        return None
    kind, names = kinds.pop() if kinds else (Kind.UNKNOWN, ())
    return Form(kind, (len(value), *lengths.pop()), names)


def regular(value: Value, span: Span, scope: Scope) -> Value:
    """Return a starting value; report a list that has no form, and return the unknown value instead."""
    if form_of(value) is not None:
        return value
    if any(not isinstance(item, tuple) and item.kind is Kind.UNKNOWN for item in _all_items(value)):
        return scope.graph.unknown
    if not all(map(_is_filled, _all_items(value))):
        message, advice = "a list without elements holds nothing", "give it one or more"
    elif len({item.kind for item in _all_items(value) if not isinstance(item, tuple)}) > 1:
        message, advice = "values of different kinds in one list", "keep them in two lists"
    else:
        message = "lists of different lengths, or single values beside lists, in one list"
        advice = "let all lists in a list be of one length"
    return scope.mistake("BB133", message, span, advice)


def _is_filled(value: Value) -> bool:
    return not isinstance(value, tuple) or bool(value)


def _all_items(value: Value) -> Iterator[Value]:
    yield value
    if isinstance(value, tuple):
        for item in value:
            yield from _all_items(item)


def fitted(value: Value, form: Form, name: str, span: Span, scope: Scope, instead: str = "") -> Value:
    """Return a value to be stored under a name of this form; report one of another form, and make it unknown.

    `instead` is what else could be written where the name is a list and the value is not.
    """
    if not form.lengths and form.kind is Kind.UNKNOWN:
        return scope.graph.unknown if isinstance(value, tuple) else value
    if not isinstance(value, tuple) and value.kind is Kind.UNKNOWN:
        return form.unknown(scope.graph)
    if not form.lengths and not isinstance(value, tuple):
        return _of_form(value, form, name, span, scope)
    if _lengths(value) != form.lengths:
        message = f"{name} is {form.text}, and this is {_text_of(value)}"
        advice = f"write {form.example}{instead}" if form.lengths else "take an element or an aggregate of it"
        scope.mistake("BB132", message, span, advice)
        return form.unknown(scope.graph)
    return _of_form(value, form, name, span, scope)


def _of_form(value: Value, form: Form, name: str, span: Span, scope: Scope) -> Value:
    if isinstance(value, tuple):
        return tuple(_of_form(item, form, name, span, scope) for item in value)
    if form.names:
        return settled(value, name, form.names, span, scope)
    return value if form.kind is Kind.UNKNOWN else require_kind(value, form.kind, span, scope)


def _lengths(value: Value) -> tuple[int, ...] | None:
    """Return the lengths of nested lists, () for a single value; None where they differ."""
    if not isinstance(value, tuple):
        return ()
    inner = {_lengths(item) for item in value}
    (lengths,) = inner if len(inner) == 1 else (None,)
    return None if lengths is None else (len(value), *lengths)


def _text_of(value: Value) -> str:
    form = form_of(value)
    return "a list of lists of different lengths" if form is None else form.text


def scalars_of(value: Value, place: tuple[int, ...] = ()) -> Iterator[tuple[tuple[int, ...], Node]]:
    """Yield the scalars of a value, each with its place in the list."""
    if isinstance(value, tuple):
        for index, item in enumerate(value):
            yield from scalars_of(item, (*place, index))
    else:
        yield place, value.node if isinstance(value, Named) else value


def with_scalar(value: Value, place: tuple[int, ...], scalar: Node) -> Value:
    """Return a value with another scalar at a place in the list."""
    if not isinstance(value, tuple):
        return scalar
    index, *rest = place
    return (*value[:index], with_scalar(value[index], tuple(rest), scalar), *value[index + 1 :])
