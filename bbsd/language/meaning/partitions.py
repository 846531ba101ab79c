"""Partitions: the cells into which a behavior's input is cut (P_i of (1)), as labels and as a cell index."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import count, pairwise
from typing import TYPE_CHECKING

from bbsd.expression.elaboration import elaboration
from bbsd.expression.elaboration.naming import one_reading
from bbsd.expression.graph import Node, value_of
from bbsd.expression.kinds import Kind
from bbsd.expression.operations import MIRRORED
from bbsd.expression.scope import Named
from bbsd.expression.syntax.mistakes import KEY, Addition, Rewriting
from bbsd.expression.syntax.text import render
from bbsd.expression.syntax.tree import Call, Comparison, Expr, Name, Span
from bbsd.language.meaning.proofs.coverage import covers_everything
from bbsd.language.meaning.tables.labels import Labels, Numbers
from bbsd.language.models import OTHERWISE, PartitionText

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from bbsd.expression.graph import Graph
    from bbsd.expression.scope import Path, Scope
    from bbsd.language.field_types import Expression

TRUTH_CELLS = ("false", "true")
MAX_CELLS = 1_000_000
"""Cells of one table: a byte each in the table of every individual of a pool."""
MAX_EXPLAINED = 12
"""Cells of a partition of which messages say what holds in them."""
MAX_CELLS_IN_ALL = 10_000_000
"""Cells of the tables of all behaviors together."""


@dataclass(frozen=True, slots=True)
class Partition:
    """The labels of the cells in order, and the node that computes the index of the present cell."""

    cells: Labels
    index: Node


def is_partition(sensor: PartitionText) -> bool:
    """Return whether a sensor is written as named cells, cut(...) or values(...), not as a plain expression."""
    return isinstance(sensor, dict) or (
        isinstance(sensor.tree, Call) and sensor.tree.function in ("cut", "values")
    )


def conditions_of_cells(sensor: PartitionText) -> dict[str, str]:
    """Return what holds in each cell of a sensor that is cut or has named cells, as an expression; few cells only."""
    if isinstance(sensor, dict):
        return _conditions_of_names(sensor) if len(sensor) <= MAX_EXPLAINED else {}
    tree = sensor.tree
    if not (isinstance(tree, Call) and tree.function == "cut" and 2 <= len(tree.arguments) <= MAX_EXPLAINED):
        return {}
    number, *bounds = (render(part) for part in tree.arguments)
    inner = {f"{low} to {high}": f"{low} <= {number} < {high}" for low, high in pairwise(bounds)}
    return {
        f"below {bounds[0]}": f"{number} < {bounds[0]}",
        **inner,
        f"from {bounds[-1]}": f"{number} >= {bounds[-1]}",
    }


def _conditions_of_names(cells: Mapping[str, Expression]) -> dict[str, str]:
    """Return what holds in each named cell: its own condition, and none of those before."""
    conditions: dict[str, str] = {}
    before: list[str] = []
    for label, condition in cells.items():
        own = "" if condition.text == OTHERWISE else condition.text
        others = f"not ({' or '.join(before)})" if before else ""
        conditions[label] = " and ".join(
            part for part in (f"({own})" if own and others else own, others) if part
        )
        before.append(f"({own})" if len(cells) > 2 and own else own)
    return conditions


def elaborate_partition(
    partition: PartitionText, scope: Scope, path: Path, robot: int | None
) -> Partition | None:
    """Return the cells of a partition and the index of the robot's; None after a mistake."""
    inner = scope.at(path, robot, draws=scope.draws is not None)
    if isinstance(partition, dict):
        return _named_cells(partition, scope, path, robot)
    tree = partition.tree
    if isinstance(tree, Call) and tree.function == "cut":
        return _cut(tree, inner)
    if isinstance(tree, Call) and tree.function == "values":
        return _values(tree, inner)
    return _truth(partition, inner)


