"""State and world that start as something else than they are used as: numbers for truths, fractions for indices."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.syntax.mistakes import WHOLE, Rewriting
from bbsd.expression.syntax.text import render
from bbsd.expression.syntax.tree import (
    Binary,
    Call,
    Comparison,
    Conditional,
    Expr,
    Generator,
    Index,
    Logical,
    Name,
    Number,
    Truth,
    Unary,
    parts,
)
from bbsd.language.meant.declared.trees import (
    CHANGES,
    STORED,
    by_name,
    effects,
    indices,
    is_fraction,
    names_unrounded,
    parsed,
    trees,
)
from bbsd.language.meant.edits.layout import correction
from bbsd.text.nodes import Scalar

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from bbsd.expression.scope import Path
    from bbsd.language.meant.reading import Reading

MOST_SHOWN = 6
"""Uses whose lines are told."""
OF_TRUTHS = ("chance", "any", "all")


def fractions_as_indices(reading: Reading) -> None:
    """Read what is used as an index, and starts as or is set to a fraction, as a whole number."""
    starts = {
        (*block, name): parsed(value) for block in STORED for name, value in reading.mapping(block).items()
    }
    constants = {name: parsed(value) for name, value in reading.mapping(("constants",)).items()}
    fractions = frozenset(name for name, tree in constants.items() if is_fraction(tree, frozenset()))
    uses: dict[str, list[Path]] = {}
    for path, index, _ in indices(reading, [*trees(reading)]):
        for name in names_unrounded(index):
            uses.setdefault(name, []).append(path)
    indexing = {path: start for path, start in starts.items() if path[-1] in uses}
    if not indexing:
        return
    own = {
        str(path[-1])
        for path, tree in starts.items()
        if path not in indexing and is_fraction(tree, fractions)
    }
    set_to, fractions = effects(reading), fractions | own
    for path, start in indexing.items():
        name, wrong = str(path[-1]), [(path, start)] if is_fraction(start, fractions) else []
        wrong += [(at, tree) for at, tree in set_to.get(name, ()) if is_fraction(tree, fractions)]
        if not wrong or any(tree is None for _, tree in wrong):
            continue
        (where, first), new = wrong[0], None
        advice = f"let {name} stay whole, or write floor({name}) where it is an index"
        if len(wrong) == 1 and isinstance(start, Call) and start.function == "uniform" and where == path:
            ends = [render(each) for each in start.arguments]
            is_between_whole = not any(is_fraction(each, fractions) for each in start.arguments)
            new = f"integers({', '.join(ends)})" if is_between_whole else f"round({render(start)})"
            advice = f"write {name}: {new}"
        message = (
            f"{render(first) if first else name} need not be a whole number, and {name} is used as an index"
        )
        written = None if new is None else Rewriting(new, WHOLE, is_certain=False)
        seen = tuple(map(reading.origin, dict.fromkeys(uses[name])))[:MOST_SHOWN]
        reading.tell(where, "BB064", message, advice, written, WHOLE, seen)
        for at, tree in wrong:
            reading.set(at, new or f"round({render(tree)})" if tree else "0")


def truths_as_numbers(reading: Reading) -> None:
    """Read a value that starts as 0 or 1 as a truth where it is one everywhere else, and the reverse."""
    starts = [
        ((*block, name), start)
        for block in STORED
        for name, value in reading.mapping(block).items()
        if isinstance(start := _element(parsed(value)), Number | Truth) and start.value in (0, 1)
    ]
    if not starts:
        return
    set_to, users, inputs = effects(reading), by_name(trees(reading)), _inputs(reading)
    for path, start in starts:
        name = str(path[-1])
        sets, other = set_to.get(name, []), "truth" if isinstance(start, Number) else "number"
        uses = [*_uses(users.get(name, ()), name), *((where, "truth") for where in inputs.get(name, ()))]
        kinds = {_kind(tree) for _, tree in sets}
        used = [where for where, kind in uses if kind == other]
        if not sets or len(used) < sum(kind != "" for _, kind in uses):
            continue
        if kinds == {other} and (used or any(where[:2] == CHANGES for where, _ in sets)):
            _tell(reading, path, start, [where for where, _ in sets], [])
        elif other == "truth" and all(_is_bit(tree) for _, tree in sets):
            used = [where for where in used if where[-1] != "inputs"]
            if used:
                _tell(reading, path, start, used, [where for where, _ in sets])


def _tell(reading: Reading, path: Path, start: Number | Truth, seen: list[Path], changed: list[Path]) -> None:
    """Tell that a value starts as the wrong kind; what `changed` sets to 0 or 1 becomes a truth too."""
    name, is_number = path[-1], isinstance(start, Number)
    edits, document = [], reading.document(path)
    for each in (path, *changed):
        node, tree = reading.node(each), _element(parsed(reading.at(each)))
        if not isinstance(node, Scalar) or not isinstance(tree, Number | Truth) or not node.is_plain:
            return
        begin = node.start + tree.span.start
        new = _other(tree)
        if reading.document(each) is document:
            edits.append(document.source.edit(begin, begin + tree.span.length, new))
    for each in (path, *changed):
        tree, text = _element(parsed(reading.at(each))), _text(reading, each)
        if isinstance(tree, Number | Truth):
            at, length = tree.span
            reading.set(each, text[:at] + _other(tree) + text[at + length :])
    first, second = ("a number", "a truth") if is_number else ("a truth", "a number")
    where = "used as" if changed else "set to"
    message = f"{name} starts as {first}, {render(start)}, and is {where} {second} everywhere else"
    advice = f"a truth starts as {_other(start)}" if is_number else f"a number starts as {_other(start)}"
    written = correction(document, edits, is_certain=False)
    places = tuple(map(reading.origin, seen[:MOST_SHOWN]))
    reading.tell(path, "BB131", message, advice, written, WHOLE, places)


def _text(reading: Reading, path: Path) -> str:
    """Return a scalar of the data as it is written."""
    node = reading.node(path)
    return node.text if isinstance(node, Scalar) else ""


def _other(tree: Number | Truth) -> str:
    if isinstance(tree, Number):
        return "true" if tree.value else "false"
    return "1" if tree.value else "0"


def _is_bit(tree: Expr | None) -> bool:
    return isinstance(tree, Number) and tree.value in (0, 1)


def _element(tree: Expr | None) -> Expr | None:
    """Return what the elements of a list are, or the value itself."""
    while isinstance(tree, Call) and tree.function == "list":
        match tree.arguments:
            case (Generator(element=element),):
                tree = element
            case _:
                return tree
    return tree


def _kind(tree: Expr | None) -> str:
    """Return whether an expression is a truth or a number, "" where that depends on names."""
    match _element(tree):
        case Truth() | Comparison() | Logical() | Unary(operator="not"):
            return "truth"
        case Call(function=function) if function in OF_TRUTHS:
            return "truth"
        case Call(function="list"):
            return ""
        case Number() | Binary() | Unary():
            return "number"
        case Conditional(then=then, otherwise=otherwise):
            return _kind(then) or _kind(otherwise)
    return ""


def _uses(found: Iterable[tuple[Path, Expr]], name: str) -> Iterator[tuple[Path, str]]:
    """Yield the paths of expressions that use a value, and as what: "truth", "number" or "" where that is open."""
    for path, tree in found:
        alone = "truth" if path[-1] in ("excited", "ends") else "number" if path[0] == "reward" else ""
        for kind in _kinds_of_uses(tree, name, alone):
            yield path, kind


def _inputs(reading: Reading) -> dict[str, list[Path]]:
    """Return the paths of the inputs in which each name is listed."""
    listed: dict[str, list[Path]] = {}
    for behavior in reading.mapping(("behaviors",)):
        path: Path = ("behaviors", behavior, "inputs")
        inputs = reading.at(path)
        names = inputs if isinstance(inputs, list) else [*inputs.values()] if isinstance(inputs, dict) else []
        for name in names:
            if isinstance(name, str):
                listed.setdefault(name, []).append(path)
    return listed


def _kinds_of_uses(tree: Expr, name: str, wanted: str) -> Iterator[str]:
    """Yield as what a value is used in an expression of which something is wanted."""
    of = tree
    while isinstance(of, Index):
        yield from _kinds_of_uses(of.index, name, "number")
        of = of.of
    match of:
        case Name(name=own):
            if own == name:
                yield wanted
            return
        case Logical() | Unary(operator="not"):
            wanted = "truth"
        case Binary() | Unary():
            wanted = "number"
        case Comparison(operands=operands):
            compared = [_kind(each) for each in operands]
            wanted = "truth" if "truth" in compared else "number"
        case Call(function=function):
            wanted = (
                wanted
                if function in ("before", "list")
                else "truth"
                if function in ("any", "all")
                else "number"
            )
        case Conditional(condition=condition, then=then, otherwise=otherwise):
            yield from _kinds_of_uses(condition, name, "truth")
            for arm in (then, otherwise):
                yield from _kinds_of_uses(arm, name, wanted)
            return
    for part in parts(of):
        yield from _kinds_of_uses(part, name, wanted)
