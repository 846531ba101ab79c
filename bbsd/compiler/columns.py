"""Columns of numbers behind the constants of a spec, which a kernel reads at an index."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from bbsd.expression.graph import Graph, Node, value_of

if TYPE_CHECKING:
    from bbsd.language.meaning.naming.constants import Constants

Numbers = npt.NDArray[np.float64 | np.int64 | np.bool_]
Reader = Callable[[Node], Node]
"""Returns the element of a column at an index."""


class Columns:
    """Columns that are added to the constants of a spec."""

    def __init__(self, graph: Graph, constants: Constants) -> None:
        self._graph, self._constants = graph, constants
        self._added: list[Node] = []

    def read(self, column: Numbers, index: Node) -> Node:
        """Return the element of a column at an index; a literal where all are the same."""
        nodes = self._numbers(column)
        return nodes[0] if all(node is nodes[0] for node in nodes) else self._add(nodes)(index)

    def reader(self, column: Numbers) -> Reader:
        """Return a column that is read at several indices."""
        return self._add(self._numbers(column))

    def _numbers(self, column: Numbers) -> list[Node]:
        return [self._graph.number(value) for value in column.ravel().tolist()]

    def _add(self, nodes: list[Node]) -> Reader:
        base = len(self._constants.scalars) + len(self._added)
        self._added += nodes
        return lambda index: self._graph.gather(base, (1,), (len(nodes),), (index,))

    @property
    def constants(self) -> Constants:
        """The constants, and what was added."""
        scalars = (*self._constants.scalars, *self._added)
        wholes = (*self._constants.wholes, *(value_of(node).is_integer() for node in self._added))
        return replace(self._constants, scalars=scalars, wholes=wholes)
