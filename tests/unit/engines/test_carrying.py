import itertools
import threading
from types import SimpleNamespace

import pytest

from bbsd.engines.carrying import carry_out
from bbsd.engines.engine import ATTEMPTS
from bbsd.engines.units import Result, Unit
from bbsd.stopping import StopRequest
from tests.unit.engines.engines import ThreadsEngine


class Counting:
    """A task of some units, each of which adds a letter."""

    def __init__(self, name, n_units, error=None):
        self.name, self.n_units, self.error = name, n_units, error
        self.so_far, self.written = "", []

    def unit(self):
        return Unit(self.name, "any:add", {}, {"so far": self.so_far.encode()})

    def take(self, result):
        self.so_far = result.files["so far"].decode()
        return len(self.so_far) == self.n_units

    def write(self):
        if self.error:
            raise self.error
        self.written.append(self.so_far)


@pytest.fixture(autouse=True)
def work(monkeypatch):
    module = SimpleNamespace(add=lambda unit: Result({"so far": unit.files["so far"] + b"x"}))
    monkeypatch.setattr("bbsd.engines.units.import_module", lambda _name: module)


@pytest.fixture
def request_():
    return StopRequest()


@pytest.mark.parametrize("count", [1, 2, 5])
def test_each_task_goes_on_from_what_its_last_unit_gave(count, request_):
    tasks = [Counting(str(n), n) for n in range(1, 5)]
    engine = ThreadsEngine(count)
    carried = carry_out(engine, iter(tasks), request_)
    assert carried == ([], {})
    assert [task.written[-1] for task in tasks] == ["x", "xx", "xxx", "xxxx"]
    assert len(engine.units) == 10
    assert not request_.is_made


def test_no_more_tasks_are_begun_than_there_are_workers(request_):
    begun = []

    def tasks():
        for number in range(4):
            begun.append(number)
            yield Counting(str(number), 2)

    engine = ThreadsEngine(2)
    seen = []
    engine.losing = lambda _unit: bool(seen.append(len(begun)))
    carry_out(engine, tasks(), request_)
    assert seen[:2] == [1, 2]
    assert max(seen[:4]) <= 3


def test_workers_that_come_later_are_waited_for(request_):
    engine = ThreadsEngine(0)
    timer = threading.Timer(0.2, lambda: setattr(engine, "count", 1))
    timer.start()
    task = Counting("late", 1)
    assert carry_out(engine, iter([task]), request_) == ([], {})
    timer.join()
    assert task.written == ["x"]


def test_a_unit_whose_worker_was_lost_is_done_again_and_others_do_not_notice(request_):
    lost = itertools.count()
    engine = ThreadsEngine(2, lambda unit: unit.name == "unlucky" and next(lost) in (1, 2, 3))
    tasks = [Counting("unlucky", 3), Counting("other", 3)]
    assert carry_out(engine, iter(tasks), request_) == ([], {})
    assert [task.written[-1] for task in tasks] == ["xxx", "xxx"]
    assert [unit.name for unit in engine.units].count("other") == 3


def test_a_unit_that_gets_further_in_between_may_lose_any_number_of_workers(request_):
    lost = itertools.count()
    engine = ThreadsEngine(1, lambda _unit: next(lost) % ATTEMPTS != 0)
    task = Counting("unlucky", 5)
    assert carry_out(engine, iter([task]), request_) == ([], {})
    assert task.written[-1] == "xxxxx"


def test_a_unit_that_loses_four_workers_is_given_up_and_the_others_are_done(request_):
    engine = ThreadsEngine(2, lambda unit: unit.name == "deadly" and unit.files["so far"] == b"x")
    tasks = [Counting("deadly", 3), *(Counting(str(n), 3) for n in range(3))]
    carried = carry_out(engine, iter(tasks), request_)
    assert carried == ([tasks[0]], {})
    assert tasks[0].written == ["x"]
    assert [task.written[-1] for task in tasks[1:]] == ["xxx"] * 3
    assert [unit.name for unit in engine.units].count("deadly") == 1 + ATTEMPTS


def test_after_an_error_nothing_new_is_begun_and_what_comes_back_is_written(request_):
    failing = Counting("failing", 2, OSError("disk full"))
    slow = Counting("slow", 50)
    carried = carry_out(ThreadsEngine(2), iter([failing, slow, Counting("never", 1)]), request_)
    assert request_.is_made
    assert [*carried.failed] == [failing]
    assert str(carried.failed[failing]) == "disk full"
    assert len(slow.so_far) < 50
    assert slow.written[-1] == slow.so_far


def test_nothing_is_written_behind_what_could_not_be_written(request_):
    class FailingOnce(Counting):
        def write(self):
            error, self.error = self.error, None
            if error:
                raise error
            super().write()

    task = FailingOnce("first", 5, error := OSError("the disk fails"))
    carried = carry_out(ThreadsEngine(1), iter([task]), request_)
    assert carried == ([], {task: error})
    assert task.written == []  # although the unit that was submitted before comes back


def test_a_stop_request_ends_all_and_gives_nobody_up(request_):
    engine = ThreadsEngine(1, lambda unit: request_.make() or True)
    assert carry_out(engine, iter([Counting("one", 3), Counting("two", 1)]), request_) == ([], {})
    assert len(engine.units) == 1
