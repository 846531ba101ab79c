"""The rollouts of a spec: printed, loaded, and run over lanes in one thread or several."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from bbsd.compiler.details import Detail
from bbsd.compiler.joint import joint_partition
from bbsd.compiler.passes.pipeline import pipeline, run_passes
from bbsd.compiler.passes.robot_loops import MOST_ROBOTS_WRITTEN_OUT
from bbsd.compiler.steps import Steps
from bbsd.compiler.writing.source import module_source
from bbsd.kernel.memory import zeros
from bbsd.kernel.modules import load_kernel

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from bbsd.compiler.joint import JointPartition
    from bbsd.compiler.tables import TableShape
    from bbsd.language.meaning import Meaning

Rollout = Callable[..., bool | None]
"""Runs an episode in each lane; returns whether the outcome is uncertain and does not count."""

BATCHES = (Detail.CREDIT, Detail.TERMS)
"""The rollouts that run many lanes; a trace runs one."""

WORTH_A_THREAD = 100_000
"""Robot-steps that a thread must have to run: about half a millisecond."""


def kernel_source(
    meaning: Meaning,
    tables: Sequence[TableShape],
    lanes: int,
    details: Sequence[Detail],
    most_written_out: int = MOST_ROBOTS_WRITTEN_OUT,
    *,
    in_phases: bool = False,
) -> str:
    """Return the source of a module with these rollouts, `lanes` episodes side by side; whole, or in phases."""
    programs = run_passes(meaning, details, pipeline(most_written_out))
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
    """Threads that share the lanes; the outcome is the same for any number."""
    most_written_out: int = MOST_ROBOTS_WRITTEN_OUT
    """Robots up to this number are written one after the other, more in loops."""

    @cached_property
    def _batches(self) -> Any:  # noqa: ANN401 - a generated module
        source = kernel_source(self.meaning, self.tables, self.lanes, BATCHES, self.most_written_out)
        names = tuple(detail.value for detail in BATCHES)
        return load_kernel(source, "rollout", names, compiled=self.compiled)

    @cached_property
    def _trace(self) -> Any:  # noqa: ANN401 - a generated module
        source = kernel_source(self.meaning, self.tables, 1, (Detail.TRACE,))
        return load_kernel(source, "trace", (), compiled=False)

    @cached_property
    def _practice(self) -> Any:  # noqa: ANN401 - a generated module
        source = kernel_source(
            self.meaning, self.tables, self.lanes, (Detail.PRACTICE,), self.most_written_out
        )
        return load_kernel(source, "practice", (Detail.PRACTICE.value,), compiled=self.compiled)

    @cached_property
    def rollout(self) -> Rollout:
        """The rollout that lifetimes call."""
        rollout: Rollout = self._batches.rollout
        return rollout

    @cached_property
    def rollout_detailed(self) -> Rollout:
        """The rollout that evaluation calls."""
        rollout: Rollout = self._batches.rollout_detailed
        return rollout

    @cached_property
    def rollout_practice(self) -> Rollout:
        """The rollout that practice calls."""
        rollout: Rollout = self._practice.rollout_practice
        return rollout

    @cached_property
    def joint(self) -> JointPartition:
        """The cells of all behaviors together that practice records."""
        return joint_partition(self.meaning.episode.modules)

    @cached_property
    def _threads(self) -> ThreadPoolExecutor:
        return ThreadPoolExecutor(self.jobs)

    def run(self, rollout: Rollout, n_lanes: int, *arrays: object) -> bool:
        """Run all lanes and return whether the outcome of any is uncertain; then that of none counts.

        Several threads share the lanes where that is worth it: a kernel does not hold the interpreter's lock.
        """
        spans, memory = self._spans(n_lanes), self._batches.MEMORY

        def run_span(span: tuple[int, int]) -> bool:
            # Infinities and NaN are values in every mode; NumPy's scalars would warn of them in plain Python.
            with np.errstate(all="ignore"):
                return bool(rollout(*span, zeros(memory), *arrays))

        if len(spans) == 1:
            return run_span(spans[0])
        return any(list(self._threads.map(run_span, spans)))

    def run_practice(
        self, n_lanes: int, before: Sequence[object], after: Sequence[object]
    ) -> Iterator[Steps]:
        """Run all lanes batch by batch and yield the steps of each batch, in the order of the lanes.

        What is yielded is overwritten later. As many batches as there are threads run at the same time.

        Args:
            n_lanes: a multiple of the lanes of a batch.
            before, after: the arguments before and behind the arrays that hold a batch's steps.
        """
        firsts = range(0, n_lanes, self.lanes)
        records = [self._new_steps() for _ in range(min(self.jobs, len(firsts)))]

        def run_batch(first: int, steps: Steps) -> Steps:
            with np.errstate(all="ignore"):
                memory = zeros(self._practice.MEMORY)
                flat = (record.reshape(-1) for record in steps[1:])
                self.rollout_practice(first, first + self.lanes, memory, *before, *flat, *after)
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
            self._trace.rollout_traced(0, 1, zeros(self._trace.MEMORY), *arrays)

    def _spans(self, n_lanes: int) -> list[tuple[int, int]]:
        """Return the lanes that each thread runs, whole batches of them."""
        environment = self.meaning.spec.environment
        batches = n_lanes // self.lanes
        worth = n_lanes * environment.steps * environment.robots // WORTH_A_THREAD
        parts = max(1, min(self.jobs, batches, worth))
        ends = [batches * part // parts * self.lanes for part in range(parts + 1)]
        return list(pairwise(ends))
