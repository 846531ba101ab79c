"""Remainders by a division, beside those of all numbers."""

import numpy as np
import pytest

from bbsd.compiler.details import Detail
from bbsd.compiler.kernels import kernel_source
from tests.unit.problems import lived, problem_of

SPEC = """
bbsd: 1
name: turning
environment:
  robots: {robots}
  steps: 40
  state: {{x: "uniform(-2, 2)", size: 3, angle: 0}}
  dynamics: {{x: "{x}", angle: "{angle}"}}
behaviors:
  go: {{actions: {{on: {{size: 5}}, off: {{size: 3}}}}}}
reward: {{turned: angle}}
"""


def turning(x="x + 2", angle="(angle + x) % 360", robots=2, **options):
    return problem_of(SPEC.format(x=x, angle=angle, robots=robots), **options)


def moduli(problem):
    source = kernel_source(problem.meaning, problem.tables, problem.lanes, (Detail.TERMS,))
    return source.count("quick_modulo("), source.replace("quick_modulo(", "").count("modulo(")


@pytest.mark.parametrize(
    ("parts", "quick", "of_all"),
    [
        ({}, 1, 0),
        ({"angle": "(angle + x) % size"}, 1, 0),
        ({"x": "x * 2"}, 0, 1),
        ({"angle": "x % (size - 4)"}, 0, 1),
        ({"angle": "x % 1e-300"}, 0, 1),
        ({"angle": "x % (x % 3)"}, 1, 1),
    ],
)
def test_a_remainder_is_quick_where_its_quotient_is_certainly_small(parts, quick, of_all):
    counted = moduli(turning(robots=1, **parts))
    assert counted[0] > 0 if quick else counted[0] == 0
    assert counted[1] > 0 if of_all else counted[1] == 0


@pytest.mark.slow
@pytest.mark.parametrize(
    ("x", "robots"), [("x + 2", 1), ("x * 1e7", 2), ("x * 1e7 if robot > 0 else x + 1", 9)]
)
def test_compiled_episodes_have_the_remainders_of_plain_ones(x, robots):
    parts = {"x": x, "angle": "(angle + x) % 360 + x % -7", "robots": robots, "lanes": 16}
    compiled, plain = (lived(turning(**parts, compiled=compiled), 16) for compiled in (True, False))
    np.testing.assert_array_equal(compiled.returns, plain.returns)
    assert np.isfinite(plain.returns).all()
    assert (plain.not_finite == 0).all()
