"""Lists that arrays keep do what elements do that are written out, bit for bit, whatever a spec asks for."""

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from bbsd.compiler import compile_meaning
from bbsd.compiler.details import Detail
from bbsd.compiler.passes.list_arrays import MOST_ELEMENTS_WRITTEN_OUT, keep_lists_in_arrays
from tests.interpreter.made_up import specs
from tests.interpreter.made_up_meanings import meaning_made_up
from tests.unit.compiler.robots import assert_arrays_change_no_bit, bits, moving, source_with, with_loops
from tests.unit.problems import lived

BINS, MARKS = "list(k * k for k in range(5))", "list(list(false for k in range(3)) for j in range(4))"
LISTS = {"bins": BINS, "marks": MARKS}
HERE, THERE = "floor(abs(3 * x))", "floor(abs(2 * y)) - 1"
SEEN = {
    "s": f"bins[{HERE}] - bins[n]",
    "t": f"marks[{HERE}][{THERE}]",
    "u": f"marks[2][{THERE}] or marks[n][1]",
}


def going(**actions):
    """Actions of the left behavior that also set lists."""
    return {
        "actions": {"go": {"x": "x - uniform(0, 1)", **actions}, "turn": {"x": "-y", "armed": "not armed"}}
    }


def turning(go, turn):
    return {
        "actions": {"go": {"x": "x - uniform(0, 1)", **go}, "turn": {"x": "-y", "armed": "not armed", **turn}}
    }


SETS = {
    "an element": (going(**{"bins[n]": "x"}), ["bins"]),
    "an element by a number that is not finite": (going(**{"bins[floor(log(x))]": "log(y)"}), ["bins"]),
    "an element of a list of lists": (going(**{f"marks[{HERE}][{THERE}]": "x > y"}), ["marks"]),
    "two elements that may be the same": (
        going(**{"bins[n]": "x", f"bins[{HERE}]": "bins[n] + 1"}),
        ["bins"],
    ),
    "elements in two actions": (
        turning(
            {"bins[n]": "x", f"marks[{HERE}][n]": "true"}, {f"bins[{THERE}]": "y", "marks[n][n]": "armed"}
        ),
        ["bins", "marks"],
    ),
    "an element by its number": (going(**{"bins[2]": "x", "bins[0]": "bins[2] + 1"}), ["bins"]),
    "an element by its number or by a computed one": (
        turning({"bins[2]": "x"}, {"bins[n]": "y", "marks[3][1]": "true"}),
        ["bins"],
    ),
    "an element in a row that is known": (going(**{f"marks[1][{THERE}]": "true"}), []),
    "a row": (going(**{f"marks[{HERE}]": "list(x > k for k in range(3))"}), []),
    "a whole list": (going(bins="list(x + k for k in range(5))"), []),
    "an element by what it is": (going(**{f"bins[{HERE}]": f"bins[{HERE}] + bins[{THERE}] + 1"}), ["bins"]),
}
READS = {
    "by sensors": {"sensors": SEEN, "dynamics": {"y": "y + s + (1 if t and not u else 0)"}},
    "before and after": {
        "sensors": SEEN,
        "reward": {
            "more": f"bins[{HERE}] - before(bins[{HERE}]) + before(bins)[n] + bins[1]",
            "new": "1 if marks[n][n] and not before(marks[n][n]) else 0",
        },
    },
    "by sums": {
        "sensors": {
            "s": "sum(bins) + sum(k * bins[k] for k in range(5))",
            "t": "any(any(row) for row in marks)",
        },
        "dynamics": {"y": "y + s / 9 if t else y"},
    },
    "by the other robots": {
        "sensors": {"s": "sum(bins[r][n] for r in team)", "t": f"marks[(robot + 1) % robots][n][{THERE}]"},
        "dynamics": {"y": "y + s / 9 if t else y - bins[0][1]"},
    },
    "by two conditions": {
        "sensors": {
            "s": "bins[3] if x > 0 else bins[1]",
            "t": f"marks[{HERE}][n] if armed else marks[n][{THERE}]",
        },
        "dynamics": {"y": "y + s - (1 if t else 0)"},
    },
    "in decisions": {
        "left": {"inputs": {"near": f"cut(bins[{HERE}], 0, 2, 5)", "was": f"marks[n][{THERE}]"}},
        "right": {"excited": "bins[n] > 2"},
    },
    "where an episode ends": {
        "ends": "bins[0][n[0]] > 6 or x[0] > 3 or step > 4 and marks[0][n[0]][1]",
        "sensors": SEEN,
    },
}
STARTS = {
    "alike": {"bins": "list(0 for k in range(5))"},
    "of literals": {"bins": BINS},
    "of constants": {"bins": "list(table[k % 4][1] for k in range(5))"},
    "drawn": {"bins": "list(uniform(-1, 1) for k in range(5))"},
    "drawn alike": {"bins": "list(x for k in range(5))"},
    "of truths": {"marks": "list(list(k > j for k in range(3)) for j in range(4))"},
}


def setting(sets, robots=1, lanes=1, state=(), **wanted):
    left = {**sets, **wanted.pop("left", {})}
    return moving(robots=robots, lanes=lanes, state={**LISTS, **dict(state)}, left=left, **wanted)


@pytest.mark.parametrize("sets", SETS, ids=str)
@pytest.mark.parametrize("reads", READS, ids=str)
def test_arrays_change_no_bit(sets, reads):
    left, kept = SETS[sets]
    assert_arrays_change_no_bit(setting(left, lanes=2, **READS[reads]), kept=kept, n_agents=4)


