"""The page on the architecture names what is there, and its floors are those that import-linter checks."""

import ast
import re
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs" / "architecture.md"
TEXT = PAGE.read_text(encoding="utf-8")
PACKAGES = sorted((ROOT / "bbsd").rglob("__init__.py"))
MOST_FILES = 17
NAMED = sorted(set(re.findall(r"`((?:bbsd|tests|benchmarks|experiments|fuzzing)(?:/[\w.*]+)*)`", TEXT)))
FLOORS = re.findall(r"^\| `bbsd/(\w+)(?:\.py)?` \|", TEXT, re.MULTILINE)


@pytest.mark.parametrize("name", NAMED)
def test_what_is_named_exists(name):
    pattern = name.replace("BBnnn", "BB*")
    assert any(ROOT.glob(pattern)), name


def test_every_folder_has_a_floor():
    folders = {path.parent.name for path in (ROOT / "bbsd").glob("*/__init__.py")}
    assert folders <= set(FLOORS)


def test_the_floors_are_in_the_order_that_is_checked():
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    (layers,) = (
        contract["layers"]
        for contract in settings["tool"]["importlinter"]["contracts"]
        if "layers" in contract
    )
    order = {name.strip(" ()"): floor for floor, names in enumerate(layers) for name in names.split("|")}
    heights = [order[f"bbsd.{name}"] for name in FLOORS]
    assert heights == sorted(heights)
    assert set(order) == {f"bbsd.{name}" for name in FLOORS}


@pytest.mark.parametrize(
    ("name", "file"),
    re.findall(r"`(\w+)` (?:of|in) `(bbsd/[\w/]+\.py)`", TEXT),
)
def test_what_a_file_is_said_to_have_is_in_it(name, file):
    assert re.search(rf"\b{name}\b", (ROOT / file).read_text(encoding="utf-8")), file


@pytest.mark.parametrize("package", PACKAGES, ids=lambda file: file.parent.relative_to(ROOT).as_posix())
def test_a_folder_says_what_it_is_for_and_can_be_overlooked(package):
    said = ast.get_docstring(ast.parse(package.read_text(encoding="utf-8")))
    assert said is not None
    assert said.splitlines()[0].endswith((".", ":"))
    assert len([*package.parent.glob("*.py")]) - 1 <= MOST_FILES
