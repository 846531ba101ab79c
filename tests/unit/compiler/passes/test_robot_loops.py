"""Loops over robots do what robots do that are written out, bit for bit, whatever a spec asks for."""

import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from bbsd.compiler import compile_meaning
from bbsd.compiler.details import Detail
from bbsd.compiler.passes import folds
from bbsd.compiler.passes.robot_loops import MOST_ROBOTS_WRITTEN_OUT, loop_over_robots
from tests.interpreter.made_up import specs
from tests.interpreter.made_up_meanings import meaning_made_up
from tests.unit.architecture.designs import shipped
from tests.unit.compiler.robots import assert_loops_change_no_bit, bits, moving, source_with, with_loops
from tests.unit.problems import RICH, lived, problem_of

AMONG_OTHERS = {
    "mate": "argmin(abs(x[r] - x) for r in others)",
    "gap": "x - x[mate]",
    "gap_of_mate": "gap[mate]",
}
TILT = {"tilt": "max(x[r] for r in team) - min(x[r] for r in team)", "twice": "2 * tilt"}

CASES = {
    # Whether the flag is up or not, the sensor of robot 2 is what all sensors are at the start, while flags are up.
    "a start that is what one robot always has": {
        "robots": 6,
        "state": {"flag": "true"},
        "left": {"actions": {"go": {"flag": "x > 0"}}},
        "sensors": {"level": "1 + table[0][1] // (2 if flag else robot)"},
        "dynamics": {"y": "level"},
    },
    "a decision by what one robot always has": {
        "robots": 6,
        "state": {"flag": "chance(0.5)"},
        "left": {"actions": {"go": {"flag": "x > 0"}}, "excited": "1 + table[0][1] // 2 > table[0][2]"},
        "sensors": {"level": "1 + table[0][1] // (2 if flag else robot)"},
        "dynamics": {"y": "level"},
    },
    "steps in which robots' indices are not finite": {
        "sensors": {"s": "table[0][1 + floor(log(x))]", "t": "table[1][floor(log(wind))]"},
        "dynamics": {"y": "s + t"},
    },
    "a cell by what is infinite for one robot": {
        "left": {"inputs": {"side": {"this": "robot ** -2 >= y", "that": "otherwise"}}},
        "dynamics": {"y": "y + 1"},
    },
    "state without dynamics": {},
    "sensors": {"sensors": {"s": "x + y", "t": "s * 2"}, "dynamics": {"x": "x + s"}},
    "draws everywhere": {
        "sensors": {"s": "x + normal(0, 0.1)", "c": "chance(0.5)"},
        "dynamics": {"x": "x + uniform(0, s)", "n": "integers(0, 2)", "wind": "wind + normal(0, 1)"},
    },
    "folds": {
        "sensors": {
            "low": "min(x[r] for r in team)",
            "high": "max(y[r] for r in team)",
            "all_of": "sum(x[r] * y[r] for r in team)",
            "mean_of": "mean(abs(x[r] - low) for r in team)",
            "any_of": "any(x[r] > 1 for r in team)",
            "every_one": "all(armed[r] or y[r] < 0 for r in team)",
        },
        "dynamics": {
            "x": "x + low - high",
            "y": "y + all_of / 8 - mean_of",
            "armed": "any_of or every_one and armed",
        },
    },
    "folds over others": {
        "sensors": {
            "crowd": "sum(abs(x[r] - x) for r in others)",
            "near": "min(hypot(x[r] - x, y[r] - y) for r in others)",
            "most": "max(crowd[r] for r in team)",
        },
        "dynamics": {"x": "x + 0.1 * crowd", "y": "y - near + most"},
    },
    "the nearest of the others": {
        "definitions": AMONG_OTHERS,
        "sensors": {"s": "gap_of_mate"},
        "dynamics": {"x": "x + gap", "y": "y + s"},
    },
    "one robot's values for all": {
        "sensors": {"lead": "x[0] + y[2]", "follow": "x - x[1]"},
        "dynamics": {"x": "x + lead", "wind": "wind + x[3] - y[1]"},
    },
    "one robot's values for the world alone": {
        "dynamics": {"wind": "wind + x[3] * y[1]"},
        "sensors": {"s": "wind"},
    },
    "roles": {
        "sensors": {"s": "x if robot == 0 else y"},
        "right": {"excited": "robot == 0"},
        "dynamics": {"y": "y - s"},
    },
    "roles with nothing in common": {
        "sensors": {"s": "sin(x) if robot == 0 else y if robot == 1 else x * y", "t": "s[1] + s[2]"},
        "dynamics": {"x": "x + s", "y": "wind if robot == 2 else y + t"},
    },
    "a role that is seen before it is named": {
        "sensors": {"first": "level[1] + 1", "level": "y if robot == 0 else x * 2 + robot"},
        "dynamics": {"y": "first"},
    },
    "a role that has what another value is": {
        "sensors": {"a": "x if robot == 0 else x[0] + 1", "b": "a + 1"},
        "dynamics": {"y": "b"},
    },
    "a start that sees another robot": {
        "state": {"z": "x[2] * 2"},
        "dynamics": {"y": "y + z"},
    },
    "a decision that is what one robot holds later": {
        "state": {"w": 3},
        "sensors": {"s": "w + (2 if armed else robot)"},
        "right": {"excited": "w + 2 > 4"},
        "dynamics": {"y": "s"},
    },
    "numbers of robots": {
        "sensors": {"s": "robot * x + robot ** 2"},
        "dynamics": {"y": "y + robot / robots + s", "n": "(n + robot) % 3"},
    },
    "constants of each robot": {
        "sensors": {"s": "table[robot][n]", "t": "table[robot][1] * x"},
        "dynamics": {"n": "(n + table[robot][n]) % 3", "y": "t + step * table[robot][0]"},
    },
    "what all hold alike": {"sensors": TILT, "state": {"y": 2}, "dynamics": {"x": "x + twice"}},
    "what some hold alike": {
        "sensors": {"s": "wind if robot < 2 else x", "t": "s + 1"},
        "state": {"y": "2 if robot < 2 else 3"},
        "dynamics": {"x": "x + t * y"},
    },
    "what starts alike and is held apart": {"state": {"y": 2}, "dynamics": {"y": "y + robot"}},
    "what starts apart and is held alike": {"dynamics": {"y": "wind", "x": 2}},
    "slots that exchange their values": {"dynamics": {"x": "y", "y": "x"}},
    "slots that take the world's value": {"dynamics": {"x": "wind", "wind": "x[0]"}},
    "slots that take another robot's value": {
        "dynamics": {"x": "x[(robot + 1) % robots]", "y": "y[3 - robot]", "armed": "armed[0]"}
    },
    "slots that are what robots are": {"dynamics": {"n": "robot % 3", "y": "step * robot"}},
    "partitions": {
        "sensors": {
            "place": {"low": "x == min(x[r] for r in team)", "high": "x > 1", "middle": "otherwise"},
            "count": "values(n, 0, 2)",
        },
        "left": {"inputs": ["place", "count"]},
    },
    "lists": {
        "sensors": {"eyes": "list(x - k * y for k in range(3))", "ears": "list(eyes[2], wind)"},
        "dynamics": {"y": "sum(eyes) - ears[1]"},
    },
    "an end": {"ends": "any(x[r] > 1.5 for r in team)"},
    "an end for several reasons": {
        "ends": "sum(x[r] for r in team) > 4 or y[2] > 1 and step > 2 or all(x[r] < 0 for r in team)"
    },
    "expectations": {
        "sensors": {"s": "min(x[r] for r in team)"},
        "left": {"expects": "x < before(x) or s > before(s)"},
        "right": {"expects": "robot < 2 or not armed"},
        "ends": "any(x[r] > 2 for r in team)",
    },
    "large tables": {
        "sensors": {"s": "x + x[0]"},
        "left": {"inputs": {"near": "values(floor(8 * y), -20, 20)", "far": "values(floor(4 * s), -9, 9)"}},
    },
    "large tables that see what robots are": {
        "left": {"inputs": {"near": "values(floor(8 * y), -20, 20)", "who": "values(robot, 0, 3)"}}
    },
    "expensive functions": {
        "sensors": {"s": "sin(x) + cos(x[0]) * atan2(y, max(x[r] for r in team))"},
        "dynamics": {"x": "log(abs(x) + 1) + exp(-abs(s))"},
    },
    "values that are not finite": {
        "sensors": {
            "eyes": "list(1 / n, log(x), sqrt(robot - 1 + n - n))",
            "tilt": "1 / (wind - wind)",
            "walls": "list(1 / (wind - wind), 2)",
        },
        "dynamics": {"y": "1 / (robot - 2 + n - n)", "wind": "wind / 0"},
    },
    "a reward that no robot has a part in": {"reward": {"wind": "wind"}},
}