def _truth(expression: Expression, scope: Scope) -> Partition | None:
    value = one_reading(elaboration.value(expression.tree, scope), expression.tree.span, scope)
    if isinstance(value, Named):
        return cells_of_names(value, scope.graph)
    if isinstance(value, tuple) or value.kind is Kind.NUMBER:
        what = "a list" if isinstance(value, tuple) else "a number"
        advice = f"cut it: cut({expression.text}, ...) or values({expression.text}, first, last), or write a condition"
        scope.mistake(
            "BB030", f"an input has cells, and this is {what} without any", expression.tree.span, advice
        )
        return None
    return None if value.kind is Kind.UNKNOWN else Partition(TRUTH_CELLS, scope.graph.apply("cell_of", value))


def cells_of_names(value: Named, graph: Graph) -> Partition:
    """Return a cell for each name that a value can be one of."""
    return Partition(value.names, graph.apply("clamp_index", value.node, data=len(value.names) - 1))


def _cut(tree: Call, scope: Scope) -> Partition | None:
    if len(tree.arguments) < 2:
        scope.mistake(
            "BB031", "cut takes a number and the bounds between its cells: cut(tilt, 2, 5)", tree.span
        )
        return None
    number_tree, *bounds = tree.arguments
    number = elaboration.number(number_tree, scope)
    nodes = [elaboration.number(bound, scope) for bound in bounds]
    if any(node.kind is Kind.UNKNOWN for node in (number, *nodes)):
        return None
    values = [value_of(node) if node.literal else scope.static(node) for node in nodes]
    for (low, high), bound in zip(pairwise(values), bounds[1:], strict=True):
        if low is not None and high is not None and not low < high:
            message = f"bounds must grow, and {high:g} does not exceed {low:g}"
            scope.mistake("BB031", message, bound.span, *_in_order(tree, bounds, values))
            return None
    texts = [render(bound) for bound in bounds]
    labels = (
        f"below {texts[0]}",
        *(f"{low} to {high}" for low, high in pairwise(texts)),
        f"from {texts[-1]}",
    )
    graph = scope.graph
    passed = [graph.apply("cell_of", graph.apply(">=", number, node)) for node in nodes]
    return Partition(labels, graph.fold("+", passed))


def _in_order(cut: Call, bounds: list[Expr], values: list[float | None]) -> tuple[str, Rewriting | None]:
    """Return the advice and the correction that sort the bounds of a cut; none where two are the same."""
    known = [value for value in values if value is not None]
    if len({*known}) < len(values):
        return "", None
    ordered = sorted(zip(known, map(render, bounds), strict=True))
    new = f"cut({', '.join([render(cut.arguments[0]), *(text for _, text in ordered)])})"
    return f"write {new}", Rewriting(new, cut.span)


def _values(tree: Call, scope: Scope) -> Partition | None:
    if len(tree.arguments) != 3:
        scope.mistake(
            "BB031",
            "values takes a whole number, the first and the last value: values(speed, 0, 5)",
            tree.span,
        )
        return None
    number_tree, first_tree, last_tree = tree.arguments
    number = elaboration.whole(number_tree, scope, "what values(...) divides")
    first, last = _ends_of_values(first_tree, last_tree, scope)
    if number.kind is Kind.UNKNOWN or first is None or last is None:
        return None
    if scope.robot and (first, last) != _ends_of_values(first_tree, last_tree, scope.at(scope.path, 0)):
        message = "the cells would differ from robot to robot, and they share one table"
        advice = "let the first and the last value be the same for all, and what differs be in the number"
        scope.mistake("BB127", message, tree.span, advice)
        return None
    if not 1 <= last - first < MAX_CELLS:
        scope.mistake(
            "BB031",
            f"from {first} to {last} are not two values or more",
            Span(tree.span.start, tree.span.length),
        )
        return None
    return cells_of_numbers(number, first, last, scope.graph)


def _ends_of_values(first: Expr, last: Expr, scope: Scope) -> tuple[int | None, int | None]:
    """Return the first and the last value that are told apart, None after a mistake."""
    return (
        elaboration.static_whole(first, scope, "the first value"),
        elaboration.static_whole(last, scope, "the last value"),
    )


