import pytest

from bbsd.runs.workers.answers import complete_runs
from tests.unit.runs.commands import command_of


@pytest.fixture
def command(tmp_path):
    return command_of(tmp_path)


def plain(architectures):
    return [([*map(list, each.tables)], each.structure.tolist()) for each in architectures]


def test_every_run_is_completed_and_reported_in_its_order(command):
    told = []
    found = complete_runs(command, 1, told.append)
    assert len(found) == 2
    assert [(line["run"], line["generation"]) for line in told] == [
        (r, g) for r in (1, 2) for g in (1, 2, 3, 4)
    ]
    assert plain([command.answer(0), command.answer(1)]) == plain(found)


def test_a_generation_is_saved_before_it_is_reported(command):
    def tell(line):
        assert command.records(line["run"] - 1).lines()[-1] == line

    complete_runs(command, 1, tell)


def test_what_is_done_is_not_done_again(command):
    first, told = command.complete(1), []
    found = complete_runs(command, 1, told.append)
    assert {line["run"] for line in told} == {1}
    assert plain(found[1:]) == plain([first])


def test_a_run_that_was_stopped_is_resumed(command):
    def stop(line):
        if line["generation"] == 3:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        complete_runs(command, 1, stop)
    assert command.answer(0) is None
    told = []
    complete_runs(command, 1, told.append)
    assert (told[0]["run"], told[0]["generation"]) == (1, 4)
