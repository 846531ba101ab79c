"""How a design is continued: in its folder, and what is said where it was stopped."""

import shlex
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from bbsd.cli.terminal.output import say

if TYPE_CHECKING:
    from bbsd.api import Interrupted
    from bbsd.runs.storage.folder import Design

CHOSEN = {"seed": "--seed", "runs": "--runs", "seeds": "--seeds", "out": "--out", "overrides": "--set"}
"""Options that a design has from its beginning."""


def former_design(folder: Path, context: typer.Context, *, goes_on: bool) -> "Design":
    """Return what a folder is the design of, to go on with it; what was chosen then cannot be chosen again."""
    from bbsd.api.making.place import former_of

    former = former_of(folder, goes_on=goes_on)
    if former is None:
        raise typer.BadParameter(f"{folder} is no folder")
    for name, option in CHOSEN.items():
        source = context.get_parameter_source(name)
        if source is not None and source.name != "DEFAULT":
            raise typer.BadParameter(
                f"{option} was chosen when the design in {folder} began; "
                "give its spec instead of the folder to choose anew"
            )
    return former.design()


def say_how_to_continue(stopped: "Interrupted", begin: str = "", out: Path | None = None) -> None:
    """Say where a design that was stopped is kept, and the command that continues it."""
    best = stopped.best
    kept = f"stopped; what was done is kept in {stopped.folder}."
    if best is not None:
        kept += (
            f" The best so far, {best.architecture}, earned {best.mean:.6g} in {best.episodes:,} episodes."
        )
    say(f"{begin}{kept} To continue: {resume_command(out or stopped.folder)}")


def resume_command(folder: Path) -> str:
    """Return the command that continues in a folder: the one given, with --resume and without a further budget."""
    words = sys.argv[1:]
    value_of_more = {index + 1 for index, word in enumerate(words) if word == "--more"}
    given = [
        word
        for index, word in enumerate(words)
        if index not in value_of_more and word.partition("=")[0] not in ("--more", "--resume")
    ]
    named = any(word.partition("=")[0] == "--out" for word in given) or str(folder) in given
    return shlex.join(["bbsd", *given, *([] if named else ["--out", str(folder)]), "--resume"])
