import os
import signal
import threading

import pytest

from bbsd.solver import interruption
from bbsd.solver.interruption import Wish, heed, interrupts_noted, present_wish


def interrupt():
    os.kill(os.getpid(), signal.SIGINT)


def interrupt_and_heed(**options):
    with interrupts_noted(**options):
        heed()
        interrupt()
        heed()


def interrupt_twice():
    with interrupts_noted():
        interrupt()
        interrupt()
        pytest.fail("the second one raised nothing")


def test_an_interrupt_is_noted_and_heeded_later():
    before = signal.getsignal(signal.SIGINT)
    with pytest.raises(KeyboardInterrupt):
        interrupt_and_heed()
    heed()
    assert signal.getsignal(signal.SIGINT) is before


def test_a_second_interrupt_is_python_s_own():
    with pytest.raises(KeyboardInterrupt):
        interrupt_twice()


def test_who_ignores_interrupts_goes_on_doing_so():
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        with interrupts_noted():
            interrupt()
            heed()
    finally:
        signal.signal(signal.SIGINT, before)


def test_whoever_wants_to_know_is_told_without_the_main_thread():
    told = threading.Event()
    with interrupts_noted():
        present_wish().when_made(told.set)
        signal.pthread_sigmask(
            signal.SIG_BLOCK, []
        )  # any call; the handler has not run when the watcher is told
        interrupt()
        assert told.wait(10)


def test_what_is_not_heeded_in_time_is_overdue(monkeypatch):
    monkeypatch.setattr(interruption, "GRACE", 0.01)
    overdue = threading.Event()
    with interrupts_noted(overdue.set):
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
        with interrupts_noted():
            present_wish().make()
            found.append(present_wish().is_made)

    with interrupts_noted():
        thread = threading.Thread(target=other)
        thread.start()
        thread.join()
        heed()
    assert found == [True]


def test_a_wish_is_told_of_once_and_to_late_comers_at_once():
    told = []
    wish = Wish()
    wish.when_made(lambda: told.append("early"))
    wish.make()
    wish.make()
    wish.when_made(lambda: told.append("late"))
    assert told == ["early", "late"]


def test_where_nobody_notes_interrupts_there_is_no_wish():
    heed()
    with pytest.raises(RuntimeError, match="nobody notes"):
        present_wish()
