"""Results in notebooks: how IPython and Jupyter show what the Python functions return."""

from bbsd.report.notebook.formatters import register

__all__ = ["register"]
