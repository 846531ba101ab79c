"""Installs what was built into an empty environment, and uses it from a folder where no checkout is."""

from __future__ import annotations

import os
import shutil
import sys
from dataclasses import dataclass
from typing import TYPE_CHECKING

from release.commands import ROOT, CheckFailed, run, tool

if TYPE_CHECKING:
    from pathlib import Path

    from release.building import Built

USED = (
    ("new", "minimal"),
    ("check", "minimal.yaml"),
    ("design", "minimal.yaml", "--quiet", "--out", "run"),
    ("evaluate", "run"),
    ("explain", "run"),
    ("worth", "run"),
    ("report", "run", "-o", "page.html"),
    ("export", "run", "--to", "python", "-o", "design.py"),
    ("runs", "."),
    ("doctor",),
)
"""Commands that need nothing but what every installation has."""

READ_THE_PACKAGE = ("tests/docs/test_architecture.py", "tests/release", "tests/unit/test_names.py")
"""Tests of the files of the checkout itself."""


@dataclass(frozen=True, slots=True)
class Environment:
    """A virtual environment outside of the tree."""

    folder: Path

    @classmethod
    def new(cls, folder: Path) -> Environment:
        """Make an empty one with the Python that runs this."""
        run(sys.executable, "-m", "venv", folder, folder=folder.parent)
        return cls(folder)

    def program(self, name: str) -> Path:
        """Return the path of a program that is installed in it."""
        return self.folder / "bin" / name

    def install(self, *what: str | Path) -> None:
        """Install packages."""
        run(self.program("pip"), "install", "--quiet", *what, folder=self.folder)

    def require_installed(self, folder: Path, home: Path) -> None:
        """Raise CheckFailed if a Python in a folder imports bbsd from elsewhere than below a home."""
        found = run(self.program("python"), "-c", "import bbsd; print(bbsd.__file__)", folder=folder).strip()
        if not found.startswith(f"{home}{os.sep}"):
            raise CheckFailed(f"bbsd is imported from {found}, not from {home}")


def use_without_extras(built: Built, environment: Environment, folder: Path) -> str:
    """Install the wheel alone, and use each command that needs no extra; CheckFailed if one fails."""
    environment.install(built.wheel)
    environment.require_installed(folder, environment.folder)
    run(environment.program("pip"), "check", folder=folder)
    for command in USED:
        run(environment.program("bbsd"), *command, folder=folder, more=own_cache(folder))
    return f"{len(USED)} commands"


def check_types(built: Built, environment: Environment, tree: Path, folder: Path) -> str:
    """Check the types of a user's program as mypy and pyright see them: with the wheel, then with an editable install.

    The program also runs. Of a program with mistakes, every line that has one must be found, and no other.

    Raises:
        CheckFailed: a checker says something else.
    """
    python = environment.program("python")
    for name in ("program.py", "mistakes.py"):
        (folder / name).write_bytes((ROOT / "tests" / "types" / name).read_bytes())
    for editable in (False, True):
        if editable:
            environment.install("--no-deps", "--editable", tree)
            environment.require_installed(folder, tree)
        mypy = (tool("mypy"), "--strict", "--python-executable", python)
        pyright = (tool("pyright"), "--pythonpath", python)
        for checker in (mypy, pyright):
            run(*checker, "program.py", folder=folder)
            require_mistakes(checker, folder)
        run(python, "program.py", folder=folder, more=own_cache(folder))
    environment.install("--no-deps", "--force-reinstall", built.wheel)
    return "mypy --strict, pyright; wheel, editable install"


def require_mistakes(checker: tuple[str | Path, ...], folder: Path) -> None:
    """Raise CheckFailed if a checker does not find the mistakes of a program in the lines that are marked."""
    lines = (folder / "mistakes.py").read_text(encoding="utf-8").splitlines()
    marked = {number for number, line in enumerate(lines, 1) if line.endswith("# wrong")}
    try:
        run(*checker, "mistakes.py", folder=folder)
    except CheckFailed as failed:
        found = {number for number in range(1, len(lines) + 1) if f"mistakes.py:{number}:" in str(failed)}
        if found != marked:
            raise
    else:
        raise CheckFailed(f"{checker[0]} finds no mistake in mistakes.py")


def run_tests(built: Built, environment: Environment, copied: Path, folder: Path) -> str:
    """Run the demo and the quick tests against the installed wheel, beside all of the checkout but the package.

    Returns:
        The last line of pytest.

    Raises:
        CheckFailed: one of them fails, or another bbsd than the installed one is imported.
    """
    environment.install(f"{built.wheel}[test]")
    tree = folder / "outside"
    shutil.copytree(copied, tree, ignore=lambda at, _: ["bbsd", "build"] if at == str(copied) else [])
    environment.require_installed(tree, environment.folder)
    demo = ("design", "specs/object_lifting.yaml", "--plot", "--quiet")
    run(environment.program("bbsd"), *demo, folder=tree, more=own_cache(folder))
    ignored = [option for name in READ_THE_PACKAGE for option in ("--ignore", name)]
    quick = ("-q", "-n", "2", "--dist", "worksteal", "-m", "not slow", "--hypothesis-profile", "quick")
    printed = run(
        environment.program("pytest"),
        *quick,
        "--ignore",
        "tests/end_to_end",
        *ignored,
        folder=tree,
        more=own_cache(folder),
    )
    return printed.strip().splitlines()[-1]


def own_cache(folder: Path) -> dict[str, str]:
    """Return surroundings with a cache of compiled code that begins empty."""
    return {"BBSD_CACHE_DIR": str(folder / "cache")}
