"""Between which numbers values lie: proven by hand, and never left by episodes of made-up specs."""

import numpy as np
import pytest
from hypothesis import given, reject
from hypothesis import strategies as st

from bbsd.compiler.passes.ranges import ranges_of
from bbsd.errors import SpecError
from bbsd.evaluation.tracing.tracing import trace
from bbsd.expression.node_data import Slot
from tests.unit.architecture.designs import meaning_of, random_architecture
from tests.unit.problems import problem_of

SPEC = """
bbsd: 1
name: ranges
constants: {{four: 4, sizes: [2, 3.5, -1]}}
environment:
  robots: {robots}
  steps: 50
  state: {{x: "{start}", speed: "uniform(-1, 1)", y: 0}}
  dynamics: {{x: "{x}", speed: "{speed}", y: "{y}"}}
behaviors:
  go: {{actions: {{on: {{speed: speed}}, off: {{speed: 0}}}}}}
reward: {{earned: "1"}}
"""


def spec(start="uniform(-2, 2)", x="x", speed="speed", y="y", robots=1):
    return SPEC.format(start=start, x=x, speed=speed, y=y, robots=robots)


def range_of(name="x", **parts):
    meaning = meaning_of(spec(**parts))
    node = meaning.episode.after[Slot(name, 0)]
    return ranges_of(meaning, [node])[node.number]


@pytest.mark.parametrize(
    ("x", "low", "high"),
    [
        ("max(min(x * 3, 7), -5)", -5, 7),
        ("min(max(x ** 3, -5), four)", -5, 4),
        ("(x + 1) % 4", 0, 4),
        ("(x - 100) % -360", -360, 0),
        ("sizes[step % 3]", -1, 3.5),
        ("step / 10", 0, 5),
        ("floor(sin(x) * 10)", -20, 20),
        ("0 if x > 1 else x / 2", -2, 2),
        ("abs(sign(x)) - 3", -3, -2),
        ("sqrt(abs(min(max(4 * x, -9), 4)))", 0, 3),
    ],
)
def test_values_that_are_held_back_lie_between_their_bounds(x, low, high):
    known = range_of(x=x)
    assert known.low == pytest.approx(low, rel=1e-6)
    assert known.high == pytest.approx(high, rel=1e-6)


def test_a_clamp_of_what_may_be_no_number_bounds_only_what_it_does():
    assert range_of(x="min(x * x, 5)").high == 5
    assert range_of(x="min(5, x * x)").high == 5
    known = range_of(x="max(min(5, x / y), -1)")  # NaN where both are 0: min gives 5 then
    assert (known.low, known.high) == (-1, 5)
    assert range_of(x="min(min(max(y, 0), 1) * 0 + 5, x / y)").high == 5


@pytest.mark.parametrize(
    ("parts", "most"),
    [
        ({"x": "x + 3"}, 2 + 50 * 3),
        ({"x": "x + speed", "speed": "min(max(speed * 2, -4), 4)"}, 2 + 50 * 4),
        ({"x": "max(x - 2, -1000)"}, 1000 + 49 * 2),
        ({"x": "x + speed", "speed": "speed + 1"}, 2 + 50 * 51),
        ({"x": "0.999 * x + 1 if x > y else floor(x)"}, 2 + 50),
        ({"x": "x + 1", "robots": 3}, 2 + 50),
    ],
)
def test_what_grows_by_so_much_in_a_step_is_bounded_by_the_steps(parts, most):
    known = range_of(**parts)
    assert known.is_known
    assert most <= known.size <= 1.1 * most + 10


@pytest.mark.parametrize(
    "x", ["x * 2", "x * x", "x + x", "1 / x", "x ** 0.5 + x / y", "exp(x)", "log(x) + x"]
)
def test_of_what_grows_faster_nothing_is_known(x):
    assert not range_of(x=x).is_known


EXPRESSIONS = st.recursive(
    st.sampled_from(["x", "y", "speed", "four", "step", "1.5", "-2", "0", "sizes[1]", "uniform(-1, 3)"]),
    lambda inner: st.one_of(
        st.tuples(inner, st.sampled_from([" + ", " - ", " * ", " / ", " // ", " % "]), inner).map("".join),
        st.builds("({})".format, inner),
        st.builds("{}({})".format, st.sampled_from(["floor", "sin", "abs", "sqrt", "exp", "sign"]), inner),
        st.builds("{}({}, {})".format, st.sampled_from(["min", "max", "hypot"]), inner, inner),
        st.builds("({} if {} > {} else {})".format, inner, inner, inner, inner),
    ),
    max_leaves=8,
)


@given(EXPRESSIONS, EXPRESSIONS, EXPRESSIONS)
def test_episodes_stay_between_their_bounds(x, speed, y):
    try:
        problem = problem_of(spec(x=x, speed=speed, y=y))
    except SpecError:  # a number that is none, of literals
        reject()
    after = problem.meaning.episode.after
    known = ranges_of(problem.meaning, after.values())
    for slot, values in trace(problem, random_architecture(problem.meaning, 1), 1, 1).values.items():
        bounds, numbers = known[after[slot].number], np.array(values, float)
        assert bounds.may_be_nan or not np.isnan(numbers).any(), slot
        numbers = numbers[~np.isnan(numbers)]
        assert (bounds.low <= numbers).all(), slot
        assert (numbers <= bounds.high).all(), slot
