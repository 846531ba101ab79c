"""Two designs compared: commands, rules, order, returns, and which change the difference comes from."""

from bbsd.explanation.comparison.comparing import compare_designs, earned_by
from bbsd.explanation.comparison.hosting import Design
from bbsd.explanation.comparison.results import Comparison

__all__ = ["Comparison", "Design", "compare_designs", "earned_by"]
