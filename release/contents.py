"""What must be in the archives, byte for byte, and that nothing else is."""

from __future__ import annotations

import tarfile
import zipfile
from typing import TYPE_CHECKING

from release.building import tracked_files
from release.commands import ROOT, CheckFailed, run, tool

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from release.building import Built

PACKAGE = "bbsd/"
BESIDE_THE_PACKAGE = ("LICENSE", "README.md", "pyproject.toml")
"""Tracked files that are in the source archive."""


def check_contents(built: Built) -> str:
    """Compare both archives with what git tracks, and the wheels with each other; return what was found.

    Raises:
        CheckFailed: a file of the package is missing or changed, or another one is in.
    """
    package = {name: (ROOT / name).read_bytes() for name in tracked_files() if name.startswith(PACKAGE)}
    wheel, source = wheel_files(built.wheel), source_files(built.source)
    code = {name: content for name, content in wheel.items() if ".dist-info/" not in name}
    require_same("the wheel", code, package)
    expected = {**package, **{name: (ROOT / name).read_bytes() for name in BESIDE_THE_PACKAGE}}
    made = {"PKG-INFO", "setup.cfg"}
    require_same(
        "the source archive",
        {name: content for name, content in source.items() if name not in made and ".egg-info/" not in name},
        expected,
    )
    if built.wheel.read_bytes() != built.direct.read_bytes():
        require_same("the wheel from the source archive", wheel, wheel_files(built.direct))
        raise CheckFailed(
            "the wheel from the source archive has the same files as that of the tree, but other bytes"
        )
    return f"{len(package)} files, {built.wheel.stat().st_size / 1000:,.0f} kB; from the source archive the same bytes"


def require_same(what: str, found: Mapping[str, bytes], expected: Mapping[str, bytes]) -> None:
    """Raise CheckFailed if files are missing, changed, or too many."""
    differences = {
        "lacks": expected.keys() - found.keys(),
        "should not have": found.keys() - expected.keys(),
        "has other bytes of": {
            name for name in expected.keys() & found.keys() if expected[name] != found[name]
        },
    }
    words = [f"{what} {verb} {', '.join(sorted(names))}" for verb, names in differences.items() if names]
    if words:
        raise CheckFailed("\n".join(words))


def wheel_files(path: Path) -> dict[str, bytes]:
    """Return the files of a wheel, by name."""
    with zipfile.ZipFile(path) as archive:
        return {name: archive.read(name) for name in archive.namelist() if not name.endswith("/")}


def source_files(path: Path) -> dict[str, bytes]:
    """Return the files of a source archive, by their names in its only folder."""
    files = {}
    with tarfile.open(path) as archive:
        for member in archive:
            content = archive.extractfile(member)
            if content is not None:
                files[member.name.partition("/")[2]] = content.read()
    return files


def check_by_tools(built: Built, folder: Path) -> str:
    """Let the tools of the Python world look at the archives, and return their names; CheckFailed if one objects."""
    run(tool("twine"), "check", "--strict", built.source, built.wheel, folder=folder)
    run(tool("check-wheel-contents"), built.wheel, folder=ROOT)
    return "twine, check-wheel-contents"


def check_documents() -> str:
    """Hold files that other programs read against their schemas; CheckFailed if one does not fit."""
    by_schema = {
        "vendor.citation-file-format": ["CITATION.cff"],
        "vendor.github-workflows": sorted(str(path) for path in ROOT.glob(".github/workflows/*.yml")),
    }
    for schema, files in by_schema.items():
        run(tool("check-jsonschema"), "--builtin-schema", schema, *files, folder=ROOT)
    return ", ".join(by_schema)