PAIRS = {
    "sums and counts": {
        "sensors": {
            "crowd": "sum(abs(x[r] - x) for r in others)",
            "close": "sum(1 if hypot(x[r] - x, y[r] - y) < 1 else 0 for r in others)",
            "with_me": "sum(1 if abs(x[r] - x) < 1 else 0 for r in team)",
            "pull": "mean((x[r] - x) / (1 + abs(y[r] - y)) for r in others)",
        },
        "dynamics": {"x": "x + 0.1 * pull - 0.01 * crowd", "y": "y + close - with_me / 8"},
    },
    "truths": {
        "sensors": {
            "alone": "all(abs(x[r] - x) > 0.2 for r in others)",
            "met": "any(armed[r] and x[r] > x for r in others)",
            "passed": "any(before(x[r]) < before(x) and x[r] > x for r in others)",
        },
        "dynamics": {"armed": "alone or not met", "y": "y + (1 if passed else 0)"},
        "right": {"excited": "alone"},
    },
    "the nearest and the farthest": {
        "definitions": {
            "mate": "argmin(hypot(x[r] - x, y[r] - y) for r in others)",
            "far": "argmax(abs(x[r] - x) for r in team)",
            "gap": "x - x[mate]",
        },
        "sensors": {
            "of_mate": "gap[mate] + y[far]",
            "both": "min(abs(x[r] - x) for r in others) + abs(x[mate] - x)",
        },
        "dynamics": {"x": "x + gap / 4", "y": "y + of_mate - both"},
    },
    "values of the robot that is looked at": {
        "definitions": {"size": "hypot(x, y)", "twin": "argmin(size[r] - r for r in others)"},
        "sensors": {
            "s": "sum(r * size[r] + (x[r] + y[r]) ** 2 * x for r in others)",
            "t": "max(size[r] if armed[r] else -r for r in others)",
            "u": "sum(table[r % 4][0] * x[r] + wind * y for r in others)",
        },
        "dynamics": {"x": "x + sin(s) + cos(t)", "y": "y[twin] + u / 100"},
    },
    "folds in folds": {
        "sensors": {
            "worst": "max(min(abs(x[q] - x[r] - 1) for q in team) for r in others)",
            "crowd": "sum(abs(x[r] - x) for r in others)",
            "calm": "min(crowd[r] + x for r in others)",
        },
        "dynamics": {"y": "y + worst - calm"},
    },
    "folds of three robots": {
        "sensors": {
            "spread": "sum(max(x[q] * y[r] - x for q in others) for r in others)",
            "apart": "min(abs(x[r] - x) + abs(r - robot) for r in others)",
        },
        "dynamics": {"y": "y + apart - spread / 100"},
    },
    "more than the fold": {
        "sensors": {"s": "1 + sum(x[r] * x for r in others) - y + wind + min(x[r] for r in others)"},
        "dynamics": {"y": "s / 9", "wind": "wind + sum(x[r] for r in team)"},
    },
    "roles among them": {
        "sensors": {
            "s": "sum(x[r] - x if robot == 0 else x[r] + x for r in others)",
            "t": "sum(x[r] * x if r == 0 else y[r] - y for r in others)",
        },
        "dynamics": {"y": "y + s - t"},
    },
    "draws for each": {
        "sensors": {"s": "min(abs(x[r] - x) + normal(0, 0.1) for r in others)"},
        "dynamics": {"y": "y + s"},
    },
    "another robot of the one that is looked at": {
        "state": {"y": 2},
        "sensors": {
            "s": "sum(x[(r + 1) % robots] * y[r] - x for r in others)",
            "t": "min(x[mate[r]] - x for r in others)",
        },
        "definitions": {"mate": "argmin(abs(x[r] - x) for r in others)"},
        "dynamics": {"x": "x + s / 50 - t"},
    },
    "constants of the robots looked at": {
        "sensors": {
            "s": "sum(table[r % 4][0] * 2 * (x[r] - x) for r in others)",
            "t": "sum(step * r * (x[r] - x) for r in others)",
        },
        "dynamics": {"y": "y + s / 100 - t / 50"},
    },
    "at the start": {"state": {"z": "sum(abs(x[r] - x) for r in others)"}, "dynamics": {"y": "y + z"}},
    "rewards and ends": {
        "reward": {"near": "-min(abs(x[r] - x) for r in others)", "wind": "wind"},
        "ends": "any(min(abs(x[q] - x[r]) for q in team) > 1 for r in team) or x[0] > 5",
    },
    "not finite": {
        "sensors": {
            "s": "sum(1 / (floor(x[r]) - floor(x)) for r in others)",
            "t": "max(log(x[r] - x) for r in others)",
        },
        "dynamics": {"y": "y + argmax(t[r] + s[r] - s for r in others)"},
    },
}


