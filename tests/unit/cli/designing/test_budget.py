import pytest
import typer

from bbsd.cli.designing.budget import read_budget, read_seeds


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (None, ([], None)),
        ("300_000", (["design.budget=300000"], None)),
        ("6000", (["design.budget=6000"], None)),
        ("20s", ([], 20.0)),
        ("1.5 m", ([], 90.0)),
        ("2h", ([], 7200.0)),
    ],
)
def test_a_budget_is_a_number_of_episodes_or_a_time(text, expected):
    assert read_budget(text) == expected


@pytest.mark.parametrize("text", ["", "many", "20 parsecs", "s", "-5s", "1e6"])
def test_what_is_neither_is_refused(text):
    with pytest.raises(typer.BadParameter, match="neither a number of episodes"):
        read_budget(text)


def test_seeds_are_a_range():
    assert [*read_seeds("3-5")] == [3, 4, 5]
    assert [*read_seeds("7-7")] == [7]


@pytest.mark.parametrize("text", ["5-3", "a-b", "3", "0-99999", "-1-3"])
def test_what_is_no_range_of_seeds_is_refused(text):
    with pytest.raises(typer.BadParameter, match="not a range of seeds"):
        read_seeds(text)
