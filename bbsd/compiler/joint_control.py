"""A spec's robots without its behaviors: one table over the joint partition says which action controls, or nobody's.

Whatever behaviors and layers can do, one such table can. Episodes, their random streams and the numbers of the actions
are those of the spec: a design and the joint table of its choices earn the same, to the bit.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from bbsd.compiler.joint import joint_partition
from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import Literal
from bbsd.language.meaning.behaviors import Module
from bbsd.language.meaning.partitions import TRUTH_CELLS
from bbsd.language.meaning.structure import Structure
from bbsd.language.meaning.tables.table import OPEN_CELL, Table

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from bbsd.compiler.joint import JointDigit, JointPartition
    from bbsd.compiler.problem import Problem
    from bbsd.expression.graph import Node
    from bbsd.language.meaning import Meaning
    from bbsd.language.meaning.tables.labels import Labels

NAME = "joint"


@dataclass(frozen=True)
class JointControl:
    """The joint partition of a problem, and what its behaviors see of each joint cell."""

    problem: Problem

    @cached_property
    def partition(self) -> JointPartition:
        """The joint partition."""
        return joint_partition(self.problem.meaning.episode.modules)

    @property
    def n_choices(self) -> int:
        """How many choices a joint cell has: every action of every behavior, and nobody's."""
        return 1 + sum(table.n_actions for table in self.problem.tables)

    @cached_property
    def first_actions(self) -> NDArray[np.int64]:
        """The number of the joint choice before each behavior's first action, (n_behaviors,)."""
        return np.cumsum([0, *(table.n_actions for table in self.problem.tables)])[:-1]

    @cached_property
    def joint_problem(self) -> Problem:
        """The problem with one behavior, which has all actions and a cell for every joint cell."""
        return self.problem.with_meaning(_joint_meaning(self.problem.meaning, self.partition))

    @cached_property
    def _digits(self) -> list[NDArray[np.int64]]:
        """The value of each digit in every joint cell."""
        sizes = [digit.size for digit in self.partition.digits]
        cells = np.arange(int(np.prod(sizes, dtype=np.int64)))
        return list(np.unravel_index(cells, sizes)) if sizes else []

    @cached_property
    def cells(self) -> NDArray[np.int64]:
        """The cell of each behavior in every joint cell, (n_behaviors, n_joint_cells)."""
        modules = self.problem.meaning.episode.modules
        cells = np.zeros((len(modules), self.partition.n_cells), np.int64)
        for behavior, module in enumerate(modules):
            for place, labels in enumerate(module.inputs.values()):
                values = self._values([robot[place] for robot in module.cells])
                cells[behavior] = cells[behavior] * len(labels) + values
        return cells

    @cached_property
    def excited(self) -> NDArray[np.bool_]:
        """Whether each behavior is excited in every joint cell, (n_behaviors, n_joint_cells)."""
        modules = self.problem.meaning.episode.modules
        return np.stack(
            [np.broadcast_to(self._values(module.excited), self.partition.n_cells) > 0 for module in modules]
        )

    def _values(self, nodes: Sequence[Node]) -> NDArray[np.int64]:
        """Return what a value that every robot has comes to in every joint cell, given its nodes by robot."""
        if nodes[0].literal and len(set(nodes)) == 1:
            return np.full(self.partition.n_cells, int(nodes[0].holding(Literal).value))
        numbers = tuple(node.number for node in nodes)
        modules = self.problem.meaning.episode.modules
        for digit, values in zip(self.partition.digits, self._digits, strict=True):
            if numbers == tuple(digit.node(modules, robot).number for robot in range(len(nodes))):
                return values
        raise KeyError(numbers)

    def controls(self, table: NDArray[np.uint8], structure: NDArray[np.int64]) -> NDArray[np.uint8]:
        """Return the joint choice of a design in every joint cell, (n_joint_cells,).

        Args:
            table: the cells of all behaviors one after the other.
            structure: lowest layer first.
        """
        first_cells = np.cumsum([0, *(shape.n_cells for shape in self.problem.tables)])[:-1]
        joint_choices = np.zeros(self.partition.n_cells, np.int64)
        for behavior in structure:
            choices = table[first_cells[behavior] + self.cells[behavior]].astype(np.int64)
            acts = self.excited[behavior] & (choices > 0)
            joint_choices = np.where(acts, self.first_actions[behavior] + choices, joint_choices)
        return joint_choices.astype(np.uint8)

    @cached_property
    def possible(self) -> NDArray[np.bool_]:
        """Which joint choices behaviors could make in each joint cell, (n_joint_cells, n_choices): those excited."""
        possible = np.ones((self.partition.n_cells, self.n_choices), np.bool_)
        for behavior, shape in enumerate(self.problem.tables):
            first = int(self.first_actions[behavior]) + 1
            excited = self.excited[behavior] & self.problem.meaning.structure.may_hold(behavior)
            possible[:, first : first + shape.n_actions] = excited[:, np.newaxis]
        return possible


def _joint_meaning(meaning: Meaning, partition: JointPartition) -> Meaning:
    modules, graph = meaning.episode.modules, meaning.graph
    robots = range(len(modules[0].cells))

    def labels(digit: JointDigit) -> Labels:
        inputs = list(modules[digit.behavior].inputs.values())
        return TRUTH_CELLS if digit.place is None else inputs[digit.place]

    def cell(digit: JointDigit, robot: int) -> Node:
        node = digit.node(modules, robot)
        return graph.apply("cell_of", node) if node.kind is Kind.TRUTH else node

    joint = Module(
        NAME,
        {str(number): labels(digit) for number, digit in enumerate(partition.digits)},
        tuple(tuple(cell(digit, robot) for digit in partition.digits) for robot in robots),
        tuple(graph.truth(value=True) for _ in robots),
        {
            f"{module.name} {action}": values
            for module in modules
            for action, values in module.actions.items()
        },
        Table(bytes([OPEN_CELL] * partition.n_cells)),
    )
    episode = replace(meaning.episode, modules=(joint,), expects={})
    return replace(meaning, episode=episode, structure=Structure((0,), ()))
