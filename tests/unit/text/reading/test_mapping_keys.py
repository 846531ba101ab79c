import pytest

from bbsd.errors import Place
from bbsd.text import Source, read


def mistakes(text: str) -> list[tuple[str, str]]:
    return [(each.code, each.message) for each in read(Source("spec.yaml", text)).diagnoses]


def test_a_key_given_twice_is_shown_and_the_first_is_kept() -> None:
    document = read(Source("spec.yaml", "state:\n  speed: 0\n  height: 1\n  speed: 2\n"))
    (diagnosis,) = document.diagnoses
    assert diagnosis.code == "BB006"
    assert diagnosis.message == 'the key "speed" is given twice, first in line 2'
    assert diagnosis.place == Place("spec.yaml", 4, 3, 5)
    assert document.data == {"state": {"speed": 0, "height": 1}}


def test_keys_are_the_same_however_they_are_quoted() -> None:
    assert [code for code, _ in mistakes("a: 1\n'a': 2\n{a: 3}: 4\n")] == ["BB006", "BB008"]


def test_all_keys_given_twice_are_shown() -> None:
    assert [code for code, _ in mistakes("a: {b: 1, b: 2}\na: 1\na: 3\n")] == ["BB006"] * 3


def test_a_merge_key_is_refused_and_left_out() -> None:
    document = read(Source("spec.yaml", "a: &x {b: 1}\nc:\n  <<: *x\n  d: 2\n"))
    assert [each.code for each in document.diagnoses] == ["BB007"]
    assert document.data == {"a": {"b": 1}, "c": {"d": 2}}


def test_a_quoted_merge_sign_is_a_text_like_any_other() -> None:
    assert mistakes("'<<': 1") == []


@pytest.mark.parametrize(
    ("key", "name"),
    [
        ("1", "the number 1"),
        ("1.5", "the number 1.5"),
        ("true", "the truth true"),
        ("null", "null"),
        ("[a, b]", "a list"),
        ("{a: b}", "a mapping"),
    ],
)
def test_a_key_that_is_no_text_is_named(key: str, name: str) -> None:
    assert mistakes(f"{key}: 1") == [("BB008", f"{name} cannot be a key")]


def test_an_alias_cannot_be_a_key() -> None:
    assert mistakes("a: &x b\n*x : 1") == [("BB008", "an alias cannot be a key")]


def test_words_that_yaml_1_1_reads_as_truths_can_be_keys() -> None:
    assert read(Source("spec.yaml", "no: 1\non: 2\ny: 3")).data == {"no": 1, "on": 2, "y": 3}
