"""The specs in tests/specs: each mistake is reported once, at its place, and nothing else is."""

import re
from collections import Counter
from pathlib import Path

import pytest

from bbsd.errors import Severity
from bbsd.errors.catalog import KINDS
from bbsd.errors.kinds.environment import ENVIRONMENT_KINDS
from bbsd.errors.kinds.warnings import WARNING_KINDS
from bbsd.expression import graph
from bbsd.language.loading import check, load
from bbsd.text import Source

SPECS = Path(__file__).parents[2] / "specs"
INVALID = sorted((SPECS / "invalid").glob("*.yaml"))
VALID = sorted((SPECS / "valid").glob("*.yaml"))
WARNED = sorted((SPECS / "warned").glob("*.yaml"))
MENDED = sorted((SPECS / "mended").glob("*.yaml"))
ROOT = SPECS.parents[1]
SHIPPED = [*sorted((ROOT / "specs").rglob("*.yaml")), *sorted((ROOT / "bbsd/cli/templates").glob("*.yaml"))]
EXPECTED = re.compile(r"# expect: (.*)$")
WITHOUT_FILE = {"BB001", "BB002", "BB028", "BB045", "BB048", *(kind.code for kind in ENVIRONMENT_KINDS)}
"""No such file, too large a file, an argument of the command line, and what only a run or an import finds."""

WARNINGS = {kind.code for kind in WARNING_KINDS}


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
    assert codes == set(KINDS) - WITHOUT_FILE - WARNINGS
    assert {path.stem for path in INVALID if path.stem.startswith("BB")} <= {path.stem for path in VALID}


@pytest.mark.parametrize("path", WARNED, ids=lambda path: path.stem)
def test_a_spec_with_warnings_has_exactly_these_and_can_be_used(path: Path) -> None:
    source = Source.read(path)
    found = load(source).warnings
    places = Counter((each.code, each.place.line, each.place.column) for each in found)
    assert places == expected(source)
    assert all(each.severity is Severity.WARNING for each in found)


@pytest.mark.parametrize("path", [*MENDED, *SHIPPED], ids=lambda path: path.stem)
def test_a_mended_spec_and_what_is_shipped_have_no_warnings(path: Path) -> None:
    assert check(Source.read(path), warnings=True) == ()


def test_every_warning_has_a_spec_and_every_such_spec_its_mended_one() -> None:
    assert {path.stem.split("_")[0] for path in WARNED} == WARNINGS
    assert {path.stem for path in WARNED} <= {path.stem for path in MENDED}
