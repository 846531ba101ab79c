"""The specs in tests/specs: each mistake is reported once, at its place, and nothing else is."""

import re
from collections import Counter
from pathlib import Path

import pytest

from bbsd.errors import KINDS
from bbsd.errors.environment_kinds import ENVIRONMENT_KINDS
from bbsd.expression import graph
from bbsd.language.loading import check
from bbsd.text import Source

SPECS = Path(__file__).parents[2] / "specs"
INVALID = sorted((SPECS / "invalid").glob("*.yaml"))
VALID = sorted((SPECS / "valid").glob("*.yaml"))
EXPECTED = re.compile(r"# expect: (.*)$")
WITHOUT_FILE = {"BB001", "BB002", "BB028", "BB045", "BB048", *(kind.code for kind in ENVIRONMENT_KINDS)}
"""No such file, too large a file, an argument of the command line, and what only a run or an import finds."""


@pytest.fixture(autouse=True)
def small_graphs(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(graph, "MAX_NODES", 20_000)


def expected(source: Source) -> Counter[tuple[str, int, int]]:
    found: Counter[tuple[str, int, int]] = Counter()
    for number, line in enumerate(source.text.split("\n"), start=1):
        if match := EXPECTED.search(line):
            for mistake in match[1].split(", "):
                code, column = mistake.split()
                found[code, number, int(column)] += 1
    return found


@pytest.mark.parametrize("path", INVALID, ids=lambda path: path.stem)
def test_an_invalid_spec_has_exactly_its_mistakes(path: Path) -> None:
    source = Source.read(path)
    diagnoses = check(source)
    assert Counter(
        (diagnosis.code, diagnosis.place.line, diagnosis.place.column) for diagnosis in diagnoses
    ) == expected(source)
    assert [diagnosis.place for diagnosis in diagnoses] == sorted(diagnosis.place for diagnosis in diagnoses)


@pytest.mark.parametrize("path", VALID, ids=lambda path: path.stem)
def test_a_valid_spec_has_none(path: Path) -> None:
    assert check(Source.read(path)) == ()


def test_every_code_has_an_invalid_spec_and_every_such_spec_its_mended_one() -> None:
    codes = {path.stem.split("_")[0] for path in INVALID if path.stem.startswith("BB")}
    assert codes == set(KINDS) - WITHOUT_FILE
    assert {path.stem for path in INVALID if path.stem.startswith("BB")} <= {path.stem for path in VALID}
