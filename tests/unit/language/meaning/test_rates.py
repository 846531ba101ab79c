import pytest

from tests.unit.language.specs import codes, meaning_of


def rates(design: str):
    return meaning_of(f"constants: {{fast: 0.5, later: 1 if generation > 2 else 0}}\ndesign: {design}").rates


def test_defaults_are_those_of_table_1() -> None:
    found = meaning_of().rates
    assert found.hard_mutation[0] == 0.01
    assert found.hard_mutation[40:] == (0.0,) * 10
    assert found.soft_mutation[0] == 0.02
    assert found.learning[:2] == pytest.approx((0.099, 0.09801))


def test_rates_are_evaluated_for_each_generation_and_episode() -> None:
    found = rates(
        "{coevolution: {generations: 4, hard_mutation: fast * later / generations},"
        " learning: {episodes: 3, last: 2, rate: 1 / episode}}"
    )
    assert found.hard_mutation == (0.0, 0.0, 0.125, 0.125)
    assert found.soft_mutation == (0.0, 0.0, 0.25, 0.25)
    assert found.learning == (1, 1 / 2, 1 / 3)


@pytest.mark.parametrize(
    ("design", "code"),
    [("{learning: {rate: 1.5}}", "BB043"), ("{learning: {rate: 2 - episode}}", "BB043"),
     ("{learning: {rate: 0 / 0}}", "BB125"),
     ("{learning: {rate: later}}", "BB066"), ("{learning: {rate: generation}}", "BB052"),
     ("{coevolution: {soft_mutation: episode}}", "BB052"), ("{coevolution: {hard_mutation: height}}", "BB052"),
     ("{coevolution: {hard_mutation: chance(0.5)}}", "BB058"), ("{coevolution: {hard_mutation: 0.9}}", "BB043")],
)  # fmt: skip
def test_mistakes(design: str, code: str) -> None:
    assert codes(f"constants: {{later: 1 if generation > 2 else 0}}\ndesign: {design}") == [code]