def cells_of_numbers(number: Node, first: int, last: int, graph: Graph) -> Partition:
    """Return a cell for each whole number from the first to the last; what lies beyond goes to the nearest."""
    offset = graph.apply("-", number, graph.number(first)) if first else number
    return Partition(Numbers(first, last), graph.apply("clamp_index", offset, data=last - first))


def _words_for_the_rest(n_others: int) -> Iterator[str]:
    """Yield names for a cell in which none of the others holds."""
    yield from ["neither", "rest"] if n_others == 2 else ["rest"]
    yield from (f"rest_{number}" for number in count(2))


def _named_cells(
    conditions_by_label: dict[str, Expression], scope: Scope, path: Path, robot: int | None
) -> Partition | None:
    labels = tuple(conditions_by_label)
    expressions = list(conditions_by_label.values())
    final = (
        isinstance(expressions[-1].tree, Name) and expressions[-1].tree.name == OTHERWISE
        if expressions
        else False
    )
    conditions = expressions[:-1] if final else expressions
    nodes = [
        elaboration.truth(condition.tree, scope.at((*path, label), robot, draws=scope.draws is not None))
        for label, condition in zip(labels, conditions, strict=False)
    ]
    whole = scope.at(path, robot)
    if len(labels) < 2:
        whole.mistake("BB032", "a partition needs two cells or more", KEY)
        return None
    if any(node.kind is Kind.UNKNOWN for node in nodes):
        return None
    if not final and not covers_everything(nodes, scope.graph, scope.size):
        if _border_is_left_out(expressions, labels, scope, path, robot):
            return None
        message = f"{path[-1]} has no cell where none of {', '.join(labels)} holds"
        rest = next(word for word in _words_for_the_rest(len(labels)) if word not in labels)
        last, span = labels[-1], expressions[-1].tree.span
        advice = f"add a last cell for the rest; write {last}: {OTHERWISE} only if the rest counts as {last}"
        added = Addition(f"{rest}: {OTHERWISE}", path, last)
        whole.at((*path, last)).mistake("BB032", message, span, advice, added)
        return None
    graph = scope.graph
    index = graph.cell(len(labels) - 1)
    for cell in reversed(range(len(labels) - 1)):
        index = graph.apply("select", nodes[cell], graph.cell(cell), index)
    return Partition(labels, index)


def _border_is_left_out(
    cells: Sequence[Expression], labels: Sequence[str], scope: Scope, path: Path, robot: int | None
) -> bool:
    """Report cells that leave out nothing but a number on their border, as x < 2 and x > 2; return whether they do."""
    trees = [cell.tree for cell in cells]
    if len(trees) > MAX_EXPLAINED:
        return False
    strict = {
        (sign, render(left), render(right))
        for tree in trees
        if isinstance(tree, Comparison)
        for sign, (left, right) in zip(tree.operators, pairwise(tree.operands), strict=True)
    }
    for number in reversed(range(len(trees))):
        tree = trees[number]
        if not isinstance(tree, Comparison):
            continue
        for place, sign in enumerate(tree.operators):
            left, right = map(render, tree.operands[place : place + 2])
            if sign not in ("<", ">") or not strict & {(MIRRORED[sign], left, right), (sign, right, left)}:
                continue
            operators = (*tree.operators[:place], f"{sign}=", *tree.operators[place + 1 :])
            looser = replace(tree, operators=operators)
            nodes = [
                elaboration.truth(each, scope.at((*path, label), robot, draws=scope.draws is not None))
                for each, label in zip((*trees[:number], looser, *trees[number + 1 :]), labels, strict=True)
            ]
            if covers_everything(nodes, scope.graph, scope.size):
                new, others = render(looser), " and ".join(dict.fromkeys(map(render, trees)))
                message = f"{path[-1]} has no cell where {left} == {right}: {others} leave it out"
                correction = Rewriting(new, tree.span, is_certain=False)
                inner = scope.at((*path, labels[number]), robot)
                inner.mistake("BB032", message, tree.span, f"let one of them take it: {new}", correction)
                return True
    return False
