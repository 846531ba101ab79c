import pytest

from tests.unit.language.specs import codes, meaning_of


def constants(text: str, seed: int = 0):
    return meaning_of(f"constants: {text}", seed).constants


def test_numbers_lists_and_expressions() -> None:
    found = constants('{a: 3, b: [1, [2, 3]], c: "a + b[1][0]", d: "list(k * a for k in range(3))"}')
    assert [found.plain(name) for name in "abcd"] == [3, [1, [2, 3]], 5, [0, 3, 6]]
    assert found.vector(1) == [3, 1, 2, 3, 5, 0, 3, 6]


def test_order_does_not_matter() -> None:
    assert constants("{a: b + 1, b: c + 1, c: 1}").plain("a") == 3


def test_draws_are_the_same_for_the_same_seed_and_name() -> None:
    drawn = constants('{a: "uniform(0, 1)", b: "uniform(0, 1)"}').vector(1)
    assert constants('{b: "uniform(0, 1)", z: 3, a: "uniform(0, 1)"}').plain("a") == drawn[0]
    assert drawn[0] != drawn[1]
    assert constants('{a: "uniform(0, 1)"}', seed=1).plain("a") != drawn[0]


def test_each_element_is_drawn_for_itself() -> None:
    policy = constants('{p: "list(list(integers(1, 700) for c in range(5)) for r in range(5))"}').plain("p")
    flat = [value for row in policy for value in row]
    assert len(set(flat)) > 20
    assert all(value.is_integer() and 1 <= value <= 700 for value in flat)


def test_a_draw_that_depends_on_another_constant() -> None:
    found = constants('{high: 3, a: "uniform(high, high + 1)", b: a}')
    assert 3 <= found.plain("a") < 4
    assert found.plain("b") == found.plain("a")


def test_what_depends_on_the_generation_stays_open() -> None:
    found = constants("{goal: 3 if generation < 30 else 4, next: goal + 1, fixed: 7}")
    assert found.plain("goal") is None
    assert [found.vector(generation) for generation in (29, 30)] == [[3, 4, 7], [4, 5, 7]]


def test_whole_numbers_are_known_scalar_by_scalar() -> None:
    found = constants("{a: 3, b: [1, 2.5], c: 3 if generation < 9 else 4, d: 1 / generation}")
    assert found.wholes == (True, True, False, True, False)


def test_circles_are_told_once_and_nothing_that_follows_from_them() -> None:
    assert codes("constants: {a: b + 1, b: a + 1, c: a + b, d: d}") == ["BB063", "BB063"]


@pytest.mark.parametrize(
    ("text", "code"),
    [("{a: height}", "BB052"), ("{a: true}", "BB055"), ("{a: 1 < 2}", "BB055"),
     ('{a: "uniform(0, generation)"}', "BB058"),
     ("{a: step}", "BB052"), ("{a: [1, x]}", "BB052"), ("{a: before(1)}", "BB065")],
)  # fmt: skip
def test_mistakes(text: str, code: str) -> None:
    assert codes(f"constants: {text}") == [code]


def test_a_mistake_in_a_table_is_told_at_its_item() -> None:
    from bbsd.language.loading import check
    from bbsd.text import Source
    from tests.unit.language.specs import BASE

    (diagnosis,) = check(Source("spec.yaml", "constants:\n  table: [[1, 2],\n          [3, 4 + x]]" + BASE))
    assert (diagnosis.place.line, diagnosis.place.column) == (3, 19)


@pytest.mark.parametrize("text", ["{a: 1 / 0, b: -a}", "{a: [1, 0 / 0]}", "{a: 'exp(uniform(800, 900))'}"])
def test_a_constant_is_finite_and_the_first_that_is_not_is_told(text: str) -> None:
    assert codes(f"constants: {text}") == ["BB125"]
