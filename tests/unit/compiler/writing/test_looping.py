"""Lines that are special to loops over robots. That they mean the same is tested in test_robot_loops.py."""

import pytest

from bbsd.compiler.details import Detail
from bbsd.compiler.passes.robot_graph import RobotGraph
from bbsd.compiler.passes.robot_loops import loop_over_robots
from bbsd.compiler.writing.emission import emitter_of
from bbsd.compiler.writing.rollout_function import RolloutFunction
from bbsd.expression.graph import Level
from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import Slot
from tests.unit.compiler.robots import moving


@pytest.fixture
def function():
    """A rollout of four robots with a number x, a truth armed and a world's number wind."""
    problem = moving(sensors={"s": "x[0] + wind"}, dynamics={"x": "x + s"})
    return RolloutFunction(loop_over_robots(problem.meaning, 1), problem.tables, 8, Detail.CREDIT)


@pytest.fixture
def robots():
    return RobotGraph(4)


def slot(robots, name, kind=Kind.NUMBER):
    return robots.graph.leaf("slot", Slot(name, 0), kind, Level.EACH)


def wind(robots):
    return robots.graph.leaf("slot", Slot("wind"), Kind.NUMBER, Level.LANE)


def plus(robots, node, value):
    return robots.graph.apply("+", node, robots.graph.number(value))


class Written:
    """What some values become in a step, read in the stage wanted."""

    def __init__(self, function, *nodes, at, hints=()):
        self.emitter = emitter_of(function, nodes, decided=1, hinted=False)
        self.emitter.hints = dict(hints)
        self.blocks = self.emitter.blocks
        self.texts = [self.emitter.text(node, self.blocks.stage(at)).source for node in nodes]

    def lines(self, stage):
        return self.blocks.stage(stage).lines


def test_one_robot_s_slot_is_read_where_it_stands(function, robots):
    nodes = [robots.of(slot(robots, "x"), robot) for robot in (0, 1, 3)]
    written = Written(function, *nodes, at=0)
    assert written.texts == ["x[lane]", "x[stride + lane]", "x[3 * stride + lane]"]
    assert written.lines(0) == []


def test_one_robot_s_slot_crosses_to_loops_over_robots(function, robots):
    lead = robots.of(slot(robots, "x"), 2)
    written = Written(function, lead, at=1)
    assert written.texts == ["part_1"]
    assert written.lines(0) == ["part_1 = x[2 * stride + lane]"]
    assert written.blocks.stage(0).kept == {"part_1": "part_1_kept"}
    assert written.blocks.stage(1).read == {"part_1": "part_1_kept[lane]"}


def test_one_robot_s_value_is_kept_by_the_loop_that_computes_it(function, robots):
    lead = robots.of(plus(robots, slot(robots, "x"), 1), 2)
    written = Written(function, lead, at=2)
    assert written.lines(1) == ["part_1 = x[own + lane] + 1.0"]
    assert written.blocks.stage(1).kept == {"part_1": "part_1_kept"}
    assert written.lines(2) == ["part_2 = part_1_kept[2 * stride + lane]"]
    assert function.is_own("part_1_kept")


def test_truths_are_kept_as_numbers(function, robots):
    armed = slot(robots, "armed", Kind.TRUTH)
    assert Written(function, robots.of(armed, 1), at=0).texts == ["armed[stride + lane] != 0.0"]
    both = robots.graph.apply("not", armed)
    written = Written(function, robots.other(both, (1, 0, 3, 2)), at=3)
    assert written.lines(1) == ["part_1 = not (armed[own + lane] != 0.0)"]
    assert written.lines(3) == ["part_2 = part_1_kept[seen_1 + lane] != 0.0"]


def test_cells_are_kept_as_integers(function, robots):
    cell = robots.graph.apply("cell_of", slot(robots, "armed", Kind.TRUTH))
    Written(function, robots.of(cell, 1), at=2)
    assert function.memory.own_integers == ["part_1_kept"]


