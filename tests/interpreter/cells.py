"""Which cell of its partitions a value is in, and what the rules say of each cell of a behavior's table."""

from __future__ import annotations

from itertools import pairwise, product
from math import inf
from typing import TYPE_CHECKING

from bbsd.expression.syntax.tree import Call, Conditional, Expr, Index, Name, OneOf
from bbsd.kernel.functions import clamp_index
from bbsd.language.field_types import Expression, expression
from bbsd.language.models import NO_ACTION_TEXT, OPEN, When
from tests.interpreter.expressions import Moment, Scope, Value, evaluate

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from bbsd.language.models import Behavior, Environment, Spec

OPEN_CELL = 255
NUMBERS = {".": 0, "?": OPEN_CELL} | {str(number): number for number in range(10)}
"""What the characters of a table mean, as far as made-up behaviors have actions."""
Partition = Expression | dict[str, Expression]


def sensed(partition: Partition, place: str, scope_at: Callable[[str, Expression], Scope]) -> Value:
    """A sensor's value, or the number of its cell; scope_at(place, expression) is what an expression sees."""
    if isinstance(partition, dict):
        return named_cell(partition, place, scope_at)
    scope = scope_at(place, partition)
    match partition.tree:
        case Call(function="cut", arguments=(cut, *bounds)):
            value = evaluate(cut, scope)
            return sum([value >= evaluate(bound, scope) for bound in bounds])
        case Call(function="values", arguments=(whole, first, last)):
            lowest = evaluate(first, scope)
            value = evaluate(whole, scope)
            return clamp_index(value - lowest if lowest else value, int(evaluate(last, scope) - lowest))
    return evaluate(partition.tree, scope)


def named_cell(cells: dict[str, Expression], place: str, scope_at: Callable[[str, Expression], Scope]) -> int:
    """The first whose condition holds; the last one where none does, whatever its condition is."""
    *early, _last = cells.items()
    for number, (label, condition) in enumerate(early):
        inside = f"{place}.{label}"
        if evaluate(condition.tree, scope_at(inside, condition)):
            return number
    return len(early)


def partitions(behavior: Behavior, spec: Spec) -> dict[str, Partition]:
    """A behavior's own partitions, or the sensors, truths of the state and observations with a size that it lists."""
    if isinstance(behavior.inputs, dict):
        own = behavior.inputs.items()
        return {name: by_names(partition, text_of(partition), spec) for name, partition in own}
    outside = spec.environment.outside
    sizes = {field.name: field.size for field in outside.fields if field.size} if outside else {}
    observed = {name: expression(f"values({name}, 0, {size - 1})") for name, size in sizes.items()}
    listed = {**observed, **spec.environment.state, **spec.environment.sensors}
    return {name: by_names(listed[name], name, spec) for name in behavior.inputs}


def text_of(partition: Partition) -> str:
    return "" if isinstance(partition, dict) else partition.text


def by_names(partition: Partition, text: str, spec: Spec) -> Partition:
    """A value that is one of several names as a cell for each of them; any other partition as it is."""
    names = None if isinstance(partition, dict) else names_of(partition.tree, spec)
    if names is None or isinstance(partition, dict):
        return partition
    return {name: expression(f"({text}) == {name}") for name in names}


def names_of(tree: Expr, spec: Spec) -> tuple[str, ...] | None:
    """The names that a value can be one of."""
    environment = spec.environment
    match tree:
        case OneOf(names=names):
            return names
        case Name(name=name):
            written = {
                **environment.world,
                **environment.state,
                **environment.definitions,
                **environment.sensors,
            }
            meant = written.get(name)
            return names_of(meant.tree, spec) if isinstance(meant, Expression) else None
        case Index(of=of):
            return names_of(of, spec)
        case Conditional(then=then, otherwise=otherwise):
            return names_of(then, spec) or names_of(otherwise, spec)
        case Call(function="before", arguments=(earlier,)):
            return names_of(earlier, spec)
    return None


def choices(environment: Environment) -> frozenset[str]:
    """All names that values of world and state can be."""
    starts = (*environment.world.values(), *environment.state.values())
    return frozenset(name for start in starts if isinstance(start.tree, OneOf) for name in start.tree.names)


def labels(partition: Partition, constants: Mapping[str, Value]) -> list[str]:
    """What the cells of a partition are called."""
    scope = Scope(Moment(lambda name, _robot: constants[name]), robots=0, robot=0, draw=no_draw)
    if isinstance(partition, dict):
        return list(partition)
    match partition.tree:
        case Call(function="cut", arguments=(_, *bounds)):
            at = [written(evaluate(bound, scope)) for bound in bounds]
            between = [f"{low} to {high}" for low, high in pairwise(at)]
            return [f"below {at[0]}", *between, f"from {at[-1]}"]
        case Call(function="values", arguments=(_, first, last)):
            lowest, highest = int(evaluate(first, scope)), int(evaluate(last, scope))
            return [str(number) for number in range(lowest, highest + 1)]
    return ["false", "true"]


def no_draw(*_: object) -> Value:
    raise AssertionError("what names a cell cannot be drawn")


def written(number: float) -> str:
    return str(int(number)) if number == int(number) else str(number)


def covered(label: str, partition: Partition, constants: Mapping[str, Value]) -> list[int]:
    """The cells that a rule means by a label: one, or with the words of `cut` a range of them."""
    names = labels(partition, constants)
    if label in names:
        return [names.index(label)]
    low, high = interval(label, constants)
    spans = [interval(name, constants) for name in names]
    return [cell for cell, (start, end) in enumerate(spans) if low <= start and end <= high]


def interval(label: str, constants: Mapping[str, Value]) -> tuple[float, float]:
    """The numbers that a cell of `cut` covers, by its label, which may name constants."""

    def number(bound: str) -> float:
        return float(constants.get(bound, bound))

    match label.split():
        case ["below", high]:
            return -inf, number(high)
        case ["from", low]:
            return number(low), inf
        case [low, "to", high]:
            return number(low), number(high)
    raise AssertionError(label)


def given_table(behavior: Behavior, spec: Spec, constants: Mapping[str, Value]) -> list[int]:
    """Each cell's action by its number, 0 for no action, or OPEN_CELL; the last input changes fastest."""
    if behavior.table is not None:
        return [NUMBERS[symbol] for symbol in behavior.table if not symbol.isspace()]
    inputs = partitions(behavior, spec)
    actions = {name: number for number, name in enumerate(behavior.actions, 1)}
    numbers = {NO_ACTION_TEXT: 0, OPEN: OPEN_CELL, **actions}
    cells = product(*(range(len(labels(partition, constants))) for partition in inputs.values()))
    return [numbers[decided(behavior, inputs, cell, constants)] for cell in cells]


def decided(
    behavior: Behavior,
    inputs: dict[str, Partition],
    cell: Sequence[int],
    constants: Mapping[str, Value],
) -> str:
    """What the first rule that matches a cell decides."""
    at = dict(zip(inputs, cell, strict=True))

    def matches(name: str, which: list[str]) -> bool:
        return any(at[name] in covered(label, inputs[name], constants) for label in which)

    for rule in behavior.rules or ():
        if not isinstance(rule, When):
            return rule.otherwise
        if all(matches(name, which) for name, which in rule.when.items()):
            return rule.do
    return OPEN
