"""A comparison of two designs, as tables for people and as plain data for programs."""

from bbsd.report.comparison.plain import comparison_plain
from bbsd.report.comparison.table import comparison_table

__all__ = ["comparison_plain", "comparison_table"]
