"""The rollouts of a spec: printed, loaded, and run over lanes in one thread or several."""

from __future__ import annotations

import pickle
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from bbsd.compiler.details import Detail
from bbsd.compiler.joint import joint_partition
from bbsd.compiler.passes.list_arrays import MOST_ELEMENTS_WRITTEN_OUT
from bbsd.compiler.passes.pipeline import pipeline, run_passes
from bbsd.compiler.passes.robot_loops import MOST_ROBOTS_WRITTEN_OUT
from bbsd.compiler.stepped import SteppedRollout, phase_names, phases_of
from bbsd.compiler.steps import Steps
from bbsd.compiler.writing.source import module_source
from bbsd.environments.stepping import not_imported
from bbsd.kernel.memory import zeros
from bbsd.kernel.modules import load_kernel, not_compiled

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from bbsd.compiler.joint import JointPartition
    from bbsd.compiler.tables import TableShape
    from bbsd.environments.stepping import Stepper
    from bbsd.language.meaning import Meaning

Rollout = Callable[..., bool | None]
"""Runs an episode in each lane; returns whether the outcome is uncertain and does not count."""

BATCHES = (Detail.CREDIT, Detail.TERMS)
"""The rollouts that run many lanes; a trace runs one."""

SECONDS_TO_BEGIN, SECONDS_A_CHARACTER = 1.5, 80e-6
"""Processor seconds to compile: until the compiler is loaded, and for each character of a kernel's text.

For specs with 10 to 900 terms of a reward, and for those shipped, it was 0.6 to 1.3 times as much.
"""

WORTH_A_THREAD = 100_000
"""Robot-steps that a thread must have to run: about half a millisecond."""


def kernel_source(
    meaning: Meaning,
    tables: Sequence[TableShape],
    lanes: int,
    details: Sequence[Detail],
    most_written_out: int = MOST_ROBOTS_WRITTEN_OUT,
    most_elements: int = MOST_ELEMENTS_WRITTEN_OUT,
    *,
    in_phases: bool = False,
) -> str:
    """Return the source of a module with these rollouts, `lanes` episodes side by side; whole, or in phases."""
    programs = run_passes(meaning, details, pipeline(most_written_out, most_elements))
    joint = joint_partition(meaning.episode.modules) if Detail.PRACTICE in details else None
    return module_source(programs, tables, lanes, joint, in_phases=in_phases)


