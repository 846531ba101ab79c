"""`bbsd doctor`."""

from dataclasses import asdict
from typing import TYPE_CHECKING

import typer

from bbsd.cli.options import AsJson
from bbsd.cli.output import show

if TYPE_CHECKING:
    from bbsd.report.health import Finding

ILL = 1
"""The exit code where something is wrong."""


def doctor(as_json: AsJson = False) -> None:
    """Look at the installation: versions, cores, caches, and whether it computes as it should.

    Leaves with 1 if something is wrong.
    """
    from bbsd.report.health import findings
    from bbsd.report.plain import json_text

    found = list(findings())
    is_well = not any(each.problem for each in found)
    if as_json:
        show(json_text({"ok": is_well, "findings": [asdict(each) for each in found]}))
    else:
        show("\n".join(map(_line, found)))
    if not is_well:
        raise typer.Exit(ILL)


def _line(finding: "Finding") -> str:
    from bbsd.errors import escape

    line = f"{finding.name:<12}{escape(finding.value)}"
    return f"{line}\n{'':<12}wrong: {escape(finding.problem)}" if finding.problem else line
