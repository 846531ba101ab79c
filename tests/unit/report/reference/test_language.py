import pytest

from bbsd.errors.catalog import KINDS
from bbsd.language.base import Part
from bbsd.language.view import View
from bbsd.report.reference.language import (
    BLOCKS,
    SECTIONS,
    keys_text,
    mistakes_text,
    regenerate,
    warnings_text,
)


def subclasses(part):
    return {part, *(found for below in part.__subclasses__() for found in subclasses(below))}


def test_what_stands_between_marks_is_written_anew_and_the_rest_stays():
    document = "before\n<!-- generated: draws -->\nold\n<!-- end -->\nafter\n"
    new = f"before\n<!-- generated: draws -->\n\n{SECTIONS['draws']()}\n<!-- end -->\nafter\n"
    assert regenerate(document) == new
    assert regenerate(new) == new


def test_an_unknown_mark_is_an_error():
    with pytest.raises(KeyError, match="colors"):
        regenerate("<!-- generated: colors -->\n<!-- end -->")


def test_every_part_of_a_spec_is_described():
    assert {part for parts in BLOCKS.values() for part in parts} == subclasses(Part) - {Part}


def test_a_description_of_several_lines_is_paragraphs_and_no_block_of_code(monkeypatch):
    monkeypatch.setattr(View, "__doc__", "From above.\n\n    A place is a point,\n    or a round one.\n    ")
    assert "### view\n\nFrom above.\n\nA place is a point,\nor a round one.\n\n| key |" in keys_text()


@pytest.mark.parametrize(
    "row",
    [
        "| `robots` | whole number, 1 to 64 | 1 | Robots that carry the architecture. |",
        (
            "| `sharing` | `uniform` or `value` or `difference` | `uniform` | How agents' fitness is shared: (15), "
            "(17), or by what an agent earns less with the behavior held to No Action. |"
        ),
        "| `excited` | expression |  | Where the behavior is excited; by default always. |",
        "| `steps` | whole number, 1 to 10,000,000 | required | The greatest number of steps in an episode. |",
    ],
)
def test_a_key_has_its_kind_bounds_default_and_meaning(row):
    assert row in keys_text().splitlines()


def test_every_code_has_a_row():
    rows = [*mistakes_text().splitlines()[2:], *warnings_text().splitlines()[2:]]
    assert [line.split(" | ")[0].removeprefix("| ") for line in rows] == list(KINDS)
