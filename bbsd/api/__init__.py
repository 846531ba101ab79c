"""The commands as functions, for Python programs: load, check, compile, design, price, evaluate, trace, and so on.

A spec is given as the path of its file, as the folder of a run, which stands for the design that came out, as its text
(with line breaks), as a dict, or as what `load` or `design` returned. `set` replaces values of the spec, as --set does
on the command line: by texts such as "design.budget=300_000", or by a dict such as {"design.budget": 300_000}. `seed`
is that of all random numbers: the same spec, `set` and seed give the same result. `lanes`, the episodes that a kernel
runs side by side, and `jobs` affect only the speed. An argument is honored, or refused with
`BadArgument`, a ValueError.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from bbsd.agent.program import Act
    from bbsd.api.acting import Agent
    from bbsd.api.appraising import faults, worth
    from bbsd.api.comparing import compare
    from bbsd.api.compiling import compile  # noqa: A004 - the verb
    from bbsd.api.evaluating import evaluate
    from bbsd.api.explaining import explain
    from bbsd.api.exporting import Export, export
    from bbsd.api.given.arguments import BadArgument
    from bbsd.api.looking import NoEnvironment, Spaces, spaces
    from bbsd.api.making.designing import design
    from bbsd.api.making.pricing import price
    from bbsd.api.paging import Page, page
    from bbsd.api.reasons import why
    from bbsd.api.results import (
        AnyProgress,
        BestSoFar,
        Designed,
        Interrupted,
        NoBudget,
        NothingToDesign,
        NotWritten,
        Progress,
        SearchProgress,
    )
    from bbsd.api.specs import AnySpec, check, load
    from bbsd.api.tidying import tidy
    from bbsd.api.tracing import trace
    from bbsd.api.watching import runs_in, watch
    from bbsd.api.worlds import env
    from bbsd.architecture import HolesLeft
    from bbsd.architecture.shorter import Shorter
    from bbsd.errors import Diagnosis, SpecError, UsageError
    from bbsd.evaluation import Evaluation, Interval, Trace
    from bbsd.explanation import Explanation
    from bbsd.explanation.comparison import Comparison
    from bbsd.explanation.faults import Degradations
    from bbsd.explanation.why import Answer
    from bbsd.explanation.worth import Worth
    from bbsd.language.loading import Loaded
    from bbsd.runs.storage.watching import Watched

HOMES = {
    "bbsd.api.acting": ("Agent",),
    "bbsd.api.appraising": ("faults", "worth"),
    "bbsd.api.comparing": ("compare",),
    "bbsd.api.compiling": ("compile",),
    "bbsd.api.making.designing": ("design",),
    "bbsd.api.making.pricing": ("price",),
    "bbsd.api.evaluating": ("evaluate",),
    "bbsd.api.explaining": ("explain",),
    "bbsd.api.exporting": ("Export", "export"),
    "bbsd.api.looking": ("NoEnvironment", "Spaces", "spaces"),
    "bbsd.api.paging": ("Page", "page"),
    "bbsd.api.reasons": ("why",),
    "bbsd.api.results": (
        "AnyProgress",
        "BestSoFar",
        "Designed",
        "Interrupted",
        "NoBudget",
        "NothingToDesign",
        "NotWritten",
        "Progress",
        "SearchProgress",
    ),
    "bbsd.api.given.arguments": ("BadArgument",),
    "bbsd.api.specs": ("AnySpec", "check", "load"),
    "bbsd.api.watching": ("runs_in", "watch"),
    "bbsd.api.tidying": ("tidy",),
    "bbsd.api.tracing": ("trace",),
    "bbsd.api.worlds": ("env",),
    "bbsd.agent.program": ("Act",),
    "bbsd.architecture": ("HolesLeft",),
    "bbsd.architecture.shorter": ("Shorter",),
    "bbsd.errors": ("Diagnosis", "SpecError", "UsageError"),
    "bbsd.evaluation": ("Evaluation", "Interval", "Trace"),
    "bbsd.explanation": ("Explanation",),
    "bbsd.explanation.comparison": ("Comparison",),
    "bbsd.explanation.faults": ("Degradations",),
    "bbsd.explanation.why": ("Answer",),
    "bbsd.explanation.worth": ("Worth",),
    "bbsd.language.loading": ("Loaded",),
    "bbsd.runs.storage.watching": ("Watched",),
}
"""Where each name is from."""

__all__ = [
    "Act",
    "Agent",
    "Answer",
    "AnyProgress",
    "AnySpec",
    "BadArgument",
    "BestSoFar",
    "Comparison",
    "Degradations",
    "Designed",
    "Diagnosis",
    "Evaluation",
    "Explanation",
    "Export",
    "HolesLeft",
    "Interrupted",
    "Interval",
    "Loaded",
    "NoBudget",
    "NoEnvironment",
    "NotWritten",
    "NothingToDesign",
    "Page",
    "Progress",
    "SearchProgress",
    "Shorter",
    "Spaces",
    "SpecError",
    "Trace",
    "UsageError",
    "Watched",
    "Worth",
    "check",
    "compare",
    "compile",
    "design",
    "env",
    "evaluate",
    "explain",
    "export",
    "faults",
    "load",
    "page",
    "price",
    "runs_in",
    "spaces",
    "tidy",
    "trace",
    "watch",
    "why",
    "worth",
]


if not TYPE_CHECKING:  # so that type checkers find a misspelled name, and the types of the others

    def __getattr__(name: str) -> object:
        """Return a verb, whose module is imported only then: what only reads a spec needs no compiler."""
        for home, names in HOMES.items():
            if name in names:
                return getattr(import_module(home), name)
        raise AttributeError(f"module 'bbsd.api' has no attribute {name!r}")


def __dir__() -> list[str]:
    """Return all names, those too that are not imported yet, so that a Python prompt completes them."""
    return sorted({*globals(), *__all__})
