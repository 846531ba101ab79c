from __future__ import annotations

import pytest

from bbsd.expression.foreign.translating import translated
from bbsd.expression.syntax.mistakes import ExpressionError, Rewriting
from bbsd.expression.syntax.parsing import parse


def written(text: str) -> tuple[str | None, bool]:
    """Return the text as it should be, and whether that is certain; None where it is not known."""
    with pytest.raises(ExpressionError) as raised:
        parse(text)
    correction = translated(text, raised.value.mistake).correction
    if not isinstance(correction, Rewriting):
        return None, False
    start, length = correction.span
    return text[:start] + correction.text + text[start + length :], correction.is_certain


@pytest.mark.parametrize(
    ("text", "right"),
    [
        ("min(e[1:4])", "min(e[1], e[2], e[3])"),
        ("e[2:9]", "list(e[k + 2] for k in range(7))"),
        ("max(e[:9])", "max(e[k] for k in range(9))"),
        ("grid[y, x] > 1", "grid[y][x] > 1"),
        ("mean([h[r] for r in team])", "mean(h[r] for r in team)"),
        ("[h[r] for r in team][0]", "list(h[r] for r in team)[0]"),
        ("sum(1 for r in team if h[r] > 2)", "sum(1 if h[r] > 2 else 0 for r in team)"),
        ("max(h[r] for r in team if r != robot)", "max(h[r] for r in others)"),
        ("any(h[r] > 1 for r in team if r > 2 or calm)", "any((r > 2 or calm) and h[r] > 1 for r in team)"),
        ("all(h[r] > 1 for r in team if r > 2)", "all(not r > 2 or h[r] > 1 for r in team)"),
        ("[[0] * 3] * 4", "list(list(0 for k in range(3)) for j in range(4))"),
        ("mode in [home, idle]", "mode == home or mode == idle"),
        ("mode not in (home, idle) and x > 1", "(mode != home and mode != idle) and x > 1"),
        ("1 if mode is not home else 0", "1 if mode != home else 0"),
        ("max(r.height for r in team)", "max(height[r] for r in team)"),
        ("[1, 2]", "list(1, 2)"),
        ("“1 if a else 0”", "1 if a else 0"),
        ("0.1# seconds", "0.1 # seconds"),
        ("a ? b : c  // in a minute", "b if a else c  # in a minute"),
    ],
)
def test_lists_and_comments_of_other_languages_are_written_as_here(text: str, right: str) -> None:
    assert written(text) == (right, True)


@pytest.mark.parametrize(
    ("text", "right"),
    [
        ("max(h[r] for r in team if r > 1)", "max(h[r] if r > 1 else -1e9 for r in team)"),
        ("speed * topSpeed", "speed * top_speed"),
        ("a // speed in meters", "a # speed in meters"),
    ],
)
def test_what_has_another_reading_is_not_certain(text: str, right: str) -> None:
    assert written(text) == (right, False)


def test_a_slice_without_an_end_is_told_without_a_right_line() -> None:
    assert written("e[2:]") == (None, False)


def test_a_division_in_a_generator_is_no_comment() -> None:
    assert written("sum(a // b for b in team if b)")[0] == "sum(a // b if b else 0 for b in team)"
