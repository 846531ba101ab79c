import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bbsd.errors import inert, inert_cell, inert_json

PLAIN = "a line\n\tand Größe, 速度, 🙂 and █\n"
BOLD_RED = "\x1b[1;31mred\x1b[0m and \x1b[mplain\x1b[2m"


@pytest.mark.parametrize("text", ["", PLAIN, BOLD_RED, "a::b", "a ::error::", ":: a"[1:]])
def test_what_is_harmless_stays(text: str) -> None:
    assert inert(text) == text


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("\x1b[2J", r"\x1b[2J"),
        ("\x1b[8mhidden", r"\x1b[8mhidden"),
        ("\x1b[30;40m", r"\x1b[30;40m"),
        ("\x1b]0;title\x07", r"\x1b]0;title\x07"),
        ("\x9b31m", r"\x9b31m"),
        ("a\rb\x08c\x00", r"a\rb\x08c\x00"),
        ("\u202eabc\u2066", r"\u202eabc\u2066"),
        ("a\xa0b\u2028c", r"a\xa0b\u2028c"),
        ("::error::a\n::add-mask::b", "\\::error::a\n\\::add-mask::b"),
        ("##[group]a", "\\##[group]a"),
    ],
)
def test_what_steers_or_hides_is_shown(text: str, shown: str) -> None:
    assert inert(text) == shown
    assert inert(shown) == shown


def test_commands_are_left_where_they_were_asked_for_and_in_the_middle_of_a_line() -> None:
    assert inert("::error::\x1b[2J", commands=True) == r"::error::\x1b[2J"
    assert inert("::error::", begins_line=False) == "::error::"
    assert inert("a\n::error::", begins_line=False) == "a\n\\::error::"


@given(st.text())
def test_nothing_of_any_text_steers(text: str) -> None:
    shown = inert(text)
    for line in shown.split("\n"):
        assert not line.startswith(("::", "##["))
    rest = shown.replace("\n", "").replace("\t", "")
    assert "\x1b" not in rest or "\x1b[" in text
    assert all(
        character.isprintable() or character == "\x1b" or ord(character) >= 0xE000 for character in rest
    )


@given(st.text())
def test_json_stays_what_it_means(text: str) -> None:
    shown = inert_json(json.dumps([text], indent=2, ensure_ascii=False))
    assert json.loads(shown) == [text]
    assert inert(shown, commands=True) == shown or "\x1b" in shown


@pytest.mark.parametrize("text", ["=cmd|' /C calc'!A0", "+1+1", "-2+3", "@sum(a)", "\tx", "\r=1"])
def test_a_cell_is_no_formula(text: str) -> None:
    assert inert_cell(text).startswith(("'", "\\"))


@pytest.mark.parametrize("text", ["-1.5", "+1e5", "low", "", "0", "-inf"])
def test_a_number_or_a_word_is_a_cell_as_it_is(text: str) -> None:
    assert inert_cell(text) == text
