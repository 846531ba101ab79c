"""Two commands that write in one folder at the same time, and holders of a folder that are killed."""

from __future__ import annotations

import platform
import re
import shutil
import time
from typing import TYPE_CHECKING

from fuzzing.faults.commands import Running, command, design, difference, written
from fuzzing.faults.kills import LONGER

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from fuzzing.faults.commands import Ended

SETTINGS = LONGER["search"]
NAMED = re.compile(r"is being written by process (\d+) on (\S+), since 2")
NOT_EMPTY = "is not empty; nothing is overwritten"
BEGUN = 20.0
"""Seconds within which a design must have written its first state."""


def try_races(spec: Path, folder: Path, count: int) -> Iterator[tuple[str, str]]:
    """Yield each race of two resumed and of two fresh designs, and of a holder that is killed, and what went wrong."""
    whole = folder / "whole"
    ended = command(*design(spec, whole, SETTINGS))
    yield "not disturbed", "" if ended.code == 0 else str(ended)
    expected = written(whole)
    for number in range(1, count + 1):
        for more in ((), ("--resume",)):
            out = folder / "raced"
            shutil.rmtree(out, ignore_errors=True)
            killed = ""
            if more:
                killed = _killed_holder(spec, out)
            words = design(spec, out, SETTINGS, *more)
            both = [Running(words), Running(words)]
            pids = [running.pid for running in both]
            wrong = killed or _wrong([running.ended() for running in both], pids, is_fresh=not more)
            files = difference(written(out), expected)
            yield (
                f"race {number} of two {'resumed' if more else 'fresh'} designs",
                wrong or (files and f"wrong are {files}"),
            )


def _killed_holder(spec: Path, out: Path) -> str:
    """Kill a design that holds its folder; return what a second one is told wrongly before."""
    holder = Running(design(spec, out, SETTINGS))
    end = time.monotonic() + BEGUN
    while not (out / "run-1" / "checkpoint.npz").exists() and time.monotonic() < end:
        time.sleep(0.005)
    second = command(*design(spec, out, SETTINGS, "--resume"))
    holder.kill()
    holder.ended()
    named = NAMED.search(second.err)
    if named is None or int(named[1]) != holder.pid or named[2] != platform.node():
        return f"while process {holder.pid} writes: {second}"
    return ""


def _wrong(ended: list[Ended], pids: list[int], *, is_fresh: bool) -> str:
    """Return what is wrong about how two writers ended: one is complete, the other names it or comes too late."""
    codes = sorted(each.code for each in ended)
    if codes == [0, 0] and not is_fresh:
        return "they did not meet: the second came when the first had ended"
    if codes != [0, 2]:
        return "; ".join(map(str, ended))
    winner = pids[[each.code for each in ended].index(0)]
    loser = next(each for each in ended if each.code)
    named = NAMED.search(loser.err)
    if named is not None and (int(named[1]), named[2]) == (winner, platform.node()):
        return ""
    if is_fresh and NOT_EMPTY in loser.err:
        return ""
    return f"{winner} is not named: {loser}"
