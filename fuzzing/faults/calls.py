"""A fault at every call of a whole design that changes a file, and what its user makes of it."""

from __future__ import annotations

import json
import shutil
from collections import Counter
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

from fuzzing.faults.commands import KILLED, METHODS, command, design, difference, put_in_place, written
from fuzzing.faults.system import FAULTS, System
from fuzzing.faults.worker import ForkedWorker

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence
    from pathlib import Path

    from fuzzing.faults.commands import Ended
    from fuzzing.faults.system import Fault

INTERVALS = (0.0, 1e9)
"""Seconds between two checkpoints: each step's state is saved, or only the first and the last."""
AGAIN = "without --resume"


class Case(NamedTuple):
    """A design that is disturbed."""

    method: str
    interval: float = 0.0
    jobs: int = 1
    further: bool = False
    """Disturb a further budget of a design that is there."""

    def __str__(self) -> str:
        states = "each state" if self.interval == 0.0 else "the first state"
        return (
            f"{self.method}, {self.jobs} jobs, {states} saved{', a further budget' if self.further else ''}"
        )


CASES = (
    *(Case(method, interval) for method in METHODS for interval in INTERVALS),
    *(Case(method, interval, jobs=2) for method in METHODS for interval in INTERVALS),
    Case("search", further=True),
)


class Trial:
    """Disturbs the designs of a case in a folder."""

    def __init__(self, case: Case, spec: Path, folder: Path) -> None:
        """Make the design that nothing disturbs."""
        self.case, self._spec, self._folder = case, spec, folder
        self._before = folder / "before"
        self._words: Callable[..., list[str | Path]] = partial(self._command, spec)
        log = folder / "calls"
        whole = folder / "whole"
        if case.further:
            _require(self._design(self._before))
            shutil.copytree(self._before, whole)
        _require(self._disturbed(whole, "none", 0, log))
        self.expected = written(whole)
        self.outcomes: dict[Fault, Counter[str]] = {fault: Counter() for fault in FAULTS}
        """How often what followed."""
        self.calls = log.read_text(encoding="utf-8").splitlines()
        self._begun = 0 if case.further else _begun(self.calls)

    @staticmethod
    def _command(spec: Path, out: Path, case: Case, *more: str) -> list[str | Path]:
        return design(spec, out, METHODS[case.method], "--jobs", str(case.jobs), *more)

    def _design(self, out: Path, *more: str, system: System | None = None) -> Ended:
        return command(*self._words(out, self.case, *more), before=lambda: self._begin(system))

    def _disturbed(self, out: Path, fault: Fault, number: int, log: Path | None = None) -> Ended:
        system = System(out, fault, number, log)
        more = ("--more", "5000") if self.case.further else ()
        return self._design(out, *more, system=system)

    def _begin(self, system: System | None) -> None:
        """Prepare a process of a command: its worker, then what disturbs it and not the worker."""
        from bbsd.runs.storage import records

        if self.case.jobs > 1:
            ForkedWorker().install()
        if system is None:
            return
        put_in_place(records, "INTERVAL", self.case.interval)
        system.install()

    def broken(self, fault: Fault, number: int) -> str:
        """Return what went wrong after a fault at the call of a number, empty where nothing did."""
        out = self._folder / "out"
        if out.exists():
            shutil.rmtree(out)
        if self.case.further:
            shutil.copytree(self._before, out)
        first = self._disturbed(out, fault, number)
        outcome, told = self._outcome(fault, first, out)
        if not told:
            resumed, told = self._continued(out, is_begun=number > self._begun)
            outcome = f"{outcome}, {resumed}"
        self.outcomes[fault]["wrong" if told else outcome] += 1
        return told

    def _outcome(self, fault: Fault, first: Ended, out: Path) -> tuple[str, str]:
        """Return what a fault did to a command, and what was wrong with that."""
        if first.code == 0:
            files = self._wrong(out)
            return "complete", files and f"exit code 0, and wrong are {files}"
        if fault in ("kill", "power", "names"):
            return "killed", "" if first.code == KILLED else f"not killed but {first}"
        is_told = first.is_refusal and str(out) in first.err
        return "refused", "" if is_told else f"the fault is not told: {first}"

    def _continued(self, out: Path, *, is_begun: bool) -> tuple[str, str]:
        """Return how a user continued, and what went wrong when he did."""
        how, ended = "resumed", self._design(out, "--resume")
        if ended.is_refusal and AGAIN in ended.err:
            if is_begun:
                return how, f"what was begun is lost: {ended}"
            how, ended = "begun again as was said", self._design(out)
        if ended.code == 0 and self.case.further and len(_budgets(out)) == 1:
            ended = self._design(out, "--more", "5000")
        if ended.code:
            return how, f"it does not go on: {ended}"
        files = self._wrong(out)
        return how, files and f"continued with exit code 0, and wrong are {files}"

    def _wrong(self, out: Path) -> str:
        return difference(written(out), self.expected)


def _begun(calls: list[str]) -> int:
    """Return the number of the call with which the beginning of a design has reached the disk."""
    named = next(index for index, call in enumerate(calls) if call.startswith("replace .run.json."))
    return next(index for index, call in enumerate(calls) if index > named and call.startswith("fsync ")) + 1


def _budgets(out: Path) -> list[int]:
    content = json.loads((out / "run.json").read_text(encoding="utf-8"))
    return list(content["budgets"])


def _require(ended: Ended) -> None:
    if ended.code:
        raise RuntimeError(f"the design that nothing disturbs: {ended}")


def try_calls(
    spec: Path,
    folder: Path,
    step: int = 1,
    cases: tuple[Case, ...] = CASES,
    faults: Sequence[Fault] = FAULTS,
) -> Iterator[tuple[str, str]]:
    """Yield what was tried, and what went wrong in it, for every step-th call of each case and fault."""
    for index, case in enumerate(cases):
        place = folder / f"case-{index}"
        place.mkdir()
        trial = Trial(case, spec, place)
        kinds = Counter(call.partition(" ")[0] for call in trial.calls)
        yield (
            f"{case}: {len(trial.calls)} calls ({', '.join(f'{n} {k}' for k, n in sorted(kinds.items()))})",
            "",
        )
        for offset, fault in enumerate(faults):
            for number in range(1 + (offset + index) % step, len(trial.calls) + 1, step):
                name = f"{case}: {fault} at call {number}, {trial.calls[number - 1]}"
                yield name, trial.broken(fault, number)
            told = "; ".join(f"{count} {outcome}" for outcome, count in sorted(trial.outcomes[fault].items()))
            print(f"calls: {case}: {fault}: {told}", flush=True)
        shutil.rmtree(place)
