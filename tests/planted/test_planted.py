"""Every planted mistake is told once, at its place, with what to do about it, and nothing else is."""

import re
from pathlib import Path

import pytest

import bbsd

FOLDER = Path(__file__).parent
FILES = sorted(FOLDER.glob("*.yaml"))
EXPECTED = re.compile(r'^# planted: (\d+):(\d+) (BB\d+)(?: "(.+)")?$', re.MULTILINE)


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_what_was_planted_is_told_at_its_place_and_nothing_else(path):
    planted = EXPECTED.findall(path.read_text(encoding="utf-8"))
    told = bbsd.check(path)
    assert [(str(each.place.line), str(each.place.column), each.code) for each in told] == [
        tuple(where) for *where, _ in planted
    ]
    for each, (*_, word) in zip(told, planted, strict=True):
        assert word in f"{each.message} {each.advice}"
        assert each.place.file == str(path)


def test_there_are_twenty_five_files_with_one_mistake_and_one_with_ten():
    counts = sorted(len(EXPECTED.findall(path.read_text(encoding="utf-8"))) for path in FILES)
    assert counts == [1] * 25 + [10]
