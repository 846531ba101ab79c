import pytest

from bbsd.language.fixing import fixed
from bbsd.language.loading import check
from bbsd.text import Source
from tests.unit.language.specs import source

SPEC = source().text


def with_lines(**lines: str) -> Source:
    """The small spec with other texts for some of its lines, which begin with these keys."""
    text = SPEC
    for key, line in lines.items():
        (old,) = (each for each in text.splitlines() if each.strip().startswith(f"{key}:"))
        text = text.replace(old, old[: len(old) - len(old.lstrip())] + f"{key}: {line}")
    return Source("spec.yaml", text)


def test_what_has_one_reading_is_corrected_and_nothing_else_changes() -> None:
    wrong = with_lines(near="1 if tilt > 1 && speed ^ 2 > 1 else 0  # both", tilted="tilt > 1 || !(tilt < 2)")
    result = fixed(wrong)
    assert check(result.source) == ()
    assert result.source.text == wrong.text.replace("&&", "and").replace("^", "**").replace(
        "|| !(", "or not ("
    )
    assert [each.diagnosis.code for each in result.made] == ["BB050", "BB050"]
    assert result.made[0].before == ("    tilted: tilt > 1 || !(tilt < 2)",)
    assert result.made[0].after == ("    tilted: tilt > 1 or not (tilt < 2)",)


def test_it_is_idempotent() -> None:
    once = fixed(with_lines(near="pow(tilt, 2) if tilted && true else random(1, 2)")).source
    assert fixed(once).source == once
    assert fixed(once).made == ()


def test_what_has_two_readings_is_left() -> None:
    wrong = with_lines(near="1 if tilted", tilt="height - 90deg")
    assert fixed(wrong).source == wrong


def test_a_correction_whose_line_is_then_wrong_in_another_way_is_left() -> None:
    wrong = with_lines(near="tilt = 3")
    assert fixed(wrong).source == wrong


def test_line_breaks_and_quotes_stay() -> None:
    wrong = Source("spec.yaml", with_lines(near='"1 if tilted && true else 0"').text.replace("\n", "\r\n"))
    assert fixed(wrong).source.text == wrong.text.replace("&&", "and")


@pytest.mark.parametrize("text", ["", "a: [", "bbsd: 1\nextends: none.yaml\n", "\t"])
def test_any_text_is_read(text: str) -> None:
    fixed(Source("spec.yaml", text))
