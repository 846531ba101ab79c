"""From a spec's meaning to arrays and one generated kernel.

`passes` rewrite the graph of an episode, `writing` prints it, `kernels` loads and runs what was printed. A `Problem` is
what the method and the evaluation see of all this, a `Team` the agents that they run episodes with.
"""

from bbsd.compiler.details import Column, Detail, traced_columns
from bbsd.compiler.kernels import kernel_source
from bbsd.compiler.problem import Problem, compile_meaning
from bbsd.compiler.tables import Pool, TableShape
from bbsd.compiler.team import DetailedOutcome, Outcome, Team

__all__ = [
    "Column",
    "Detail",
    "DetailedOutcome",
    "Outcome",
    "Pool",
    "Problem",
    "TableShape",
    "Team",
    "compile_meaning",
    "kernel_source",
    "traced_columns",
]  # fmt: skip