@pytest.mark.parametrize(
    ("seen", "begins"),
    [
        ((1, 0, 0, 0), "cell_of(robot <= 0) * stride"),
        ((2, 2, 1, 1), "(1 + cell_of(robot <= 1)) * stride"),
        ((3, 3, 3, 2), "(2 + cell_of(robot <= 2)) * stride"),
        ((3, 0, 1, 2), "BY_ROBOT_1[robot] * stride"),
    ],
)
def test_robots_begin_once_where_they_see_another(function, robots, seen, begins):
    x, y = (robots.other(slot(robots, name), seen) for name in "xy")
    written = Written(function, x, y, at=1)
    assert written.texts == ["x[seen_1 + lane]", "y[seen_1 + lane]"]
    assert written.blocks.robot(1).lines == [f"seen_1 = {begins}"]


def test_what_is_seen_in_two_stages_begins_in_each(function, robots):
    seen = (1, 2, 3, 0)
    theirs = plus(robots, robots.other(slot(robots, "x"), seen), 1)
    written = Written(function, robots.other(theirs, seen), at=3)
    assert written.lines(1) == ["part_1 = x[seen_2 + lane] + 1.0"]
    assert written.lines(3) == ["part_2 = part_1_kept[seen_1 + lane]"]
    assert [written.blocks.robot(stage).lines for stage in (1, 3)] == [
        ["seen_2 = BY_ROBOT_1[robot] * stride"],
        ["seen_1 = BY_ROBOT_1[robot] * stride"],
    ]


def test_a_fold_is_done_in_the_loop_over_robots_and_read_by_all(function, robots):
    total = robots.over(plus(robots, slot(robots, "x"), 1), "+")
    both = plus(robots, total, 5), robots.graph.apply("*", slot(robots, "x"), total)
    written = Written(function, both[0], at=2)
    assert written.texts == ["over_1[lane] + 5.0"]
    assert written.lines(1) == [
        "part_1 = x[own + lane] + 1.0",
        "over_1[lane] = select(robot == 0, part_1, over_1[lane] + part_1)",
    ]
    assert Written(function, both[1], at=3).texts == ["x[own + lane] * over_2[lane]"]


@pytest.mark.parametrize(
    ("operation", "folded"),
    [
        ("*", "over_1[lane] * x[own + lane]"),
        ("minimum", "minimum(over_1[lane], x[own + lane])"),
        ("maximum", "maximum(over_1[lane], x[own + lane])"),
    ],
)
def test_folds_of_numbers(function, robots, operation, folded):
    written = Written(function, robots.over(slot(robots, "x"), operation), at=2)
    assert written.lines(1) == [f"over_1[lane] = select(robot == 0, x[own + lane], {folded})"]


@pytest.mark.parametrize("operation", ["&", "|"])
def test_folds_of_truths(function, robots, operation):
    written = Written(function, robots.over(slot(robots, "armed", Kind.TRUTH), operation), at=2)
    kept, armed = "over_1[lane] != 0.0", "armed[own + lane] != 0.0"
    assert written.lines(1) == [
        f"over_1[lane] = select(select(robot == 0, {armed}, ({kept}) {operation} ({armed})), 1.0, 0.0)"
    ]
    assert written.texts == [kept]


def test_what_is_folded_is_called_as_the_designer_calls_it(function, robots):
    total = robots.over(slot(robots, "x"), "+")
    assert Written(function, total, at=2, hints={total.number: "crowd"}).texts == ["crowd[lane]"]


def test_values_that_have_nothing_in_common_are_stored_one_by_one(function, robots):
    values = [
        robots.of(slot(robots, "x"), 1),
        wind(robots),
        robots.graph.number(2),
        plus(robots, wind(robots), 1),
    ]
    written = Written(function, robots.each(values), at=1)
    assert written.texts == ["apart_1[own + lane]"]
    assert written.lines(0) == [
        "apart_1[lane] = x[stride + lane]",
        "apart_1[stride + lane] = wind[lane]",
        "apart_1[2 * stride + lane] = 2.0",
        "apart_1[3 * stride + lane] = wind[lane] + 1.0",
    ]


