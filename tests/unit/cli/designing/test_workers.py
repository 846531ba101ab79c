from contextlib import contextmanager

import pytest
import typer

from bbsd.cli.designing import workers
from bbsd.cli.designing.workers import EngineName, chosen_engine, require_engine


def test_a_scheduler_is_one_of_dask():
    require_engine(EngineName.DASK, "tcp://host:8786")
    require_engine(EngineName.PROCESSES, None)
    with pytest.raises(typer.BadParameter, match="for --engine dask"):
        require_engine(EngineName.PROCESSES, "tcp://host:8786")


def test_a_design_without_processes_needs_no_engine():
    with chosen_engine(EngineName.PROCESSES, None, jobs=4, processes=0) as engine:
        assert engine is None


@pytest.mark.parametrize(("count", "said"), [(0, "waiting for workers of tcp://a\\x1b:1\n"), (2, "")])
def test_that_a_cluster_has_no_workers_yet_is_told(monkeypatch, capsys, count, said):
    class Cluster:
        def capacity(self):
            return count

    @contextmanager
    def connected(scheduler, jobs):
        assert (scheduler, jobs) == ("tcp://a\x1b:1", 3)
        yield Cluster()

    monkeypatch.setattr("bbsd.engines.cluster.dask_engine", connected)
    with chosen_engine(EngineName.DASK, "tcp://a\x1b:1", jobs=3, processes=0) as engine:
        assert isinstance(engine, Cluster)
    assert capsys.readouterr().err == said


def test_what_workers_import_is_what_they_need():
    from bbsd.runs.workers.side_by_side import NEEDED

    assert workers.NEEDED == NEEDED
