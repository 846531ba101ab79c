"""Figures, written to files; the same data gives the same bytes."""

from bbsd.report.figures.choice import names_to_show, require_names
from bbsd.report.figures.curves import draw_curves
from bbsd.report.figures.episode import draw_episode
from bbsd.report.figures.files import FigureError, require_figure

__all__ = [
    "FigureError",
    "draw_curves",
    "draw_episode",
    "names_to_show",
    "require_figure",
    "require_names",
]
