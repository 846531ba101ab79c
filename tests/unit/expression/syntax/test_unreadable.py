import pytest

from bbsd.expression.syntax.unreadable import find_culprit


@pytest.mark.parametrize(
    ("text", "place", "advice"),
    [
        ("a = 3", 2, "equality is written =="),
        ("a == 1 or b = 3", 12, "equality is written =="),
        ("a <= b && c", 7, "write and"),
        ("a || b", 2, "write or"),
        ("a != b or !c", 10, "write not"),
    ],
)
def test_signs_of_other_languages(text: str, place: int, advice: str) -> None:
    start, length, told = find_culprit(text, 0)
    assert (start, told) == (place, advice)
    assert text[start : start + length] in ("=", "&&", "||", "!")


@pytest.mark.parametrize(
    ("text", "place", "advice"),
    [
        ("max(a", 3, "this ( is never closed; ) is missing"),
        ("max(a, (b + c)", 3, "this ( is never closed; ) is missing"),
        ("max(a, (b + c", 7, "this ( is never closed; ) is missing"),
        ("a + b)", 5, "this ) closes nothing"),
        ("x[max(a]", 7, ") is missing before it"),
    ],
)
def test_brackets_without_a_partner(text: str, place: int, advice: str) -> None:
    assert find_culprit(text, 0) == (place, 1, advice)


def test_otherwise_the_place_is_where_the_parser_stumbled() -> None:
    assert find_culprit("a b", 2) == (2, 0, "")
