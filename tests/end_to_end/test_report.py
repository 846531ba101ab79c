"""`bbsd report` as a shell sees it."""

import re
from pathlib import Path

import pytest

from tests.end_to_end.commands import bbsd

SPECS = Path(__file__).parents[2] / "specs"


def test_a_page_is_written_and_named(tmp_path):
    target = tmp_path / "grid.html"
    code, out, err = bbsd("report", SPECS / "grid_world_hand.yaml", "-o", target, "--episodes", "30")
    assert (code, out) == (0, f"{target}\n"), err
    text = target.read_text(encoding="utf-8")
    assert text.startswith("<!doctype html>")
    assert len(text) < 2_000_000
    assert "grid-world-by-hand" in re.search("<title>(.*)</title>", text)[1]
    assert str(SPECS.parent) not in text


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ((SPECS / "object_lifting.yaml",), "holes"),
        ((SPECS / "grid_world_hand.yaml", "-o", "nowhere/page.html"), "nowhere"),
        ((SPECS / "grid_world_hand.yaml", "--episodes", "0"), "--episodes"),
    ],
)
def test_mistakes_are_told_and_nothing_is_written(tmp_path, words, said):
    code, out, err = bbsd("report", *words, cwd=tmp_path)
    assert (code, out) == (2, "")
    assert said in err
    assert "Traceback" not in err
    assert not [*tmp_path.iterdir()]
