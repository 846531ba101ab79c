"""Expressions that Hypothesis makes up: well typed for the place where they stand."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

from hypothesis import strategies as st

from bbsd.expression.vocabulary import FUNCTIONS

Draw = Any
"""What Hypothesis gives to a composite strategy."""

Writer = Callable[[Draw, "Reach", int], str]
"""Writes an expression within a reach, nested at most so deep."""

LITERALS = ("0", "1", "2", "3", "0.1", "0.5", "2.5", "10", "1e-3", "pi")
WHOLE_LITERALS = ("0", "1", "2", "3", "7")
EXPONENTS = ("2", "3", "-1", "-2", "0", "0.5", "1.5")
DEPTH = 3


@dataclass(frozen=True)
class Reach:
    """What an expression may use: names by what they hold."""

    robots: int
    numbers: tuple[str, ...] = ()
    truths: tuple[str, ...] = ()
    wholes: tuple[str, ...] = ()
    lists: tuple[tuple[str, int], ...] = ()
    tables: tuple[tuple[str, int, int], ...] = ()
    numbers_of_robots: tuple[str, ...] = ()
    truths_of_robots: tuple[str, ...] = ()
    definitions: tuple[tuple[str, int], ...] = ()
    team: bool = False
    others: bool = False
    truth_tables: tuple[tuple[str, int, int], ...] = ()
    lists_of_robots: tuple[tuple[str, int], ...] = ()
    draws: bool = False
    before: bool = False
    bound: int = 0
    """Names bound by generators around, so that new ones differ."""

    def binding(self, *, numbers: int = 0, wholes: int = 0) -> tuple[Reach, tuple[str, ...]]:
        """What can be used where a generator binds more names, and these names."""
        names = tuple(f"v{self.bound + k}" for k in range(numbers + wholes))
        inner = replace(self, bound=self.bound + len(names))
        if numbers:
            return replace(inner, numbers=self.numbers + names), names
        return replace(inner, wholes=self.wholes + names), names


def number(draw: Draw, reach: Reach, depth: int = DEPTH) -> str:
    """An expression for a number."""
    return one_way(draw, numbers(reach, depth))(draw, reach, depth - 1)


def truth(draw: Draw, reach: Reach, depth: int = DEPTH) -> str:
    """An expression for a truth."""
    return one_way(draw, truths(reach, depth))(draw, reach, depth - 1)


def whole(draw: Draw, reach: Reach, depth: int = DEPTH) -> str:
    """An expression for a number that is always whole."""
    return one_way(draw, wholes(reach, depth))(draw, reach, depth - 1)


def one_way(draw: Draw, ways: Sequence[Writer]) -> Writer:
    way: Writer = draw(st.sampled_from(ways))
    return way


def numbers(reach: Reach, depth: int) -> list[Writer]:
    """All ways to write a number."""
    if depth <= 0:
        return [one_of(LITERALS)] + [one_of(names) for names in (reach.numbers, reach.wholes) if names] * 2
    ways = [function, binary, binary, power, conditional(number), several, negated, over_range, whole]
    ways += [one_of(reach.numbers or LITERALS)]
    if reach.lists:
        ways += [element, aggregate_of_list, over_list]
    if reach.tables:
        ways += [element_of_table, over_rows]
    if reach.team:
        ways += [of_robot(reach.numbers_of_robots), over_team, over_team, over_team, first_best]
    if reach.lists_of_robots:
        ways += [element_of_robot, element_of_robot]
    if reach.definitions:
        ways += [defined, defined]
    if reach.before:
        ways += [earlier(number), earlier(number)]
    if reach.draws:
        ways += [drawn, drawn, drawn_again_and_again]
    return ways


def truths(reach: Reach, depth: int) -> list[Writer]:
    """All ways to write a truth."""
    leaf = one_of(reach.truths or ("true", "false"))
    if depth <= 0:
        return [leaf]
    ways = [leaf, comparison, comparison, chain, joined, denied, conditional(truth)]
    if reach.lists:
        ways += [any_of_list]
    if reach.truth_tables:
        ways += [element_of_truths, element_of_truths]
    if reach.team and reach.truths_of_robots:
        ways += [of_robot(reach.truths_of_robots)]
    if reach.before:
        ways += [earlier(truth)]
    if reach.draws:
        ways += [chance]
    return ways


def wholes(reach: Reach, depth: int) -> list[Writer]:
    """All ways to write a whole number."""
    leaf = one_of((*WHOLE_LITERALS, *reach.wholes * 3))
    if depth <= 0:
        return [leaf]
    return [leaf, rounded, rounded, whole_sum] + [integers] * reach.draws


def one_of(texts: Sequence[str]) -> Writer:
    return lambda draw, _reach, _depth: str(draw(st.sampled_from(texts)))


def function(draw: Draw, reach: Reach, depth: int) -> str:
    name = draw(st.sampled_from(sorted(FUNCTIONS)))
    arguments = [number(draw, reach, depth) for _ in range(FUNCTIONS[name].arity)]
    return f"{name}({', '.join(arguments)})"


def binary(draw: Draw, reach: Reach, depth: int) -> str:
    operator = draw(st.sampled_from(["+", "-", "*", "/", "//", "%"]))
    left, right = number(draw, reach, depth), number(draw, reach, depth)
    return f"({left} {operator} {right})" if draw(st.booleans()) else f"{left} {operator} ({right})"


def power(draw: Draw, reach: Reach, depth: int) -> str:
    return f"({number(draw, reach, depth)}) ** {draw(st.sampled_from(EXPONENTS))}"


def negated(draw: Draw, reach: Reach, depth: int) -> str:
    return f"(-({number(draw, reach, depth)}))"


def conditional(arm: Writer) -> Writer:
    def write(draw: Draw, reach: Reach, depth: int) -> str:
        then, otherwise = arm(draw, reach, depth), arm(draw, reach, depth)
        return f"({then} if {truth(draw, reach, depth)} else {otherwise})"

    return write


def several(draw: Draw, reach: Reach, depth: int) -> str:
    name = draw(st.sampled_from(["min", "max", "sum", "mean"]))
    count = draw(st.integers(2, 3))
    return f"{name}({', '.join(number(draw, reach, depth) for _ in range(count))})"


def folded(draw: Draw, element_text: str, names: Sequence[str], source: str) -> str:
    name = draw(st.sampled_from(["min", "max", "sum", "mean"]))
    return f"{name}({element_text} for {', '.join(names)} in {source})"


def element(draw: Draw, reach: Reach, depth: int) -> str:
    name, length = draw(st.sampled_from(reach.lists))
    return f"{name}[{index(draw, reach, depth, length)}]"


def index(draw: Draw, reach: Reach, depth: int, length: int) -> str:
    """A plain index in the range, or a computed one that may be beyond."""
    if draw(st.booleans()):
        return str(draw(st.integers(0, length - 1)))
    return f"0 + {whole(draw, reach, depth)}" if depth > 0 else f"floor({number(draw, reach, depth)})"


def aggregate_of_list(draw: Draw, reach: Reach, _depth: int) -> str:
    name, _ = draw(st.sampled_from(reach.lists))
    return f"{draw(st.sampled_from(['min', 'max', 'sum', 'mean']))}({name})"


def over_list(draw: Draw, reach: Reach, depth: int) -> str:
    name, _ = draw(st.sampled_from(reach.lists))
    inner, names = reach.binding(numbers=1)
    return folded(draw, f"{names[0]} * {number(draw, inner, depth)}", names, name)


def element_of_table(draw: Draw, reach: Reach, depth: int) -> str:
    name, rows, columns = draw(st.sampled_from(reach.tables))
    return f"{name}[{index(draw, reach, depth, rows)}][{index(draw, reach, depth, columns)}]"


def element_of_truths(draw: Draw, reach: Reach, depth: int) -> str:
    name, rows, columns = draw(st.sampled_from(reach.truth_tables))
    return f"{name}[{index(draw, reach, depth, rows)}][{index(draw, reach, depth, columns)}]"


def element_of_robot(draw: Draw, reach: Reach, depth: int) -> str:
    name, length = draw(st.sampled_from(reach.lists_of_robots))
    return f"{name}[{index(draw, reach, depth, reach.robots)}][{index(draw, reach, depth, length)}]"


def a_list(draw: Draw, reach: Reach, length: int, columns: int = 0) -> str:
    """A list of numbers, or with columns of lists of truths: its elements one by one, or by a generator."""
    if draw(st.booleans()):
        rows = [a_row(draw, reach, columns) if columns else number(draw, reach, 2) for _ in range(length)]
        return f"list({', '.join(rows)})"
    inner, (each,) = reach.binding(wholes=1)
    row = a_row(draw, inner, columns) if columns else number(draw, inner, 2)
    return f"list({row} for {each} in range({length}))"


def a_row(draw: Draw, reach: Reach, columns: int) -> str:
    """A list of truths."""
    inner, (each,) = reach.binding(wholes=1)
    return f"list({truth(draw, inner, 2)} for {each} in range({columns}))"


def over_rows(draw: Draw, reach: Reach, depth: int) -> str:
    name, _, columns = draw(st.sampled_from(reach.tables))
    inner, names = reach.binding(numbers=columns)
    return folded(draw, f"{' - '.join(names)} + {number(draw, inner, depth)}", names, name)


def over_range(draw: Draw, reach: Reach, depth: int) -> str:
    inner, names = reach.binding(wholes=1)
    return folded(draw, number(draw, inner, depth), names, f"range({draw(st.integers(1, 3))})")


def of_robot(names: Sequence[str]) -> Writer:
    def write(draw: Draw, reach: Reach, depth: int) -> str:
        name = draw(st.sampled_from(names))
        return f"{name}[{index(draw, reach, depth, reach.robots)}]"

    return write


def over_team(draw: Draw, reach: Reach, depth: int) -> str:
    inner, names = reach.binding(wholes=1)
    theirs = f"{draw(st.sampled_from(reach.numbers_of_robots))}[{names[0]}]"
    source = draw(st.sampled_from(["others", "team"] if reach.others else ["team"]))
    return folded(draw, f"{theirs} - {number(draw, inner, depth)}", names, source)


def first_best(draw: Draw, reach: Reach, _depth: int) -> str:
    name = draw(st.sampled_from(["argmin", "argmax"]))
    _, (each,) = reach.binding(wholes=1)
    return f"{name}({draw(st.sampled_from(reach.numbers_of_robots))}[{each}] for {each} in team)"


def defined(draw: Draw, reach: Reach, depth: int) -> str:
    name, parameters = draw(st.sampled_from(reach.definitions))
    arguments = ", ".join(number(draw, reach, depth) for _ in range(parameters))
    return f"{name}({arguments})" if parameters else name


def earlier(what: Writer) -> Writer:
    def write(draw: Draw, reach: Reach, depth: int) -> str:
        return f"before({what(draw, replace(reach, before=False, draws=False), depth)})"

    return write


def drawn(draw: Draw, reach: Reach, depth: int) -> str:
    name = draw(st.sampled_from(["uniform", "normal"]))
    first, second = number(draw, reach, depth), number(draw, reach, depth)
    if is_unchecked(draw, reach):
        return f"{name}({first}, {second} + 0 * x)"
    return f"uniform({ordered(first, second)})" if name == "uniform" else f"normal({first}, abs({second}))"


def is_unchecked(draw: Draw, reach: Reach) -> bool:
    """Whether a draw may be of impossible numbers: only of what changes in an episode, else it is a mistake."""
    return "x" in reach.numbers and draw(st.booleans())


def ordered(first: str, second: str) -> str:
    return f"min({first}, {second}), max({first}, {second})"


def drawn_again_and_again(draw: Draw, reach: Reach, depth: int) -> str:
    """Draws in a generator in a generator."""
    inner, (row, column) = reach.binding(wholes=2)
    within = f"sum({drawn(draw, inner, depth)} + {column} for {column} in range(2))"
    return folded(draw, f"{row} - {within}", [row], f"range({draw(st.integers(2, 3))})")


def integers(draw: Draw, reach: Reach, depth: int) -> str:
    first, second = whole(draw, reach, depth), whole(draw, reach, depth)
    if is_unchecked(draw, reach):
        return f"integers({first}, {second} + floor(0 * x))"
    return f"integers({ordered(first, second)})"


def chance(draw: Draw, reach: Reach, depth: int) -> str:
    probability = number(draw, reach, depth)
    if is_unchecked(draw, reach):
        return f"chance({probability} + 0 * x)"
    return f"chance(min(max({probability}, 0), 1))"


def comparison(draw: Draw, reach: Reach, depth: int) -> str:
    operator = draw(st.sampled_from(["<", "<=", ">", ">=", "==", "!="]))
    return f"({number(draw, reach, depth)} {operator} {number(draw, reach, depth)})"


def chain(draw: Draw, reach: Reach, depth: int) -> str:
    first, second, third = (number(draw, reach, depth) for _ in range(3))
    return f"({first} <= {second} < {third})"


def joined(draw: Draw, reach: Reach, depth: int) -> str:
    operator = draw(st.sampled_from(["and", "or"]))
    return f"({truth(draw, reach, depth)} {operator} {truth(draw, reach, depth)})"


def denied(draw: Draw, reach: Reach, depth: int) -> str:
    return f"(not {truth(draw, reach, depth)})"


def any_of_list(draw: Draw, reach: Reach, depth: int) -> str:
    name, _ = draw(st.sampled_from(reach.lists))
    inner, (each,) = reach.binding(numbers=1)
    return f"{draw(st.sampled_from(['any', 'all']))}({truth(draw, inner, depth)} for {each} in {name})"


def rounded(draw: Draw, reach: Reach, depth: int) -> str:
    return f"{draw(st.sampled_from(['floor', 'ceil', 'round']))}({number(draw, reach, depth)})"


def whole_sum(draw: Draw, reach: Reach, depth: int) -> str:
    operator = draw(st.sampled_from(["+", "-", "*"]))
    return f"({whole(draw, reach, depth)} {operator} {whole(draw, reach, depth)})"
