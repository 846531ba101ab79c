"""What is said of the package in several places is the same, and what belongs to it is in it."""

import re
import tomllib
from pathlib import Path

import pytest
import yaml

import bbsd
from bbsd.version import __version__

ROOT = Path(__file__).parents[2]
SETTINGS = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
PROJECT = SETTINGS["project"]
CITATION = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
EXTRAS = PROJECT["optional-dependencies"]
REQUIREMENTS = [*PROJECT["dependencies"], *(each for extra in EXTRAS.values() for each in extra)]


def test_the_version_is_the_same_everywhere():
    assert {PROJECT["version"], CITATION["version"], bbsd.__version__} == {__version__}


def test_the_license_is_the_same_everywhere():
    assert PROJECT["license"] == CITATION["license"] == "MIT"
    assert (ROOT / "LICENSE").read_text(encoding="utf-8").startswith("MIT License\n")
    assert {path.relative_to(ROOT).as_posix() for path in ROOT.glob("bbsd/**/LICENSE*")} <= {
        *PROJECT["license-files"]
    }
    assert all((ROOT / name).exists() for name in PROJECT["license-files"])


def test_a_citation_says_what_the_package_says():
    assert (CITATION["title"], CITATION["keywords"]) == (PROJECT["name"], PROJECT["keywords"])
    assert CITATION["abstract"].rstrip(".") == PROJECT["description"]


def test_the_oldest_python_is_the_same_everywhere():
    oldest = re.fullmatch(r">=(3\.\d+)", PROJECT["requires-python"])[1]
    listed = re.findall(
        r"^Programming Language :: Python :: (3\.\d+)$", "\n".join(PROJECT["classifiers"]), re.MULTILINE
    )
    assert listed[0] == oldest
    assert listed == [f"3.{minor}" for minor in range(int(oldest[2:]), int(oldest[2:]) + len(listed))]
    assert SETTINGS["tool"]["ruff"]["target-version"] == f"py{oldest.replace('.', '')}"


@pytest.mark.parametrize("requirement", REQUIREMENTS)
def test_a_requirement_has_a_lower_bound_and_no_upper_one(requirement):
    assert re.fullmatch(
        r"bbsd\[[\w,-]+\]|[\w-]+(\[[\w,]+\])?>=[\d.]+(; python_version < '3\.\d+')?", requirement
    )


def test_every_extra_that_is_asked_for_exists():
    asked = [name for each in REQUIREMENTS if each.startswith("bbsd[") for name in each[5:-1].split(",")]
    assert set(asked) <= set(EXTRAS)


def test_every_file_that_is_no_module_is_listed():
    patterns = SETTINGS["tool"]["setuptools"]["package-data"]["bbsd"]
    listed = {path for pattern in patterns for path in (ROOT / "bbsd").glob(pattern)}
    files = {
        path for path in (ROOT / "bbsd").rglob("*") if path.is_file() and "__pycache__" not in path.parts
    }
    assert {path.relative_to(ROOT).as_posix() for path in files - listed if path.suffix != ".py"} == set()
    assert all(any((ROOT / "bbsd").glob(pattern)) for pattern in patterns)
