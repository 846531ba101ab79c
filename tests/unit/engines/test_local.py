import pytest

from bbsd.engines.carrying import carry_out
from bbsd.engines.engine import ATTEMPTS, WorkerLost
from bbsd.engines.local import processes_engine
from bbsd.engines.units import OtherVersion, Unit
from bbsd.stopping import StopRequest
from tests.unit.engines.engines import WORK, Adding


@pytest.mark.slow
def test_processes_that_are_killed_twice_and_one_that_always_is(tmp_path):
    marks = {"marks": [str(tmp_path / "first"), str(tmp_path / "second")]}
    tasks = [Adding("a", marks), Adding("b", None), Adding("c", {"marks": []})]
    with processes_engine(2, []) as engine:
        carried = carry_out(engine, iter(tasks), StopRequest())
    assert carried == ([tasks[1]], {})
    assert [task.files for task in tasks] == [{"x": b"aaa"}, {}, {"x": b"ccc"}]


@pytest.mark.slow
def test_what_a_process_raises_and_its_loss_are_told_apart():
    with processes_engine(1, []) as engine:
        with pytest.raises(WorkerLost):
            engine.submit(Unit("deadly", WORK, {"deaths": None})).result()
        with pytest.raises(KeyError, match="deaths"):
            engine.submit(Unit("wrong", WORK, {})).result()
        with pytest.raises(OtherVersion):
            engine.submit(Unit("old", WORK, {}, version="bbsd 0.0.1, revision 1")).result()
    assert ATTEMPTS == 4
