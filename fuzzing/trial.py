"""One spec, checked and formatted, and the rules that this must keep.

Nothing but diagnoses may come out of `bbsd check`, in all its formats, and of `bbsd fmt`: no traceback, no check of
more than two seconds of the processor, no more memory than 500 MB, no file read or written but the spec.
"""

from __future__ import annotations

import faulthandler
import os
import resource
import signal
import time
import traceback
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from bbsd.errors import SpecError, render_json, render_text
from bbsd.language.loading import load
from bbsd.report.spec.github import github_text
from bbsd.report.spec.sarif import sarif_log
from bbsd.text import Source, read
from bbsd.text.writing.house_style import in_house_style

if TYPE_CHECKING:
    from pathlib import Path

MOST_SECONDS = 2.0
MOST_MEGABYTES = 500
DEPTHS = (0, 7, 23, 61)
"""A check that took too long is timed again within so many more calls, and the least time counts.

Python 3.11 takes memory for its calls in pieces. A check that goes back and forth over the end of a piece is up to
eight times as slow, and where that end is depends on the calls around it. On a shared machine a neighbor can have the
same effect.
"""
HANGS = 120
"""Seconds of the processor after which a check that does not return is reported with its stack, and ends all."""
WRITES = os.O_WRONLY | os.O_RDWR | os.O_CREAT | os.O_TRUNC | os.O_APPEND
FORBIDDEN = {
    "ctypes.dlopen",
    "os.chmod",
    "os.exec",
    "os.fork",
    "os.link",
    "os.mkdir",
    "os.posix_spawn",
    "os.remove",
    "os.rename",
    "os.rmdir",
    "os.symlink",
    "os.system",
    "os.truncate",
    "socket.connect",
    "subprocess.Popen",
}
"""Python's audit events of what a check must not do."""


@dataclass
class Watch:
    """An audit hook that records forbidden events while it is on: files opened or changed, programs started."""

    spec: str = ""
    on: bool = False
    events: list[str] = field(default_factory=list)

    def __call__(self, event: str, arguments: tuple[object, ...]) -> None:
        """Record an event if it is forbidden."""
        if not self.on:
            return
        if event == "open":
            path, _, flags = arguments
            wrote = isinstance(flags, int) and flags & WRITES
            if wrote or not (str(path) == self.spec or str(path).endswith((".py", ".pyc", ".so"))):
                self.events.append(f"{'wrote' if wrote else 'read'} {path!r}")
        elif event in FORBIDDEN:
            self.events.append(f"{event} {arguments!r}")


def trial(path: Path, watch: Watch) -> tuple[str, float]:
    """Check and format a spec; return the rule that was broken, empty if none was, and the seconds of the check."""
    watch.spec, watch.events = str(path), []
    seconds, broken = 0.0, ""
    faulthandler.register(signal.SIGPROF, chain=True)  # shows the stack, then the signal ends the process
    signal.setitimer(signal.ITIMER_PROF, HANGS)
    watch.on = True
    try:
        seconds = check_seconds(path)
        if seconds > MOST_SECONDS:
            seconds = min(check_seconds(path, depth) for depth in DEPTHS)
        style(path)
    except BaseException:  # noqa: BLE001 - no exception whatever may come out
        broken = traceback.format_exc()
    watch.on = False
    signal.setitimer(signal.ITIMER_PROF, 0)
    if not broken and seconds > MOST_SECONDS:
        broken = f"the check took {seconds:.1f} s of the processor"
    if not broken and peak_megabytes() > MOST_MEGABYTES:
        broken = f"{peak_megabytes():.0f} MB of memory"
    return broken or "\n".join(watch.events), seconds


def check(path: Path) -> None:
    """Do what `bbsd check` does, in every format."""
    try:
        loaded = load(Source.read(path))
        error = loaded.lineage.error(loaded.warnings)
    except SpecError as found:
        error = found
    for diagnosis in error.diagnoses:
        render_text(diagnosis, error.line(diagnosis.place))
    github_text(error.diagnoses)
    render_json(error.diagnoses)
    sarif_log(error.diagnoses)


def check_seconds(path: Path, depth: int = 0) -> float:
    """Return the processor's time of a check that is made within so many more calls."""
    if depth:
        return check_seconds(path, depth - 1)
    began = time.process_time()
    check(path)
    return time.process_time() - began


def style(path: Path) -> None:
    """Do what `bbsd fmt` does, without writing the file."""
    try:
        document = read(Source.read(path))
    except SpecError:
        return
    if not document.diagnoses:
        in_house_style(document)


def peak_megabytes() -> float:
    """Return the peak of this process's memory."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
