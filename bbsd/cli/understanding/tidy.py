"""`bbsd tidy`."""

from difflib import unified_diff
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

import bbsd
from bbsd.cli.options import DesignFile
from bbsd.cli.terminal.output import require_writable_file, say, show
from bbsd.errors import escape
from bbsd.runs.storage.lock import write_result_text

if TYPE_CHECKING:
    from bbsd.architecture.shorter import Shortened, Shorter

CAN_BE_SHORTER = 1
"""The exit code of --check if a design can be shorter."""


def tidy(
    design: DesignFile,
    out: Annotated[
        Path | None,
        typer.Option(
            "--out", "-o", metavar="FILE", help="Write the shorter design here.", show_default="print it"
        ),
    ] = None,
    check: Annotated[
        bool, typer.Option("--check", help="Write nothing; exit with code 1 if the design can be shorter.")
    ] = False,
    diff: Annotated[bool, typer.Option("--diff", help="Write nothing; print the changes as a diff.")] = False,
) -> None:
    """Offer a design in fewer words that does the same.

    Proven in every situation that its behaviors can tell apart. Rules become as short as they can be, also over cells
    in which a higher layer always acts; behaviors that never control leave the structure. Comments and layout stay
    elsewhere.
    """
    if out is not None:
        require_writable_file(out)
    loaded = bbsd.load(design)
    found = bbsd.tidy(loaded)
    for line in _what_changed(found):
        say(escape(line))
    if diff:
        show(_diff(loaded.source.text, found.text, loaded.source.file))
    if check:
        raise typer.Exit(CAN_BE_SHORTER if found.is_changed else 0)
    if out is not None:
        write_result_text(out, found.text)
        say(f"wrote {escape(str(out))}")
    elif not diff:
        show(found.text)


def _what_changed(found: "Shorter") -> list[str]:
    if not found.is_changed:
        return ["nothing can be shorter"]
    removed = [f"{name}: never controls, and left the structure" for name in found.removed]
    proof = f"the same in all {found.joint_cells:,} situations"
    return [*map(_shortened_text, found.shortened), *removed, proof]


def _shortened_text(shortened: "Shortened") -> str:
    before = f"a table of {shortened.before:,} cells" if shortened.was_table else f"{shortened.before:,}"
    return (
        f"{shortened.behavior}: {shortened.now:,} word{'' if shortened.now == 1 else 's'} instead of {before}"
    )


def _diff(before: str, after: str, file: str) -> str:
    lines = unified_diff(before.splitlines(), after.splitlines(), file, f"{file} shorter", lineterm="")
    return "\n".join(escape(line) for line in lines)
