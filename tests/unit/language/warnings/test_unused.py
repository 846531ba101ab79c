from __future__ import annotations

from bbsd.language.loading import check
from tests.unit.language.specs import source


def unused(part: str) -> list[str]:
    """Return the messages about unused names that a part brings to the small spec."""
    before = {each.message for each in check(source(), warnings=True)}
    after = check(source(part), warnings=True)
    return [each.message for each in after if each.code == "BB201" and each.message not in before]


def test_what_nothing_uses_is_told_with_what_it_is() -> None:
    assert unused("constants: {goal: 3}") == ["nothing uses the constant goal"]
    assert unused("environment: {world: {wind: 0}}") == ["nothing uses the value of the world wind"]
    assert unused("environment: {definitions: {'twice(x)': 2 * x}}") == ["nothing uses the definition twice"]


def test_what_only_unused_names_use_is_told_with_them() -> None:
    part = "constants: {a: 1, b: a, c: b, d: a + b}"
    assert unused(part) == [
        "the constant a is used only by b and 1 more, which are of no use themselves",
        "the constant b is used only by c and 1 more, which are of no use themselves",
        "nothing uses the constant c",
        "nothing uses the constant d",
    ]


def test_what_is_only_computed_from_itself_does_not_matter() -> None:
    part = "environment: {state: {way: 0}, dynamics: {way: way + speed}}"
    assert unused(part) == ["the state way is used only to compute itself"]


def test_a_name_that_a_parameter_hides_is_not_used() -> None:
    part = (
        "constants: {goal: 3}\nenvironment: {definitions: {'near(goal)': abs(goal) < 1}}\n"
        "reward: {near: 1 if near(height) else 0}"
    )
    assert unused(part) == ["nothing uses the constant goal"]


def test_every_place_that_matters_counts_as_a_use() -> None:
    for part in (
        "reward: {near: 1 if abs(height - goal) < 1 else 0}",
        "environment: {ends: 'mean(height[r] for r in team) > goal'}",
        "behaviors: {stop: {excited: height > goal}}",
        "behaviors: {stop: {inputs: {reached: height >= goal}}}",
        "behaviors: {stop: {actions: {halt: {speed: goal}}}}",
        "behaviors: {stop: {expects: height > goal}}",
        "view: {at: [goal, height]}",
        "environment: {dynamics: {height: height + speed + goal}}",
        "environment: {state: {height: goal}}",
        "design: {learning: {rate: 1 / goal}}",
        "environment: {sensors: {far: height > goal}}\nbehaviors: {stop: {inputs: [far]}}",
    ):
        assert unused(f"constants: {{goal: 3}}\n{part}") == [], part


def test_what_an_environment_in_python_is_told_is_used() -> None:
    part = """
environment: {gymnasium: CartPole-v1, observation: [x, v, angle, turn], action: push,
  robots: 1, state: null, world: null, dynamics: null, definitions: null, sensors: null}
behaviors: {stop: {inputs: {left: angle < 0}, actions: {halt: {push: 1}}}}
reward: {near: earned}
"""
    state = part.replace("state: null", "state: {push: 0, height: null, speed: null}")
    assert unused(state) == []


def test_an_index_in_a_key_of_an_action_is_a_use() -> None:
    part = (
        "constants: {place: 1}\nenvironment: {state: {seen: 'list(0 for i in range(3))'}}\n"
        "behaviors: {stop: {actions: {halt: {'seen[place]': 1}}}}\nreward: {near: max(seen)}"
    )
    assert "nothing uses the constant place" not in unused(part)


def test_what_an_environment_in_python_is_always_told_need_not_change() -> None:
    part = """
environment: {gymnasium: CartPole-v1, observation: [x, v, angle, turn], action: [push, hard],
  robots: 1, state: {push: 0, hard: 1, height: null, speed: null}, dynamics: null, sensors: null}
behaviors: {stop: {inputs: {reached: null, left: angle < 0}, actions: {halt: {push: 1, speed: null}}}}
reward: {near: earned}
"""
    assert check(source(part), warnings=True) == ()
