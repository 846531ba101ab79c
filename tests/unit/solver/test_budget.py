"""The automatic budget grows with the number of designs, up to a limit."""

from types import SimpleNamespace

import pytest

from bbsd.solver.budget import LEAST, MOST, automatic_budget


@pytest.mark.parametrize(
    ("decades", "budget"), [(0.0, LEAST), (8.0, 400_000), (8.1, 400_000), (8.5, 410_000), (131.0, MOST)]
)
def test_it_follows_from_the_number_of_designs(decades, budget):
    assert automatic_budget(SimpleNamespace(decades=decades)) == budget
