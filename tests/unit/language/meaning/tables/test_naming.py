import pytest

from bbsd.language.meaning.tables.naming import meant_cell

CUT = ("below 0.2", "0.2 to 0.5", "0.5 to 1", "from 1")


@pytest.mark.parametrize(
    ("word", "meant"),
    [
        ("< 0.5", ("below 0.5", True)),
        (">= 0.5", ("from 0.5", True)),
        ("> 0.5", ("from 0.5", False)),
        ("0.2..0.5", ("0.2 to 0.5", True)),
        ("0.2-1", ("0.2 to 1", True)),
        ("[0.2, 0.5]", ("0.2 to 0.5", True)),
        ("between 0.2 and 0.5", ("0.2 to 0.5", True)),
        ("under 0.5", ("below 0.5", True)),
        ("below 0.4", ("below 0.5", False)),
        ("0.3 to 1", ("0.2 to 1", False)),
        ("elephant", ("", False)),
    ],
)
def test_ranges_as_they_are_written_elsewhere(word: str, meant: tuple[str, bool]) -> None:
    assert meant_cell(word, CUT) == meant


def test_truths_by_other_names() -> None:
    assert meant_cell("yes", ("false", "true")) == ("true", True)
    assert meant_cell("midle", ("left", "middle")) == ("middle", False)
