from __future__ import annotations

import errno
import os
import sys
from io import BytesIO, StringIO, TextIOWrapper

import pytest

from bbsd.cli.terminal.streams import Steady, steady_streams


class Broken(StringIO):
    """A stream that fails from the n-th call on."""

    def __init__(self, good: int, error: Exception) -> None:
        super().__init__()
        self.good, self.error, self.calls = good, error, 0

    def write(self, text: str, /) -> int:
        self.calls += 1
        if self.calls > self.good:
            raise self.error
        return super().write(text)


FULL = OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))


@pytest.mark.parametrize("error", [FULL, BrokenPipeError(errno.EPIPE, "gone"), ValueError("closed file")])
def test_a_stream_that_fails_takes_everything_and_keeps_the_reason(error: Exception) -> None:
    broken = Broken(1, error)
    stream = Steady(broken)
    assert stream.write("one\n") == 4
    assert stream.failure is None
    for _ in range(3):
        assert stream.write("two\n") == 4
        stream.flush()
    assert isinstance(stream.failure, OSError)
    assert (broken.getvalue(), broken.calls) == ("one\n", 2)


def test_the_streams_are_put_back_whatever_happens() -> None:
    def work() -> None:
        with steady_streams() as output:
            assert sys.stdout is output
            raise RuntimeError

    before = sys.stdout, sys.stderr
    with pytest.raises(RuntimeError):
        work()
    assert (sys.stdout, sys.stderr) == before


def test_a_stream_that_was_closed_leads_to_nowhere(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stdout", None)
    monkeypatch.setattr(sys, "stderr", None)
    with steady_streams() as output:
        sys.stdout.write("a")
        sys.stderr.write("b")
        assert not sys.stdout.isatty()
        assert output.failure is None


def test_a_stream_writes_what_its_encoding_lacks_as_escapes(monkeypatch: pytest.MonkeyPatch) -> None:
    stream = TextIOWrapper(BytesIO(), encoding="ascii")
    monkeypatch.setattr(sys, "stdout", stream)
    with steady_streams() as output:
        assert output.encoding == "ascii"
        output.write("█")
    assert stream.buffer.getvalue() == b"\\u2588"  # type: ignore[attr-defined]
