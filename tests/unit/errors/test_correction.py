from bbsd.errors import Correction, Diagnosis, Edit, Place, SpecError, render_json, render_text
from bbsd.errors.correction import MOST_LINES, corrected_lines
from bbsd.text import Source

SOURCE = Source("spec.yaml", "a: 1\nb: x && y\nc: 3\n")
AND = Correction((Edit(2, 6, 2, 8, "and"),))


def texts(correction: Correction) -> list[str]:
    return [line.text for line in corrected_lines(correction, SOURCE)]


def told(correction: Correction) -> str:
    diagnosis = Diagnosis("BB050", "wrong", Place("spec.yaml", 2, 6, 2), "write and", correction)
    error = SpecError([diagnosis], SOURCE)
    return render_text(diagnosis, error.line(diagnosis.place), corrected=error.corrected_lines(diagnosis))


def test_the_line_as_it_should_be_stands_below_the_line() -> None:
    assert told(AND).split("\n")[1:] == [
        "    2 | b: x && y",
        "      |      ^^",
        "write | b: x and y",
        "      = write and",
    ]


def test_what_has_more_readings_is_marked() -> None:
    assert "maybe | b: x and y" in told(Correction(AND.edits, is_certain=False))


def test_lines_that_only_move_are_shown_as_they_should_be() -> None:
    edits = (Edit(1, 1, 1, 1, "  "), Edit(3, 1, 3, 1, "  "))
    assert texts(Correction(edits)) == ["  a: 1", "  c: 3"]


def test_edits_of_one_line_are_shown_once_and_lines_taken_away_not_at_all() -> None:
    edits = (Edit(2, 1, 2, 2, "d"), Edit(2, 6, 2, 8, "and"), Edit(3, 1, 4, 1, ""))
    assert texts(Correction(edits)) == ["d: x and y"]


def test_a_correction_of_half_a_file_is_not_shown() -> None:
    assert texts(Correction((Edit(1, 1, MOST_LINES + 2, 1, ""),))) == []


def test_a_hostile_text_is_inert() -> None:
    assert "\x1b" not in told(Correction((Edit(2, 6, 2, 8, "\x1b[2J"),)))


def test_in_json_a_correction_has_its_edits() -> None:
    (plain,) = render_json([Diagnosis("BB050", "wrong", Place("spec.yaml", 2, 6, 2), correction=AND)])
    assert plain["correction"] == {
        "certain": True,
        "edits": [{"line": 2, "column": 6, "end_line": 2, "end_column": 8, "text": "and"}],
    }


def test_edits_are_carried_out_together() -> None:
    edits = (Edit(1, 1, 1, 1, "# first\n"), Edit(2, 6, 2, 8, "and"))
    assert SOURCE.edited(edits).text == "# first\na: 1\nb: x and y\nc: 3\n"
    assert SOURCE.edit(10, 12, "and") == Edit(2, 6, 2, 8, "and")


def test_of_lines_that_are_added_or_taken_away_no_other_is_shown() -> None:
    assert texts(Correction((Edit(1, 5, 1, 5, "\n  more"),))) == ["  more"]
    assert texts(Correction((Edit(2, 1, 2, 1, "  more\n"),))) == ["  more"]
    assert texts(Correction((Edit(2, 1, 3, 1, ""),))) == []


def test_lines_that_stand_apart_have_their_numbers() -> None:
    apart = Correction((Edit(1, 1, 1, 2, "d"), Edit(3, 1, 3, 2, "d")))
    assert "write | d: 1\n at 3 | d: 3\n" in told(apart)
    together = Correction((Edit(1, 1, 1, 2, "d"), Edit(2, 1, 2, 2, "d")))
    assert "write | d: 1\n      | d: x && y\n" in told(together)


def test_the_key_of_a_block_that_changes_is_shown_above_it() -> None:
    assert texts(Correction((Edit(2, 1, 2, 1, "  "),), below=1)) == ["a: 1", "  b: x && y"]
