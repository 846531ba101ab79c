"""The house style changes blanks and quotes, and not the content of a file."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from bbsd.text import Source, read
from bbsd.text.writing.house_style import in_house_style
from bbsd.text.writing.leaves import comments_in

ROOT = Path(__file__).parents[4]
SHIPPED = [*sorted((ROOT / "specs").rglob("*.yaml")), *sorted((ROOT / "bbsd/cli/templates").glob("*.yaml"))]
FILES = [*SHIPPED, *sorted((ROOT / "tests/specs/valid").glob("*.yaml"))]


def document(text):
    return read(Source("spec.yaml", text))


def styled(text):
    return in_house_style(document(text))


def content(text):
    read_document = document(text)
    assert not read_document.diagnoses, text
    comments = [text[start:end].rstrip() for start, end in comments_in(text, read_document.root)]
    return json.dumps(read_document.data), comments


@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.name)
def test_shipped_specs_are_in_the_style(path):
    text = path.read_text(encoding="utf-8")
    assert styled(text) == text


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.name)
def test_the_content_is_kept_and_a_second_run_changes_nothing(path):
    text = path.read_text(encoding="utf-8")
    once = styled(text)
    assert content(once) == content(text)
    assert styled(once) == once


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a:\n    b: 1\n", "a:\n  b: 1\n"),
        ("a:\n- 1\n- 2\n", "a:\n  - 1\n  - 2\n"),
        ("a:\n  -   b: 1\n      c: 2\n", "a:\n  - b: 1\n    c: 2\n"),
        ("a:\n - - 1\n   - 2\n", "a:\n  - - 1\n    - 2\n"),
        ("a :   1   \n", "a: 1\n"),
        ("a: {b : [1,2 , 3],c: x }\n", "a: {b: [1, 2, 3], c: x}\n"),
        ("a: [ 1, 2, ]\n", "a: [1, 2]\n"),
        ('a: \'b\'\n"c": "d e"\n', "a: b\nc: d e\n"),
        ("a: {b: 'min(x, y)'}\n", "a: {b: 'min(x, y)'}\n"),
        ("a: 'no'\nb: '1'\nc: ''\nd: '> 1'\n", "a: 'no'\nb: '1'\nc: ''\nd: '> 1'\n"),
        ("a: 1 # one\n", "a: 1  # one\n"),
        ("a:   1     # one\nb: two   # two\n", "a: 1       # one\nb: two   # two\n"),
        ("a:\n    # of b\n    b: 1\n    # the end\nc: 1\n", "a:\n  # of b\n  b: 1\n  # the end\n\nc: 1\n"),
        ("\n\na: 1\n\n\n\nb: 2\n\n", "a: 1\n\nb: 2\n"),
        ("a:\n  b: 1\n# of c\nc:\n  d: 1\n", "a:\n  b: 1\n\n# of c\nc:\n  d: 1\n"),
        ("a:\n    b: x +\n        y\n", "a:\n  b: x +\n      y\n"),
        ("a:\n    b: |\n      x\n        y\n", "a:\n  b: |\n    x\n      y\n"),
        ("a: &n\n    b: 1\nc: *n\n", "a: &n\n  b: 1\n\nc: *n\n"),
        ("a:\r\n    b: 1\r\n", "a:\r\n  b: 1\r\n"),
        ("  a: 1\n  b: 2", "a: 1\nb: 2\n"),
        ("{a: 1,b: 2}\n", "{a: 1, b: 2}\n"),
        ("a:\n    b: [1,\n        2]\n", "a:\n  b: [1,\n      2]\n"),
    ],
)
def test_a_file_is_put_in_the_style(text, expected):
    assert styled(text) == expected
    assert styled(expected) == expected


@pytest.mark.parametrize("text", ["? a\n:   1\n", "a: |+\n  x\n\n\n", 'a: "x\\\n   y"\n', "a: [b: 1]\n"])
def test_what_is_written_unusually_is_left_alone(text):
    assert content(styled(text)) == content(text)


def test_a_file_with_mistakes_is_refused():
    with pytest.raises(ValueError, match="mistakes"):
        styled("a: 1\na: 2\n")


# Files as people leave them: any indentation, spacing, quotes, comments and blank lines.

NAMES = st.text("abcdefgh_", min_size=1, max_size=6).filter(lambda name: name.strip("_"))
TEXTS = st.sampled_from(["x + 1", "no", "min(a, b)", "a: b", "# no", "1", "", "- x", "it's", "x if y else z"])
VALUES = st.recursive(
    st.integers(-9, 9) | st.booleans() | TEXTS,
    lambda inner: st.dictionaries(NAMES, inner, max_size=3) | st.lists(inner, max_size=3),
    max_leaves=8,
)
BLANKS = st.integers(1, 3).map(lambda count: " " * count)
QUOTED = {"'": lambda text: "'" + text.replace("'", "''") + "'", '"': json.dumps}


@st.composite
def files(draw):
    data = draw(st.dictionaries(NAMES, VALUES, min_size=1, max_size=4))
    return "".join(_block(draw, data, draw(st.integers(0, 2))))


def _block(draw, data, column):
    """Yield the lines of a mapping or list whose keys or dashes begin in a column."""
    for each in data:
        yield from _aside(draw, column)
        head = "-" if isinstance(data, list) else f"{each}{draw(st.sampled_from(['', ' ']))}:"
        value = each if isinstance(data, list) else data[each]
        if isinstance(value, dict | list) and value and draw(st.booleans()):
            yield f"{' ' * column}{head}{draw(st.sampled_from(['', '  ', ' # so', '   # so']))}\n"
            yield from _block(draw, value, column + draw(st.integers(1, 5)))
        else:
            end = draw(st.sampled_from(["", " ", " # here", "    # there"]))
            yield f"{' ' * column}{head}{draw(BLANKS)}{_flow(draw, value)}{end}\n"


def _aside(draw, column):
    """Yield blank lines and comments, in the column of what follows or in another."""
    for each in draw(st.lists(st.sampled_from(["", "#", "# why", "blank"]), max_size=2)):
        if each.startswith("#"):
            yield f"{' ' * draw(st.sampled_from([column, column, 0, 3]))}{each}\n"
        elif each:
            yield draw(st.sampled_from(["\n", "  \n", "\n\n\n"]))


def _flow(draw, value):
    blank = draw(st.sampled_from(["", " ", "  "]))
    if isinstance(value, dict):
        inner = [f"{key}{blank}: {_flow(draw, each)}" for key, each in value.items()]
        return f"{{{blank}{f'{blank},{blank} '.join(inner)}{blank}}}"
    if isinstance(value, list):
        return f"[{blank}{f'{blank},{blank}'.join(_flow(draw, each) for each in value)}{blank}]"
    return QUOTED[draw(st.sampled_from("'\""))](value) if isinstance(value, str) else json.dumps(value)


@settings(max_examples=100)
@given(files())
def test_any_file_keeps_its_content_and_a_second_run_changes_nothing(text):
    once = styled(text)
    assert content(once) == content(text)
    assert styled(once) == once
    assert document(once).data == document(text).data
