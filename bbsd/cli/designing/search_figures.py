"""The figures of a search that `bbsd design` draws: in its folder, or anywhere, beside other designs."""

from pathlib import Path
from typing import TYPE_CHECKING

import typer

from bbsd.cli.terminal.output import require_writable_file
from bbsd.report.figures import draw_curves, require_figure
from bbsd.report.wording.numbers import number

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bbsd.api import Designed
    from bbsd.cli.terminal.access import Stepping

CURVES = "curves.png"
"""The figure in the folder of a design."""


def require_figures(plot: bool, plot_to: Path | None, beside: Path | None, seed: int) -> None:
    """Find out before the search whether its figures can be drawn, and what they compare it with evaluated."""
    if plot:
        require_figure(Path(CURVES))
    if plot_to:
        require_figure(plot_to)
        require_writable_file(plot_to)
    if beside is None:
        return
    if not (plot or plot_to):
        raise typer.BadParameter("--plot-beside needs --plot or --plot-to")
    from bbsd.api.specs import load
    from bbsd.architecture import architecture_of

    architecture_of(load(beside, seed=seed).meaning)


def draw_search(
    designed: "Designed",
    name: str,
    seed: int,
    beside: Path | None,
    figures: "Sequence[Path]",
    opening: "Stepping",
) -> None:
    """Draw the metrics, after the result is shown: matplotlib takes longer than a small design."""
    if not figures:
        return
    from bbsd import api

    returns = {"random agents": designed.random.mean}
    if beside is not None:
        compared = api.load(beside, seed=seed)
        returns[compared.spec.name] = api.evaluate(compared, seed=seed, **opening).mean
    title = f"{name}, seed {seed}: the design earns {number(designed.mean)}"
    for path in figures:
        draw_curves(designed.metrics, path, title=title, beside=returns)
