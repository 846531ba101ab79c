import pytest

from bbsd.text import Document, Source, read
from bbsd.text.reading.composition import MAX_DEPTH, MAX_NODES, compose


def document(text: str) -> Document:
    return read(Source("spec.yaml", text))


def codes(text: str) -> list[str]:
    return [diagnosis.code for diagnosis in document(text).diagnoses]


def test_data_are_plain_values() -> None:
    text = "a: 1\nb: [x, 2.5, true, null]\nc:\n  d: 'no'\n  e:\n"
    assert document(text).data == {"a": 1, "b": ["x", 2.5, True, None], "c": {"d": "no", "e": None}}
    assert codes(text) == []


def test_words_that_yaml_1_1_reads_as_truths_stay_words() -> None:
    assert document("a: [yes, no, on, off, y]").data == {"a": ["yes", "no", "on", "off", "y"]}


def test_aliases_are_expanded_and_nothing_is_shared() -> None:
    data = document("a: &x [1, {b: 2}]\nc: *x\nd: *x\n").data
    assert data == {"a": [1, {"b": 2}], "c": [1, {"b": 2}], "d": [1, {"b": 2}]}
    assert data["a"] is not data["c"]


def test_a_later_anchor_of_the_same_name_counts() -> None:
    assert document("a: &x 1\nb: *x\nc: &x 2\nd: *x\n").data == {"a": 1, "b": 1, "c": 2, "d": 2}


@pytest.mark.parametrize("text", ["", "\n\n", "# only a comment\n", "---\n", "- 1\n- 2\n", "word", "12"])
def test_a_text_that_is_no_mapping_is_one_mistake(text: str) -> None:
    assert codes(text) == ["BB014"]
    assert document(text).data == {}


def test_an_empty_mapping_is_a_mapping() -> None:
    assert document("{}").data == {}
    assert codes("{}") == []


def test_a_second_document_is_shown_where_it_begins() -> None:
    read_document = document("a: 1\n---\nb: 2\n")
    assert [(each.code, each.place.line) for each in read_document.diagnoses] == [("BB015", 2)]
    assert read_document.data == {"a": 1}


@pytest.mark.parametrize("tag", ["!!python/object/apply:os.system", "!!str", "!mine", "!"])
def test_tags_are_refused_and_what_they_tag_is_a_text(tag: str) -> None:
    assert codes(f"a: {tag} 1") == ["BB009"]
    assert document(f"a: {tag} 1").data == {"a": "1"}


def test_tags_of_mappings_and_lists_are_refused() -> None:
    assert codes("a: !x {b: 1}\nc: !y [1]\n") == ["BB009", "BB009"]


def test_an_alias_of_nothing_is_shown_with_advice() -> None:
    (diagnosis,) = document("a: *b\n").diagnoses
    assert (diagnosis.code, diagnosis.place.column, diagnosis.place.length) == ("BB010", 4, 2)
    assert "quotes" in diagnosis.advice


def test_an_alias_inside_its_own_anchor_is_refused() -> None:
    assert codes("a: &x [1, *x]\n") == ["BB010"]
    assert codes("a: &x 1\nb: &x [*x]\n") == ["BB010"]


def test_aliases_cannot_expand_beyond_the_bound() -> None:
    lines = ["a0: &a0 [x, x, x, x, x, x, x, x, x]"]
    lines += [f"a{i}: &a{i} [{', '.join([f'*a{i - 1}'] * 9)}]" for i in range(1, 30)]
    assert codes("\n".join(lines)) == ["BB011"]


@pytest.mark.slow
def test_the_bound_of_values_is_exact() -> None:
    fitting = MAX_NODES - 3  # the mapping, its key, the list
    assert codes("a: [" + "1," * fitting + "]") == []
    assert codes("a: [" + "1," * (fitting + 1) + "]") == ["BB011"]


def test_the_bound_of_depth_is_exact() -> None:
    fitting = MAX_DEPTH - 2  # the mapping and the innermost value
    assert codes("a: " + "[" * fitting + "1" + "]" * fitting) == []
    assert codes("a: " + "[" * (fitting + 1) + "1" + "]" * (fitting + 1)) == ["BB012"]


def test_aliases_cannot_nest_beyond_the_bound() -> None:
    assert codes("\n".join(f"a{i}: &a{i} [{f'*a{i - 1}' if i else 'x'}]" for i in range(60))) == ["BB012"]


@pytest.mark.parametrize("text", ["[" * 10**6, "a: " + "{" * 10**6, "- " * 10**5, "? " * 10**5])
def test_endless_nesting_ends_reading_at_once(text: str) -> None:
    assert codes(text) == ["BB012"]


def test_a_number_of_many_digits_is_refused() -> None:
    assert codes("a: " + "9" * 100) == []
    assert codes("a: " + "9" * 101) == ["BB013"]
    assert codes("a: 1." + "9" * 5000) == ["BB013"]


def test_a_long_text_is_refused() -> None:
    assert codes("a: " + "x" * 10_000) == []
    assert codes("a: " + "x" * 10_001) == ["BB013"]
    assert codes("table: " + "x" * 900_000) == []


def test_a_long_table_cannot_be_repeated_as_another_text() -> None:
    assert codes("table: &long " + "x" * 10_001 + "\na: *long\n") == ["BB013"]


def test_long_texts_count_as_several_values() -> None:
    repeated = "".join(f"a{n}: {{table: *long}}\n" for n in range(600))
    assert codes("table: &long " + "x" * 100_000 + "\n" + repeated) == ["BB011"]


@pytest.mark.parametrize("character", ["\0", "\x07", "\x1b", "\x7f", "\ufffe", "\ud800"])
def test_a_control_character_is_shown_where_it_is(character: str) -> None:
    (diagnosis,) = document(f"a: 1\nb: x{character}\n").diagnoses
    assert (diagnosis.code, diagnosis.place.line, diagnosis.place.column) == ("BB003", 2, 5)


def test_mistakes_before_a_syntax_error_are_kept_in_order() -> None:
    assert codes("a: {b: 1, b: 2}\nb: !x 3\nc: {d\n") == ["BB006", "BB009", "BB004"]


def test_a_syntax_error_replaces_a_mistake_at_the_same_place() -> None:
    assert codes("a: *b + 1\nc: 2\n") == ["BB004"]


@pytest.mark.parametrize("break_", ["\x85", "\u2028", "\u2029"])
def test_a_line_break_that_is_none_for_readers_is_refused_by_name(break_: str) -> None:
    (diagnosis,) = compose(Source("s", f"a: 1  # a comment{break_}hidden: 2\n"))[1]
    assert (diagnosis.code, diagnosis.place.column) == ("BB003", 18)
    assert f"hidden line break U+{ord(break_):04X}" in diagnosis.message


@pytest.mark.parametrize(
    ("text", "advice"),
    [
        ("010", "write 10, or 0o10 if octal is meant"),
        ("-09", "write -9"),
        ("00.5", "write 0.5"),
        ("+0012", "write +12"),
    ],
)
def test_a_number_with_a_zero_in_front_is_refused(text: str, advice: str) -> None:
    (diagnosis,) = compose(Source("s", f"a: {text}\n"))[1]
    assert (diagnosis.code, diagnosis.advice) == ("BB125", advice)


@pytest.mark.parametrize("text", ["0", "0.5", "-0.5", "0o17", "0x1f", "1e05", '"010"', "010-020", "0 + 1"])
def test_other_zeros_are_left(text: str) -> None:
    assert compose(Source("s", f"a: {text}\n"))[1] == []
