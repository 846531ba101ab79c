import pytest

from bbsd.language.meaning.tables.labels import Numbers

CELLS = Numbers(-2, 3)
WRITTEN = ("-2", "-1", "0", "1", "2", "3")


def test_numbers_are_the_labels_of_their_cells() -> None:
    assert tuple(CELLS) == WRITTEN
    assert (len(CELLS), CELLS[0], CELLS[-1], CELLS[1:4]) == (6, "-2", "3", WRITTEN[1:4])
    assert [CELLS.index(label) for label in WRITTEN] == [0, 1, 2, 3, 4, 5]


@pytest.mark.parametrize("label", ["-3", "4", "01", "1.0", "-0", "", "x", "1" * 5000])
def test_nothing_else_is_one(label: str) -> None:
    assert label not in CELLS
    with pytest.raises(ValueError, match="is not a cell"):
        CELLS.index(label)


def test_the_same_numbers_are_equal() -> None:
    assert Numbers(0, 5) == Numbers(0, 5) != Numbers(1, 5)
