"""That cutting long sums and loops into short ones changes no bit of what an episode comes to."""

from itertools import takewhile

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from bbsd.compiler import compile_meaning
from bbsd.compiler.details import Detail
from bbsd.compiler.kernels import kernel_source
from bbsd.compiler.writing import loop_fission, parts, totals
from tests.interpreter.made_up import specs
from tests.interpreter.made_up_meanings import meaning_made_up
from tests.unit.compiler.robots import bits
from tests.unit.problems import RICH, problem_of

LIMITS = (
    (totals, "MOST_TERMS", 1), (parts, "LONGEST_ONCE", 1), (loop_fission, "LONGEST_ONCE", 1),
    (loop_fission, "LONGEST_LOOP", 2),
)  # fmt: skip


def cut_bits(problem, seed):
    """The bits of episodes in which everything that can be cut is cut."""
    with pytest.MonkeyPatch.context() as patch:
        for module, name, limit in LIMITS:
            patch.setattr(module, name, limit)
        return bits(problem(), 3, seed)


@pytest.mark.slow
@settings(max_examples=10, deadline=None, suppress_health_check=list(HealthCheck))
@given(specs(most_robots=5), st.integers(0, 2**32), st.sampled_from([1, 2]))
def test_cutting_changes_no_bit_of_specs_that_are_made_up(data, seed, lanes):
    meaning = meaning_made_up(data, seed)

    def problem():
        return compile_meaning(meaning, lanes=lanes, compiled=False)

    assert cut_bits(problem, seed) == bits(problem(), 3, seed)


@pytest.mark.parametrize("compiled", [False, True])
def test_cutting_changes_no_bit(compiled):
    def problem():
        return problem_of(RICH, lanes=2, compiled=compiled)

    assert cut_bits(problem, 7) == bits(problem(), 3, 7)


def source_with_terms(n_terms):
    terms = "".join(f"  t{k}: {k} if x > 0.{k} else x * {k}\n" for k in range(n_terms))
    head, _, _ = RICH.partition("reward:\n")
    problem = problem_of(f"{head}reward:\n{terms}")
    return kernel_source(problem.meaning, problem.tables, 4, (Detail.CREDIT, Detail.TERMS))


def length_of_loop(lines):
    """The number of lines in the loop that begins these lines."""
    depth = len(lines[0]) - len(lines[0].lstrip())
    return len([*takewhile(lambda line: line.startswith(" " * (depth + 1)), lines[1:])])


def test_no_line_and_no_loop_grows_with_the_number_of_terms():
    few, many = (source_with_terms(n).splitlines() for n in (100, 400))
    assert max(map(len, many)) < 1.2 * max(map(len, few))
    loops = [many[i:] for i, line in enumerate(many) if line.endswith("for lane in range(4):")]
    assert max(map(length_of_loop, loops)) <= loop_fission.LONGEST_ONCE
