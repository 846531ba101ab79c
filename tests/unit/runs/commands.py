"""Commands that complete small runs, and identities."""

from dataclasses import replace

from bbsd.compiler import compile_meaning
from bbsd.language.loading import load
from bbsd.runs.command import Command
from bbsd.runs.origin import origin_of
from bbsd.runs.storage.folder import Folder
from bbsd.runs.storage.identity import Identity, identity
from bbsd.solver.paper.settings import settings_of
from bbsd.text import Source
from tests.unit.solver.problems import GUESS, guess

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


SENT = GUESS.format(structure="", sharing="uniform", search="sampled", culture="{size: 3}")


def sent_command(path, n_runs=2, budgets=(), overrides=(), lanes=5, seed=11):
    """A command that workers can make too, of the paper's loop, or with budgets of another method."""
    overrides = (*overrides, *(["design.method=random"] if budgets else []))
    loaded = load(Source("guess.yaml", SENT), seed=seed, overrides=overrides)
    problem = compile_meaning(loaded.meaning, lanes=lanes, compiled=False)
    who = identity(loaded, seed, n_runs)
    settings, origin = settings_of(loaded.meaning), origin_of(loaded)
    return Command(problem, settings, seed, n_runs, Folder(path), who, tuple(budgets), origin=origin)
