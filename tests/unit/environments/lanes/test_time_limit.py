import signal
import threading
import time

import pytest

from bbsd.environments.lanes.time_limit import CallTooLongError, CallWatch


def forever():
    while True:
        pass


def test_a_call_that_takes_too_long_is_ended():
    began = time.monotonic()
    with pytest.raises(CallTooLongError), CallWatch(0.2):
        forever()
    assert 0.15 < time.monotonic() - began < 5


def test_one_that_sleeps_is_ended_too():
    with pytest.raises(CallTooLongError), CallWatch(0.2):
        time.sleep(60)


def test_many_short_calls_are_no_long_one():
    watch = CallWatch(0.2)
    with watch:
        began = time.monotonic()
        while time.monotonic() - began < 0.6:
            watch.calls += 1
            time.sleep(0.01)


def test_it_swallows_nothing_and_leaves_no_timer():
    before = signal.getsignal(signal.SIGALRM)
    with pytest.raises(ZeroDivisionError), CallWatch(0.2):
        raise ZeroDivisionError
    assert signal.getsignal(signal.SIGALRM) is before
    assert signal.getitimer(signal.ITIMER_REAL) == (0.0, 0.0)


def test_in_other_threads_it_ends_what_runs_python_code():
    ended = []

    def work():
        try:
            with CallWatch(0.2):
                forever()
        except CallTooLongError:
            ended.append(True)

    thread = threading.Thread(target=work, daemon=True)
    thread.start()
    thread.join(20)
    assert ended == [True]


def test_a_watch_can_be_used_again():
    watch = CallWatch(0.2)
    for _ in range(2):
        with pytest.raises(CallTooLongError), watch:
            forever()
        with watch:
            pass
