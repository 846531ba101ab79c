"""All expressions of a spec's data that can be read, and what in them is used as an index."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

from bbsd.expression.syntax.mistakes import ExpressionError
from bbsd.expression.syntax.parsing import parse
from bbsd.expression.syntax.tree import (
    Binary,
    Call,
    Conditional,
    Expr,
    Index,
    Name,
    Number,
    Unary,
    names_used,
    parts,
)
from bbsd.language.field_types import scalar_text, signature

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from bbsd.expression.scope import Path
    from bbsd.language.meant.reading import Reading
    from bbsd.text import Data

ENVIRONMENT = ("state", "world", "dynamics", "definitions", "sensors", "ends")
OF_BEHAVIORS = ("excited", "expects", "inputs", "actions")
STORED: tuple[Path, ...] = (("environment", "state"), ("environment", "world"))
CHANGES: Path = ("environment", "dynamics")
DEFINITIONS: Path = ("environment", "definitions")
MAX_TREES = 4_096
"""Texts whose trees are kept from one reading to the next."""
MAX_TEXT = 2_000
"""Characters of an expression up to which it is looked into."""


def parsed(value: Data) -> Expr | None:
    """Return the tree of a value that is an expression; None for anything else."""
    text = scalar_text(value)
    return None if text is None or len(text) > MAX_TEXT else _tree(text)


@lru_cache(maxsize=MAX_TREES)
def _tree(text: str) -> Expr | None:
    try:
        return parse(text)
    except ExpressionError:
        return None


def trees_of_behaviors(reading: Reading) -> Iterator[tuple[Path, Expr]]:
    """Yield the expressions of all behaviors with their paths."""
    for behavior in reading.mapping(("behaviors",)):
        for key in OF_BEHAVIORS:
            path: Path = ("behaviors", behavior, key)
            value = reading.at(path)
            if not isinstance(value, list):
                yield from _below(path, value)


def trees(reading: Reading) -> Iterator[tuple[Path, Expr]]:
    """Yield the expressions of what is computed in a step, and of behaviors, with their paths."""
    for key in ENVIRONMENT:
        path: Path = ("environment", key)
        yield from _below(path, reading.at(path))
    for block in ("reward", "expects"):
        yield from _below((block,), reading.at((block,)))
    yield from trees_of_behaviors(reading)


def _below(path: Path, value: Data) -> Iterator[tuple[Path, Expr]]:
    if isinstance(value, dict):
        for key, inner in value.items():
            yield from _below((*path, key), inner)
    elif value is not None and (tree := parsed(value)) is not None:
        yield path, tree


def effects(reading: Reading) -> dict[str, list[tuple[Path, Expr | None]]]:
    """Return what dynamics and actions set values or elements of them to, None where that cannot be read."""
    blocks: list[Path] = [CHANGES]
    for behavior in reading.mapping(("behaviors",)):
        actions: Path = ("behaviors", behavior, "actions")
        blocks += [(*actions, action) for action in reading.mapping(actions)]
    found: dict[str, list[tuple[Path, Expr | None]]] = {}
    for block in blocks:
        for key, value in reading.mapping(block).items():
            found.setdefault(key.partition("[")[0].strip(), []).append(((*block, key), parsed(value)))
    return found


def by_name(found: Iterable[tuple[Path, Expr]]) -> dict[str, list[tuple[Path, Expr]]]:
    """Return for each name the expressions that use it, with their paths."""
    users: dict[str, list[tuple[Path, Expr]]] = {}
    for path, tree in found:
        for name in names_used(tree):
            users.setdefault(name, []).append((path, tree))
    return users


def within(tree: Expr) -> Iterator[Expr]:
    """Yield an expression and all its parts."""
    yield tree
    for part in parts(tree):
        yield from within(part)


def indices(reading: Reading, found: list[tuple[Path, Expr]]) -> Iterator[tuple[Path, Expr, Expr | None]]:
    """Yield what stands as an index, with its path and what is indexed: in expressions, keys of actions and calls.

    An argument of a definition stands as an index where its parameter does; of it, None is indexed.
    """
    indexing: dict[str, set[int]] = {}
    for key in reading.mapping(DEFINITIONS):
        name, *parameters = signature(key) or ("",)
        tree = parsed(reading.at((*DEFINITIONS, key)))
        used = [each.index for each in within(tree) if isinstance(each, Index)] if tree and parameters else []
        names = {own for each in used for own in names_unrounded(each)}
        indexing[name] = {place for place, own in enumerate(parameters) if own in names}
    for path, tree in found:
        own = [*within(tree)]
        key_at = path[-1]
        if isinstance(key_at, str) and "[" in key_at and (target := parsed(key_at)) is not None:
            own += within(target)
        for part in own:
            if isinstance(part, Index):
                yield path, part.index, part.of
            elif isinstance(part, Call) and part.function in indexing:
                for place in sorted(indexing[part.function]):
                    if place < len(part.arguments):
                        yield path, part.arguments[place], None


def names_unrounded(tree: Expr) -> frozenset[str]:
    """Return the names of which an expression is a sum, or nothing else: whole only where they are."""
    match tree:
        case Name(name=name):
            return frozenset({name})
        case Binary(operator="+" | "-", left=left, right=right):
            return names_unrounded(left) | names_unrounded(right)
        case Unary(operator="-", operand=operand):
            return names_unrounded(operand)
    return frozenset()


FROM_PARTS = ("min", "max", "abs", "clip")
"""Functions whose values are whole where all their arguments are."""
FRACTIONAL = ("uniform", "normal", "sqrt", "sin", "cos", "exp", "hypot", "atan2")


def is_fraction(tree: Expr | None, fractions: frozenset[str]) -> bool:
    """Return whether a value certainly cannot be proven to be whole, where the given names cannot."""
    match tree:
        case Number(value=value):
            return not value.is_integer()
        case Name(name=name):
            return name in fractions
        case Unary(operator="-" | "+", operand=operand):
            return is_fraction(operand, fractions)
        case Binary(operator="/", left=Number(value=left), right=Number(value=right)):
            return right == 0 or not (left / right).is_integer()
        case Binary(operator="/", left=left, right=right):
            return not isinstance(right, Number) or right.value != 1 or is_fraction(left, fractions)
        case Binary(operator="+" | "-" | "*" | "%", left=left, right=right):
            return is_fraction(left, fractions) or is_fraction(right, fractions)
        case Conditional(then=then, otherwise=otherwise):
            return is_fraction(then, fractions) or is_fraction(otherwise, fractions)
        case Call(function=function) if function in FRACTIONAL:
            return True
        case Call(function=function, arguments=arguments) if function in FROM_PARTS:
            return any(is_fraction(each, fractions) for each in arguments)
    return False


def unknown_names(tree: Expr, known: set[str]) -> list[str]:
    """Return the names of an expression that nothing has, in the order in which they are written."""
    unknown = names_used(tree) - known
    written = [part for part in within(tree) if isinstance(part, Name) and part.name in unknown]
    return [*dict.fromkeys(part.name for part in sorted(written, key=lambda part: part.span.start))]
