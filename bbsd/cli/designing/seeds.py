"""`bbsd design --seeds`: a design for each of several seeds, with more jobs than one several at the same time.

Each is done as a whole by one process, which holds the lock of its folder. What it would have said is said here, in the
order of the seeds; so all that is written and printed is the same with any number of jobs.
"""

import pickle
import sys
from collections import deque
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Future, wait
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field, replace
from functools import partial
from io import StringIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bbsd.cli.designing.search_figures import Additions
from bbsd.cli.terminal.access import Stepping, import_text
from bbsd.cli.terminal.output import error_console, say
from bbsd.engines.engine import ATTEMPTS
from bbsd.errors import UsageError
from bbsd.runs.signals import interrupts_request_stop
from bbsd.runs.storage.finished import RUN_FILE
from bbsd.stopping import raise_if_stopped

if TYPE_CHECKING:
    from rich.console import Console

    from bbsd.api import Designed, Interrupted
    from bbsd.engines.engine import Engine
    from bbsd.engines.processes import Processes

IMPORTS = ("bbsd.api.making.designing", "bbsd.cli.designing.seeds", "bbsd.report.progress")
"""What each process imports while this one reads the spec."""
PATIENCE = 0.1
"""Seconds between two looks at whether a stop was requested."""


class SeedsLost(UsageError):
    """Designs that lost their process again and again."""

    advice = "continue with --resume; fewer --jobs need less memory"


@dataclass(frozen=True, slots=True)
class Order:
    """One design: all that a process has to know of it."""

    spec: Path
    seed: int
    overrides: tuple[str, ...]
    out: Path
    resume: bool
    """Whether a design that was begun in the folder is continued."""
    options: Mapping[str, Any]
    """Arguments of `bbsd.design` that all seeds share."""
    additions: Additions
    opening: Mapping[str, Any]
    """How an environment in Python is opened, but for who is told of it."""

    @property
    def goes_on(self) -> bool:
        """Whether there is something to continue."""
        return self.resume and (self.out / RUN_FILE).is_file()


@dataclass(slots=True)
class Answer:
    """What came of a design in another process."""

    designed: "Designed | None" = None
    error: Exception | None = None
    """Why there is no design."""
    notes: list[str] = field(default_factory=list)
    """What was said of its environment."""
    progress: str = ""
    """What a listener printed that is on no terminal."""


def order_of(
    spec: Path,
    seed: int,
    overrides: Sequence[str],
    out: Path,
    additions: Additions,
    options: Mapping[str, Any],
    *,
    resume: bool,
) -> Order:
    """Return the order of one design, in which is nothing that cannot go to another process."""
    opening = {key: value for key, value in additions.opening.items() if key not in ("announce", "note")}
    plain = replace(additions, opening=opening)
    return Order(spec, seed, tuple(overrides), out, resume, options, plain, opening)


def designs_of_seeds(
    orders: Sequence[Order],
    opening: Stepping,
    jobs: int,
    engine: "Engine | None",
    console: "Console",
    *,
    quiet: bool,
    overdue: "Callable[[Interrupted], object]",
    base: Path,
) -> "dict[int, Designed]":
    """Do designs, one after another or side by side, and return them by their seeds.

    Args:
        orders: the designs, in the order in which they are told.
        opening: how an environment in Python is opened in this process.
        jobs: how many processes there may be.
        engine: where their runs are done; none for this machine.
        console: where progress is shown.
        quiet: show no progress.
        overdue: called in another thread if it does not stop soon after an interrupt.
        base: the folder of all.

    Raises:
        Interrupted: it was interrupted; what was done is kept.
        SeedsLost: processes that did a design were killed, again and again; the others were completed.
        Exception: what a design raised; those before it are complete.
    """
    from bbsd.api import Interrupted
    from bbsd.report.progress import generation_listener

    if engine is None and min(jobs, len(orders)) > 1:
        try:
            return _side_by_side(orders, jobs, quiet=quiet, overdue=lambda: overdue(Interrupted(base)))
        except KeyboardInterrupt:
            raise Interrupted(base) from None
    found = {}
    for order in orders:
        with ExitStack() as showing:
            found[order.seed] = design_of(
                order,
                jobs=jobs,
                engine=engine,
                progress=showing.enter_context(generation_listener(console, quiet=quiet)),
                overdue=overdue,
                announce=opening["announce"],
                note=opening["note"],
            )
    return found


def design_of(order: Order, **more: Any) -> "Designed":  # noqa: ANN401 - further arguments of the verb
    """Do one design in this process."""
    from bbsd import api

    loaded = api.load(order.spec, seed=order.seed, set=order.overrides)
    return api.design(
        loaded,
        seed=order.seed,
        out=order.out,
        resume=order.goes_on,
        finish=partial(order.additions.add, seed=order.seed, part=order.out.name),
        **order.options,
        **order.opening,
        **more,
    )


