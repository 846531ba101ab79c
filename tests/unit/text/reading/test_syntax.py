import pytest

from bbsd.errors import Diagnosis
from bbsd.errors.catalog import KINDS
from bbsd.text import Source, read


def diagnosis(text: str) -> Diagnosis:
    (only,) = read(Source("spec.yaml", text)).diagnoses
    return only


@pytest.mark.parametrize(
    "value",
    [
        "> 3",
        ">= 3",
        "| x",
        "%x",
        "@a",
        "`a`",
        "* 3",
        "*b + 1",
        "& b",
        "[1, 2][0]",
        "{a} - 1",
        "'a' + 1",
    ],
)
@pytest.mark.parametrize("frame", ["x: {}", "x: {}\ny: 2\n", "x:\n  - y: {}   # why\n", "x:\n  - {}\n"])
def test_an_expression_that_yaml_cannot_begin_with_needs_quotes(value: str, frame: str) -> None:
    text = frame.replace("{}", value)
    found = diagnosis(text)
    assert found.code == "BB004"
    assert found.message == f'a value that begins with "{value[0]}" needs quotes'
    line = text.split("\n")[found.place.line - 1]
    assert line[found.place.column - 1 :][: found.place.length] == value
    assert found.advice == f'write "{value}", if an expression is meant'


def test_a_long_value_is_not_repeated_in_the_advice() -> None:
    assert diagnosis("x: > " + "a" * 100).advice == "put all of it in quotes, if an expression is meant"


@pytest.mark.parametrize(
    ("text", "line", "column", "message"),
    [
        ("x: {a: b[0]}", 1, 9, 'a value inside {...} or [...] cannot contain "[" without quotes'),
        ("x: {a: b", 1, 4, 'this "{" is never closed'),
        ("x: {a: b\ny: 3\n", 1, 4, 'this "{" is never closed'),
        ("a: 1\nx: [a, b\ny: 3\n", 2, 4, 'this "[" is never closed'),
        ("x: {a: b,", 1, 10, "the file ends inside a {...} or [...] that is never closed"),
        ("x: {a: 1 b: 2}", 1, 11, 'there is a comma or a "}" missing before this'),
        ("x: {a: 1,\n    b: 2\n    c: 3}", 3, 6, 'there is a comma or a "}" missing before this'),
        ("x: }", 1, 4, 'this "}" closes nothing'),
        ("x: 1\n]\n", 2, 1, 'this "]" closes nothing'),
        ("x: 1}\ny: [2]]", 2, 7, 'this "]" closes nothing'),
        ("x: 'abc\ny: 3\n", 1, 4, "this quote is never closed"),
        ('x: {a: "b}\ny: 3\n', 1, 8, "this quote is never closed"),
        ('x: "a\n---\n', 1, 4, "this quote is never closed"),
        ("x: - 3", 1, 4, "a value cannot begin with a minus and a blank"),
        ("x: ? 3", 1, 4, 'a value that begins with "?" needs quotes'),
        ("x: a: b\n", 1, 5, "a value with a colon and a blank in it needs quotes"),
        ("x: 1 if a else: 3\n", 1, 15, "a value with a colon and a blank in it needs quotes"),
        ("x:\n  a: 1\n b: 2\n", 3, 2, "this line is indented unlike those it should belong to"),
        (
            "x:\n  a: 1\n    b: 2\n",
            3,
            5,
            "this line is indented more than the one above it, which has a value already",
        ),
        ("x: 1\n- 2\n", 2, 1, "an item of a list stands among keys"),
        ("- 1\nx: 3\n", 2, 1, "this line stands in a list and does not begin with a dash"),
        ("a: 1\nb\nc: 3", 2, 1, 'there is no colon after "b"'),
        ("a\n  b: 3", 1, 1, 'there is no colon after "a"'),
        ("x: 1\n...\ny: 2", 3, 1, "there is more after the end of the document"),
        ("%YAML 3.1\n---\nx: 1", 1, 1, "a line cannot begin with %"),
        ("%FOO\n---\nx: 1", 1, 1, "a line cannot begin with %"),
    ],
)
def test_a_syntax_error_is_explained_in_plain_words_at_its_place(
    text: str, line: int, column: int, message: str
) -> None:
    found = diagnosis(text)
    assert (found.code, found.message, found.place.line, found.place.column) == (
        "BB004",
        message,
        line,
        column,
    )


@pytest.mark.parametrize("value", ['"a\\qb"', '"\\u12"', '"\\x"'])
def test_an_unknown_escape_needs_single_quotes(value: str) -> None:
    found = diagnosis(f"x: {value}")
    assert found.code == "BB004"
    assert "single quotes" in found.advice


@pytest.mark.parametrize(
    ("text", "line"),
    [("x:\n\ty: 3\n", 2), ("\tx: 3", 1), ("x: a\n\ty: 2\n", 2), ("a: 1\n\n \t\n\tb: 3\n", 4)],
)
def test_a_tab_that_indents_is_shown(text: str, line: int) -> None:
    found = diagnosis(text)
    assert (found.code, found.place.line) == ("BB005", line)


@pytest.mark.parametrize(
    "code", ["BB004", "BB005", "BB006", "BB007", "BB008", "BB009", "BB010", "BB014", "BB015"]
)
def test_the_examples_of_the_catalog_are_what_they_say(code: str) -> None:
    def codes(text: str) -> list[str]:
        return [each.code for each in read(Source("s", text)).diagnoses]

    assert code in codes(KINDS[code].example)
    assert code not in codes(KINDS[code].mend)


@pytest.mark.parametrize("code", ["BB016", "BB017", "BB018"])
def test_the_traps_of_the_catalog_are_what_they_say(code: str) -> None:
    assert [each.code for each in read(Source("s", KINDS[code].example)).diagnoses] == [code]
    assert read(Source("s", KINDS[code].mend)).diagnoses == ()