@pytest.mark.slow
@pytest.mark.parametrize("lanes", [1, 2])
@pytest.mark.parametrize("case", CASES.values(), ids=CASES)
def test_loops_change_no_bit(case, lanes):
    assert_loops_change_no_bit(moving(lanes=lanes, **case))


@pytest.fixture
def paired(monkeypatch):
    """Robots that look at five or more have loops over those that they look at."""
    monkeypatch.setattr(folds, "MOST_PAIRS_WRITTEN_OUT", 4)


@pytest.mark.slow
@pytest.mark.usefixtures("paired")
@pytest.mark.parametrize("robots", [6, 9])
@pytest.mark.parametrize("case", PAIRS.values(), ids=PAIRS)
def test_loops_over_pairs_change_no_bit(case, robots):
    assert_loops_change_no_bit(moving(robots=robots, lanes=2, **case))


@pytest.mark.slow
@pytest.mark.usefixtures("paired")
def test_loops_over_pairs_are_compiled_to_the_same_bits():
    case = {"robots": 7, "lanes": 8, **PAIRS["the nearest and the farthest"]}
    expected = bits(with_loops(moving(**case, compiled=True), 100), 20)
    assert bits(with_loops(moving(**case, compiled=True), 1), 20) == expected
    assert bits(with_loops(moving(**case), 1), 20) == expected


