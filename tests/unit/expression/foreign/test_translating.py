import pytest

from bbsd.expression.foreign.tokens import reads
from bbsd.expression.foreign.translating import MAX_LENGTH, translated
from bbsd.expression.syntax.mistakes import ExpressionError, Mistake
from bbsd.expression.syntax.parsing import parse


def told(text: str, key: str = "") -> Mistake:
    with pytest.raises(ExpressionError) as refused:
        parse(text)
    return translated(text, refused.value.mistake, key)


def corrected(text: str, key: str = "") -> tuple[str, bool] | None:
    """The text as it should be, and whether that is certain."""
    correction = told(text, key).correction
    if correction is None:
        return None
    start, length = correction.span
    return text[:start] + correction.text + text[start + length :], correction.is_certain


CERTAIN = {
    "-5 if a == 0 && b > 0.3 else 0": "-5 if a == 0 and b > 0.3 else 0",
    "a || b": "a or b",
    "a & b": "a and b",
    "dirty and !docked": "dirty and not docked",
    "x == !y": "x == (not y)",
    "!(a or b)": "not (a or b)",
    "a AND NOT b": "a and not b",
    "a ~= 1": "a != 1",
    "a <> 1": "a != 1",
    "a ≤ 1": "a <= 1",
    "a === 1": "a == 1",
    "1 if a = 0 else 0": "1 if a == 0 else 0",
    "a == True": "a == true",
    "1 - a ^ 2": "1 - a ** 2",
    "x²": "x ** 2",
    "a == 0 ? 1 : 0": "1 if a == 0 else 0",
    "max(a ? 1 : 2, b)": "max(1 if a else 2, b)",
    "a ? b ? 1 : 2 : 3": "(1 if b else 2) if a else 3",
    "a ? 1 : b ? 2 : 3": "1 if a else 2 if b else 3",
    "if a == 0 then 1 else 0": "1 if a == 0 else 0",
    "if (a > 1) 2 else 3": "2 if (a > 1) else 3",
    "if a then 1 else if b then 2 else 3": "1 if a else 2 if b else 3",
    "if(a > 1, 2, 3)": "(2 if a > 1 else 3)",
    "1 if abs(a) < 0.05 elif abs(a) < 0.1 0.5 else 0": "1 if abs(a) < 0.05 else 0.5 if abs(a) < 0.1 else 0",
    "1 if a elif 0.5 if b else 0": "1 if a else 0.5 if b else 0",
    "1 if |a| < 0.05 else 0": "1 if abs(a) < 0.05 else 0",
    "|a - b| + |c|": "abs(a - b) + abs(c)",
    "0.1s": "0.1",
    "2 m": "2",
    "0,1": "0.1",
    "x + 0.05 * math.sin(h)": "x + 0.05 * sin(h)",
    "np.abs(a)": "abs(a)",
    "math.pow(a, 2) + math.pi": "a ** 2 + pi",
    "random.random()": "uniform(0, 1)",
    "cut(s, [0.2, 0.5, 1])": "cut(s, 0.2, 0.5, 1)",
    "max([a, b])": "max(a, b)",
    "max(a - b * c, 0": "max(a - b * c, 0)",
    "a + b)": "a + b",
    "0  // meters a second": "0  # meters a second",
    "x;": "x",
    "list[8, 8]": "list(8, 8)",
    "a // b && c": "a // b and c",
    "abs(robots[1].x - x) < 0.5": "abs(x[1] - x) < 0.5",
    "self.x + 1": "x + 1",
    "x.abs()": "abs(x)",
    "a && !b || c ^ 2 > 1": "a and not b or c ** 2 > 1",
}
PERHAPS = {
    "1 if a == 0": "1 if a == 0 else 0",
    "90deg": "radians(90)",
    "90 deg": "radians(90)",
    "100ms": "100",
    "20%": "20",
    "cut(b, 20%, 50%)": "cut(b, 20, 50)",
    "chance(20%)": "chance(0.2)",
    "normal(mean=0, sd=1)": "normal(0, 1)",
    "2x": "2 * x",
    "a // cell size": "a # cell size",
    "min(a, b + c": "min(a, b + c)",
    "mode == 'clean'": "mode == clean",
    "mode == “clean”": "mode == clean",
    "mode is 'clean'": "mode == clean",
    "mode in ['clean', 'home']": "mode == clean or mode == home",
    "(8, 8)": "list(8, 8)",
    "8, 8": "list(8, 8)",
}
UNCLEAR = ["a b", "a ? 1", "zone == 'below 0.2'", "(a", "x.y", "lambda: 1", "a +"]


@pytest.mark.parametrize(("text", "new"), CERTAIN.items())
def test_what_has_one_reading_is_written_as_it_is_here(text: str, new: str) -> None:
    assert corrected(text) == (new, True)
    assert reads(new.partition("  #")[0])


@pytest.mark.parametrize(("text", "new"), PERHAPS.items())
def test_what_has_more_readings_is_only_proposed(text: str, new: str) -> None:
    assert corrected(text) == (new, False)


@pytest.mark.parametrize("text", UNCLEAR)
def test_what_is_not_understood_is_not_corrected(text: str) -> None:
    assert corrected(text) in (None, (f"{text})", True))


@pytest.mark.parametrize(
    ("text", "key", "new"),
    [
        ("+= 0.1", "speed", "speed + 0.1"),
        ("speed += 0.1", "speed", "speed + 0.1"),
        ("-= a + b", "speed", "speed - (a + b)"),
        ("*= 2", "speed", "speed * 2"),
        ("speed = 3", "speed", "3"),
        ("mode = 2", "excited", "mode == 2"),
        ("= 2", "speed", "2"),
    ],
)
def test_an_assignment_is_told_by_the_key_that_it_sets(text: str, key: str, new: str) -> None:
    assert corrected(text, key) == (new, True)


def test_the_first_foreign_sign_is_told_at_its_place() -> None:
    mistake = told("a and b && !c")
    assert mistake.message == 'there is no "&&" in expressions'
    assert mistake.advice == "write and"
    assert mistake.span == (8, 2)


def test_a_long_text_is_not_searched() -> None:
    assert told("a && " * MAX_LENGTH).correction is None
