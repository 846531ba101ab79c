"""The catalog of mistakes: every code that is reported is in it, and its examples have the mistakes that they show."""

import re
from pathlib import Path

import pytest

import bbsd
from bbsd.errors import Diagnosis, SpecError
from bbsd.errors.catalog import KINDS
from bbsd.errors.kinds.environment import ENVIRONMENT_KINDS
from bbsd.errors.kinds.warnings import WARNING_KINDS
from bbsd.expression import graph
from bbsd.language.loading import check, load
from bbsd.text import Source, read
from tests.unit.language.specs import source

PACKAGE = Path(bbsd.__file__).parent
CATALOG = PACKAGE / "errors"
NO_EXAMPLES = {"BB001", "BB002", "BB003", "BB011", "BB012", "BB013", "BB029", "BB045", "BB048"}
NO_EXAMPLES |= {kind.code for kind in ENVIRONMENT_KINDS}
WARNINGS = sorted(kind.code for kind in WARNING_KINDS)
MISTAKES = sorted(set(KINDS) - NO_EXAMPLES - {*WARNINGS})
"""What no few lines can show: missing files, files of no text, what is too large, what a run or an import finds."""


def reported(example: str) -> tuple[Diagnosis, ...]:
    """What is wrong with an example: an argument, a part of a spec, or a text that is no YAML."""
    if example.startswith("--set "):
        return of_override(example.removeprefix("--set "))
    return read(Source("example", example)).diagnoses or check(source(example))


def of_override(argument: str) -> tuple[Diagnosis, ...]:
    try:
        load(source(), overrides=[argument])
    except SpecError as error:
        return error.diagnoses
    return ()


def test_the_codes_that_are_told_are_those_of_the_catalog() -> None:
    sources = [path for path in PACKAGE.rglob("*.py") if CATALOG not in path.parents]
    used = {
        code for path in sources for code in re.findall(r'"(BB\d{3,})"', path.read_text(encoding="utf-8"))
    }
    assert used == set(KINDS)


@pytest.mark.parametrize("code", MISTAKES)
def test_an_example_has_its_mistake_and_nothing_else(code: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(graph, "MAX_NODES", 20_000)
    assert {diagnosis.code for diagnosis in reported(KINDS[code].example)} == {code}


@pytest.mark.parametrize("code", MISTAKES)
def test_the_mended_example_has_it_no_longer(code: str) -> None:
    remaining = reported(KINDS[code].mend)
    assert code not in {diagnosis.code for diagnosis in remaining}
    assert remaining == () or code < "BB020"


def warned(part: str) -> set[str]:
    """Return the codes of the warnings that a part brings to the small spec."""
    before = {diagnosis.message for diagnosis in check(source(), warnings=True)}
    after = check(source(part), warnings=True)
    return {diagnosis.code for diagnosis in after if diagnosis.message not in before}


@pytest.mark.parametrize("code", WARNINGS)
def test_an_example_has_its_warning_and_the_mended_one_has_none(code: str) -> None:
    assert warned(KINDS[code].example) == {code}
    assert warned(KINDS[code].mend) == set()
