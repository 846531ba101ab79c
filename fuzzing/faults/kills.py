"""Designs that are killed at random instants, with all their processes, and continued until they are complete."""

from __future__ import annotations

import random
import shutil
import time
from typing import TYPE_CHECKING

from fuzzing.faults.calls import AGAIN
from fuzzing.faults.commands import KILLED, METHODS, Running, command, design, difference, written

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

LONGER = {
    "paper": (*METHODS["paper"], "design.coevolution.generations=60", "design.coevolution.agents=40"),
    "search": ("design.budget=60000",),
}
OPTIONS = ("--runs", "4", "--jobs", "2")


def try_kills(spec: Path, folder: Path, count: int, seed: int) -> Iterator[tuple[str, str]]:
    """Yield each kill, and what went wrong after it, until there were so many; methods take turns."""
    dice, kills, design_number = random.Random(seed), 0, 0
    expected, seconds = {}, {}
    for method, settings in LONGER.items():
        began, whole = time.monotonic(), folder / f"whole-{method}"
        ended = command(*design(spec, whole, settings, *OPTIONS))
        seconds[method] = time.monotonic() - began
        if ended.code:
            yield f"{method}, not disturbed", str(ended)
            return
        expected[method] = written(whole)
        yield f"{method}: {seconds[method]:.1f} s where it is not disturbed", ""
    while kills < count:
        method, out = list(LONGER)[design_number % len(LONGER)], folder / "killed"
        shutil.rmtree(out, ignore_errors=True)
        design_number += 1
        resume: tuple[str, ...] = ()
        while True:
            running = Running(design(spec, out, LONGER[method], *OPTIONS, *resume))
            if kills < count:
                time.sleep(dice.uniform(0, seconds[method]))
                running.kill()
            ended = running.ended()
            if ended.code == KILLED:
                kills += 1
                yield f"{method}, kill {kills}", ""
            elif ended.code == 0:
                files = difference(written(out), expected[method])
                yield f"{method}, complete after {kills} kills in all", files and f"wrong are {files}"
                break
            elif not (ended.is_refusal and AGAIN in ended.err):
                yield f"{method}, after kill {kills}", str(ended)
                break
            resume = () if AGAIN in ended.err or not out.exists() else ("--resume",)
