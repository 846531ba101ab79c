import numpy as np

from bbsd.compiler import Problem, compile_meaning
from bbsd.compiler.details import Detail
from bbsd.compiler.kernels import kernel_source
from bbsd.compiler.passes.shared_slots import share_slots
from bbsd.compiler.writing.rollout_function import RolloutFunction
from tests.unit.architecture.designs import meaning_of, shipped
from tests.unit.problems import RICH, lived, problem_of

THREE = """
bbsd: 1
name: three
environment:
  robots: 3
  steps: 4
  state: {{x: "{x}", y: "{y}"}}
  definitions: {{whole: "list(x, 1)"}}
  dynamics: {{x: "{next_x}", y: "{next_y}"}}
  sensors: {{seen: "sum(x[r] for r in team)"}}
behaviors:
  idle: {{inputs: {{far: seen > 3}}, actions: {{go: {{x: x + 1}}}}}}
reward: {{earned: seen}}
"""


def kept_slots(text):
    """The slots that a rollout keeps from step to step."""
    problem = problem_of(text)
    return RolloutFunction(share_slots(problem.meaning), problem.tables, 1, Detail.CREDIT).slots


def test_what_all_robots_sense_alike_is_kept_once():
    kept = kept_slots(THREE.format(x="uniform(0, 1)", y=0, next_x="x", next_y="y + 1"))
    assert [slot for slot in kept if slot[0] == "seen"] == [("seen", 0, ())]
    assert [slot for slot in kept if slot[0] == "x"] == [("x", 0, ()), ("x", 1, ()), ("x", 2, ())]


def test_draws_at_the_start_and_in_dynamics_keep_slots_apart():
    for_start = kept_slots(THREE.format(x="normal(0, 1)", y=0, next_x="x", next_y="y + 1"))
    in_dynamics = kept_slots(THREE.format(x=0, y=0, next_x="x + normal(0, 1)", next_y="y + 1"))
    assert [sum(slot[0] == "x" for slot in kept) for kept in (for_start, in_dynamics)] == [3, 3]


def test_equal_starts_that_part_later_are_not_merged():
    kept = kept_slots(THREE.format(x=0, y=0, next_x="x + robot", next_y="y + 1"))
    assert sum(slot[0] == "x" for slot in kept) == 3


def test_a_truth_and_a_number_that_start_alike_are_two():
    text = """
    bbsd: 1
    name: two
    environment: {steps: 3, state: {number: 1, truth: "true", other: "true"}, dynamics: {number: number + 1}}
    behaviors: {b: {inputs: {truth: truth}, excited: other, actions: {a: {number: number}}}}
    reward: {r: "number if truth else 0"}
    """
    assert sorted(slot for slot, *_ in kept_slots(text)) == ["number", "truth"]


def test_nothing_to_merge_leaves_the_meaning_as_it_is():
    meaning = meaning_of(shipped("abstract"))
    assert share_slots(meaning) is meaning


def test_lifting_s_tilt_is_computed_once():
    problem = problem_of(shipped("object_lifting"))
    source = kernel_source(problem.meaning, problem.tables, 1, (Detail.TERMS,))
    assert source.count("atan(") == 1 + 1  # at the start, and in a step


def test_merging_changes_no_bit():
    for text in (
        RICH,
        shipped("object_lifting"),
        THREE.format(x=0, y="chance(0.5)", next_x="x + seen", next_y="not y"),
    ):
        meaning = meaning_of(text)
        with_merging = compile_meaning(meaning, compiled=False)
        without = Problem(
            meaning, with_merging.tables, with_merging.layers, with_merging.candidates, 1, compiled=False
        )
        found, expected = lived(with_merging, 2), lived(without, 2)
        for name in (
            "returns",
            "credit",
            "terms",
            "control",
            "steps_taken",
            "not_finite",
            "expectations_met",
        ):
            np.testing.assert_array_equal(getattr(found, name), getattr(expected, name))
