"""Mistakes that newcomers wrote down before any message was looked at, in three sets, and what is said of each."""

from pathlib import Path

import pytest
import yaml

from bbsd.language.fixing import fixed
from bbsd.language.loading import check
from bbsd.text import Source
from tests.newcomers import FOLDER, ROOT, SECOND, THIRD, Told, is_at_line, names_cause, shows_right, told_of

ITEMS = yaml.safe_load((FOLDER / "expected.yaml").read_text(encoding="utf-8"))
SECOND_ITEMS = yaml.safe_load((SECOND / "expected.yaml").read_text(encoding="utf-8"))
THIRD_ITEMS = yaml.safe_load((THIRD / "expected.yaml").read_text(encoding="utf-8"))
SETS = {FOLDER: ITEMS, SECOND: SECOND_ITEMS, THIRD: THIRD_ITEMS}
FILES = [folder / item["file"] for folder, items in SETS.items() for item in items if "file" in item]
WANTED = {FOLDER: 95, SECOND: 100, THIRD: len(THIRD_ITEMS)}

ADVICE: dict[str, tuple[str, ...]] = {
    "004": (
        'there is no "!" in expressions',
        "|     excited: not docked",
        'write not (for YAML, "!docked" is a tag)',
    ),
    "037": ("write |   state:\n      |     distance: uniform(2, 5)",),
    "042": ('this "(" is never closed', 'write ")" behind distance - speed * dt, 0'),
    "047": ('"---" begins a second document, and a spec is one', "remove this line"),
    "054": (
        "remove this line, and write at the end: structure: [clean, recharge], the highest priority first",
    ),
    "057": ("maybe |     actions:\n      |       left: {turn: 0}",),
    "058": ("write |     rules:\n      |       - when: {contact: true}",),
    "062": ("zone is not cut at 0.4, only at 0.2, 0.5 and 1", "cut(..., 0.2, 0.4, 0.5, 1)"),
    "067": ("environment.state (line 10)", "a name stands for one thing only"),
    "068": ("sonar is a number without any", "maybe |     inputs: [zone]", "zone is sonar cut into cells"),
    "072": ("|   top_speed: 1\nat 22 |         speed: min(speed + 0.1, top_speed)",),
    "075": ("the greatest number of steps in an episode", "maybe |   steps: 100"),
    "076": ('"creep" is an action of drive, not of stay', "stay has: halt; or write no action"),
    "080": ("contact is a sensor, but not an input of drive", "maybe |     inputs: [zone, contact]"),
    "082": (
        "side has no cell where none of left, right holds",
        "maybe |       neither: otherwise",
        "write right: otherwise only if the rest counts as right",
    ),
    "083": ("excited draws nothing at random", "under state coin: false, under dynamics coin: chance(0.5)"),
}
"""What is said of mistakes whose correction takes a thought: it must lead on, and nowhere else."""


@pytest.fixture(scope="module")
def told() -> dict[Path, list[Told]]:
    return {folder: [told_of(item, ROOT, folder) for item in items] for folder, items in SETS.items()}


def name_of(item: dict[str, object]) -> str:
    return str(item.get("file") or item["command"])


@pytest.mark.parametrize(("folder", "number"), [(FOLDER, 100), (SECOND, 100), (THIRD, 60)])
def test_no_mistake_is_left_out(folder: Path, number: int) -> None:
    assert len(SETS[folder]) >= number
    named = sorted(path.name for path in FILES if path.parent == folder)
    assert named == sorted(path.name for path in folder.glob("0*.yaml"))


@pytest.mark.parametrize("folder", SETS, ids=lambda folder: folder.name)
def test_the_cause_is_named_at_its_line_and_the_right_line_is_shown(
    folder: Path, told: dict[Path, list[Told]]
) -> None:
    items = SETS[folder]
    checks = {"cause": names_cause, "line": is_at_line, "right line": shows_right}
    wanting = {
        name_of(item): missing
        for item, said in zip(items, told[folder], strict=True)
        if (missing := [what for what, holds in checks.items() if not holds(item, said)])
    }
    assert len(items) - len(wanting) >= WANTED[folder], wanting


@pytest.mark.parametrize("number", ADVICE)
def test_what_is_said_leads_on(number: str, told: dict[Path, list[Told]]) -> None:
    said = next(
        said.said
        for item, said in zip(ITEMS, told[FOLDER], strict=True)
        if name_of(item).startswith(f"{number}_")
    )
    for words in ADVICE[number]:
        assert words in said


@pytest.mark.parametrize("path", FILES, ids=lambda path: f"{path.parent.name}-{path.stem}")
def test_a_file_has_one_mistake_that_is_told(path: Path) -> None:
    assert len(check(Source.read(path))) <= 1


@pytest.mark.parametrize("path", FILES, ids=lambda path: f"{path.parent.name}-{path.stem}")
def test_what_is_fixed_is_right_and_stays(path: Path) -> None:
    source = Source.read(path)
    mistakes = check(source)
    result = fixed(source)
    assert fixed(result.source).source == result.source
    if mistakes and mistakes[0].correction is not None and mistakes[0].correction.is_certain:
        assert check(result.source) == ()
        assert result.made
    else:
        assert result.source == source
