import math

import pytest

from bbsd.text.core_schema import is_text, is_text_everywhere, meaning


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("12", 12),
        ("-3", -3),
        ("007", 7),
        ("0x1F", 31),
        ("0o17", 15),
        ("1e-3", 1e-3),
        ("5.", 5.0),
        (".5", 0.5),
        ("-.inf", -math.inf),
        ("true", True),
        ("FALSE", False),
        ("null", None),
        ("~", None),
        ("", None),
    ],
)
def test_numbers_truths_and_nulls_are_those_of_yaml_1_2(text: str, value: float | None) -> None:
    assert meaning(text) == value
    assert type(meaning(text)) is type(value)
    assert not is_text(text)


@pytest.mark.parametrize("text", ["yes", "no", "on", "off", "12:30", "1_000", "2001-01-01", "=", "<<", "0b1"])
def test_what_only_yaml_1_1_reads_as_something_else_is_a_text(text: str) -> None:
    assert meaning(text) == text
    assert is_text(text)
    assert not is_text_everywhere(text)


@pytest.mark.parametrize("text", ["x", "y", "n", "lowest", "speed + 1", "-x", "1 / episode"])
def test_names_and_expressions_are_texts_everywhere(text: str) -> None:
    assert is_text_everywhere(text)
