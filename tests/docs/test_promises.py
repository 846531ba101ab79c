"""What the page on promises names as shown by a test or a command is there, and no promise is without."""

import re
from pathlib import Path

import pytest

from fuzzing.faults.__main__ import PARTS

ROOT = Path(__file__).parents[2]
TEXT = (ROOT / "docs" / "promises.md").read_text(encoding="utf-8")
TESTS = sorted(set(re.findall(r"`(tests/[\w/.]+)`", TEXT)))
COMMANDS = sorted(set(re.findall(r"`make ([^`]+)`", TEXT)))
ROWS = [line for line in TEXT.splitlines() if line.startswith("| ") and "---" not in line]
HEADS = ("| what happens", "| promise ")


@pytest.mark.parametrize("path", TESTS)
def test_what_is_named_is_a_file_of_tests(path):
    assert "def test_" in (ROOT / path).read_text(encoding="utf-8")


@pytest.mark.parametrize("command", COMMANDS)
def test_what_is_named_is_a_command_of_make(command):
    target, *settings = command.split()
    assert re.search(rf"^{target}:", (ROOT / "Makefile").read_text(encoding="utf-8"), re.MULTILINE)
    for setting in settings:
        name, _, part = setting.partition("=")
        assert (target, name) == ("faults", "PART")
        assert part in PARTS


def test_every_part_of_the_faults_is_named():
    assert {f"faults PART={part}" for part in PARTS} <= set(COMMANDS)


@pytest.mark.parametrize("row", [row for row in ROWS if not row.startswith(HEADS)])
def test_every_promise_names_what_shows_it(row):
    assert re.search(r"`tests/|`make ", row.rstrip(" |").rpartition("|")[2])