def design_elsewhere(order: Order, jobs: int) -> Answer:
    """Do one design in a process that does nothing else, and return what came of it and what it had to say."""
    from rich.console import Console

    from bbsd.report.progress import generation_listener

    answer, printed = Answer(), StringIO()

    def announce(module: str, file: str) -> None:
        answer.notes.append(import_text(module, file))

    try:
        with generation_listener(Console(file=printed)) as listener:
            answer.designed = design_of(
                order, jobs=jobs, progress=listener, announce=announce, note=answer.notes.append
            )
    except Exception as error:  # noqa: BLE001 - it is raised where the design is wanted
        answer.error = _portable(error)
    answer.progress = printed.getvalue()
    return answer


def _portable(error: Exception) -> Exception:
    """Return an error that another process can read: itself, or what it says."""
    try:
        pickle.loads(pickle.dumps(error))  # noqa: S301 - written just now
    except Exception:  # noqa: BLE001 - whatever an error's own class makes of it
        told = UsageError(str(error))
        told.advice = getattr(error, "advice", "")
        return told
    return error


def _side_by_side(
    orders: Sequence[Order], jobs: int, *, quiet: bool, overdue: Callable[[], object]
) -> "dict[int, Designed]":
    """Do designs in as many processes as there are jobs, with threads in each where there are more jobs."""
    from bbsd.engines.processes import waiting_processes

    count = min(jobs, len(orders))
    with waiting_processes(count, IMPORTS) as processes, interrupts_request_stop(overdue):
        try:
            return _SideBySide(processes, orders, jobs // count, quiet=quiet).run()
        except BaseException:
            processes.stop()  # what they were doing can be continued
            raise


class _SideBySide:
    """Designs that are going on."""

    def __init__(self, processes: "Processes", orders: Sequence[Order], threads: int, *, quiet: bool) -> None:
        self._processes, self._orders, self._threads, self._quiet = processes, orders, threads, quiet
        self._waiting = deque(range(len(orders)))
        self._going_on: dict[Future[Answer], int] = {}
        self._losses = dict.fromkeys(range(len(orders)), 0)
        self._answers: dict[int, Answer | None] = {}
        """None for those that were given up."""
        self._told: set[str] = set()

    def run(self) -> "dict[int, Designed]":
        found, lost = dict[int, "Designed"](), list[int]()
        with self._display() as show:
            for number, order in enumerate(self._orders):
                while number not in self._answers:
                    self._go_on()
                    show()
                answer = self._answers[number]
                if answer is None:
                    lost.append(order.seed)
                    continue
                self._tell(answer)
                if answer.error is not None:
                    raise answer.error
                if answer.designed is not None:
                    found[order.seed] = answer.designed
        if lost:
            seeds = ", ".join(map(str, lost))
            raise SeedsLost(
                f"{ATTEMPTS} processes that did the design of seed {seeds} were killed, one after the other, maybe by "
                "the system for lack of memory; the other designs were completed"
            )
        return found

    def _go_on(self) -> None:
        """Begin what can be begun, and wait a moment for answers."""
        while self._waiting and len(self._going_on) < self._processes.count:
            number = self._waiting.popleft()
            order = self._orders[number]
            if self._losses[number]:
                order = replace(order, resume=True)
            self._going_on[self._processes.submit(design_elsewhere, order, self._threads)] = number
        done, _ = wait(self._going_on, PATIENCE, FIRST_COMPLETED)
        raise_if_stopped()
        for future in done:
            number = self._going_on.pop(future)
            try:
                self._answers[number] = future.result()
            except BrokenExecutor:
                self._losses[number] += 1
                if self._losses[number] == ATTEMPTS:
                    self._answers[number] = None
                else:
                    self._waiting.appendleft(number)

    def _tell(self, answer: Answer) -> None:
        """Print what a design would have said, its environment's notes once."""
        for note in answer.notes:
            if note not in self._told:
                self._told.add(note)
                say(note)
        if not self._quiet and not error_console().is_terminal:
            sys.stderr.write(answer.progress)

    @contextmanager
    def _display(self) -> "Iterator[Callable[[], None]]":
        """Yield what shows on a terminal how far it is."""
        console = error_console()
        if self._quiet or not console.is_terminal:
            yield lambda: None
            return
        with console.status("") as status:
            yield lambda: status.update(self._position())

    def _position(self) -> str:
        going_on = ", ".join(str(self._orders[number].seed) for number in sorted(self._going_on.values()))
        return f"{len(self._answers)} of {len(self._orders)} seeds designed; going on: {going_on}"