WRITTEN_OUT = {"roles among them", "draws for each", "folds of three robots"}


@pytest.mark.slow
@pytest.mark.parametrize("case", [case for case in PAIRS if case not in WRITTEN_OUT])
def test_the_source_does_not_grow_with_the_number_of_robots_that_look_at_one_another(case):
    few, many = (
        source_with(moving(robots=robots, **PAIRS[case]), MOST_ROBOTS_WRITTEN_OUT, (Detail.CREDIT,))
        for robots in (11, 16)
    )
    assert "for pair in range(10):" in few
    assert len(many.splitlines()) == len(few.splitlines())


@pytest.mark.parametrize(("robots", "n_loops"), [(8, 0), (9, 0), (10, 1)])
def test_few_robots_that_are_looked_at_are_written_out(robots, n_loops):
    problem = moving(robots=robots, sensors={"s": "sum(x[r] * x for r in others)"}, dynamics={"y": "s"})
    source = source_with(problem, MOST_ROBOTS_WRITTEN_OUT, (Detail.CREDIT,))
    assert source.count("for pair in") == 2 * n_loops  # at the start and in a step


def test_a_literal_of_the_robot_looked_at_is_read_before_the_lanes():
    problem = moving(robots=12, sensors={"s": "argmin(abs(x[r] - x) for r in others)"}, dynamics={"y": "s"})
    lines = [
        line.strip() for line in source_with(problem, MOST_ROBOTS_WRITTEN_OUT, (Detail.CREDIT,)).splitlines()
    ]
    place = lines.index("theirs = other * stride")
    assert lines[place + 1].startswith("its_1 = BY_ROBOT_")
    assert lines[place + 1].endswith("[other]")
    assert lines[place + 2].startswith("for lane in range(")


