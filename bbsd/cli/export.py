"""`bbsd export`."""

from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

import bbsd
from bbsd.cli.options import DesignFile, Overrides, Seed
from bbsd.cli.terminal.output import require_writable_file, say, show
from bbsd.errors import escape
from bbsd.runs.storage.lock import write_result_text

if TYPE_CHECKING:
    from bbsd.api.exporting import Export

NOT_VERIFIED = 1
"""The exit code of --verify where what was written was not verified, or differs."""


class TargetName(StrEnum):
    """What a design can be written for."""

    C = "c"
    PYTHON = "python"
    BTCPP = "btcpp"
    PYTREES = "pytrees"
    ROS2 = "ros2"


class Leaves(StrEnum):
    """What the leaves of a tree are."""

    SCRIPT = "script"
    CUSTOM = "custom"


def export(
    design: DesignFile,
    to: Annotated[TargetName, typer.Option("--to", help="What to write the design for.", show_default=False)],
    out: Annotated[
        Path | None,
        typer.Option("--out", "-o", metavar="FILE", help="Write it here.", show_default="print it"),
    ] = None,
    verify: Annotated[
        bool,
        typer.Option(
            "--verify",
            help="Run it through the target in all situations that the behaviors tell apart; exit with code 1 if it "
            "differs, or if the target is not on this machine.",
        ),
    ] = False,
    sensing: Annotated[
        bool,
        typer.Option(
            "--sensing",
            help="Of c: from what the robot measures, also compute sensors, excitation and what actions set.",
        ),
    ] = False,
    measured: Annotated[
        list[str] | None,
        typer.Option(
            metavar="NAME", help="With --sensing: a sensor or state that the robot measures. Repeatable."
        ),
    ] = None,
    remembered: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME", help="With --sensing: state that the robot keeps itself. Repeatable."),
    ] = None,
    episodes: Annotated[
        int,
        typer.Option(
            min=1, help="With --sensing: recorded episodes beside which --verify runs what was written."
        ),
    ] = 3,
    leaves: Annotated[
        Leaves,
        typer.Option(
            help="Of btcpp: scripts, which run as they are, or nodes of your own with a model for Groot2."
        ),
    ] = Leaves.SCRIPT,
    seed: Seed = 0,
    overrides: Overrides = None,
) -> None:
    """Write a design in another language, for your own program.

    The file decides from the cells of the behaviors' inputs: your program tells it which cells its sensors are in, and
    it answers with the action of the behavior that controls. It needs nothing else. With --sensing it computes the
    cells, and what the action sets, from what your robot measures.
    """
    if out is not None:
        require_writable_file(out)
    exported = bbsd.export(
        design,
        to.value,
        verify=verify,
        sensing=sensing,
        measured=measured or (),
        remembered=remembered or (),
        episodes=episodes,
        leaves=leaves.value,
        seed=seed,
        set=overrides or (),
    )
    _write(exported, out)
    if verify:
        from bbsd.report.exports import verified_lines

        for line in verified_lines(exported):
            say(line)
        if not exported.is_verified:
            raise typer.Exit(NOT_VERIFIED)


def _write(exported: "Export", out: Path | None) -> None:
    if out is None:
        show(exported.text)
        return
    write_result_text(out, exported.text)
    say(f"wrote {escape(str(out))}")
