import pytest

from bbsd.expression.graph import Graph, Level, evaluate
from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import Slot
from bbsd.expression.syntax.mistakes import Mistake
from bbsd.expression.syntax.text import render
from bbsd.language.loading import check
from bbsd.language.meaning.setting.targets import Target, read_target, target_name, with_element
from tests.unit.language.specs import codes, source

LISTS = "environment: {state: {w: 'list(0 for k in range(4))', at: 'integers(0, 3)', "
LISTS += "grid: 'list(list(false for x in range(2)) for y in range(3))'}}\n"
SET = LISTS + "behaviors: {stop: {actions: {halt: {%s}}}}"


def test_a_key_is_a_name_or_a_name_with_indices():
    assert read_target("speed") == Target("speed")
    target = read_target("grid[y + 1][x]")
    assert isinstance(target, Target)
    assert (target.name, [*map(render, target.indices)]) == ("grid", ["y + 1", "x"])
    assert target_name("grid [y][x]") == "grid"


@pytest.mark.parametrize("key", ["w[", "w[1", "sqrt(2)[1]", "w[1] + 2", "w[1:2]"])
def test_other_keys_are_mistakes(key):
    assert isinstance(read_target(key), Mistake)


def number(name):
    return GRAPH.leaf("slot", Slot(name), Kind.NUMBER, Level.LANE)


GRAPH = Graph()


@pytest.mark.parametrize(("index", "expected"), [
    (0, [9, 1, 2]), (1, [0, 9, 2]), (2, [0, 1, 9]), (7, [0, 1, 9]), (-3, [9, 1, 2]), (float("nan"), [9, 1, 2]),
])  # fmt: skip
def test_a_computed_index_sets_the_nearest_element(index, expected):
    items = tuple(GRAPH.number(value) for value in (0, 1, 2))
    changed = with_element(items, [number("i")], GRAPH.number(9), GRAPH)
    assert evaluate(changed, lambda leaf, _: index) == expected


def test_a_known_index_leaves_all_other_nodes_as_they_are():
    items = tuple(GRAPH.number(value) for value in (0, 1, 2))
    assert with_element(items, [GRAPH.number(1)], items[0], GRAPH) == (items[0], items[0], items[2])


def test_fewer_indices_set_a_list_in_the_list():
    rows = tuple(tuple(GRAPH.number(10 * y + x) for x in range(2)) for y in range(2))
    row = (GRAPH.number(5), GRAPH.number(6))
    changed = with_element(rows, [number("i")], row, GRAPH)
    assert [evaluate(each, lambda leaf, _: 1.0) for each in changed] == [[0, 1], [5, 6]]


@pytest.mark.parametrize(("sets", "expected"), [
    ("'w[at]': 1", []), ("'w[3 - at]': 1, 'w[at]': 2", []), ("w: 'list(k for k in range(4))'", []),
    ("'grid[at][1]': true", []), ("'grid[at]': 'list(true for x in range(2))'", []),
    ("'w[at]': true", ["BB055"]), ("'w[4]': 1", ["BB134"]), ("'w[-1]': 1", ["BB134"]), ("'w[0][0]': 1", ["BB134"]),
    ("'speed[0]': 1", ["BB134"]), ("'w[at / 2]': 1", ["BB064"]), ("'w[at > 1]': 1", ["BB055"]),
    ("'w[w]': 1", ["BB056"]),
    ("w: 1", ["BB132"]), ("w: 'list(1)'", ["BB132"]), ("speed: w", ["BB132"]), ("'grid[at]': true", ["BB132"]),
    ("'w[at]': 1, 'w[ at ]': 2", ["BB135"]), ("'w[at]': 1, w: 'list(k for k in range(4))'", ["BB135"]),
    ("'grid[1]': 'list(true for x in range(2))', 'grid[1][at]': false", ["BB135"]),
    ("'ww[1]': 1", ["BB033"]), ("'tilt[0]': 1", ["BB033"]), ("'w[hight]': 1", ["BB052"]), ("'w[1': 1", ["BB050"]),
    ("'w[integers(0, 3)]': 1", []),
])  # fmt: skip
def test_what_an_action_may_set(sets, expected):
    assert codes(SET % sets) == expected


def test_a_mistake_in_an_index_is_shown_in_the_key():
    text = source(SET % "'w[hight]': 1")
    (mistake,) = check(text)
    line = text.text.split("\n")[mistake.place.line - 1]
    assert line[mistake.place.column - 1 :].startswith("hight")


@pytest.mark.parametrize(("part", "expected"), [
    ("environment: {dynamics: {'w[1]': 2}}", ["BB134"]), ("reward: {'w[1]': 2}", ["BB134"]),
    ("environment: {world: {'w[1]': 2}}", ["BB134"]), ("environment: {sensors: {'w[1]': 2}}", ["BB134"]),
])  # fmt: skip
def test_only_actions_have_such_keys(part, expected):
    assert codes(part) == expected
