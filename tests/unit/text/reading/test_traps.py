import pytest

from bbsd.text import Data, Source, read


def data_and_codes(text: str) -> tuple[dict[str, Data], list[str]]:
    document = read(Source("spec.yaml", text))
    return document.data, [diagnosis.code for diagnosis in document.diagnoses]


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("{speed: min(speed, top)}", {"speed": "min(speed, top)"}),
        ("{speed: min(speed, top), turn: 0}", {"speed": "min(speed, top)", "turn": 0}),
        ("{a: min(b, max(c, d), 3) + 1}", {"a": "min(b, max(c, d), 3) + 1"}),
        ("{x: min(x, x, x)}", {"x": "min(x, x, x)"}),
        ("{clip(a, b): a + b}", {"clip(a, b)": "a + b"}),
        ("{a:\n  min(b,\n    c)}", {"a": "min(b, c)"}),
        ("[min(a, b), c]", ["min(a, b)", "c"]),
        ("[uniform(0, 1)]", ["uniform(0, 1)"]),
    ],
)
def test_a_comma_between_parentheses_is_one_mistake_and_read_as_meant(text: str, meant: Data) -> None:
    assert data_and_codes(f"key: {text}") == ({"key": meant}, ["BB016"])


def test_every_value_that_commas_cut_is_a_mistake() -> None:
    data, codes = data_and_codes("{f(x, y): min(x, y), b: max(a, b)}")
    assert data == {"f(x, y)": "min(x, y)", "b": "max(a, b)"}
    assert codes == ["BB016"] * 3


def test_the_mistake_is_shown_at_the_whole_value() -> None:
    (diagnosis,) = read(Source("s", "a: {speed: min(speed, top)}")).diagnoses
    assert (diagnosis.place.column, diagnosis.place.length) == (12, len("min(speed, top)"))
    assert "quotes" in diagnosis.advice


@pytest.mark.parametrize(
    "text",
    [
        "key: {a: 'min(b', 'c)': null}",
        "key: {a: min(b), c: max(d)}",
        "key: {a, b}",
        "key: [a (b, c]",
        "key: {a: f(b, c: 1}",
        "key: {a: f(b, c: g), d}",
        "key:\n  a: min(b, c)\n",
    ],
)
def test_other_commas_are_left_alone(text: str) -> None:
    assert data_and_codes(text)[1] == []


@pytest.mark.parametrize(
    ("text", "line", "column"),
    [
        ("state:\n  speed:0\n", 2, 3),
        ("state:\n  speed:0\n  height:1\n", 2, 3),
        ("state: {speed:0, height: 1}", 1, 9),
        ("bbsd:1", 1, 1),
        ("a: 1\nstate:\n  speed:0\n  height: 1\n", 3, 3),
        ("a: 1\nb:2\nc: 3\n", 2, 1),
    ],
)
def test_a_colon_without_a_blank_is_shown(text: str, line: int, column: int) -> None:
    (diagnosis,) = read(Source("s", text)).diagnoses
    assert (diagnosis.code, diagnosis.place.line, diagnosis.place.column) == ("BB017", line, column)


@pytest.mark.parametrize(
    "text", ["summary: see:this", "summary:\n  http://example.org", "a: '\n  b:c'", "at: 12:30"]
)
def test_colons_in_other_texts_are_left_alone(text: str) -> None:
    assert data_and_codes(text)[1] == []


@pytest.mark.parametrize("text", ["a: >3\nb: 1\n", "a: |\nb: 1\n", "a: >\n\n"])
def test_a_block_of_text_without_text_is_a_mistake(text: str) -> None:
    assert data_and_codes(text)[1] == ["BB018"]
