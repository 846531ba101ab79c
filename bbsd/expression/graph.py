"""What expressions mean, as a graph of scalar operations in which every distinct value stands once.

Lists, generators, definitions and robots are unrolled while the graph is made, so a node is always one
number, one truth or one cell index for one robot. Operations on literals are
carried out at once, with the functions that the kernel uses.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import IntEnum
from math import frexp
from typing import TYPE_CHECKING, Any, TypeVar

from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import Draw, Gather, Literal, NodeData, Slot
from bbsd.expression.operations import OPERATIONS

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable, Iterable, Sequence

T = TypeVar("T")
Data = TypeVar("Data", bound=NodeData)

MAX_NODES = 100_000
"""The most nodes of a spec's graph (decision 2, a graph of scalar values)."""
MAX_WORK = 500_000
"""The most units of work: a node asked for, even one that exists, is one; `EXPRESSION_WORK` and others come on top."""


class Level(IntEnum):
    """How often a value changes: each level is computed outside the loops of the next.

    The last three are only where a kernel loops over robots (`compiler.passes.families`): ROBOT changes from robot to
    robot but not from lane to lane, EACH changes with both, PAIR also with the robot looked at.
    """

    CALL = 0
    STEP = 1
    LANE = 2
    ROBOT = 3
    EACH = 4
    PAIR = 5


@dataclass(frozen=True, eq=False, slots=True)
class Node:
    """One value, equal only to itself; the numbers of nodes follow their order of creation, operands first."""

    number: int
    operation: str
    operands: tuple[Node, ...]
    data: NodeData
    kind: Kind
    level: Level

    @property
    def literal(self) -> bool:
        """Whether the value is written in the node itself."""
        return self.operation == "literal"

    @property
    def slot(self) -> Slot:
        """What is read. Raises TypeError where the node reads no slot."""
        return self.holding(Slot)

    @property
    def draw(self) -> Draw:
        """What is drawn. Raises TypeError where the node is no draw."""
        return self.holding(Draw)

    @property
    def gather(self) -> Gather:
        """Which element of the constants is read. Raises TypeError where the node is no gather."""
        return self.holding(Gather)

    @property
    def index(self) -> int:
        """Which constant, robot or fold the node is about. Raises TypeError where it is about none."""
        return self.holding(int)

    def read(self, constants: Sequence[T], indices: Sequence[float]) -> T:
        """Return the value of a constant or a gather, given all constants. Raises TypeError for other nodes."""
        return constants[self.index] if self.operation == "constant" else self.gather.read(constants, indices)

    def holding(self, data_type: type[Data]) -> Data:
        """Return the data, narrowed to their type. Raises TypeError where they are of another one."""
        if not isinstance(self.data, data_type):
            raise TypeError(f"the data of {self.operation} are no {data_type.__name__}: {self.data!r}")
        return self.data


LEAVES = frozenset({"slot", "constant", "step", "start", "draw", "gather", "choice", "outside"})
"""Operations whose values come from outside the graph; draws and gathers also have operands."""


class GraphTooLargeError(Exception):
    """A spec that unrolls to more values than are allowed."""


