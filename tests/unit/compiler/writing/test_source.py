import pytest

from bbsd.compiler.details import Detail
from bbsd.compiler.kernels import kernel_source
from tests.unit.architecture.designs import shipped
from tests.unit.problems import RICH, lived, problem_of

GUARD = """
bbsd: 1
name: guard
constants:
  reach: 2
environment:
  robots: 2
  steps: 10
  state:
    x: uniform(0, 5)
    awake: "true"
  dynamics:
    x: x - 0.1 * step
  sensors:
    middle: mean(x[r] for r in team)
  ends: any(x[r] < 0 for r in team)
behaviors:
  wait:
    actions:
      stay:
        x: x
  come:
    excited: awake
    inputs:
      near: abs(x - middle) < reach
      place: values(floor(x), 0, 39)
    actions:
      nearer:
        x: 0.5 * (x + middle)
      sleep:
        awake: false
reward:
  close: -abs(x - middle)
"""

MANY_GUARDS = GUARD.replace("robots: 2", "robots: 8")


def source_of(problem, *details, lanes=8):
    return kernel_source(problem.meaning, problem.tables, lanes, details)


def without_title(source):
    """The source without its first line, which tells bbsd's version."""
    return source.partition("\n\n")[2]


def test_the_source_of_a_small_spec(golden):
    golden("compiler/guard.py", without_title(source_of(problem_of(GUARD), Detail.CREDIT)))


def test_the_source_of_an_evaluation_of_a_small_spec(golden):
    golden("compiler/guard_detailed.py", without_title(source_of(problem_of(GUARD), Detail.TERMS)))


def test_the_source_of_many_robots_loops_over_them(golden):
    golden("compiler/many_guards.py", without_title(source_of(problem_of(MANY_GUARDS), Detail.CREDIT)))


@pytest.mark.parametrize(
    "text", [RICH, GUARD, MANY_GUARDS, shipped("abstract"), shipped("object_lifting"), shipped("pursuit")]
)
def test_a_module_is_python_that_lints_itself(text):
    """Everything imported is used, and everything used is imported or its own."""
    source = source_of(problem_of(text), Detail.CREDIT, Detail.TERMS, Detail.TRACE)
    compile(source, "rollout.py", "exec")
    imported = [
        name
        for line in source.splitlines()
        if line.startswith("from ")
        for name in line.split("import ")[1].split(", ")
    ]
    assert len(set(imported)) == len(imported)
    assert [name for name in imported if source.count(f"{name}(") == 0] == []


def test_the_same_spec_is_the_same_source():
    for text in (RICH, MANY_GUARDS):
        assert source_of(problem_of(text), Detail.CREDIT) == source_of(problem_of(text), Detail.CREDIT)


@pytest.mark.parametrize("text", [GUARD, MANY_GUARDS, RICH])
def test_the_solver_s_rollout_knows_nothing_of_expectations(text):
    expecting = text.replace(
        "  wait:\n", "  wait:\n    expects: atan(x - before(x)) > 0 or middle > tan(x)\n"
    )
    expecting = expecting.replace("  rest:\n", "  rest:\n    expects: atan(noisy - before(noisy)) > 0\n")
    assert expecting != text
    source = source_of(problem_of(expecting), Detail.CREDIT)
    assert source == source_of(problem_of(text), Detail.CREDIT)
    assert "atan(" in source_of(problem_of(expecting), Detail.TERMS)


def test_a_rollout_computes_nothing_that_nobody_asks_for():
    text = GUARD.replace("  sensors:", "  sensors:\n    unused: atan(x) + normal(0, 1)")
    source = source_of(problem_of(text), Detail.CREDIT)
    assert "atan" not in source
    assert "normal" not in source
    assert source == source_of(problem_of(GUARD), Detail.CREDIT)


def test_an_episode_that_cannot_end_early_has_no_test_for_it():
    text = GUARD.replace("  ends: any(x[r] < 0 for r in team)\n", "")
    assert "break" in source_of(problem_of(GUARD), Detail.CREDIT)
    assert "break" not in source_of(problem_of(text), Detail.CREDIT)
    assert lived(problem_of(text), 5).steps_taken.tolist() == [10] * 5
