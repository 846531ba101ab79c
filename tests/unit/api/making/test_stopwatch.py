"""How long designing and compiling take."""

import time

from bbsd.api.making import stopwatch


def test_what_is_compiled_since_it_was_made_is_no_time_of_the_design(monkeypatch):
    now, compiled = 100.0, 7.0
    monkeypatch.setattr(time, "monotonic", lambda: now)
    monkeypatch.setattr(stopwatch, "seconds_compiling", lambda: compiled)
    watch = stopwatch.Stopwatch(now, compiled)
    now, compiled = 116.0, 21.0
    assert watch.read() == (2.0, 14.0)