@pytest.mark.slow
@pytest.mark.parametrize("text", [RICH, shipped("pursuit"), shipped("object_lifting")])
def test_loops_change_no_bit_of_larger_specs(text):
    assert_loops_change_no_bit(problem_of(text, lanes=2), n_agents=3)


@pytest.mark.slow
@settings(max_examples=60, suppress_health_check=[HealthCheck.too_slow])
@given(
    specs(most_robots=6), st.integers(0, 2**32), st.sampled_from([1, 2]), st.integers(1, 3), st.integers(2, 8)
)
def test_loops_change_no_bit_of_specs_that_are_made_up(data, seed, lanes, generation, looked_at):
    meaning = meaning_made_up(data, seed)
    assume(meaning.spec.environment.robots > 1)
    problem = compile_meaning(meaning, lanes=lanes, compiled=False)
    written_out = bits(with_loops(problem, 100), 3, seed, generation)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(folds, "MOST_PAIRS_WRITTEN_OUT", looked_at)
        assert bits(with_loops(problem, 1), 3, seed, generation) == written_out


@pytest.mark.parametrize("n_terms", [11, 12])
def test_a_decision_with_as_many_terms_as_robots_does_not_meet_the_folds_of_its_step(n_terms):
    excited = f"min(abs(y - k) for k in range({n_terms})) > 0.3"
    problem = moving(
        robots=12,
        state={"z": "uniform(-1, 1)"},
        right={"excited": excited},
        dynamics={"y": "y + sum(z[r] * z - y for r in team) / 10"},
    )
    assert_loops_change_no_bit(problem)


@pytest.mark.slow
@pytest.mark.usefixtures("paired")
def test_folds_within_folds_may_be_deep():
    for length in range(1, 36):
        terms = " + ".join(f"{k} * y" for k in range(length))
        definitions = {"near(u)": f"abs(u) + {terms}", "far(u)": f"near(u) - {terms.replace('+', '-')}"}
        sensors = {"c": "sum(far(sin(x[r] - x)) for r in others)", "s": "sum(c[r] * x - c for r in team)"}
        problem = moving(robots=6, definitions=definitions, sensors=sensors, dynamics={"y": "s"})
        source = source_with(problem, 1, (Detail.CREDIT,))
        assert source.count("for pair in") == 4  # two at the start, two in a step


def test_long_sums_of_a_robot_s_own_are_not_taken_for_folds_again_and_again():
    walk = {f"a{k}": f"a{k - 1} + a{k - 1 - k % 3}" for k in range(3, 45)}
    problem = moving(
        robots=12, definitions={"a0": "x * y", "a1": "y", "a2": "x", **walk}, dynamics={"y": "a44"}
    )
    assert "for pair in" not in source_with(problem, MOST_ROBOTS_WRITTEN_OUT, (Detail.CREDIT,))


