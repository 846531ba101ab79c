import os
import signal
import threading

import pytest

from bbsd.runs import signals
from bbsd.runs.signals import interrupts_request_stop
from bbsd.stopping import StopRequest, current_stop_request, raise_if_stopped


def interrupt():
    os.kill(os.getpid(), signal.SIGINT)


def interrupt_and_heed(**options):
    with interrupts_request_stop(**options):
        raise_if_stopped()
        interrupt()
        raise_if_stopped()


def interrupt_twice():
    with interrupts_request_stop():
        interrupt()
        interrupt()
        pytest.fail("the second one raised nothing")


def test_an_interrupt_is_noted_and_heeded_later():
    before = signal.getsignal(signal.SIGINT)
    with pytest.raises(KeyboardInterrupt):
        interrupt_and_heed()
    raise_if_stopped()
    assert signal.getsignal(signal.SIGINT) is before


def test_a_second_interrupt_is_python_s_own():
    with pytest.raises(KeyboardInterrupt):
        interrupt_twice()


def test_who_ignores_interrupts_goes_on_doing_so():
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        with interrupts_request_stop():
            interrupt()
            raise_if_stopped()
    finally:
        signal.signal(signal.SIGINT, before)


def test_whoever_wants_to_know_is_told_without_the_main_thread():
    told = threading.Event()
    with interrupts_request_stop():
        current_stop_request().when_made(told.set)
        signal.pthread_sigmask(
            signal.SIG_BLOCK, []
        )  # any call; the handler has not run when the watcher is told
        interrupt()
        assert told.wait(10)


def test_what_is_not_heeded_in_time_is_overdue(monkeypatch):
    monkeypatch.setattr(signals, "GRACE", 0.01)
    overdue = threading.Event()
    with interrupts_request_stop(overdue.set):
        interrupt()
        assert overdue.wait(10)


def test_what_is_heeded_is_not_overdue():
    overdue = []
    with pytest.raises(KeyboardInterrupt):
        interrupt_and_heed(overdue=lambda: overdue.append(True))
    assert overdue == []


def test_outside_of_the_main_thread_wishes_are_those_of_a_design():
    found = []

    def other():
        with interrupts_request_stop():
            current_stop_request().make()
            found.append(current_stop_request().is_made)

    with interrupts_request_stop():
        thread = threading.Thread(target=other)
        thread.start()
        thread.join()
        raise_if_stopped()
    assert found == [True]


def test_a_request_calls_listeners_once_and_late_ones_at_once():
    told = []
    request = StopRequest()
    request.when_made(lambda: told.append("early"))
    request.make()
    request.make()
    request.when_made(lambda: told.append("late"))
    assert told == ["early", "late"]


def test_outside_of_a_context_there_is_no_stop_request():
    raise_if_stopped()
    with pytest.raises(RuntimeError, match="no stop request"):
        current_stop_request()
