"""The values of constants: numbers, tables, draws; some change with the generation."""

from __future__ import annotations

from dataclasses import dataclass
from math import nan
from typing import TYPE_CHECKING, Any, cast

from bbsd.expression.elaboration import elaboration
from bbsd.expression.elaboration.checks import require_finite
from bbsd.expression.graph import (
    LEAVES,
    Graph,
    Level,
    Node,
    evaluate,
    needed,
    replace_leaves,
    value_of,
)
from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import Slot
from bbsd.expression.scope import Binding, Findings, Named, Path, Plain, Scope, Shared, Unusable, Value
from bbsd.expression.whole_numbers import whole_nodes
from bbsd.kernel import streams
from bbsd.language.field_types import expressions_in
from bbsd.language.meaning.naming.order import dependency_order, names_used_in, uses_among

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from bbsd.expression.node_data import Gather
    from bbsd.language.field_types import Expression, Nested

GENERATION = "generation"
GENERATION_SLOT = Slot(GENERATION)


@dataclass(frozen=True, slots=True)
class Constants:
    """The constants of a command: the value of each scalar, and its position in the vector that a kernel gets.

    `values` are nested tuples of nodes: literals, or expressions of the generation.
    """

    values: Mapping[str, Plain]
    scalars: tuple[Node, ...]
    leaves: Mapping[str, Plain]
    """The same shapes, as the leaves by which a kernel reads them."""
    wholes: tuple[bool, ...]
    """For each scalar, whether it is certainly a whole number."""

    def vector(self, generation: int) -> list[float]:
        """Return all scalars in order, as they are in a generation (counted from 1)."""
        return [
            float(value) for value in evaluate(self.scalars, lambda node, _: _generation(node, generation))
        ]

    def plain(self, name: str) -> Any:  # noqa: ANN401 - a number or nested lists of numbers
        """Return a constant's value as plain data; None where it depends on the generation."""
        return _plain(self.values[name])

    def static(self, node: Node) -> float | None:
        """Return the value of a node of constants; None where it is not the same in every generation."""
        if any(leaf.operation in LEAVES and not self._is_static(leaf) for leaf in needed([node])):
            return None
        return float(evaluate([node], self._at_leaf)[0])

    def _is_static(self, leaf: Node) -> bool:
        if leaf.operation == "gather":
            return all(self.scalars[place].literal for place in leaf.gather.places)
        return leaf.operation == "constant" and self.scalars[leaf.index].literal

    def _at_leaf(self, leaf: Node, indices: Sequence[float]) -> float:
        return value_of(leaf.read(self.scalars, indices))

    def whole(self, data: int | Gather) -> bool:
        """Return whether a constant, or every constant that a gather may read, is certainly whole."""
        places = [data] if isinstance(data, int) else data.places
        return all(self.wholes[place] for place in places)


def _generation(node: Node, generation: int) -> float:
    return float(generation) if node.data == GENERATION_SLOT else nan


def _plain(value: Plain) -> Any:  # noqa: ANN401 - a number or nested lists of numbers
    if isinstance(value, tuple):
        return [_plain(item) for item in value]
    return value_of(value) if value.literal else None


def read_constants(
    constants: Mapping[str, Nested],
    seed_key: int,
    graph: Graph,
    findings: Findings,
    unusable: frozenset[str],
) -> Constants:
    """Evaluate the constants, with draws from the stream of (seed, the constant's name)."""
    bindings: dict[str, Binding] = {
        GENERATION: Shared(graph.leaf("slot", GENERATION_SLOT, Kind.NUMBER, Level.CALL)),
        **dict.fromkeys(unusable, Unusable()),
    }
    base = Scope(graph, bindings, findings)
    constants_key = streams.fold(seed_key, streams.name_word("constants"))
    values: dict[str, Plain] = {}
    for name in _dependency_order(constants, unusable):
        path: Path = ("constants", name)
        key = streams.fold(constants_key, streams.name_word(name))
        values[name] = _with_draws(_read(constants[name], base, path), key, base.at(path), constants[name])
        bindings[name] = Shared(values[name])
    ordered = {name: values[name] for name in constants if name in values}
    scalars: list[Node] = []
    leaves = {name: _leaves(value, scalars, graph) for name, value in ordered.items()}
    whole = whole_nodes(scalars, {GENERATION_SLOT: True}, lambda _: False)
    return Constants(ordered, tuple(scalars), leaves, tuple(whole[node.number] for node in scalars))


def _dependency_order(constants: Mapping[str, Nested], unusable: frozenset[str]) -> list[str]:
    used = {
        name: names_used_in(expressions_in(value))
        for name, value in constants.items()
        if name not in unusable
    }
    return dependency_order(uses_among(used))


def _read(constant: Nested, scope: Scope, path: Path) -> Plain:
    if isinstance(constant, tuple):
        return tuple(_read(item, scope, (*path, index)) for index, item in enumerate(constant))
    value = elaboration.value(constant.tree, scope.at(path, 0, draws=True))
    return _numbers_only(value, scope.at(path), constant)


def _numbers_only(value: Value, scope: Scope, expression: Expression) -> Plain:
    """Return a value with truths reported and replaced by unknown numbers."""
    if isinstance(value, tuple):
        return tuple(_numbers_only(item, scope, expression) for item in value)
    if isinstance(value, Named) or value.kind is Kind.TRUTH:
        message = f"a constant is a number or a list of numbers, not {value.kind.value}"
        return scope.mistake("BB055", message, expression.tree.span)
    return value


def _with_draws(value: Plain, key: int, scope: Scope, constant: Nested) -> Plain:
    """Return the value with its draws made from the stream of `key`; it may still depend on the generation."""
    if isinstance(value, tuple):
        texts = constant if isinstance(constant, tuple) else (constant,) * len(value)
        return tuple(_with_draws(item, key, scope, text) for item, text in zip(value, texts, strict=True))
    try:
        drawn = replace_leaves(
            value, scope.graph, lambda node, operands: _draw(node, operands, key, scope.graph)
        )
        return cast("Node", require_finite(drawn, expressions_in(constant)[0].tree.span, scope))
    except _DrawsWithGenerationError:
        span = expressions_in(constant)[0].tree.span
        return scope.mistake("BB058", "a draw in a constant cannot depend on the generation", span)


class _DrawsWithGenerationError(Exception):
    pass


def _draw(node: Node, operands: list[Node], key: int, graph: Graph) -> Node:
    if node.operation != "draw":
        return node
    if not all(operand.literal for operand in operands):
        raise _DrawsWithGenerationError
    distribution, word = node.draw
    drawn = streams.DISTRIBUTIONS[distribution](key, word, *(value_of(operand) for operand in operands))
    return graph.truth(value=bool(drawn)) if node.kind is Kind.TRUTH else graph.number(drawn)


def _leaves(value: Plain, scalars: list[Node], graph: Graph) -> Plain:
    """Return the leaves by which a kernel reads a constant's scalars, and append those to `scalars`."""
    if isinstance(value, tuple):
        return tuple(_leaves(item, scalars, graph) for item in value)
    scalars.append(value)
    return (
        value
        if value.kind is Kind.UNKNOWN
        else graph.leaf("constant", len(scalars) - 1, Kind.NUMBER, Level.CALL)
    )
