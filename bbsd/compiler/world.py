"""A spec's world without its design: another program chooses what the robots do, lane by lane and step by step."""

from __future__ import annotations

from contextlib import nullcontext
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from bbsd.compiler.details import WORLD_PHASES, Detail
from bbsd.compiler.passes.pipeline import Program
from bbsd.compiler.stepped import new_between
from bbsd.compiler.writing.source import module_source
from bbsd.kernel.memory import zeros
from bbsd.kernel.modules import load_kernel

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from bbsd.compiler.stepped import Phase
    from bbsd.expression.graph import Node
    from bbsd.language.meaning import Meaning

    Floats = NDArray[np.float64]
    Integers = NDArray[np.int64]


class World:
    """A world in lanes, each in an episode and at a step of its own.

    What it computes is what a rollout of the spec computes, to the last bit. After `begin` and `step`, arrays hold for
    each lane: `observed` (n, n_lanes) the values of the nodes to observe, `earned` (n_robots, n_lanes) what the last
    step earned, `living` (n_lanes,) 1 while no end of the spec's was met, `returns` (n_lanes,) what the team earned so
    far, `steps` (n_lanes,) the steps taken.
    """

    def __init__(
        self,
        meaning: Meaning,
        observed: Sequence[Node],
        n_lanes: int,
        generation: int,
        *,
        compiled: bool = True,
    ) -> None:
        """Make it.

        Args:
            meaning: of a spec whose world is its own.
            observed: values that a decision may depend on.
            n_lanes: how many lanes there are.
            generation: in whose constants it runs.
            compiled: whether as machine code.
        """
        self.meaning, self.n_lanes, self._compiled = meaning, n_lanes, compiled
        self._nodes = tuple(observed)
        robots = meaning.spec.environment.robots
        self._constants = np.array(meaning.constants.vector(generation), np.float64)
        self._keys = np.zeros(n_lanes, np.uint64)
        self._numbers = zeros(self._module.MEMORY)
        self._between = new_between(meaning, n_lanes)
        self.earned, self.observed = np.zeros((robots, n_lanes)), np.zeros((len(self._nodes), n_lanes))
        self.returns, self.steps = np.zeros(n_lanes), np.zeros(n_lanes, np.int64)

    @property
    def living(self) -> Floats:
        """1 while no end of the spec's was met, (n_lanes,)."""
        return self._between.living

    @property
    def over(self) -> NDArray[np.bool_]:
        """Whether a lane's episode is over: an end was met, or all steps were taken, (n_lanes,)."""
        over: NDArray[np.bool_] = (self.living == 0.0) | (self.steps >= self.meaning.spec.environment.steps)
        return over

    def begin(self, lanes: Integers, keys: NDArray[np.uint64]) -> None:
        """Begin an episode in some lanes (n,), each with a key of its own (n,)."""
        self._keys[lanes] = keys
        self.steps[lanes] = 0
        self.earned[:, lanes] = 0.0
        self.returns[lanes] = 0.0
        self.living[lanes] = 1.0
        self._run(("start", "observe"), 0, lanes)

    def step(self, lanes: Integers, choices: Integers) -> None:
        """Take a step in some lanes (n,), none of which is over.

        Args:
            lanes: any number of them.
            choices: the number of the action that controls each robot, counted over all behaviors as kernels do; 0 is
                nobody's; (n_robots, n).
        """
        self._between.chosen[:, lanes] = choices
        self.steps[lanes] += 1
        steps = self.steps[lanes]
        for step in set(steps.tolist()):
            self._run(("outcome", "observe", "finish"), step, lanes[steps == step])

    def _run(self, phases: Sequence[str], step: int, lanes: Integers) -> None:
        """Do phases in some lanes. Functions do them in all: what others held is put back."""
        if len(lanes) == self.n_lanes:
            self._run_all(phases, step)
            return
        numbers = self._numbers.reshape(-1, self.n_lanes)
        written = (numbers, self.earned, self.observed, self.returns, self.living)
        others = np.setdiff1d(np.arange(self.n_lanes), lanes)
        before = [array[..., others] for array in written]
        self._run_all(phases, step)
        for array, values in zip(written, before, strict=True):
            array[..., others] = values

    def _run_all(self, phases: Sequence[str], step: int) -> None:
        arguments = (self._numbers, self._keys, self._constants, self.returns, self.earned, self.observed)
        with nullcontext() if self._compiled else np.errstate(all="ignore"):
            for phase in phases:
                self._functions[phase](0, step, *arguments, *self._between)

    @cached_property
    def _functions(self) -> dict[str, Phase]:
        return {phase: getattr(self._module, _name(phase)) for phase in WORLD_PHASES}

    @cached_property
    def _module(self) -> Any:  # noqa: ANN401 - a generated module
        programs = {Detail.WORLD: Program(self.meaning)}
        source = module_source(programs, (), self.n_lanes, in_phases=True, observed=self._nodes)
        names = tuple(map(_name, WORLD_PHASES)) if self._compiled else ()
        return load_kernel(source, "world", names, compiled=self._compiled)


def _name(phase: str) -> str:
    return f"{Detail.WORLD.value}_{phase}"
