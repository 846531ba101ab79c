"""Damaged and burdensome specs, for as long as wanted: `python -m fuzzing.fuzz --seconds 3600`.

Every shipped and every test spec is damaged at random, in its text, its data and its expressions, and specs are made
up that are as large, deep or involved as 1 MB allows. Nothing but diagnoses may come out of `bbsd check`, in all its
formats, and of `bbsd fmt`: no traceback, no check of more than two seconds of the processor, no more memory than
500 MB, no file written or read but the spec. Exits with 1 and keeps the spec that broke a rule.
"""

from __future__ import annotations

import argparse
import faulthandler
import gc
import os
import random
import resource
import sys
import tempfile
import time
import traceback
from dataclasses import dataclass, field
from multiprocessing import Pipe, Process
from pathlib import Path
from typing import TYPE_CHECKING

from bbsd.cli.app import SELDOM
from bbsd.errors import SpecError, render_json, render_text
from bbsd.language.loading import load
from bbsd.report.github import github_text
from bbsd.report.sarif import sarif_log
from bbsd.text import Source, read
from bbsd.text.writing.house_style import in_house_style
from fuzzing.damage import damaged
from fuzzing.heavy_specs import burden

if TYPE_CHECKING:
    from multiprocessing.connection import Connection

ROOT = Path(__file__).parents[1]
SPECS = (*ROOT.glob("specs/*.yaml"), *ROOT.glob("tests/specs/*/*.yaml"), *ROOT.glob("tests/planted/*.yaml"))
SLOW = 2.0
MEGABYTES = 500
DEPTHS = (0, 7, 23, 61)
"""A check that took too long is measured again within so many more calls, and the least counts.

Python 3.11 takes memory for its calls in pieces: one that goes back and forth over a piece's end is up to eight times
as slow, and where that is depends on the calls around it. On a shared machine a neighbor can have the same effect.
"""
HANGS = 120
"""Seconds after which a check that does not come back is told of with its stack."""
WRITES = os.O_WRONLY | os.O_RDWR | os.O_CREAT | os.O_TRUNC | os.O_APPEND
FORBIDDEN = (
    "os.system",
    "os.exec",
    "os.posix_spawn",
    "os.fork",
    "subprocess.Popen",
    "socket.connect",
    "ctypes.dlopen",
)
CHANGES = (
    "os.mkdir",
    "os.remove",
    "os.rename",
    "os.rmdir",
    "os.link",
    "os.symlink",
    "os.truncate",
    "os.chmod",
)


@dataclass
class Watch:
    """Notes what a check does beside thinking: files opened or changed, programs started."""

    spec: str = ""
    on: bool = False
    seen: list[str] = field(default_factory=list)

    def __call__(self, event: str, arguments: tuple[object, ...]) -> None:
        """Note an audit event of Python's."""
        if not self.on:
            return
        if event == "open":
            path, _, flags = arguments
            wrote = isinstance(flags, int) and flags & WRITES
            if wrote or not (str(path) == self.spec or str(path).endswith((".py", ".pyc", ".so"))):
                self.seen.append(f"{'wrote' if wrote else 'read'} {path!r}")
        elif event in FORBIDDEN or event in CHANGES:
            self.seen.append(f"{event} {arguments!r}")


def checked(path: Path) -> None:
    """Do what `bbsd check` does, in every format."""
    try:
        load(Source.read(path))
    except SpecError as error:
        for each in error.diagnoses:
            render_text(each, error.line(each.place))
        github_text(error.diagnoses)
        render_json(error.diagnoses)
        sarif_log(error.diagnoses)


def seconds(path: Path) -> float:
    """The processor's time of a check."""
    began = time.process_time()
    checked(path)
    return time.process_time() - began


def seconds_deeper(path: Path, depth: int) -> float:
    """The same, measured from within so many calls more."""
    return seconds_deeper(path, depth - 1) if depth else seconds(path)


def styled(path: Path) -> None:
    """Do what `bbsd fmt` does but for writing."""
    try:
        document = read(Source.read(path))
    except SpecError:
        return
    if not document.diagnoses:
        in_house_style(document)


def broken_by(path: Path, watch: Watch) -> tuple[str, float]:
    """What is wrong with how a spec was taken, nothing if all was as it should be; and the seconds of its check."""
    watch.spec, watch.seen = str(path), []
    taken, wrong = 0.0, ""
    faulthandler.dump_traceback_later(HANGS, exit=True)
    watch.on = True
    try:
        taken = seconds(path)
        if taken > SLOW:
            taken = min(seconds_deeper(path, depth) for depth in DEPTHS)
        styled(path)
    except BaseException:  # noqa: BLE001 - whatever it is, it is what is looked for
        wrong = traceback.format_exc()
    watch.on = False
    faulthandler.cancel_dump_traceback_later()
    wrong = wrong or (f"the check took {taken:.1f} s of the processor" if taken > SLOW else "")
    wrong = wrong or (f"{peak_megabytes():.0f} MB of memory" if peak_megabytes() > MEGABYTES else "")
    return wrong or "\n".join(watch.seen), taken


def peak_megabytes() -> float:
    """The most memory that this process had at any time."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


class Maker:
    """Makes specs, one after the other, in a process of its own, so that its memory is not the check's."""

    def __init__(self, seed: int) -> None:
        self.dice = random.Random(seed)
        self.specs = [path.read_text(encoding="utf-8", errors="replace") for path in sorted(SPECS)]

    def made(self) -> bytes:
        """A spec as bytes, now and then not of UTF-8."""
        dice = self.dice
        text = burden(dice) if dice.random() < 0.1 else damaged(dice.choice(self.specs), dice)
        if dice.random() < 0.02:
            return text.encode(dice.choice(("utf-16", "latin-1", "utf-8-sig")), errors="replace")
        return text.encode("utf-8", errors="surrogatepass")


def make(seed: int, pipe: Connection) -> None:
    """Send a spec whenever one is asked for."""
    maker = Maker(seed)
    while pipe.recv():
        pipe.send(maker.made())


def main() -> int:
    """Make specs until the time is over or one of them breaks a rule."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=60)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    sys.dont_write_bytecode = True
    gc.set_threshold(SELDOM)  # as the command does
    pipe, other = Pipe()
    Process(target=make, args=(options.seed, other), daemon=True).start()
    watch = Watch()
    sys.addaudithook(watch)
    folder = Path(tempfile.mkdtemp(prefix="bbsd-fuzz-"))
    path = folder / "fuzzed.yaml"
    began, tried, slowest = time.monotonic(), 0, 0.0
    while time.monotonic() - began < options.seconds:
        pipe.send(True)
        path.write_bytes(pipe.recv())
        tried += 1
        wrong, taken = broken_by(path, watch)
        slowest = max(slowest, taken)
        if wrong:
            print(f"after {tried} specs of seed {options.seed}: {path}\n{wrong}")
            return 1
    path.unlink()
    folder.rmdir()
    print(
        f"{tried} specs in {time.monotonic() - began:.0f} s with seed {options.seed}: nothing but diagnoses, at most "
        f"{slowest:.2f} s of the processor each, {peak_megabytes():.0f} MB in all, no file touched but the spec"
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