@dataclass(frozen=True)
class Kernels:
    """The rollouts of a spec for some number of lanes, compiled or as plain Python."""

    meaning: Meaning
    tables: tuple[TableShape, ...]
    lanes: int
    compiled: bool
    jobs: int = 1
    """Threads or, where Python steps the environment, processes that share the lanes; they change no bit."""
    most_written_out: int = MOST_ROBOTS_WRITTEN_OUT
    """Robots up to this number are written one after the other, more in loops."""
    most_elements: int = MOST_ELEMENTS_WRITTEN_OUT
    """Lists of up to so many elements have a variable for each, longer ones an array where that can be."""
    stepper: Callable[[], Stepper] | None = None
    """Makes what steps the environment, if it is stepped in Python."""

    @property
    def is_stepped(self) -> bool:
        """Whether the environment is stepped in Python, between the phases of a kernel."""
        return self.stepper is not None or bool(self.meaning.episode.outside)

    @cached_property
    def alone(self) -> Kernels:
        """The same rollouts with one job."""
        return replace(self, jobs=1)

    @cached_property
    def recipe(self) -> bytes:
        """The rollouts with one job, for another process to print and load."""
        return pickle.dumps(replace(self, jobs=1))

    @cached_property
    def _batches(self) -> Any:  # noqa: ANN401 - a generated module
        return self._load("rollout", BATCHES, self.lanes, self.most_written_out, compiled=self.compiled)

    @cached_property
    def _trace(self) -> Any:  # noqa: ANN401 - a generated module
        return self._load("trace", (Detail.TRACE,), 1, MOST_ROBOTS_WRITTEN_OUT, compiled=False)

    @cached_property
    def _practice(self) -> Any:  # noqa: ANN401 - a generated module
        details = (Detail.PRACTICE,)
        return self._load("practice", details, self.lanes, self.most_written_out, compiled=self.compiled)

    def _load(
        self, name: str, details: tuple[Detail, ...], lanes: int, most_written_out: int, *, compiled: bool
    ) -> Any:  # noqa: ANN401 - a generated module
        source = self._source(details, lanes, most_written_out)
        return load_kernel(source, name, self._names(details) if compiled else (), compiled=compiled)

    def _source(self, details: tuple[Detail, ...], lanes: int, most_written_out: int) -> str:
        return kernel_source(
            self.meaning,
            self.tables,
            lanes,
            details,
            most_written_out,
            self.most_elements,
            in_phases=self.is_stepped,
        )

    def _names(self, details: tuple[Detail, ...]) -> tuple[str, ...]:
        return tuple(name for detail in details for name in self._functions(detail))

    def seconds_to_compile(self, *, practices: bool = False) -> float:
        """Return the processor seconds that compiling takes for search and evaluation, estimated from the text.

        With practice, those of its kernel too. 0.0 where all is in the cache, or nothing is compiled.
        """
        if not self.compiled:
            return 0.0
        modules = {"rollout": BATCHES, **({"practice": (Detail.PRACTICE,)} if practices else {})}
        characters = sum(self._characters_to_compile(name, details) for name, details in modules.items())
        return SECONDS_TO_BEGIN + characters * SECONDS_A_CHARACTER if characters else 0.0

    def _characters_to_compile(self, name: str, details: tuple[Detail, ...]) -> int:
        source = self._source(details, self.lanes, self.most_written_out)
        texts = {text.partition("(")[0]: text for text in source.split("\ndef ")[1:]}
        return sum(len(texts[function]) for function in not_compiled(source, name, self._names(details)))

    def _functions(self, detail: Detail) -> tuple[str, ...]:
        """Return the names of a rollout's functions."""
        return phase_names(detail) if self.is_stepped else (detail.value,)

    def _rollout_of(self, module: Any, detail: Detail, lanes: int) -> Rollout:  # noqa: ANN401 - a generated module
        if self.is_stepped:
            return SteppedRollout(phases_of(module, detail), self.meaning, lanes, self._opened)
        rollout: Rollout = getattr(module, detail.value)
        return rollout

    @cached_property
    def _opened(self) -> Stepper:
        """What steps the environment. Raises EnvironmentNotImported."""
        if self.stepper is None:
            raise not_imported(self.meaning.spec.environment.outside)
        return self.stepper()

    @cached_property
    def rollout(self) -> Rollout:
        """The rollout that lifetimes call. Raises EnvironmentNotImported."""
        return self._rollout_of(self._batches, Detail.CREDIT, self.lanes)

    @cached_property
    def rollout_detailed(self) -> Rollout:
        """The rollout that evaluation calls. Raises EnvironmentNotImported."""
        return self._rollout_of(self._batches, Detail.TERMS, self.lanes)

    @cached_property
    def rollout_practice(self) -> Rollout:
        """The rollout that practice calls. Raises EnvironmentNotImported."""
        return self._rollout_of(self._practice, Detail.PRACTICE, self.lanes)

    @cached_property
    def rollout_traced(self) -> Rollout:
        """The rollout that is run to look at one episode. Raises EnvironmentNotImported."""
        return self._rollout_of(self._trace, Detail.TRACE, 1)

    @cached_property
    def joint(self) -> JointPartition:
        """The cells of all behaviors together that practice records."""
        return joint_partition(self.meaning.episode.modules)

    @property
    def n_threads(self) -> int:
        """Threads that share the lanes: one where Python steps the environment, and holds the interpreter's lock."""
        return 1 if self.is_stepped else self.jobs

    @cached_property
    def _threads(self) -> ThreadPoolExecutor:
        return ThreadPoolExecutor(self.n_threads)

    def run(self, rollout: Rollout, n_agents: int, *arrays: object) -> bool:
        """Run the lanes of all agents and return whether the outcome of any is uncertain; then that of none counts.

        Several threads share the lanes where that is worth it: a kernel does not hold the interpreter's lock.
        """
        spans, memory = self._spans(n_agents), self._batches.MEMORY

        def run_span(span: tuple[int, int]) -> bool:
            # Infinities and NaN are values in every mode; NumPy's scalars would warn of them in plain Python.
            with np.errstate(all="ignore"):
                return bool(rollout(*span, zeros(memory), *arrays))

        if len(spans) == 1:
            return run_span(spans[0])
        return any(list(self._threads.map(run_span, spans)))

    def run_practice(
        self, n_agents: int, before: Sequence[object], after: Sequence[object]
    ) -> Iterator[Steps]:
        """Run all lanes batch by batch and yield the steps of each batch, in the order of the lanes.

        What is yielded is overwritten later. As many batches as there are threads run at the same time.

        Args:
            n_agents: each has a lane.
            before, after: the arguments before and behind the arrays that hold a batch's steps.
        """
        firsts = range(0, n_agents, self.lanes)
        records = [self._new_steps() for _ in range(min(self.n_threads, len(firsts)))]

        def run_batch(first: int, steps: Steps) -> Steps:
            with np.errstate(all="ignore"):
                memory = zeros(self._practice.MEMORY)
                flat = (record.reshape(-1) for record in steps[1:])
                last = min(first + self.lanes, n_agents)
                self.rollout_practice(first, last, memory, *before, *flat, *after)
            return steps._replace(first=first)

        for group in range(0, len(firsts), len(records)):
            batches = list(zip(firsts[group:], records, strict=False))
            if len(batches) == 1:
                yield run_batch(*batches[0])
            else:
                yield from list(self._threads.map(run_batch, *zip(*batches, strict=True)))

    def _new_steps(self) -> Steps:
        """Return memory for the steps of a batch."""
        environment, n_behaviors = self.meaning.spec.environment, len(self.tables)
        shape = (environment.steps, environment.robots)
        n_pairs = sum(table.n_cells * (table.n_actions + 1) for table in self.tables)
        codes = np.int32 if 2 * n_pairs < 1 << 31 else np.int64
        return Steps(
            0,
            np.empty((*shape, n_behaviors, self.lanes), codes),
            np.empty((*shape, self.lanes), np.int32),
            np.empty((*shape, self.lanes)),
        )

    def run_traced(self, *arrays: object) -> None:
        """Run the first lane as plain Python and record every step."""
        with np.errstate(all="ignore"):
            self.rollout_traced(0, 1, zeros(self._trace.MEMORY), *arrays)

    def _spans(self, n_agents: int) -> list[tuple[int, int]]:
        """Return the lanes that each thread runs, whole batches of them but for the last one."""
        environment = self.meaning.spec.environment
        batches = -(-n_agents // self.lanes)
        worth = batches * self.lanes * environment.steps * environment.robots // WORTH_A_THREAD
        parts = max(1, min(self.n_threads, batches, worth))
        ends = [batches * part // parts * self.lanes for part in range(parts)]
        return list(pairwise([*ends, n_agents]))