@pytest.mark.slow
def test_loops_are_compiled_to_the_same_bits():
    text = RICH.replace("robots: 3", "robots: 5").replace("chart[robot][n]", "chart[robot % 2][n]")
    compiled, plain = problem_of(text, lanes=8, compiled=True), problem_of(text, lanes=8)
    expected = bits(with_loops(compiled, 100), 20)
    assert bits(with_loops(compiled, 1), 20) == expected
    assert bits(with_loops(plain, 1), 20) == expected


@pytest.mark.parametrize("robots", [1, 2, 3, 4, 5])
def test_few_robots_are_written_out(robots):
    problem = moving(robots=robots)
    source = source_with(problem, MOST_ROBOTS_WRITTEN_OUT)
    assert ("for robot in range(" in source) is (robots > MOST_ROBOTS_WRITTEN_OUT)
    assert (loop_over_robots(problem.meaning) is problem.meaning) is (robots <= MOST_ROBOTS_WRITTEN_OUT)


@pytest.mark.slow
def test_the_source_does_not_grow_with_the_number_of_robots():
    few, many = (
        source_with(moving(robots=robots, **CASES["folds"]), MOST_ROBOTS_WRITTEN_OUT, (Detail.CREDIT,))
        for robots in (4, 40)
    )
    assert len(many.splitlines()) == len(few.splitlines())


def test_counts_of_what_all_robots_hold_alike_are_written_once_for_all():
    few, many = (
        source_with(moving(robots=robots, **CASES["what all hold alike"]), MOST_ROBOTS_WRITTEN_OUT)
        for robots in (4, 64)
    )
    assert "not_finite_twice = part(numbers, " in many
    assert len(many.splitlines()) == len(few.splitlines())


def test_an_operation_of_all_robots_is_written_once():
    problem = moving(sensors={"s": "atan(x)"}, dynamics={"y": "s"})
    assert source_with(problem, 1, (Detail.CREDIT,)).count("atan(") == 1 + 1  # at the start and in a step


def test_what_all_robots_hold_alike_is_stored_once():
    source = source_with(moving(**CASES["what all hold alike"]), 1, (Detail.CREDIT,))
    assert "    twice = part(numbers, " in source
    assert "    x = part(own_numbers, " in source


def test_robots_that_need_one_another_are_written_out():
    problem = moving(sensors={"a": "x if robot == 0 else (x[0] + 1) * 2", "b": "a + 1"}, dynamics={"y": "b"})
    assert_loops_change_no_bit(problem, looped=False)
    assert loop_over_robots(problem.meaning, 1) is problem.meaning


def test_a_trace_is_written_robot_by_robot():
    assert "for robot in" not in source_with(moving(**CASES["folds"]), 1, (Detail.TRACE,))


def test_values_that_are_not_finite_are_counted_at_their_place():
    problem = moving(lanes=2, **CASES["values that are not finite"])
    assert "for robot in" in source_with(problem, MOST_ROBOTS_WRITTEN_OUT)
    *counts, deciding = lived(problem, 3).not_finite[0].tolist()
    odd = dict(zip(problem.checked_slots, counts, strict=True))
    assert deciding == 0
    assert [odd["y", robot, ()] for robot in range(4)] == [0, 0, 6, 0]
    assert [odd["eyes", robot, (2,)] for robot in range(4)] == [6, 0, 0, 0]
    assert [odd["tilt", robot, ()] for robot in range(4)] == [6] * 4
    assert [odd["walls", robot, (place,)] for robot in range(4) for place in (0, 1)] == [6, 0] * 4
    assert odd["wind", None, ()] == 6
    assert 0 < sum(odd["eyes", robot, (1,)] for robot in range(4)) < 24
