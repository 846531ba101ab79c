from tests.unit.runs.commands import command_of


def test_threads_are_those_of_the_problem(tmp_path):
    command = command_of(tmp_path)
    assert command.with_threads(3).problem.jobs == 3
    assert command.problem.jobs == 1
