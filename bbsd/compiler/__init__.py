"""From a spec's meaning to arrays and one generated kernel."""

from bbsd.compiler.problem import DetailedOutcome, Outcome, Problem, Team, compile_meaning
from bbsd.compiler.tables import Pool, TableShape

__all__ = ["DetailedOutcome", "Outcome", "Pool", "Problem", "TableShape", "Team", "compile_meaning"]
