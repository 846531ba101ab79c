import pytest

from bbsd.runs.outcome.interim import best_so_far
from tests.unit.runs.commands import command_of, search_of


def stopped(command):
    def stop(_line):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        command.complete(0, stop)
    return command


@pytest.mark.parametrize("make", [command_of, search_of])
def test_the_best_of_what_was_saved_is_raced(tmp_path, make):
    best = best_so_far(stopped(make(tmp_path)))
    assert best.episodes >= 20
    assert best.mean > -2.0
    assert sorted(best.architecture.structure.tolist()) == [0, 1, 2]


def test_nothing_is_the_best_where_nothing_was_saved(tmp_path):
    assert best_so_far(search_of(tmp_path)) is None
