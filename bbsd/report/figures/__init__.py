"""Figures as files, the same bytes for the same data."""

from bbsd.report.figures.curves import curves
from bbsd.report.figures.episode import episode
from bbsd.report.figures.files import FigureError, require_figure

__all__ = ["FigureError", "curves", "episode", "require_figure"]
