import pytest

from bbsd.language.goals import goal_mistake, is_block_of_costs, is_goal


def test_only_where_no_term_can_stand() -> None:
    assert is_goal(("minimize",))
    assert is_goal(("design", "objective"))
    assert not is_goal(("reward", "cost"))
    assert not is_goal(("behaviors", "cost"))
    assert not is_goal(())
    assert is_block_of_costs(("reward", "cost"))
    assert not is_block_of_costs(("reward", "near"))


@pytest.mark.parametrize(
    ("key", "value", "term"),
    [
        ("minimize", "abs(height - goal)", "under reward, write cost: -abs(height - goal)"),
        ("minimize", "height - goal", "under reward, write cost: -(height - goal)"),
        ("cost", {"effort": "speed ** 2"}, "under reward, write effort: -speed ** 2"),
        ("cost", {"effort": 1, "time": 2}, "a term like distance: -abs(x)"),
        ("maximize", "height", "under reward, write gain: height"),
        ("objective", "minimize", "such as distance: -abs(x)"),
        ("penalty", "not an (expression", "a term like distance: -abs(x)"),
        ("loss", None, "a term like distance: -abs(x)"),
    ],
)
def test_the_term_to_write_is_shown(key: str, value: object, term: str) -> None:
    mistake = goal_mistake((key,), value)
    assert mistake.code == "BB138"
    assert key in mistake.message
    assert mistake.advice.endswith(term)
