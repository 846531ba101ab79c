"""`bbsd doctor`."""

from dataclasses import asdict
from typing import TYPE_CHECKING, Annotated

import typer

from bbsd.cli.options import AsFormat, AsJson, ResultFormat
from bbsd.cli.terminal.output import say, show

if TYPE_CHECKING:
    from bbsd.report.health import Finding

PROBLEM = 1
"""The exit code if something is wrong."""


Clean = Annotated[bool, typer.Option("--clean", help="Empty the cache of compiled code first.")]


def doctor(clean: Clean = False, form: AsFormat = ResultFormat.TEXT, as_json: AsJson = False) -> None:
    """Check the installation: versions, cores, caches, a test result.

    The test is also compiled, which takes some seconds where the cache is empty. Exits with code 1 if something is
    wrong.
    """
    from bbsd.kernel import cache
    from bbsd.report.health import examine
    from bbsd.report.plain import json_text

    if clean:
        root = cache.cache_root()
        say(f"{cache.clean(root) / 1e6:.1f} MB removed from {root}")
    findings = list(examine())
    is_well = not any(finding.problem for finding in findings)
    if as_json or form is ResultFormat.JSON:
        show(json_text({"ok": is_well, "findings": [asdict(finding) for finding in findings]}))
    else:
        show("\n".join(map(_line, findings)))
    if not is_well:
        raise typer.Exit(PROBLEM)


def _line(finding: "Finding") -> str:
    from bbsd.errors import escape

    line = f"{finding.name:<12}{escape(finding.value)}"
    return f"{line}\n{'':<12}wrong: {escape(finding.problem)}" if finding.problem else line
