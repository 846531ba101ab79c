"""Passes run in their order, each for its rollouts, and once for rollouts that begin alike."""

import pytest

from bbsd.compiler.details import Detail
from bbsd.compiler.kernels import kernel_source
from bbsd.compiler.passes.pipeline import Pass, Program, pipeline, run_passes
from bbsd.compiler.writing.source import module_source
from tests.unit.architecture.designs import meaning_of, shipped
from tests.unit.compiler.robots import moving
from tests.unit.problems import problem_of

MEANING = meaning_of(shipped("object_lifting"))


def noting(name, calls, details=frozenset(Detail)):
    """A pass that notes that it was called and gives a new program."""

    def rewrite(program):
        calls.append(name)
        return Program(program.meaning, program.to_prove)

    return Pass(name, rewrite, details, "to see it")


def test_passes_run_in_order_and_once_for_rollouts_that_begin_alike():
    calls = []
    both = frozenset({Detail.CREDIT, Detail.TERMS})
    passes = (
        noting("all", calls),
        noting("two", calls, both),
        noting("one", calls, frozenset({Detail.TERMS})),
    )
    programs = run_passes(MEANING, tuple(Detail), passes)
    assert calls == ["all", "two", "one"]
    assert list(programs) == list(Detail)
    assert len(set(map(id, programs.values()))) == 3


def test_rollouts_that_are_not_asked_for_cost_nothing():
    calls = []
    run_passes(MEANING, (Detail.TRACE,), (noting("one", calls, frozenset({Detail.TERMS})),))
    assert calls == []


def test_without_passes_a_program_is_the_spec_s_own_graph():
    (program,) = run_passes(MEANING, (Detail.CREDIT,), ()).values()
    assert program == Program(MEANING)


@pytest.mark.parametrize("left_out", range(4))
def test_each_pass_is_optional_and_says_why_it_is_there(left_out):
    """A kernel without one pass is another text, and without any the longest."""
    spec = "grid_world" if left_out == 0 else "object_lifting"
    problem = problem_of(shipped(spec)) if left_out != 2 else moving(robots=6)
    passes = [step for place, step in enumerate(pipeline()) if place != left_out]
    assert pipeline()[left_out].why
    programs = run_passes(problem.meaning, (Detail.CREDIT,), passes)
    source = module_source(programs, problem.tables, 4)
    assert source != kernel_source(problem.meaning, problem.tables, 4, (Detail.CREDIT,))


def test_only_the_rollout_for_lifetimes_has_something_to_prove():
    programs = run_passes(MEANING, tuple(Detail))
    assert {detail for detail, program in programs.items() if program.to_prove} == {Detail.CREDIT}
