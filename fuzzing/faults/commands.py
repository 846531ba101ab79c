"""Commands of bbsd as a shell sees them, in processes forked from this one, which has imported everything already."""

from __future__ import annotations

import gc
import os
import signal
import sys
import tempfile
import threading
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from types import ModuleType

SPEC = """bbsd: 1
name: guess
environment:
  steps: 2
  state: {at: "integers(0, 3)", said: 0}
  sensors: {seen: "values(at, 0, 3)"}
behaviors:
  odd: {inputs: [seen], actions: {one: {said: 1}, three: {said: 3}}}
  even: {inputs: [seen], actions: {none: {said: 0}, two: {said: 2}}}
reward: {right: 1 if said == at else 0}
design:
  record: 1
  answer: {candidates: 5, episodes: 100, judged: 100}
"""
PAPER = (
    "design.method=paper", "design.coevolution.generations=5", "design.coevolution.population=4",
    "design.coevolution.agents=8", "design.learning.episodes=3", "design.learning.last=3",
)  # fmt: skip
SEARCH = ("design.budget=5000",)
METHODS = {"paper": PAPER, "search": SEARCH}
KILLED = -signal.SIGKILL
NEWEST, PREVIOUS = "checkpoint.npz", "checkpoint.previous.npz"
PASSING = ("lock", PREVIOUS)
"""Files that say nothing of a design: who wrote it last, and the state before the last one."""


@dataclass(frozen=True, slots=True)
class Ended:
    """How a command ended: its exit code, negative for a signal, and what it said."""

    code: int
    out: str
    err: str

    @property
    def is_refusal(self) -> bool:
        """Whether it was a mistake that was told in words."""
        return self.code == 2 and bool(self.err) and "Traceback" not in self.err

    def __str__(self) -> str:
        return f"exit code {self.code}: {self.err.strip()[-600:]}"


class Running:
    """A command that goes on in a process of its own."""

    def __init__(self, words: Sequence[str | Path], before: Callable[[], object] = lambda: None) -> None:
        """Start a command; `before` is called in its process first."""
        self._out, self._err = tempfile.TemporaryFile(), tempfile.TemporaryFile()  # noqa: SIM115 - closed by ended
        sys.stdout.flush()
        self.pid = os.fork()
        if self.pid == 0:
            code = 1
            try:
                os.setpgid(0, 0)
                os.dup2(self._out.fileno(), 1)
                os.dup2(self._err.fileno(), 2)
                code = _main([str(word) for word in words], before)
            finally:
                os._exit(code)

    def kill(self) -> None:
        """End the process, and all that it started, as the system does for lack of memory."""
        with suppress(ProcessLookupError, PermissionError):
            os.killpg(self.pid, signal.SIGKILL)
        with suppress(ProcessLookupError):
            os.kill(self.pid, signal.SIGKILL)

    def is_over(self) -> bool:
        """Return whether the process has ended."""
        return os.waitid(os.P_PID, self.pid, os.WEXITED | os.WNOHANG | os.WNOWAIT) is not None

    def ended(self) -> Ended:
        """Wait for the end."""
        _, status = os.waitpid(self.pid, 0)
        texts = []
        for file in (self._out, self._err):
            file.seek(0)
            texts.append(file.read().decode(errors="replace"))
            file.close()
        return Ended(os.waitstatus_to_exitcode(status), *texts)


def _main(words: list[str], before: Callable[[], object]) -> int:
    """Run the command in this process; return its exit code."""
    import traceback

    from bbsd.cli import main

    sys.argv = ["bbsd", *words]
    try:
        before()
        main()
    except SystemExit as left:
        code = left.code
        sys.stdout.flush()
        sys.stderr.flush()
        return code if isinstance(code, int) else 0 if code is None else 1
    except BaseException:  # noqa: BLE001 - as the interpreter shows it
        traceback.print_exc()
        sys.stderr.flush()
        return 1
    return 0


def command(*words: str | Path, before: Callable[[], object] = lambda: None) -> Ended:
    """Run a command to its end."""
    return Running(words, before).ended()


def design(spec: Path, out: Path, settings: Sequence[str], *more: str) -> list[str | Path]:
    """Return the words of a small design with two runs; later words count more."""
    sets = [word for setting in settings for word in ("--set", setting)]
    return ["design", spec, "--seed", "1", "--runs", "2", "--out", out, "-q", *sets, *more]


def written(out: Path) -> dict[str, bytes]:
    """Return the files of a design and their bytes, without those that say nothing of it."""
    files = (path for path in sorted(out.rglob("*")) if path.is_file() and path.name not in PASSING)
    contents = {str(path.relative_to(out)): path.read_bytes() for path in files}
    for path in out.rglob(PREVIOUS):  # it is as good as the newest, where that could not be written again
        contents.setdefault(str(path.with_name(NEWEST).relative_to(out)), path.read_bytes())
    return contents


def difference(there: dict[str, bytes], expected: dict[str, bytes]) -> str:
    """Return which files are not as they should be, empty where all are."""
    return ", ".join(name for name in sorted({*there, *expected}) if there.get(name) != expected.get(name))


def prepare(folder: Path) -> Path:
    """Write the spec into a folder; import what designs need, and load their kernels, for all that is forked from here.

    Returns the spec's file.

    Raises:
        RuntimeError: this process has several threads, of which a fork would keep only one.
    """
    import bbsd.api
    import bbsd.cli.designing.design
    import bbsd.report.progress
    import bbsd.report.tables
    import bbsd.runs.workers.side_by_side

    spec = folder / "guess.yaml"
    spec.write_text(SPEC, encoding="utf-8")
    for method, settings in METHODS.items():
        bbsd.api.design(spec, seed=1, runs=2, out=folder / f"first-{method}", set=settings)
    if (threads := _threads()) != 1:
        raise RuntimeError(f"{threads} threads are running; set OPENBLAS_NUM_THREADS=1")
    gc.collect()
    gc.freeze()  # a collection in a child would copy all pages
    return spec


def put_in_place(home: ModuleType, name: str, value: object) -> None:
    """Give a name of a module another value, there and in each module of bbsd that has imported it by this name."""
    before = vars(home)[name]
    for module in list(sys.modules.values()):
        if module.__name__.startswith("bbsd.") and vars(module).get(name) is before:
            vars(module)[name] = value


def _threads() -> int:
    """Return the number of this process's threads, those of libraries included where the system tells."""
    tasks = Path("/proc/self/task")
    return len(list(tasks.iterdir())) if tasks.is_dir() else threading.active_count()
