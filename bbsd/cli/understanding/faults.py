"""`bbsd evaluate --fault`."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import typer

import bbsd
from bbsd.cli.terminal.output import error_console, say, show, show_table
from bbsd.report.plain import json_text
from bbsd.report.wording.numbers import column

if TYPE_CHECKING:
    from bbsd.cli.terminal.access import Stepping
    from bbsd.language.loading import Loaded

TOO_LOW = 1
"""The exit code if a mean is below --at-least, or a share below --expect-at-least."""


def show_faults(
    loaded: "Loaded",
    faults: Sequence[str],
    episodes: int,
    seed: int,
    least: float | None,
    lanes: int,
    jobs: int,
    opening: "Stepping",
    *,
    relearn: bool,
    as_json: bool,
) -> None:
    """Show what a design earns undisturbed and under each fault; exit with 1 where one mean is below `least`."""
    if episodes < 2:
        raise typer.BadParameter("--fault needs --episodes 2 at least")
    from bbsd.report.faults import faults_plain, faults_table
    from bbsd.report.progress import episode_listener

    with episode_listener(error_console(), "faults") as listener:
        found = bbsd.faults(
            loaded,
            faults,
            episodes=episodes,
            seed=seed,
            relearn=relearn,
            lanes=lanes,
            jobs=jobs,
            progress=listener,
            **opening,
        )
    if as_json:
        show(json_text(faults_plain(found)))
    else:
        show_table(faults_table(found))
    failures = too_low(found.returns.mean, least)
    for each in found.faults:
        failures += too_low(each.returns.mean, least, f"with {each.fault.text} ")
    for failure in failures:
        say(failure)
    if failures:
        raise typer.Exit(TOO_LOW)


def too_low(mean: float, least: float | None, condition: str = "") -> list[str]:
    """Return what to say where a mean return is below the least that is wanted."""
    if least is None or mean >= least:
        return []
    mean_text, least_text, by = column([mean, least, least - mean])
    return [f"bbsd: {condition}the mean return {mean_text} is below {least_text} by {by}"]
