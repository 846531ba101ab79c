"""What the keys of an action name: state, or an element of a state that is a list, `waiting[floor]`."""

from __future__ import annotations

import re
from dataclasses import replace
from functools import lru_cache
from itertools import product
from typing import TYPE_CHECKING, NamedTuple

from bbsd.expression.elaboration import elaboration
from bbsd.expression.elaboration.lookup import is_plain_number
from bbsd.expression.graph import value_of
from bbsd.expression.kinds import Kind
from bbsd.expression.scope import Draws, Named
from bbsd.expression.syntax.mistakes import KEY, ExpressionError, Mistake, Rewriting, in_key
from bbsd.expression.syntax.parsing import parse
from bbsd.expression.syntax.tree import Expr, Index, Name, with_spans
from bbsd.kernel.functions import clamp_index

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from bbsd.expression.graph import Graph, Node
    from bbsd.expression.scope import Scope, Value
    from bbsd.language.meaning.forms import Form


class Target(NamedTuple):
    """What a key of an action names: state, and the indices of the element that is set, none for all of it."""

    name: str
    indices: tuple[Expr, ...] = ()


CALLED = re.compile(r"([a-z]\w*)\(([\w, ]+)\)")
"""A key that names an element as in MATLAB: `grid(y, x)`."""


@lru_cache(maxsize=1024)
def read_target(key: str) -> Target | Mistake:
    """Return what a key of an action names, or what is wrong with it; its spans count characters of the key."""
    if called := CALLED.fullmatch(key):
        new = called[1] + "".join(f"[{index.strip()}]" for index in called[2].split(","))
        return Mistake(
            "BB134",
            f"an element is set as name[index], not as {key}",
            KEY,
            f"write {new}",
            Rewriting(new, KEY),
        )
    if "[" not in key:
        return Target(key)
    try:
        tree = parse(key)
    except ExpressionError as error:
        from bbsd.expression.foreign.translating import translated

        mistake = translated(key, error.mistake)
        correction = mistake.correction
        if isinstance(correction, Rewriting):
            correction = correction._replace(span=in_key(correction.span))
        return mistake._replace(span=in_key(mistake.span), correction=correction)
    tree, indices = with_spans(tree, in_key), list[Expr]()
    while isinstance(tree, Index):
        indices.insert(0, tree.index)
        tree = tree.of
    if isinstance(tree, Name):
        return Target(tree.name, tuple(indices))
    return Mistake(
        "BB134", "only state, and an element of state, can be set", KEY, "write name[index]: value"
    )


def target_name(key: str) -> str:
    """Return the name of what a key of an action sets, without indices."""
    return key.partition("[")[0].strip()


def indices_of(target: Target, form: Form, scope: Scope) -> tuple[Node, ...] | None:
    """Return the values of a target's indices for the scope's robot; None after a mistake.

    What the k-th index draws, counted from 0, has the place of the key and [k] behind it.
    """
    if form.kind is Kind.UNKNOWN and not form.lengths:
        return None
    if len(target.indices) > len(form.lengths):
        fitting = f"{target.name}{'[...]' * len(form.lengths)}"
        message = f"{target.name} is {form.text}, which the key has too many indices for"
        scope.mistake("BB134", message, KEY, f"write {fitting}: ...")
        return None
    nodes = [
        _index(index, number, length, scope)
        for number, (index, length) in enumerate(zip(target.indices, form.lengths, strict=False))
    ]
    return None if any(node.kind is Kind.UNKNOWN for node in nodes) else tuple(nodes)


def _index(index: Expr, number: int, length: int, scope: Scope) -> Node:
    draws = scope.draws and Draws(f"{scope.draws.place}[{number}]")
    node = elaboration.whole(index, replace(scope, draws=draws), "an index")
    if is_plain_number(index) and not 0 <= value_of(node) < length:
        message = f"there is no element {value_of(node):g}; the {length} count from 0 to {length - 1}"
        return scope.mistake("BB134", message, index.span)
    return node


def places_set(form: Form, indices: Sequence[Node]) -> Iterator[tuple[int, ...]]:
    """Yield the places of the scalars that setting an element may change: at an index that is not known, of all."""
    wanted = [*indices, *[None] * (len(form.lengths) - len(indices))]
    return product(
        *(
            range(length)
            if index is None or not index.literal
            else (clamp_index(value_of(index), length - 1),)
            for index, length in zip(wanted, form.lengths, strict=True)
        )
    )


def with_element(items: Value, indices: Sequence[Node], new: Value, graph: Graph) -> Value:
    """Return a list with another element at some indices, each clamped to its length."""
    return _replaced(items, indices, new, graph.truth(value=True), graph)


def _replaced(old: Value, indices: Sequence[Node], new: Value, hit: Node, graph: Graph) -> Value:
    """Return the new value where the element is `hit`, else the old one."""
    if isinstance(old, tuple) and indices:
        index, *further = indices
        last = len(old) - 1
        if index.literal or not last:
            place = clamp_index(value_of(index), last) if last else 0
            inner = _replaced(old[place], further, new, hit, graph)
            return (*old[:place], inner, *old[place + 1 :])
        return tuple(
            _replaced(item, further, new, graph.apply("&", hit, _is_at(index, place, last, graph)), graph)
            for place, item in enumerate(old)
        )
    if isinstance(old, tuple) and isinstance(new, tuple):
        return tuple(_replaced(one, (), other, hit, graph) for one, other in zip(old, new, strict=True))
    if isinstance(old, tuple) or isinstance(new, tuple):
        raise TypeError("what is set has another form")
    if isinstance(old, Named) and isinstance(new, Named):
        return Named(((old.names, graph.apply("select", hit, new.node, old.node)),))
    if isinstance(old, Named) or isinstance(new, Named):
        return graph.unknown
    return graph.apply("select", hit, new, old)


def _is_at(index: Node, place: int, last: int, graph: Graph) -> Node:
    """Return whether a whole number, clamped to the range, is a place; NaN is the first one."""
    if place == 0:
        return graph.apply("not", graph.apply(">=", index, graph.number(1)))
    return graph.apply(">=" if place == last else "==", index, graph.number(place))


def certainly_meet(one: Sequence[Node], other: Sequence[Node]) -> bool:
    """Return whether elements at these indices are the same, or one is in the other, whatever the indices are."""
    return all(left is right for left, right in zip(one, other, strict=False))
