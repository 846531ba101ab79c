"""The automatic budget grows with the number of designs, up to a limit."""

from types import SimpleNamespace

import pytest

from bbsd.solver.budget import LEAST, MOST, automatic_budget


@pytest.mark.parametrize(
    ("decades", "budget"), [(0.0, LEAST), (8.0, 400_000), (8.1, 400_000), (8.5, 410_000), (131.0, MOST)]
)
def test_it_follows_from_the_number_of_designs(decades, budget):
    assert automatic_budget(SimpleNamespace(decades=decades, is_stepped=False)) == budget


@pytest.mark.parametrize(
    ("steps", "robots", "budget"),
    [(500, 1, 10_000), (250, 1, 20_000), (25, 3, 70_000), (10_000, 4, 10_000), (5, 1, 200_000)],
)
def test_in_python_it_is_bounded_by_steps_but_by_no_clock(steps, robots, budget):
    environment = SimpleNamespace(steps=steps, robots=robots)
    meaning = SimpleNamespace(spec=SimpleNamespace(environment=environment))
    assert automatic_budget(SimpleNamespace(decades=0.0, is_stepped=True, meaning=meaning)) == budget
