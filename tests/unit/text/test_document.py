from typing import Any

import pytest

from bbsd.errors import Place
from bbsd.text import DataPath, Document, Source, read

SPEC = """\
bbsd: 1
environment:
  state: {height: uniform(2, 3), speed: 0}
  sensors:
    tilt: degrees(atan(
      height + wrong))
    place:
      lowest: height == 0
  ends:
behaviors:
  push: &push
    rules:
      - when: {pace: 5}
        do: cap
      - otherwise: no action
  pull: *push
definitions:
  room_at(px, py): 'it''s (px'
  "quoted \\"key\\"": 1
"""


@pytest.fixture(scope="module")
def document() -> Document:
    # The comma in {height: uniform(2, 3)} is read as meant, and diagnosed.
    return read(Source("spec.yaml", SPEC))


def shown(place: Place) -> tuple[int, str]:
    line = SPEC.split("\n")[place.line - 1]
    return place.line, line[place.column - 1 : place.column - 1 + place.length]


@pytest.mark.parametrize(
    ("path", "line", "marked"),
    [
        (("bbsd",), 1, "1"),
        (("environment", "state", "speed"), 3, "0"),
        (("environment", "state", "height"), 3, "uniform(2, 3)"),
        (("environment", "sensors", "tilt"), 5, "degrees(atan("),
        (("environment", "sensors", "place"), 8, "l"),
        (("behaviors", "push", "rules", 0, "do"), 14, "cap"),
        (("behaviors", "push", "rules", 1), 15, "o"),
        (("behaviors", "pull"), 16, "*push"),
        (("behaviors", "pull", "rules", 0, "do"), 14, "cap"),
        ((), 1, "b"),
    ],
)
def test_a_path_leads_to_the_value(document: Document, path: DataPath, line: int, marked: str) -> None:
    assert shown(document.place(path)) == (line, marked)


@pytest.mark.parametrize(
    ("path", "line", "marked"),
    [
        (("environment",), 2, "environment"),
        (("environment", "sensors", "place", "lowest"), 8, "lowest"),
        (("behaviors", "push", "rules", 0, "when", "pace"), 13, "pace"),
        (("behaviors", "push", "rules", 0), 13, "w"),
        (("definitions", 'quoted "key"'), 19, '"quoted \\"key\\""'),
    ],
)
def test_a_path_leads_to_the_key(document: Document, path: DataPath, line: int, marked: str) -> None:
    assert shown(document.place(path, on_key=True)) == (line, marked)


def test_segments_that_name_nothing_are_skipped(document: Document) -> None:
    path = ("behaviors", "tagged-union", "push", "function-after", "rules", 0, "Rule", "do")
    assert shown(document.place(path)) == (14, "cap")


def test_a_missing_value_is_shown_at_the_nearest_key(document: Document) -> None:
    assert shown(document.place(("environment", "sensors", "nothing"))) == (4, "sensors")
    assert shown(document.place(("environment", "sensors", "tilt", "deeper", 3))) == (5, "tilt")
    assert shown(document.place(("behaviors", "push", "rules", 7))) == (12, "rules")
    assert shown(document.place(("nothing",))) == (1, "b")


def test_a_value_that_is_not_written_is_shown_at_its_key(document: Document) -> None:
    assert shown(document.place(("environment", "ends"))) == (9, "ends")


def test_an_offset_counts_in_the_value_as_it_is_read(document: Document) -> None:
    path = ("environment", "sensors", "tilt")
    data: Any = document.data
    value = data["environment"]["sensors"]["tilt"]
    assert value == "degrees(atan( height + wrong))"
    assert shown(document.place(path, offset=value.index("wrong"), length=5)) == (6, "wrong")
    assert shown(document.place(path, offset=value.index("atan"), length=12)) == (5, "atan(")
    assert shown(document.place(path, offset=value.index("atan"))) == (5, "a")


def test_an_offset_sees_through_quotes(document: Document) -> None:
    assert shown(document.place(("definitions", "room_at(px, py)"), offset=6, length=2)) == (18, "px")


def test_an_offset_can_count_in_a_key(document: Document) -> None:
    place = document.place(("definitions", "room_at(px, py)"), offset=12, on_key=True, length=2)
    assert shown(place) == (18, "py")


def test_an_offset_can_count_in_a_value_that_commas_had_cut(document: Document) -> None:
    assert shown(document.place(("environment", "state", "height"), offset=11)) == (3, "3")


def test_the_end_of_a_value_has_a_place(document: Document) -> None:
    assert document.place(("bbsd",), offset=1) == Place("spec.yaml", 1, 8, 1)
    assert document.place(("bbsd",), offset=99) == Place("spec.yaml", 1, 8, 1)


def test_a_text_that_could_not_be_read_has_one_place() -> None:
    document = read(Source("s", "a: {"))
    assert document.place(("a", "b")) == Place("s", 1, 1, 1)
    assert document.data == {}


@pytest.mark.parametrize(
    ("path", "holds"),
    [
        ((), True),
        (("bbsd",), True),
        (("environment", "state", "speed"), True),
        (("behaviors", "pull", "rules", 1), True),  # through an alias
        (("behaviors", "pull", "rules", 2), False),
        (("environment", "state", "sped"), False),
        (("bbsd", "below"), False),
    ],
)
def test_a_document_says_whether_it_has_a_path(document: Document, path: DataPath, holds: bool) -> None:
    assert document.holds(path) is holds
