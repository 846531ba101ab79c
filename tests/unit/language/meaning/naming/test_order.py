from itertools import pairwise

import pytest

from bbsd.language.field_types import expression
from bbsd.language.meaning.naming.order import (
    chain_weights,
    dependency_order,
    find_circles,
    names_used_in,
    uses_among,
    within_definitions,
)


def test_names_come_after_those_they_use() -> None:
    order = dependency_order({"a": {"b", "c"}, "b": {"c"}, "c": set()})
    assert order == ["c", "b", "a"]


def test_only_the_uses_of_each_other_count() -> None:
    uses = {
        "a": names_used_in([expression("b + x"), expression("sin(c)")]),
        "b": frozenset(),
        "c": frozenset(),
    }
    assert uses_among(uses) == {"a": {"b", "c"}, "b": set(), "c": set()}


def test_definitions_are_looked_into_by_how_they_are_used() -> None:
    definitions = {
        "floor": expression("ceiling - 1"),
        "ceiling": expression("floor(3)"),
        "near (a)": expression("a + far"),
        "far": expression("2"),
        "other": expression("1"),
    }
    texts = [
        each.text for each in within_definitions([expression("floor + near(1) + other(1)")], definitions)
    ]
    assert texts == ["floor + near(1) + other(1)", "ceiling - 1", "a + far", "floor(3)", "2"]


@pytest.mark.parametrize(
    ("uses", "found", "involved"),
    [
        ({"a": {"b"}, "b": set()}, [], set()),
        ({"a": {"a"}}, [("a", "a")], {"a"}),
        ({"a": {"b"}, "b": {"a"}, "c": {"a"}}, [("a", "b", "a")], {"a", "b"}),
        ({"a": {"a"}, "b": {"b"}}, [("a", "a"), ("b", "b")], {"a", "b"}),
    ],
)
def test_circles(uses: dict[str, set[str]], found: list[tuple[str, ...]], involved: set[str]) -> None:
    circles, all_involved = find_circles(uses)
    assert sorted(tuple(sorted(set(circle))) for circle in circles) == sorted(
        tuple(sorted(set(circle))) for circle in found
    )
    assert all(circle[0] == circle[-1] for circle in circles)
    assert all_involved == involved


def test_each_step_of_a_circle_is_a_use() -> None:
    uses = {"a": {"b", "x"}, "b": {"c"}, "c": {"a"}, "x": set()}
    ((*circle,),) = find_circles(uses)[0]
    assert all(needed in uses[name] for name, needed in pairwise(circle))


def test_of_very_many_circles_not_all_are_told_but_all_are_known() -> None:
    circles, involved = find_circles({str(place): {str(place)} for place in range(200)})
    assert len(circles) == 50
    assert len(involved) == 200


def test_heights_add_up_along_the_heaviest_chain() -> None:
    uses = {"a": set(), "b": {"a"}, "c": {"a"}, "d": {"b", "c"}}
    assert chain_weights(uses, {"a": 1, "b": 10, "c": 2, "d": 1}) == {"a": 1, "b": 11, "c": 3, "d": 12}
