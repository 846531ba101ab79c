"""The interpreter that kernels are compared with, on examples worked by hand."""

import math
from pathlib import Path

import pytest

from bbsd.expression.syntax.parsing import parse
from bbsd.kernel.streams import DISTRIBUTIONS, fold, name_word
from bbsd.language.models import Spec
from bbsd.text.reading.reader import read
from bbsd.text.source import Source
from tests.interpreter.cells import OPEN_CELL, given_table
from tests.interpreter.constants import read_constants
from tests.interpreter.draws import draws_of_episode
from tests.interpreter.episode import run_episode
from tests.interpreter.expressions import Moment, Scope, evaluate

SPECS = Path(__file__).parents[2] / "specs"
KEY = 2**63 + 5
COUNTING = {
    "bbsd": 1,
    "name": "counting",
    "environment": {"steps": 4, "state": {"count": 0}},
    "behaviors": {"up": {"actions": {"one": {"count": "count + 1"}}}},
    "reward": {"gain": "count - before(count)"},
}


def value(text, robot=0, robots=2, **names):
    """An expression's value where each name is a list of the robots' values."""
    moment = Moment(lambda name, of: names[name][of], step=3)
    tree = parse(text)
    return evaluate(tree, Scope(moment, robots, robot, draws_of_episode("here", tree, robot, 3, KEY)))


def word_of_draw(place, *folds):
    """The word of a draw at step 3 by the rule: the place, then robot and positions, then the step."""
    word = name_word(place)
    for each in folds:
        word = fold(word, each)
    return fold(word | 1 << 63, 3)


def spec_of(data):
    return Spec.model_validate(data)


def shipped(name):
    path = SPECS / f"{name}.yaml"
    return read(Source(path.name, path.read_text())).data


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("7 // 2 + 7 % -2 - 2 ** 3", -6.0),
        ("1 / 0", math.inf),
        ("1 < 2 <= 2 != 3", True),
        ("1 < 2 < 2", False),
        ("not true or 1 == 1 and true", True),
        ("(1 if step == 3 else 2) + robot", 1.0),
        ("mean(x[r] + r for r in team)", 13.0),
        ("sum(x[r] for r in others)", 15.0),
        ("argmax(x[r] for r in team)", 1.0),
        ("argmin(0 for r in team)", 0.0),
        ("x[9] - x[-9]", 5.0),
        ("max(list(k * k for k in range(4)))", 9.0),
        ("degrees(pi) + abs(-1) + round(2.5)", 183.0),
    ],
)
def test_values(text, expected):
    assert value(text, x=[10.0, 15.0]) == expected


def test_what_is_not_a_number_is_not_chosen():
    assert math.isnan(value("min(0 / 0, 1)"))
    assert value("min(1, 0 / 0)") == 1.0
    assert value("x[0 / 0]", x=[4.0, 5.0]) == 4.0


def test_draws_are_counted_in_the_order_they_are_written_with_then_before_condition():
    text = "uniform(0, 1) if chance(0.5) else normal(0, integers(1, 9))"
    drawn = {"uniform": 0, "chance": 1, "normal": 2, "integers": 3}
    words = {name: word_of_draw(f"here#{number}", 1) for name, number in drawn.items()}
    if DISTRIBUTIONS["chance"](KEY, words["chance"], 0.5):
        expected = DISTRIBUTIONS["uniform"](KEY, words["uniform"], 0.0, 1.0)
    else:
        sd = DISTRIBUTIONS["integers"](KEY, words["integers"], 1.0, 9.0)
        expected = DISTRIBUTIONS["normal"](KEY, words["normal"], 0.0, sd)
    assert value(text, robot=1) == expected


def test_draws_in_generators_differ_by_the_elements_position_the_outer_first():
    found = value("list(list(uniform(0, 1) for b in range(2)) for a in range(3))", robot=1)
    assert found[2][1] == DISTRIBUTIONS["uniform"](KEY, word_of_draw("here#0", 1, 2, 1), 0.0, 1.0)
    assert len({number for row in found for number in row}) == 6


def test_constants_are_drawn_by_name_and_may_use_each_other_and_the_generation():
    data = COUNTING | {
        "constants": {"late": "3 if generation < 30 else base", "base": 4, "table": [[1, "uniform(0, base)"]]}
    }
    key = fold(fold(name_word("bbsd seed 9") ^ 9, name_word("constants")), name_word("table"))
    word = fold(name_word("constants.table.0.1#0"), 0)
    table = [[1.0, DISTRIBUTIONS["uniform"](key, word, 0.0, 4.0)]]
    assert read_constants(spec_of(data), 9, 1) == {"late": 3.0, "base": 4.0, "table": table}
    assert read_constants(spec_of(data), 9, 30)["late"] == 4.0


