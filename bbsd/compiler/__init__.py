"""From a spec's meaning to arrays and one generated kernel."""

from bbsd.compiler.problem import Problem, compile_meaning
from bbsd.compiler.tables import Pool, TableShape
from bbsd.compiler.team import DetailedOutcome, Outcome, Team

__all__ = ["DetailedOutcome", "Outcome", "Pool", "Problem", "TableShape", "Team", "compile_meaning"]
