import pytest

from bbsd.exports.names import Names, words_of


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("below 1.5", "below_1_5"),
        ("-1 to -0.5", "minus_1_to_minus_0_5"),
        ("back-left", "back_left"),
        ("a - b", "a_b"),
        ("Größe", "Gro_udf_e"),
        ("中", "u4e2d"),
        ("*/", ""),
    ],
)
def test_texts_become_words(text, words):
    assert words_of(text) == words


def test_names_are_given_out_once_and_are_no_reserved_words():
    names = Names({"int"})
    assert [names.new(each) for each in ("a b", "a_b", "a-b", "int", "a b 2", "2d", "*", "**")] == [
        "a_b",
        "a_b_2",
        "a_b_3",
        "int_2",
        "a_b_2_2",
        "_2d",
        "unnamed",
        "unnamed_2",
    ]


def test_upper_and_lower_case_count_as_wanted():
    names = Names((), "X_")
    assert [names.new("a", upper=True), names.new("A", upper=True)] == ["X_A", "X_A_2"]
