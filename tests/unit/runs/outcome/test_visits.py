from dataclasses import replace

from bbsd.runs.command import Command
from bbsd.runs.outcome.visits import unvisited
from bbsd.runs.storage.folder import Folder
from bbsd.solver.paper.settings import settings_of
from tests.unit.problems import problem_of
from tests.unit.runs.commands import WHO, command_of
from tests.unit.solver.problems import GUESS


def test_cells_that_no_episode_reaches_are_counted(tmp_path):
    text = GUESS.format(structure="", sharing="uniform", search="sampled", culture="none")
    problem = problem_of(text.replace("values(at, 0, 3)", "values(at, 0, 5)"), lanes=5)
    settings = replace(settings_of(problem.meaning), method="random")
    command = Command(problem, settings, 11, 1, Folder(tmp_path), replace(WHO, runs=1), (5000,))
    command.complete(0)
    missed = {each.behavior: (each.cells, each.of) for each in unvisited(command)}
    assert missed == {"odd": (2, 6), "even": (2, 5)}


def test_the_paper_s_loop_is_not_asked(tmp_path):
    assert unvisited(command_of(tmp_path)) == ()
