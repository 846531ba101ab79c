from collections.abc import Mapping

import pytest

from bbsd.expression.elaboration import elaboration
from bbsd.expression.syntax.parsing import parse
from bbsd.language.meaning.proofs.coverage import covers_everything
from tests.unit.expression.scopes import scope


def covered(*conditions: str, sizes: Mapping[str, int] | None = None) -> bool:
    here = scope()
    nodes = [elaboration.truth(parse(condition), here) for condition in conditions]
    assert not here.findings.mistakes
    by_node = {elaboration.number(parse(name), here): size for name, size in (sizes or {}).items()}
    return covers_everything(nodes, here.graph, by_node.get)


@pytest.mark.parametrize(
    "conditions",
    [("x < 1", "x >= 1"), ("x < 1", "1 <= x < 2", "x >= 2"), ("x < k", "x == k", "x > k"), ("x < k", "not x < k"),
     ("ok and x > 1", "ok and x <= 1", "not ok"), ("x > 1", "x < 2"), ("1 > x", "1 <= x"), ("x != 3", "x == 3"),
     ("ok if x > 1 else not ok", "not ok if x > 1 else ok"), ("x + k < 1", "x + k >= 1"), ("true", "x < 1"),
     ("x < 1", "x < 2", "x > 1.5"), ("x > 1e300", "x <= 1e300")],
)  # fmt: skip
def test_conditions_that_leave_no_gap(conditions: tuple[str, ...]) -> None:
    assert covered(*conditions)


@pytest.mark.parametrize(
    "conditions",
    [("x < 1", "x > 1"), ("x < 1", "x >= 1.5"), ("x < k", "x > k"), ("ok", "x > 1"), ("x < 1", "k >= 1"),
     ("ok and x > 1", "not ok"), ("x > 1e300", "x == 1e300"), ("x >= 1e300", "x == 0"), ("x < k", "k < x"),
     ("x == 1", "x == 2")],
)  # fmt: skip
def test_conditions_that_may_leave_one(conditions: tuple[str, ...]) -> None:
    assert not covered(*conditions)


@pytest.mark.parametrize(
    "conditions",
    [("x == 0", "x == 1", "x == 2"), ("x < 0.5", "x > 0.5"), ("x == 0", "0 < x < 2", "x >= 2"), ("x < 3",), ("x > -1",),
     ("x != 1", "x > 0.5 and x < 1.5"), ("x == 0 or x == 2", "x == 1"), ("x < 1e300",), ("not x == 5",),
     ("x == 0 and k < 1", "x == 0 and k >= 1", "x > 0")],
)  # fmt: skip
def test_conditions_about_three_whole_numbers_that_leave_no_gap(conditions: tuple[str, ...]) -> None:
    assert covered(*conditions, sizes={"x": 3})


@pytest.mark.parametrize(
    "conditions",
    [("x == 0", "x == 2"), ("x == 1", "x == 2"), ("x == 0", "x == 1"), ("x < 2",), ("x > 0",), ("x == 5",),
     ("x > 1e300",), ("x == 0", "x == 1", "k == 2")],
)  # fmt: skip
def test_conditions_about_three_whole_numbers_that_leave_one(conditions: tuple[str, ...]) -> None:
    assert not covered(*conditions, sizes={"x": 3})


def test_what_would_take_too_long_to_prove_is_not_held_for_proven() -> None:
    many = " or ".join(f"x == {place}" for place in range(310))
    assert not covered(many, f"not ({many})")
