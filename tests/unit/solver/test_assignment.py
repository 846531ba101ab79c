from itertools import permutations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from bbsd.solver.assignment import assign

SIZES = st.tuples(st.integers(0, 4), st.integers(0, 2)).map(lambda size: (size[0], size[0] + size[1]))
COSTS = st.one_of(st.integers(-3, 3).map(float), st.floats(-1e6, 1e6))


@st.composite
def cost_tables(draw):
    n_rows, n_columns = draw(SIZES)
    cells = draw(st.lists(COSTS, min_size=n_rows * n_columns, max_size=n_rows * n_columns))
    return np.array(cells).reshape(n_rows, n_columns)


def cost_of(costs, columns):
    return sum(costs[row, column] for row, column in enumerate(columns))


def test_a_cheap_column_goes_to_the_row_that_needs_it_most():
    # Both rows like column 0 best: 1 + 9 = 10 one way, 2 + 3 = 5 the other.
    np.testing.assert_array_equal(assign(np.array([[1.0, 3.0], [2.0, 9.0]])), [1, 0])


def test_columns_may_be_left_over():
    # Rows take columns 2 and 0: 1 + 2 = 3.
    np.testing.assert_array_equal(assign(np.array([[5.0, 4.0, 1.0], [2.0, 7.0, 1.0]])), [2, 0])


@given(cost_tables())
def test_no_assignment_is_cheaper_and_no_column_is_used_twice(costs):
    columns = assign(costs)
    n_rows, n_columns = costs.shape
    assert len(set(columns.tolist())) == n_rows
    least = min(cost_of(costs, some) for some in permutations(range(n_columns), n_rows))
    slack = 1e-12 * max(1.0, np.abs(costs).sum())  # of rounding, in prices and sums
    assert cost_of(costs, columns) <= least + slack


def test_costs_that_are_not_numbers_end_too():
    with np.errstate(invalid="ignore"):  # plain Python says what compiled code passes over
        assert assign(np.full((3, 3), np.nan)).shape == (3,)
        assert assign(np.array([[np.nan, 1.0], [np.inf, -np.inf]])).shape == (2,)