@dataclass(slots=True)
class Graph:
    """The nodes of a spec, each distinct one once."""

    nodes: dict[tuple[Hashable, ...], Node] = field(default_factory=dict)
    work: int = 0
    first: int = 0
    """The number of the first node."""
    bounded: bool = True
    """Whether nodes and work are limited, as they are for a spec; not so for what the compiler makes of its graph."""

    def number(self, value: float) -> Node:
        """Return a literal number; zeros of both signs are different literals."""
        return self.make("literal", (), Literal(float(value), str(float(value))), Kind.NUMBER, Level.CALL)

    def truth(self, *, value: bool) -> Node:
        """Return a literal truth."""
        return self.make("literal", (), Literal(bool(value), "truth"), Kind.TRUTH, Level.CALL)

    def cell(self, value: int) -> Node:
        """Return a literal cell index."""
        return self.make("literal", (), Literal(int(value), "cell"), Kind.CELL, Level.CALL)

    @property
    def unknown(self) -> Node:
        """The value of what could not be understood."""
        return self.make("unknown", (), None, Kind.UNKNOWN, Level.CALL)

    def leaf(self, operation: str, data: NodeData, kind: Kind, level: Level) -> Node:
        """Return a value that comes from outside the graph: a slot that is read, a constant, the step."""
        return self.make(operation, (), data, kind, level)

    def draw(self, distribution: str, word: int, operands: tuple[Node, ...]) -> Node:
        """Return a draw; `word` names its place in the spec, robot and element, so no two draws are the same node."""
        return self.make("draw", operands, Draw(distribution, word), _kind_drawn(distribution), Level.LANE)

    def gather(
        self, base: int, strides: tuple[int, ...], lengths: tuple[int, ...], indices: tuple[Node, ...]
    ) -> Node:
        """Return the constant at `base + sum(stride * index)`, each index clamped to its length."""
        return self.make("gather", indices, Gather(base, strides, lengths), Kind.NUMBER, _highest(indices))

    def copy(self, node: Node, operands: Sequence[Node]) -> Node:
        """Return the operation of a node on new operands, of which literals are computed at once."""
        match node.data:
            case Draw(distribution, word):
                return self.draw(distribution, word, tuple(operands))
            case Gather(base, strides, lengths):
                return self.gather(base, strides, lengths, tuple(operands))
        if node.operands:
            return self.apply(node.operation, *operands, data=node.data)
        return self.make(node.operation, (), node.data, node.kind, node.level)

    def apply(self, operation: str, *operands: Node, data: NodeData = None) -> Node:
        """Return an operation on nodes, simplified; it is computed at once if all operands are literals."""
        if any(node.kind is Kind.UNKNOWN for node in operands):
            return self.unknown
        simpler = self._simplified(operation, operands)
        if simpler is not None:
            return simpler
        kind = _kind_of(operation, operands)
        if all(node.literal for node in operands):
            return self._literal(compute(operation, [value_of(node) for node in operands], data), kind)
        return self.make(operation, operands, data, kind, _highest(operands))

    def fold(self, operation: str, nodes: Iterable[Node]) -> Node:
        """Join nodes from left to right by a binary operation."""
        joined, *rest = nodes
        for node in rest:
            joined = self.apply(operation, joined, node)
        return joined

    def fork(self) -> Graph:
        """Return a graph that begins with the same nodes; new nodes of the two have different numbers."""
        return Graph(dict(self.nodes), self.work, self.first + MAX_NODES)

    def spend(self, work: int) -> None:
        """Count work. Raises GraphTooLargeError where the graph is bounded and its work or nodes are too many."""
        self.work += work
        if self.bounded and (self.work > MAX_WORK or len(self.nodes) >= MAX_NODES):
            raise GraphTooLargeError

    def _simplified(self, operation: str, operands: tuple[Node, ...]) -> Node | None:
        match operation, operands:
            case "divide", (dividend, divisor) if divisor.literal and not dividend.literal:
                reciprocal = _exact_reciprocal(value_of(divisor))
                return None if reciprocal is None else self.apply("*", dividend, self.number(reciprocal))
            case "select", (condition, then, otherwise) if condition.literal:
                return then if value_of(condition) else otherwise
            case "select", (_, then, otherwise) if then is otherwise:
                return then
            case "&" | "|", (left, right) if left.literal or right.literal:
                literal, other = (left, right) if left.literal else (right, left)
                return other if bool(value_of(literal)) == (operation == "&") else literal
        return None

    def _literal(self, value: float | bool, kind: Kind) -> Node:
        match kind:
            case Kind.TRUTH:
                return self.truth(value=bool(value))
            case Kind.CELL:
                return self.cell(int(value))
            case _:
                return self.number(value)

    def make(
        self, operation: str, operands: tuple[Node, ...], data: NodeData, kind: Kind, level: Level
    ) -> Node:
        """Return the node of an operation, operands and data: the existing one, or a new one."""
        key = (operation, kind, data, *[node.number for node in operands])
        self.spend(1)
        node = self.nodes.get(key)
        if node is None:
            node = Node(self.first + len(self.nodes), operation, operands, data, kind, level)
            self.nodes[key] = node
        return node


def _exact_reciprocal(divisor: float) -> float | None:
    """Return the reciprocal of a power of two, by which multiplying gives the same bits; None for other numbers."""
    fraction, exponent = frexp(divisor)
    return 1.0 / divisor if abs(fraction) == 0.5 and abs(exponent) < 1000 else None


def value_of(node: Node) -> float:
    """Return the value of a literal: a number, a truth or a cell index."""
    return node.holding(Literal).value


def _highest(nodes: tuple[Node, ...]) -> Level:
    levels = {node.level for node in nodes}
    return Level.EACH if {Level.LANE, Level.ROBOT} <= levels else max(levels, default=Level.CALL)


def _kind_drawn(distribution: str) -> Kind:
    return Kind.TRUTH if distribution == "chance" else Kind.NUMBER


def _kind_of(operation: str, operands: tuple[Node, ...]) -> Kind:
    kind = OPERATIONS[operation].kind
    return operands[kind].kind if isinstance(kind, int) else kind


def compute(operation: str, operands: Sequence[Any], data: NodeData = None) -> Any:  # noqa: ANN401 - a number, a truth or a cell index
    """Return the value of an operation on plain numbers and truths."""
    function = OPERATIONS[operation].compute
    return function(*operands) if data is None else function(*operands, data)


def needed(outputs: Iterable[Node]) -> list[Node]:
    """Return the outputs and all nodes that they depend on, operands first."""
    nodes: dict[int, Node] = {}
    waiting = list(outputs)
    while waiting:
        node = waiting.pop()
        number = node.number
        if number not in nodes:
            nodes[number] = node
            waiting += node.operands
    return [nodes[number] for number in sorted(nodes)]


def evaluate(outputs: Iterable[Node], leaf: Callable[[Node, list[Any]], Any]) -> list[Any]:
    """Return the values of nodes; `leaf` gives the values of leaves, from those of their operands if they have any."""
    outputs = list(outputs)
    values: dict[int, Any] = {}
    for node in needed(outputs):
        operands = [values[operand.number] for operand in node.operands]
        if node.literal:
            values[node.number] = value_of(node)
        elif node.operation in LEAVES:
            values[node.number] = leaf(node, operands)
        else:
            values[node.number] = compute(node.operation, operands, node.data)
    return [values[node.number] for node in outputs]


def replace_leaves(output: Node, graph: Graph, leaf: Callable[[Node, list[Node]], Node]) -> Node:
    """Return a value with every leaf replaced by what `leaf` gives for it and its operands, themselves replaced."""
    new: dict[int, Node] = {}
    for node in needed([output]):
        operands = [new[operand.number] for operand in node.operands]
        if node.literal or node.kind is Kind.UNKNOWN:
            new[node.number] = node
        elif node.operation in LEAVES:
            new[node.number] = leaf(node, operands)
        else:
            new[node.number] = graph.copy(node, operands)
    return new[output.number]
