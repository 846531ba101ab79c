import sys
from bisect import bisect

import pytest

from tests.unit.language.specs import codes, meaning_of, messages


def test_definitions_follow_the_robot_that_uses_them() -> None:
    found = meaning_of("""
environment:
  definitions:
    lead: height - height[0]
    far(limit): abs(lead) > limit
reward:
  near: 1 if far(2) else 0
""")
    assert {robot for name, robot, _ in found.episode.definitions if name == "lead"} == {0, 1, 2}
    assert not any(name == "far" for name, *_ in found.episode.definitions)


def test_a_parameter_hides_a_name_of_the_spec() -> None:
    assert codes("environment: {state: {turn: spin(2)}, definitions: {spin(turn): turn * 2}}") == []


@pytest.mark.parametrize(
    "key", ["Far", "far(", "far(A)", "far(a, a)", "far(step)", "step(a)", "far(a)(b)", "far a", "3", "class"]
)
def test_keys_that_are_no_definition(key: str) -> None:
    assert codes(f'environment: {{definitions: {{"{key}": height > 2}}}}')[:1] == ["BB024"]


def test_uses_of_a_definition_whose_key_is_wrong_are_not_told() -> None:
    assert codes(
        'environment: {definitions: {"far(Limit)": height > Limit}}\nreward: {near: 1 if far(2) else 0}'
    ) == ["BB024"]


def test_what_is_named_twice_is_told_at_the_second_place() -> None:
    assert messages("environment: {sensors: {speed: 3}}") == [
        "speed is already the name of something in environment.state (line 9)"
    ]
    assert codes('environment: {definitions: {far: 1, "far(a)": a}}') == ["BB025"]


def test_circles_lead_through_starts_definitions_and_sensors() -> None:
    assert codes("environment: {definitions: {a: b, b: turn}, sensors: {turn: a}}") == ["BB063"]
    assert codes("environment: {state: {height: speed, speed: height}}") == ["BB063"]
    assert codes("environment: {sensors: {drift: height - before(height), late: before(late)}}") == ["BB063"]


def chain(length: int, link: str) -> str:
    lines = "\n".join(f"    d{place}: {link.format(place - 1)}" for place in range(1, length))
    return f"environment:\n  definitions:\n    d0: height\n{lines}\nreward:\n  near: d{length - 1}\n"


@pytest.mark.parametrize(
    "link", ["d{} + 1", "max(d{}, 2)", "d{} if tilted else 1", "d{}[2]", "sum(d{}[r] for r in team)"]
)
def test_a_chain_is_elaborated_or_told_but_never_too_deep_for_python(link: str) -> None:
    longest = bisect(range(200), 0, lo=10, key=lambda length: len(codes(chain(length, link)))) - 1
    limit = sys.getrecursionlimit()
    assert longest > 20
    try:
        sys.setrecursionlimit(len(_stack()) + 800)
        assert codes(chain(longest, link)) == []
    finally:
        sys.setrecursionlimit(limit)


def _stack() -> list[object]:
    frame, found = sys._getframe(), []
    while frame:
        found.append(frame)
        frame = frame.f_back
    return found


def test_a_chain_that_is_far_too_long_is_told_once() -> None:
    assert codes(chain(400, "d{} + 1")) == ["BB060"]