@pytest.mark.parametrize("sets", SETS, ids=str)
@pytest.mark.parametrize("reads", READS, ids=str)
@pytest.mark.parametrize("written_out", [1, 100])
def test_arrays_of_several_robots_change_no_bit(sets, reads, written_out):
    problem = setting(SETS[sets][0], robots=3, **READS[reads])
    assert_arrays_change_no_bit(problem, robots=written_out, n_agents=3)


@pytest.mark.parametrize("start", STARTS, ids=str)
@pytest.mark.parametrize(("robots", "written_out"), [(1, 1), (2, 2), (3, 1)])
def test_arrays_start_as_their_elements_do(start, robots, written_out):
    left = going(**{"bins[n]": "bins[n] + x", f"marks[{HERE}][{THERE}]": "true"})
    problem = setting(left, robots, 2, STARTS[start], **READS["before and after"])
    assert_arrays_change_no_bit(problem, robots=written_out, n_agents=3)


@pytest.mark.slow
@settings(max_examples=80, suppress_health_check=[HealthCheck.too_slow])
@given(
    specs(most_robots=5),
    st.integers(0, 2**32),
    st.sampled_from([1, 2]),
    st.integers(1, 3),
    st.sampled_from([1, 9]),
)
def test_arrays_change_no_bit_of_specs_that_are_made_up(data, seed, lanes, generation, written_out):
    problem = compile_meaning(meaning_made_up(data, seed), lanes=lanes, compiled=False)
    arrays, written = (with_loops(problem, written_out, elements) for elements in (0, 1000))
    assert bits(arrays, 3, seed, generation) == bits(written, 3, seed, generation)


@pytest.mark.parametrize("written_out", [1, 100])
def test_a_robot_has_a_list_of_its_own(written_out):
    left = going(**{"bins[n]": "bins[n] + x", f"marks[{HERE}][{THERE}]": "true"})
    problem = setting(left, robots=4, **READS["by sensors"])
    kept = (
        ["bins", "marks"]
        if written_out == 1
        else [f"{name}_{k}" for name in ("bins", "marks") for k in range(4)]
    )
    source = assert_arrays_change_no_bit(problem, robots=written_out, kept=kept, n_agents=3)
    assert ("    bins = part(own_numbers, " in source) is (written_out == 1)


def test_angles_that_are_compared_may_be_of_elements():
    sensors = {"s": f"atan(bins[{HERE}]) < 1", "t": "atan2(bins[n], 2) > 0.5"}
    problem = setting(
        going(**{"bins[n]": "x"}), lanes=2, sensors=sensors, dynamics={"y": "y - 1 if s else 1"}
    )
    assert_arrays_change_no_bit(problem, kept=["bins"])


def test_values_that_are_not_finite_are_counted_at_their_place():
    left = {"actions": {"go": {"bins[1 + n]": "log(n - 9)", "x": "1"}}, "inputs": {"side": "x > 0"}}
    problem = setting(left, robots=5, sensors={"s": "sum(bins)"}, dynamics={"y": "s"})
    assert_arrays_change_no_bit(problem, robots=1, kept=["bins"])
    counts = lived(with_loops(problem, 1, 0), 20).not_finite
    odd = dict(zip(problem.checked_slots, counts.sum(axis=0).tolist(), strict=False))
    places = {slot.place: count for slot, count in odd.items() if slot.name == "bins" and slot.robot == 3}
    assert places[(1,)] + places[(2,)] + places[(3,)] > 0
    assert places[(0,)] == places[(4,)] == 0


@pytest.mark.slow
@pytest.mark.parametrize("robots", [1, 4])
def test_arrays_are_compiled_to_the_same_bits(robots):
    left, reads = (
        going(**{"bins[n]": "bins[n] + x", f"marks[{HERE}][{THERE}]": "x > y"}),
        READS["before and after"],
    )
    problems = [setting(left, robots, 8, compiled=compiled, **reads) for compiled in (True, False)]
    compiled, plain = (bits(with_loops(problem, 1, 0), 20) for problem in problems)
    assert compiled == plain == bits(with_loops(problems[1], 100, 1000), 20)


def room(n):
    """A list of n times n elements of which one is set."""
    state = {"marks": f"list(list(false for k in range({n})) for j in range({n}))"}
    sensors = {"s": f"marks[{HERE}][{THERE}]"}
    dynamics = {"y": "y + (1 if s else 0)"}
    return moving(
        robots=1, state=state, sensors=sensors, dynamics=dynamics, left=going(**{"marks[n][n]": "true"})
    )


def test_the_source_does_not_grow_with_the_number_of_elements():
    few, many = (source_with(room(n), 1) for n in (4, 12))
    assert len(many.splitlines()) == len(few.splitlines())


@pytest.mark.parametrize("n", [2, 3, 4])
def test_few_elements_are_written_out(n):
    meaning, kept = room(n).meaning, n * n > MOST_ELEMENTS_WRITTEN_OUT
    assert ("marks = part(" in source_with(room(n), 1)) is kept
    assert (keep_lists_in_arrays(meaning.episode)[0] is meaning.episode) is not kept


@pytest.mark.parametrize(("n", "kept"), [(12, False), (13, False), (96, False), (97, True)])
def test_a_list_that_is_summed_is_written_out_unless_it_is_long(n, kept):
    left = going(**{"bins[n]": "x"})
    problem = moving(
        robots=1,
        state={"bins": f"list(k for k in range({n}))"},
        left=left,
        dynamics={"y": "y + sum(bins) / 9"},
    )
    assert ("bins = part(" in source_with(problem, 1)) is kept


def test_a_trace_names_each_element():
    assert "marks_3_3 = part(" in source_with(room(4), 1, (Detail.TRACE,))