def test_literals_and_constants_that_differ_are_looked_up_once_a_robot(function, robots):
    graph = robots.graph
    table = robots.varied("table", [graph.number(value) for value in (1, -0.0, float("nan"), float("-inf"))])
    truths = robots.varied("table", [graph.truth(value=value) for value in (True, False, False, False)])
    constants = [graph.leaf("constant", place, Kind.NUMBER, Level.CALL) for place in (4, 3, 2, 4)]
    picked = robots.varied("pick", constants)
    written = Written(function, table, truths, picked, at=1)
    assert written.texts == ["its_1", "its_2", "its_3"]
    assert written.blocks.robot(1).lines == [
        "its_1 = BY_ROBOT_1[robot]",
        "its_2 = BY_ROBOT_2[robot]",
        "its_3 = constants[BY_ROBOT_3[robot]]",
    ]
    assert list(function.tables) == [
        "(1.0, -0.0, np.nan, -np.inf)",
        "(True, False, False, False)",
        "(4, 3, 2, 4)",
    ]


def test_the_same_table_stands_before_the_function_once(function, robots):
    graph = robots.graph
    values = [graph.number(value) for value in (1, 2, 3, 4)]
    table = robots.varied("table", values)
    Written(function, table, at=1)
    Written(function, table, at=1)
    assert list(function.tables.values()) == ["BY_ROBOT_1"]


def test_draws_are_named_once_a_robot(function, robots):
    graph = robots.graph
    bounds = graph.number(0), slot(robots, "x")
    family = [graph.draw("uniform", word, bounds) for word in (1, 2, 3, 4)]
    written = Written(function, robots.copy(family, bounds), at=1)
    assert written.texts == ["uniform(key[lane], draw_1, 0.0, x[own + lane])"]
    assert written.blocks.robot(1).lines == ["draw_1 = fold(BY_ROBOT_1[robot], word_of(step))"]
    [words] = function.tables
    assert words == f"({', '.join(f'0x800000000000000{word}' for word in (1, 2, 3, 4))})"


def test_elements_of_the_constants_are_read_from_each_robot_s_base(function, robots):
    graph, x = robots.graph, slot(robots, "x")
    family = [graph.gather(base, (3,), (4,), (x,)) for base in (0, 12, 24, 36)]
    written = Written(function, robots.copy(family, (x,)), at=1)
    assert written.texts == ["constants[BY_ROBOT_1[robot] + 3 * clamp_index(x[own + lane], 3)]"]


def test_what_a_slot_holds_now_crosses_to_where_it_is_stored(function, robots):
    emitter = emitter_of(function, [], hinted=False)
    now, later = emitter.blocks.stage(1), emitter.blocks.stage(3)
    assert emitter.copy(slot(robots, "x"), "next_y", now, later).source == "next_y"
    assert now.lines == ["next_y = x[own + lane]"]
    assert now.kept == {"next_y": "next_y_kept"}
    assert later.read == {"next_y": "next_y_kept[own + lane]"}
    assert emitter.copy(slot(robots, "x"), "next_z", now, now).source == "next_z"
    assert "next_z" not in now.kept


def test_a_deep_value_of_the_robots_is_written_in_their_loop(function, robots):
    graph, node = robots.graph, slot(robots, "x")
    for _ in range(3000):
        node = graph.apply("negate", node)
    total = robots.over(node, "+")
    for _ in range(3000):
        total = graph.apply("negate", total)
    written = Written(function, total, at=2)
    assert not any("own" in line for line in written.lines(2))
    assert written.blocks.stage(2).read == {}
    assert written.lines(1)[-1].startswith("over_1[lane] = ")
