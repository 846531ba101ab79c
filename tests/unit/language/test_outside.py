"""What a spec says of an environment that is stepped in Python, read without importing anything."""

import sys

import pytest

from bbsd.language.loading import check, load
from bbsd.language.outside import Field, Outside, OutsideKind, read_path
from bbsd.text import Source

SPEC = """
bbsd: 1
name: example
environment:
  {target}
  steps: 10
  observation: {observation}
  action: {action}
  state: {{push: 0, turn: 0}}
behaviors:
  act: {{actions: {{left: {{push: 0}}, right: {{push: 1}}}}}}
reward: {{earned: earned}}
"""


def written(
    target: str = "gymnasium: CartPole-v1", observation: str = "[angle]", action: str = "push"
) -> Source:
    return Source("spec.yaml", SPEC.format(target=target, observation=observation, action=action))


def outside(
    target: str = "gymnasium: CartPole-v1", observation: str = "[angle]", action: str = "push"
) -> Outside:
    found = load(written(target, observation, action)).spec.environment.outside
    assert found is not None
    return found


def mistakes(
    target: str = "gymnasium: CartPole-v1", observation: str = "[angle]", action: str = "push"
) -> list[tuple[str, str]]:
    return [(diagnosis.code, diagnosis.message) for diagnosis in check(written(target, observation, action))]


def test_all_that_a_spec_says() -> None:
    found = outside(
        "with: {limit: 5, sizes: [1, 2.5], deep: {a: null}}\n  pettingzoo: mpe2.simple_spread_v3",
        "[x, _, y]",
        "[turn, push]",
    )
    assert found == Outside(
        "pettingzoo",
        "mpe2.simple_spread_v3",
        {"limit": 5, "sizes": [1, 2.5], "deep": {"a": None}},
        (Field("x"), Field("_"), Field("y")),
        ("turn", "push"),
    )
    assert found.names == ("x", "y", "earned")


def test_sizes_and_paths() -> None:
    assert outside(observation="{row: 5, column: 4.0}").fields == (Field("row", 5), Field("column", 4))
    assert outside(observation='{front: "image[3, 5,0]", facing: direction}').fields == (
        Field("front", path=("image", 3, 5, 0)),
        Field("facing", path=("direction",)),
    )


def test_an_own_world_has_none() -> None:
    text = "bbsd: 1\nname: own\nenvironment: {steps: 3, state: {x: 0}}\n"
    text += "behaviors: {a: {actions: {b: {x: 1}}}}\nreward: {r: x}"
    assert load(Source("spec.yaml", text)).spec.environment.outside is None


@pytest.mark.parametrize(
    ("text", "path"),
    [("image", ("image",)), ("image[3,5,0]", ("image", 3, 5, 0)), ("a.b[2].c", ("a", "b", 2, "c")),
     ("[0]", (0,)), ("[1].x", (1, "x")), ("[1][2]", (1, 2)), ("desired goal[0]", ("desired goal", 0)),
     ("", None), ("a.", None), (".a", None), ("a..b", None), ("a[]", None), ("a[-1]", None), ("a[1.5]", None),
     ("a[1", None), ("a]1[", None), ("a[1]b", None), ("a[1234567890]", None), ("a[x]", None)],
)  # fmt: skip
def test_paths(text: str, path: tuple[str | int, ...] | None) -> None:
    assert read_path(text) == path


@pytest.mark.parametrize(
    ("kind", "target"),
    [("gymnasium", "CartPole-v1"), ("gymnasium", "ALE/Breakout-v5"), ("gymnasium", "minigrid:MiniGrid-Empty-5x5-v0"),
     ("gymnasium", "a.b:space-1/Name.x_y-v10"), ("pettingzoo", "mpe2.simple_spread_v3"),
     ("pettingzoo", "pettingzoo.sisl.multiwalker_v9"), ("python", "arena:Arena"), ("python", "my.arena_1:Arena2")],
)  # fmt: skip
def test_names_of_environments(kind: OutsideKind, target: str) -> None:
    found = outside(f"{kind}: {target}")
    assert (found.kind, found.target) == (kind, target)


@pytest.mark.parametrize(
    ("kind", "target"),
    [("gymnasium", "CartPole"), ("gymnasium", "CartPole-v"), ("gymnasium", "-v1"), ("gymnasium", "a/b/C-v1"),
     ("gymnasium", "os; import x:C-v1"), ("gymnasium", "../evil:C-v1"), ("gymnasium", "CartPole-v1 "),
     ("pettingzoo", "simple_spread_v3"), ("pettingzoo", "mpe2.simple_spread"), ("pettingzoo", "mpe2:spread_v3"),
     ("python", "arena"), ("python", "arena.py:"), ("python", ":Arena"), ("python", "arena:Arena()"),
     ("python", "folder/arena:Arena"), ("python", "arena:Outer.Inner"), ("python", "árena:Arena")],
)  # fmt: skip
def test_other_texts_are_no_names(kind: str, target: str) -> None:
    assert [code for code, _ in mistakes(f'{kind}: "{target}"')] == ["BB102"]


def test_a_number_is_no_name() -> None:
    assert mistakes("gymnasium: 5") == [("BB102", "a number cannot be the name of an environment")]


def test_nothing_is_imported_to_check_a_spec(tmp_path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "outside_module.py").write_text("raise SystemExit('imported')")
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.chdir(tmp_path)
    for target in (
        "python: outside_module:A", "gymnasium: outside_module:A-v0", "pettingzoo: outside_module.a_v0",
    ):  # fmt: skip
        assert mistakes(target) == []
    assert "outside_module" not in sys.modules


@pytest.mark.parametrize("given", ["{a-b: 1}", "{class: 1}", "{1a: 2}", "{a: [.nan]}", "{a: {b: -.inf}}"])
def test_arguments_that_cannot_be_given(given: str) -> None:
    assert [code for code, _ in mistakes(f"with: {given}\n  gymnasium: CartPole-v1")] == ["BB103"]


@pytest.mark.parametrize("given", ["", "{}", "null"])
def test_no_arguments(given: str) -> None:
    assert outside(f"with: {given}\n  gymnasium: CartPole-v1").arguments == {}


@pytest.mark.parametrize(
    ("size", "message"),
    [("0", "a size is a whole number from 1 on, not 0"), ("2.5", "a size is a whole number from 1 on, not 2.5"),
     ("true", "a size is a whole number from 1 on, not a truth"),
     ("[1]", "a size is a whole number from 1 on, not a list")],
)  # fmt: skip
def test_sizes_that_are_none(size: str, message: str) -> None:
    assert mistakes(observation=f"{{angle: {size}}}") == [("BB109", message)]


def test_sizes_and_paths_do_not_mix() -> None:
    expected = [("BB109", "b has a path, and a has a size")]
    assert mistakes(observation="{a: 2, b: image, c: image}") == expected


@pytest.mark.parametrize("name", ["Angle", "_x", "step", "a-b"])
def test_names_that_expressions_cannot_use(name: str) -> None:
    assert [code for code, _ in mistakes(observation=f"[angle, {name}]")] == ["BB024"]


def test_mistakes_of_form_do_not_hide_those_of_meaning() -> None:
    source = written("gymnasium: CartPole\n  with: {a-b: 1}", "[Angle, tilt]", "pull")
    source = Source("spec.yaml", source.text.replace("earned: earned", "earned: earned + titl + angle"))
    assert [(each.code, each.place.line) for each in check(source)] == [
        ("BB102", 5), ("BB103", 6), ("BB024", 8), ("BB106", 9), ("BB052", 13),
    ]  # fmt: skip
