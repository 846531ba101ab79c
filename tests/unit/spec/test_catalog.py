"""The catalog of mistakes: every code that is told is in it, and its examples are what they say."""

import re
from pathlib import Path

import pytest

import bbsd
from bbsd.errors import KINDS, Diagnosis, SpecError
from bbsd.expression import graph
from bbsd.spec.loading import check, load
from bbsd.text import Data, Source, read, write

PACKAGE = Path(bbsd.__file__).parent
CATALOG = PACKAGE / "errors"
NO_EXAMPLES = {"BB001", "BB002", "BB003", "BB011", "BB012", "BB013", "BB045"}
"""What no few lines can show: files that are missing or no text, what is too large, what only a run finds."""

BASE: dict[str, Data] = {
    "bbsd": 1,
    "name": "example",
    "environment": {
        "robots": 3,
        "steps": 10,
        "state": {"height": "uniform(2, 3)", "speed": 0},
        "dynamics": {"height": "height + speed"},
        "sensors": {"tilt": "height - mean(height[r] for r in team)", "tilted": "tilt > 1"},
    },
    "behaviors": {"stop": {"inputs": {"reached": "height >= 3"}, "actions": {"halt": {"speed": 0}}}},
    "reward": {"near": "1 if abs(height - 3) < 1 else 0"},
}


def merged(base: Data, part: Data) -> Data:
    if not (isinstance(base, dict) and isinstance(part, dict) and part):
        return part
    return {**base, **{key: merged(base.get(key), value) for key, value in part.items()}}


def told(example: str) -> tuple[Diagnosis, ...]:
    """What is wrong with an example: an argument, a part of a spec, or a text that is no YAML."""
    if example.startswith("--set "):
        return of_override(example.removeprefix("--set "))
    part = read(Source("example", example))
    return part.diagnoses or check(Source("example", write(merged(BASE, part.data))))


def of_override(argument: str) -> tuple[Diagnosis, ...]:
    try:
        load(Source("example", write(BASE)), overrides=[argument])
    except SpecError as error:
        return error.diagnoses
    return ()


def test_the_codes_that_are_told_are_those_of_the_catalog() -> None:
    sources = [path for path in PACKAGE.rglob("*.py") if path.parent != CATALOG]
    used = {code for path in sources for code in re.findall(r'"(BB\d{3})"', path.read_text(encoding="utf-8"))}
    assert used == set(KINDS)


@pytest.mark.parametrize("code", sorted(set(KINDS) - NO_EXAMPLES))
def test_an_example_has_its_mistake_and_nothing_else(code: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(graph, "MAX_NODES", 20_000)
    assert {each.code for each in told(KINDS[code].example)} == {code}


@pytest.mark.parametrize("code", sorted(set(KINDS) - NO_EXAMPLES))
def test_the_mended_example_has_it_no_longer(code: str) -> None:
    left = told(KINDS[code].mend)
    assert code not in {each.code for each in left}
    assert left == () or code < "BB020"
