import json

import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st

from bbsd.text import Data, Source, read
from bbsd.text.writing.writer import write

TRICKY = [
    "",
    "yes",
    "null",
    "12",
    "a: b",
    "a #b",
    "- a",
    "f(x",
    "x)",
    "'",
    '"',
    "a\nb",
    "a\n",
    "\n",
    " a",
    "a:b",
    "---",
]
TRICKY += [
    "word " * 30 + "end",
    "<<",
    "{a}",
    "é🙂\x85\ufeff",
    "a, b",
    "x[0]",
    "# a",
    "key:",
    "...",
    "a\tb",
    "a\n b\n",
]
texts = st.sampled_from(TRICKY) | st.text(st.characters(exclude_categories=["Cs"]), max_size=12)
scalars = st.none() | st.booleans() | st.integers(-(10**90), 10**90) | st.floats() | texts
data = st.recursive(
    scalars,
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(texts, inner, max_size=4),
    max_leaves=12,
)
documents = st.dictionaries(texts | st.just("when"), data, max_size=5)

SPEC = """\
bbsd: 1
name: object-lifting

constants:
  dt: 0.005
  no_wind: 5.0
  obstacles: [[3, 2, 0.5], [5, 5.5, 0.8]]

environment:
  sensors:
    place:
      lowest: height == min(height[r] for r in team)
      middle: otherwise

behaviors:
  do_not_go_fast:
    inputs: [place, pace]
    actions:
      cap:
        speed: min(speed, top_speed)
    rules:
      - when: {pace: [4, 5], place: lowest}
        do: cap
      - otherwise: no action

structure: [stop_at_goal, do_not_go_fast]
"""


def identity(value: Data) -> str:
    return json.dumps(value)  # tells 1 from 1.0 and true, and nan is nan


@settings(deadline=None)
@given(documents)
def test_what_is_written_reads_as_the_same_data(document: dict[str, Data]) -> None:
    again = read(Source("s", write(document)))
    assert again.diagnoses == ()
    assert identity(again.data) == identity(document)


@settings(deadline=None)
@given(documents)
def test_writing_is_stable(document: dict[str, Data]) -> None:
    text = write(document)
    assert write(read(Source("s", text)).data) == text


@settings(deadline=None)
@given(st.dictionaries(texts, texts | st.booleans() | st.none(), max_size=6))
def test_a_reader_of_yaml_1_1_reads_the_same_texts_and_truths(document: dict[str, Data]) -> None:
    assert yaml.safe_load(write(document)) == document


def test_a_spec_is_written_as_people_write_it() -> None:
    assert write(read(Source("s", SPEC)).data) == SPEC


def test_a_list_that_does_not_fit_a_line_has_a_line_for_each_item() -> None:
    names: list[Data] = ["a_rather_long_behavior_name"] * 4
    assert write({"structure": names}) == "structure:\n" + "  - a_rather_long_behavior_name\n" * 4


def test_a_table_that_does_not_fit_a_line_has_a_line_for_each_row() -> None:
    assert write({"t": [[0.125] * 8] * 3}) == "t:\n" + f"  - [{', '.join(['0.125'] * 8)}]\n" * 3


def test_the_widest_list_has_a_hundred_columns() -> None:
    fitting: list[Data] = ["x" * 92]
    assert len(write({"abc": fitting}).rstrip()) == 99
    assert write({"abcd": fitting}).count("\n") == 1
    assert write({"abcde": fitting}).count("\n") == 2


def test_a_long_expression_is_broken_at_its_blanks() -> None:
    expression = " + ".join(f"term_{number}" for number in range(30))
    lines = write({"reward": {"sum": expression}}).split("\n")
    assert all(len(line) <= 100 for line in lines)
    assert lines[1].startswith("  sum: term_0 +")
    assert lines[2].startswith("    ")


def test_a_text_over_lines_is_a_block() -> None:
    document: dict[str, Data] = {"summary": "one\ntwo\n", "notes": ["a\nb", {"c": "d\ne"}]}
    assert write(document) == (
        "summary: |\n  one\n  two\n\nnotes:\n  - |-\n    a\n    b\n  - c: |-\n      d\n      e\n"
    )


def test_empty_collections_are_written_in_brackets() -> None:
    assert write({}) == "{}\n"
    assert write({"a": {}, "b": [], "c": [{}]}) == "a: {}\n\nb: []\n\nc: [{}]\n"


@pytest.mark.parametrize("document", [{"a": object()}, {"a": [1, (2, 3)]}, {1: "a"}, {"a": {None: 1}}])
def test_what_is_no_plain_data_is_refused(document: dict[str, Data]) -> None:
    with pytest.raises(TypeError):
        write(document)