def test_the_end_counts_the_step_in_which_it_holds():
    data = COUNTING | {"environment": COUNTING["environment"] | {"ends": "count >= 2"}}
    result = run_episode(spec_of(data), {}, [[1]], [0], KEY)
    assert (result.steps, result.return_, result.credit) == (2, 2.0, [2.0, 0.0])


def test_nobody_controls_where_all_decide_no_action_and_values_stay():
    data = COUNTING | {"reward": {"gain": "count - before(count)", "alive": 0.5}}
    result = run_episode(spec_of(data), {}, [[0]], [0], KEY)
    assert (result.return_, result.credit, result.terms) == (2.0, [0.0, 2.0], [0.0, 2.0])


def test_dynamics_use_what_actions_set_and_sensors_of_before():
    environment = {
        "steps": 1,
        "state": {"count": 1, "old": 0, "new": 0},
        "dynamics": {"old": "shown", "new": "count"},
        "sensors": {"shown": "10 * count"},
    }
    data = COUNTING | {"environment": environment}
    (step,) = run_episode(spec_of(data), {}, [[1]], [0], KEY).trace
    assert step.values == {"count": [2.0], "old": [10.0], "new": [2.0], "shown": [20.0]}


def test_rules_name_cells_of_every_kind_of_partition_and_leave_others_open():
    inputs = {"tilt": "cut(count, 2, 5)", "pace": "values(count, 1, 2)"}
    rules = [
        {"when": {"tilt": ["2 to 5", "from 5"], "pace": 2}, "do": "one"},
        {"when": {"tilt": "below 5", "pace": "1"}, "do": "no action"},
    ]
    data = COUNTING | {"behaviors": {"up": COUNTING["behaviors"]["up"] | {"inputs": inputs, "rules": rules}}}
    spec = spec_of(data)
    assert given_table(spec.behaviors["up"], spec, {}) == [0, OPEN_CELL, 0, 1, OPEN_CELL, 1]


def test_a_table_is_read_with_its_last_input_changing_fastest():
    inputs = {"many": "count > 1", "where": {"zero": "count == 0", "one": "count == 1", "more": "otherwise"}}
    data = COUNTING | {"behaviors": {"up": COUNTING["behaviors"]["up"] | {"inputs": inputs}}}
    for open_cells, counted in [([0], 1.0), ([0, 1], 2.0), ([0, 1, 5], 4.0), ([0, 1, 2], 2.0)]:
        table = [int(cell in open_cells) for cell in range(6)]
        assert run_episode(spec_of(data), {}, [table], [0], KEY).return_ == counted


def test_the_first_step_of_lifting_by_the_hand_made_design():
    data = shipped("object_lifting_hand")
    data["environment"]["steps"] = 1
    data["environment"]["state"]["height"] = "2 + robot / 2"  # 30 degrees of tilt; the third is at the goal
    spec = spec_of(data)
    constants = read_constants(spec, 0, 1)
    tables = [given_table(behavior, spec, constants) for behavior in spec.behaviors.values()]
    result = run_episode(spec, constants, tables, [0, 1, 3, 4, 2], KEY)
    (step,) = result.trace
    assert [list(spec.behaviors)[index] for index in step.controlling] == [
        "hurry_up",
        "push_more",
        "stop_at_goal",
    ]
    assert step.values["speed"] == [1.0, 1.0, 0.0]
    assert step.values["height"] == [2.005, 2.505, 3.0]
    assert step.values["tilt"] == pytest.approx([29.876] * 3, abs=1e-3)
    assert step.terms == [[-0.1, -0.1, -0.1, 0, 0], [-0.1, -0.1, 1, 0, 0], [-0.1, -0.1, 1, 0, 0]]
    assert result.return_ == pytest.approx(1.3 / 3)
    assert result.credit == pytest.approx([0.8 / 3, 0, 0.8 / 3, -0.1, 0, 0])
    assert result.terms == pytest.approx([-0.1, -0.1, 1.9 / 3, 0, 0])


def test_the_abstract_problem_rewards_the_answer_of_the_policy():
    spec = spec_of(shipped("abstract"))
    constants = read_constants(spec, 1, 1)
    drawn = [fold(fold(name_word(f"environment.state.{name}#0"), 0) | 1 << 63, 0) for name in "ij"]
    i, j = (int(DISTRIBUTIONS["integers"](KEY, word, 0.0, 4.0)) for word in drawn)
    right = int(constants["policy"][i][j]) - 1
    tables = [[1] * 25 for _ in range(7)]
    for top in range(7):
        others = [index for index in range(7) if index != top]
        result = run_episode(spec, constants, tables, [*others, top], KEY)
        assert result.return_ == (1.0 if top == right else -1.0)
        assert result.credit[top] == result.return_
        tables[top][5 * i + j] = 0
        beneath = run_episode(spec, constants, tables, [*others, top], KEY)
        assert beneath.trace[0].controlling == [others[-1]]
        tables[top][5 * i + j] = 1
