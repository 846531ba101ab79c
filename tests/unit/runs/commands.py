"""Commands that complete small runs, and identities."""

from dataclasses import replace

from bbsd.runs.command import Command
from bbsd.runs.storage.folder import Folder
from bbsd.runs.storage.identity import Identity
from tests.unit.solver.problems import guess

WHO = Identity((("environment", "a"), ("reward", "b")), 11, 2)


def command_of(path, n_runs=2, who=WHO, lanes=5):
    """A command of the paper's loop, a tenth of a second a run."""
    return Command(*guess(lanes=lanes), seed=11, n_runs=n_runs, folder=Folder(path), who=who)


def search_of(path, *budgets, method="random", n_runs=2, who=WHO, lanes=5):
    """A command of another method, with these budgets."""
    problem, settings = guess(lanes=lanes)
    return Command(
        problem, replace(settings, method=method), 11, n_runs, Folder(path), who, budgets or (5000,)
    )
