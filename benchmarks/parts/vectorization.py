"""A guard: the same kernel with one lane must be much slower, or the compiler silently stopped vectorizing."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

import numpy as np

from bbsd.kernel.keys import keys
from benchmarks.processes import figures_of
from benchmarks.report import Goal, Section, table
from benchmarks.timing import alternating_times
from benchmarks.workloads.generated import Shape, compiled, repeated_agents, spec_text
from benchmarks.workloads.lifting import SPEC
from benchmarks.workloads.specs import KEY

if TYPE_CHECKING:
    from collections.abc import Callable

LEAST_GAIN = 2.0
"""With 8 numbers a vector, vectorized loops gain 2.2 (many robots, large tables) to 13, lost ones 0.9 to 1.5; a single
scalar call goes unseen."""
AGENTS = 400
SLOW = ("16 robots", "64 robots")
"""Specs that are measured in a process of their own, which can be stopped."""
PATIENCE = 60
"""Seconds after which a spec counts as too slow to compile."""

SHAPES = {
    "generated": Shape(),
    "one robot": Shape(robots=1),
    "8 robots": Shape(robots=8),
    "16 robots": Shape(robots=16),
    "64 robots": Shape(robots=64, steps=100),
    "16 robots that look at one another": Shape(
        robots=16,
        steps=100,
        sensors={
            "near": "min(abs(x[r] - x) for r in others)",
            "toward": "x[argmin(abs(x[r] - x) for r in others)] - x",
        },
        dynamics="x + 0.01 * v + 0.001 * toward * near",
    ),
    "20 behaviors": Shape(behaviors=20),
    "32 behaviors": Shape(behaviors=32),
    "tables of 1000 cells": Shape(cells=1000, seen="100 * x"),
    "tables of 100,000 cells": Shape(cells=100_000, seen="10000 * x"),
    "ends early": Shape(ends="all(x[r] > 2 for r in team)"),
    "a draw in the dynamics": Shape(dynamics="x + 0.01 * v + uniform(-0.01, 0.01)"),
    "a normal draw in the dynamics": Shape(dynamics="x + 0.01 * v + normal(0, 0.01)"),
    "lists": Shape(
        sensors={"far": "list(abs(x - 0.1 * k) for k in range(8))"},
        excited="any(far[k] < 0.3 for k in range(8))",
    ),
    "sine and cosine": Shape(dynamics="x + 0.01 * v * cos(x) + 0.001 * sin(9 * x)"),
    "exponential and logarithm": Shape(dynamics="x + 0.01 * v * exp(-abs(x)) + 0.001 * log(1 + abs(x))"),
    "power, tanh, remainder": Shape(
        dynamics="x + 0.01 * tanh(v) + 0.001 * abs(x) ** 0.5 + 0.001 * (x % 0.3)"
    ),
}


def section(*, quick: bool) -> Section:
    """Measure the gain of lanes in lock-step for lifting and for generated specs."""
    names = ["lifting", *(name for name in SHAPES if not quick or name == "generated")]
    gains = {name: gain_of(name, 3 if quick else 7) for name in names}
    goals = [
        Goal(f"vectorized: {name}", gain, LEAST_GAIN, at_least=True, required=True)
        for name, gain in gains.items()
        if gain is not None
    ]
    rows = [
        [name, f"{gain:.2f}", "yes" if gain >= LEAST_GAIN else "**lost**"]
        if gain is not None
        else [name, "", f"not measured: more than {PATIENCE} s to compile"]
        for name, gain in gains.items()
    ]
    text = (
        "Time of the same kernel compiled for one lane, relative to the one for 40 lanes that a design runs. Below "
        f"{LEAST_GAIN:g} the benchmark fails: the loop over lanes is no longer vectorized."
    )
    return Section("Vectorization", [text, table(["spec", "gain", "vectorized"], rows)], goals)


def gain_of(name: str, rounds: int) -> float | None:
    """Return the gain of a spec by its name, or None where compiling takes too long."""
    if name in SLOW:
        figures = figures_of(__name__, name, str(rounds), patience=PATIENCE)
        return figures[0] if figures else None
    return gain(SPEC.read_text(encoding="utf-8") if name == "lifting" else spec_text(SHAPES[name]), rounds)


def gain(text: str, rounds: int) -> float:
    """Return by which factor lanes in lock-step are faster than one lane at a time."""
    times = alternating_times({"scalar": rollout(text, 1), "lanes": rollout(text, None)}, rounds)
    return float(np.median(times["scalar"] / times["lanes"]))


def rollout(text: str, lanes: int | None) -> Callable[[], object]:
    """Return a call that runs an episode of random agents in that many lanes."""
    problem = compiled(text, lanes)
    agents = repeated_agents(problem, AGENTS)
    team, streams = problem.assemble(agents.pools, agents.members, 1), keys(KEY, 0, AGENTS)
    return lambda: team.episode(streams, agents.structures)


if __name__ == "__main__":
    print(gain(spec_text(SHAPES[sys.argv[1]]), int(sys.argv[2])))
