"""What `bbsd design` draws and writes beside a design: figures of the search, event files of TensorBoard."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from bbsd.cli.terminal.output import require_writable_file
from bbsd.report.figures import draw_curves, require_figure
from bbsd.report.wording.numbers import number

if TYPE_CHECKING:
    from collections.abc import Mapping
    from typing import Any

    from bbsd.api import Designed
    from bbsd.cli.terminal.access import Stepping

CURVES = "curves.png"
"""The figure in the folder of a design."""


@dataclass(frozen=True, slots=True)
class Additions:
    """What is wanted beside a design."""

    plot: bool
    """The figure in its folder."""
    plot_to: Path | None
    """The file of another figure."""
    beside: Path | None
    """A design that figures compare it with."""
    tensorboard: Path | None
    """The folder of event files."""
    opening: "Stepping | Mapping[str, Any]"
    """How an environment in Python is opened."""

    def require(self, seed: int, out: Path | None, *, several: bool) -> None:
        """Find out before the search whether its figures can be drawn, and what they compare it with evaluated.

        Raises:
            BadParameter: options that contradict one another.
            FigureError: no figure can be drawn.
            OSError, FileInFolderInUse: a file cannot be written.
        """
        if self.plot:
            require_figure(Path(CURVES))
        if self.plot_to:
            if several:
                advice = (
                    "--plot-to draws one search: with --seeds, --plot draws each in the folder of its seed"
                )
                raise typer.BadParameter(advice)
            require_figure(self.plot_to)
            if self.plot_to.parent != out:
                require_writable_file(self.plot_to)
        if self.tensorboard is not None and out not in (self.tensorboard, *self.tensorboard.parents):
            self.tensorboard.mkdir(parents=True, exist_ok=True)
        if self.beside is None:
            return
        if not (self.plot or self.plot_to):
            raise typer.BadParameter("--plot-beside needs --plot or --plot-to")
        from bbsd.api.specs import load
        from bbsd.architecture import architecture_of

        architecture_of(load(self.beside, seed=seed).meaning)

    def add(self, designed: "Designed", seed: int, part: str = "") -> None:
        """Draw and write all, while the design's folder is locked; event files of a part in a folder of its name."""
        figures = [
            *([designed.folder / CURVES] if self.plot else []),
            *([self.plot_to] if self.plot_to else []),
        ]
        if figures:
            self._draw(designed, seed, figures)
        if self.tensorboard is not None:
            from bbsd.report.watching.events import EventFiles
            from bbsd.runs.storage.watching import look

            EventFiles(self.tensorboard / part).update(look(designed.folder))

    def _draw(self, designed: "Designed", seed: int, figures: list[Path]) -> None:
        from bbsd import api

        returns = {"random agents": designed.random.mean}
        if self.beside is not None:
            compared = api.load(self.beside, seed=seed)
            returns[compared.spec.name] = api.evaluate(compared, seed=seed, **self.opening).mean
        title = f"{designed.name}, seed {seed}: the design earns {number(designed.mean)}"
        for path in figures:
            draw_curves(designed.metrics, path, title=title, beside=returns)
