"""Definitions whose parameters are not written, and rows of tables that are shorter or longer than the others."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING

from bbsd.expression.syntax.mistakes import KEY, WHOLE, Rewriting
from bbsd.expression.syntax.tree import Call, Expr, Generator, Name, OneOf, names_used
from bbsd.language.field_types import is_value_name, signature
from bbsd.language.meant.declared.trees import DEFINITIONS, indices, parsed, trees, unknown_names, within
from bbsd.language.meant.values_by_name import known_names

if TYPE_CHECKING:
    from bbsd.expression.scope import Path
    from bbsd.language.meant.reading import Reading
    from bbsd.text import Data

FEWEST_ROWS = 3
"""Rows of a table of which one can be told to differ from the others."""


def parameters_not_written(reading: Reading) -> None:
    """Read `free: room[row][column] == 0`, which is called as free(x, y), as free(row, column)."""
    block = reading.mapping(DEFINITIONS)
    if not block:
        return
    found = [*trees(reading)]
    known = known_names(reading) | {name for _, tree in found for name in _values(tree)}
    calls: dict[str, list[tuple[Path, Call]]] = {}
    for path, tree in found:
        for part in within(tree):
            if isinstance(part, Call):
                calls.setdefault(part.function, []).append((path, part))
    for key in [*block]:
        name, *parameters = signature(key) or ("",)
        own, called = parsed(block[key]), calls.get(name, ())
        numbers = {len(call.arguments) for _, call in called}
        is_of_values = not any(isinstance(each, Generator) for _, call in called for each in call.arguments)
        if own is None or len(numbers) != 1 or not is_of_values:
            continue
        wanted = [each for each in unknown_names(own, known) if each not in parameters]
        number = numbers.pop()
        if not wanted or number != len(parameters) + len(wanted) or not all(map(is_value_name, wanted)):
            continue
        new = f"{name}({', '.join([*parameters, *wanted])})"
        names, arguments = " and ".join(wanted), f"{number} argument{'s' * (number > 1)}"
        only = f"only {len(parameters)} parameter{'s' * (len(parameters) > 1)}"
        has = f"has {only if parameters else 'no parameters'}"
        verb = "are names" if len(wanted) > 1 else "is a name"
        message = f"{name} {has}, but {names} in it {verb} of nothing, and it is called with {arguments}"
        written = Rewriting(new, KEY, is_certain=False)
        seen = tuple(dict.fromkeys(reading.origin(path) for path, _ in called))
        at = (*DEFINITIONS, key)
        reading.tell(at, "BB054", message, f"parameters stand behind the name: {new}", written, KEY, seen)
        reading.rename(at, new)


def _values(tree: Expr) -> tuple[str, ...]:
    return tree.names if isinstance(tree, OneOf) else ()


def rows_of_other_lengths(reading: Reading) -> None:
    """Read a table of which one row is shorter or longer than all others as one of equal rows, where it must be."""
    tables = {
        name: value for name, value in reading.mapping(("constants",)).items() if _odd_row(value) is not None
    }
    if not tables:
        return
    needed = {reading.at(("view", "grid"))}
    fixed = {*reading.mapping(("constants",))}
    changing = {*reading.mapping(("environment", "state")), *reading.mapping(("environment", "world"))}
    changing |= {*reading.mapping(("environment", "sensors"))}
    changing |= {name for key in reading.mapping(DEFINITIONS) for name in signature(key)[1:]}
    for _, index, of in indices(reading, [*trees(reading)]):
        if isinstance(of, Name) and names_used(index) - fixed & changing:
            needed.add(of.name)
    for name, rows in tables.items():
        odd = _odd_row(rows)
        if name not in needed or odd is None or not isinstance(rows, list):
            continue
        row, length = odd
        path: Path = ("constants", name, row)
        wrong = rows[row]
        if not isinstance(wrong, list):
            continue
        has = f"{len(wrong)} value{'s' * (len(wrong) != 1)}"
        message = f"row {row} of {name}, counted from 0, has {has}, the others {length}"
        if all(
            parsed(each) is not None for each in wrong
        ):  # else its length follows from what is wrong in it
            reading.tell(path, "BB172", message, "the rows of a table are equally long", None, WHOLE)
        fill = (wrong or [0])[-1]
        reading.set(path, [*wrong[:length], *[fill] * (length - len(wrong))])


def _odd_row(rows: Data) -> tuple[int, int] | None:
    """Return the one row of a table that is of another length, and the length of all others; None without one."""
    if (
        not isinstance(rows, list)
        or len(rows) < FEWEST_ROWS
        or not all(isinstance(row, list) for row in rows)
    ):
        return None
    lengths = [len(row) for row in rows if isinstance(row, list)]
    counted = Counter(lengths).most_common()
    if len(counted) != 2 or counted[1][1] != 1:
        return None
    return lengths.index(counted[1][0]), counted[0][0]
