from bbsd.runs.command import Command
from bbsd.runs.folder import Folder
from tests.unit.solver.problems import guess


def test_threads_are_those_of_the_problem(tmp_path):
    command = Command(*guess(lanes=5), seed=11, n_runs=2, folder=Folder(tmp_path))
    assert command.with_threads(3).problem.jobs == 3
    assert command.problem.jobs == 1
