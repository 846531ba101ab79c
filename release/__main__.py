"""`python -m release`: builds what is handed out, checks it, and uses it where no checkout is.

Ends with exit code 1 and the reason at the first thing that is not as it should be.
"""

from __future__ import annotations

import sys
import tempfile
import time
from pathlib import Path
from typing import TYPE_CHECKING

from release.building import build, copy_tracked
from release.commands import CheckFailed
from release.contents import check_by_tools, check_contents, check_documents
from release.installing import Environment, check_types, run_tests, use_without_extras

if TYPE_CHECKING:
    from collections.abc import Callable


def step(name: str, work: Callable[[], str]) -> None:
    """Do a step, and print its name, its time and what it found."""
    started = time.monotonic()
    found = work()
    print(f"{name:22} {time.monotonic() - started:5.0f} s   {found}", flush=True)


def check(folder: Path) -> None:
    """Do all checks in an empty folder; CheckFailed at the first that fails."""
    started = time.monotonic()
    for name in ("dist", "use"):
        (folder / name).mkdir()
    tree, use = copy_tracked(folder / "tree"), folder / "use"
    built = build(tree, folder / "dist")
    print(
        f"{'build':22} {time.monotonic() - started:5.0f} s   {built.wheel.name}, {built.source.name}",
        flush=True,
    )
    step("contents", lambda: check_contents(built))
    step("tools", lambda: check_by_tools(built, folder))
    step("documents", check_documents)
    environment = Environment.new(folder / "environment")
    step("without extras", lambda: use_without_extras(built, environment, use))
    step("types", lambda: check_types(built, environment, tree, use))
    step("demo and tests", lambda: run_tests(built, environment, tree, use))
    print(f"{'in all':22} {time.monotonic() - started:5.0f} s")


def main() -> int:
    """Check, and return the exit code."""
    with tempfile.TemporaryDirectory(prefix="bbsd-release-") as folder:
        try:
            check(Path(folder).resolve())
        except CheckFailed as failed:
            print(failed, file=sys.stderr)
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
