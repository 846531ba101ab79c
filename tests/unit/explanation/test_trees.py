from itertools import product

import numpy as np
import pytest

from bbsd.explanation import tree_text
from bbsd.explanation.trees import tree_of
from tests.unit.explanation.test_layers import LARGE, UPPER_NEAR, explained


def decision(tree, cell):
    while tree.branches:
        tree = next(branch.tree for branch in tree.branches if cell[tree.axis] in branch.cells)
    return tree.decision


@pytest.mark.parametrize("number", range(60))
def test_a_tree_decides_as_the_table_does(number):
    rng = np.random.default_rng(number)
    sizes = rng.integers(1, 5, rng.integers(1, 4))
    table = rng.integers(-1, 3, sizes)
    tree = tree_of(table)
    for cell in product(*map(range, sizes)):
        assert table[cell] in (-1, decision(tree, cell))


def test_a_tree_looks_first_at_what_tells_most():
    table = np.array([[0, 0, 0], [1, 1, 2]])
    tree = tree_of(table)
    assert (tree.axis, tree.leaves) == (0, 3)


def test_the_tree_of_each_layer_is_drawn():
    explanation = explained(UPPER_NEAR, [[0, 0, 2, 0, 1, 1], [0, 0]], [0, 1])
    assert tree_text(explanation) == (
        "2  upper\n   no action\n\n"
        "1  lower\n"
        "   |- pace 0: no action\n"
        "   |- pace 1\n"
        "   |  |- near does not hold: no action\n"
        "   |  `- near holds: a\n"
        "   `- pace 2\n"
        "      |- near does not hold: b\n"
        "      `- near holds: a\n\n"
        "no action in any layer: nobody controls, and commands stay\n"
    )


def test_a_table_that_is_too_large_is_said_to_be():
    assert "a table of 1,000 cells" not in tree_text(explained(LARGE, [[1] * 1000, [1] * 1000], [0, 1]))
