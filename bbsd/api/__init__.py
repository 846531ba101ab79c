"""The commands as functions, for Python programs: load, check, compile, design, price, evaluate, trace, explain.

A spec is given as the path of its file, or as what `load` returned. `overrides` are texts such as
"design.coevolution.generations=10"; they replace values of the spec. `seed` is that of all random numbers: the same
spec, overrides and seed give the same result. `lanes`, the episodes that a kernel runs side by side, and `jobs` affect
only the speed.
"""

from bbsd.api.designing import design, price
from bbsd.api.evaluating import evaluate, explain, trace
from bbsd.api.results import (
    AnyProgress,
    BestSoFar,
    Designed,
    Interrupted,
    NoBudget,
    NothingToDesign,
    Progress,
    SearchProgress,
)
from bbsd.api.specs import AnySpec, check, compile, load  # noqa: A004 - the verb

__all__ = [
    "AnyProgress",
    "AnySpec",
    "BestSoFar",
    "Designed",
    "Interrupted",
    "NoBudget",
    "NothingToDesign",
    "Progress",
    "SearchProgress",
    "check",
    "compile",
    "design",
    "evaluate",
    "explain",
    "load",
    "price",
    "trace",
]
