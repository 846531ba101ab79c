"""Decision trees of behaviors as text: which input to look at first, and what then."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bbsd.architecture.rules import cell_words
from bbsd.errors import escape
from bbsd.language.meaning.partitions import TRUTH_CELLS

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from numpy.typing import NDArray

    from bbsd.explanation.words import Explanation, InputInWords, LayerInWords

    Decisions = NDArray[np.int64]
    """The number of the decision in each cell, -1 where any will do; a dimension for each input."""

MOST_CELLS = 20_000
"""Cells of a table of which a tree is made."""


@dataclass(frozen=True, slots=True)
class Branch:
    """The subtree for some cells of the input that a tree looks at."""

    cells: tuple[int, ...]
    tree: Tree


@dataclass(frozen=True, slots=True)
class Tree:
    """A decision, or an input to look at and a branch for its cells."""

    decision: int
    """The number of the decision; -1 where there are branches."""
    axis: int
    branches: tuple[Branch, ...]

    @property
    def leaves(self) -> int:
        """The number of decisions in it."""
        return sum(branch.tree.leaves for branch in self.branches) or 1


def tree_of(decisions: Decisions) -> Tree:
    """Return a small tree that decides each cell as given, found greedily.

    It first looks at the input that leaves the fewest different columns to tell apart; cells whose columns do not
    contradict each other share a branch.
    """
    counted = np.unique(decisions[decisions >= 0])
    if len(counted) <= 1:
        return Tree(int(counted[0]) if len(counted) else 0, -1, ())
    choices = [
        (axis, _merged(decisions, axis)) for axis in range(decisions.ndim) if decisions.shape[axis] > 1
    ]
    for axis, columns in choices:
        if len(columns) == 1:  # the input does not matter
            return tree_of(np.expand_dims(columns[0][1], axis))

    def mixed(choice: tuple[int, list[tuple[list[int], Decisions]]]) -> tuple[float, int]:
        return sum(_disorder(column) for _, column in choice[1]), len(choice[1])

    axis, columns = min(choices, key=mixed)
    branches = tuple(Branch(tuple(cells), tree_of(np.expand_dims(column, axis))) for cells, column in columns)
    return Tree(-1, axis, branches)


def _merged(decisions: Decisions, axis: int) -> list[tuple[list[int], Decisions]]:
    """Return the cells of an input in groups whose columns agree wherever both count, with the common column."""
    groups: list[tuple[list[int], Decisions]] = []
    for cell, column in enumerate(np.moveaxis(decisions, axis, 0)):
        for index, (cells, common) in enumerate(groups):
            if ((column == common) | (column < 0) | (common < 0)).all():
                groups[index] = ([*cells, cell], np.maximum(column, common))
                break
        else:
            groups.append(([cell], column))
    return groups


def _disorder(column: Decisions) -> float:
    """Return the entropy of the decisions in a column times their number, in bits."""
    counts = np.bincount(column[column >= 0])
    counts = counts[counts > 0]
    return float(-(counts * np.log2(counts / counts.sum())).sum()) if counts.size else 0.0


def tree_text(explanation: Explanation) -> str:
    """Return the tree of each layer, the highest first; it ends with a line break."""
    blocks = [_layer_lines(layer) for layer in explanation.layers]
    lowest = (
        ["no action in any layer: nobody controls, and commands stay"]
        if explanation.nobody_cells != 0
        else []
    )
    return "\n".join("\n".join(block) + "\n" for block in [*blocks, *([lowest] if lowest else [])])


def _layer_lines(layer: LayerInWords) -> list[str]:
    excited = "" if layer.excited is None else f", when {layer.excited}"
    head = escape(f"{layer.layer}  {layer.behavior}{excited}")
    if not layer.table or len(layer.table) > MOST_CELLS or any(not each.cells for each in layer.inputs):
        return [
            head,
            f"   a table of {sum(each.cells for each in layer.counted):,} cells, too large for a tree",
        ]
    words = list(dict.fromkeys(decision for decision in layer.table if decision))
    numbers = [words.index(decision) if decision else -1 for decision in layer.table]
    shape = tuple(len(each.cells) for each in layer.inputs)
    tree = tree_of(np.array(numbers, np.int64).reshape(shape))
    return [head, *_lines(tree, layer.inputs, words, "   ")]


def _lines(tree: Tree, inputs: Sequence[InputInWords], words: Sequence[str], indent: str) -> Iterator[str]:
    if not tree.branches:
        yield indent + escape(words[tree.decision])
        return
    name = escape(inputs[tree.axis].name)
    for index, branch in enumerate(tree.branches):
        is_last = index == len(tree.branches) - 1
        where = f"{name} {escape(_cells_text(branch.cells, inputs[tree.axis].cells))}"
        corner, below = ("`- ", "   ") if is_last else ("|- ", "|  ")
        if branch.tree.branches:
            yield f"{indent}{corner}{where}"
            yield from _lines(branch.tree, inputs, words, indent + below)
        else:
            yield f"{indent}{corner}{where}: {escape(words[branch.tree.decision])}"


def _cells_text(cells: Sequence[int], labels: tuple[str, ...]) -> str:
    if labels == TRUTH_CELLS:
        return "holds" if tuple(cells) == (1,) else "does not hold"
    return ", ".join(str(word) for word in cell_words(cells, labels))
