import math
from typing import Any

import pytest

from bbsd.text.writing.scalars import literal_lines, scalar_text


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (None, "null"),
        (True, "true"),
        (False, "false"),
        (5, "5"),
        (-0.5, "-0.5"),
        (5.0, "5.0"),
        (1e-05, "1e-05"),
        (1e300, "1e+300"),
        (math.inf, ".inf"),
        (-math.inf, "-.inf"),
        (math.nan, ".nan"),
        ("lowest", "lowest"),
        ("speed + 1", "speed + 1"),
        ("min(speed, top)", "min(speed, top)"),
        ("-x", "-x"),
        ("y", "y"),
        ("it's", "it's"),
    ],
)
def test_what_needs_no_quotes_gets_none(value: str | float | None, text: str) -> None:
    assert scalar_text(value) == text


@pytest.mark.parametrize(
    "text",
    [
        "yes",
        "No",
        "on",
        "OFF",
        "null",
        "~",
        "",
        "12",
        "1e-3",
        "0x1f",
        "1_000",
        "12:30",
        "2001-01-01",
        "=",
        "<<",
    ],
)
def test_what_a_reader_of_yaml_would_mistake_is_quoted(text: str) -> None:
    assert scalar_text(text) == f"'{text}'"


@pytest.mark.parametrize(
    "text",
    [
        *[
            "> 3",
            "%x",
            "@a",
            "*b",
            "&c",
            "!d",
            "[e",
            "{f",
            "- g",
            "-",
            "| h",
            "? i",
            "`j`",
            '"k"',
            "#l",
            ", m",
        ],
        *["a: b", "a #b", "a:", " a", "a ", "---", "...", "key:value"],
    ],
)
def test_what_would_break_yaml_is_quoted(text: str) -> None:
    assert scalar_text(text) == f"'{text}'"


@pytest.mark.parametrize("text", ["a, b", "x[0]", "a:b", "f(x", "x)", "{", "a?"])
def test_more_is_quoted_inside_brackets(text: str) -> None:
    assert scalar_text(text, flow=True) == f"'{text}'"


def test_single_quotes_are_doubled() -> None:
    assert scalar_text("'tis: so") == "'''tis: so'"


def test_what_cannot_be_seen_is_escaped() -> None:
    assert scalar_text('a\n\t"\\\x00\xa0\u2028\u202e\U000e0001') == (
        '"a\\n\\t\\"\\\\\\x00\\xA0\\u2028\\u202E\\U000E0001"'
    )


def test_a_text_over_lines_is_a_literal_block() -> None:
    assert literal_lines("one\ntwo") == ["|-", "one", "two"]
    assert literal_lines("one\ntwo\n") == ["|", "one", "two"]


@pytest.mark.parametrize(
    "text", ["one", "", "\n", "one\n\n", " one\ntwo", "one \ntwo", "a\tb\nc\x07", "one\r\ntwo"]
)
def test_a_text_that_a_block_would_change_is_no_block(text: str) -> None:
    assert literal_lines(text) is None


@pytest.mark.parametrize("value", [object(), 1j, b"x", (1, 2)])
def test_other_values_are_refused(value: Any) -> None:
    with pytest.raises(TypeError, match="is not a plain value"):
        scalar_text(value)
