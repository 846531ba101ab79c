"""The guard: the same kernel one lane at a time must be much slower, or vectorization was lost without a word."""

from __future__ import annotations

import subprocess
import sys
from typing import TYPE_CHECKING

import numpy as np

from bbsd.kernel.keys import keys
from bbsd.solver.random_agents import random_agents
from benchmarks.generated import Shape, compiled, text_of
from benchmarks.lifting import KEY, SPEC
from benchmarks.page import Asked, table
from benchmarks.timing import alternated

if TYPE_CHECKING:
    from collections.abc import Callable

LEAST = 2.0
"""Kept loops gain 2.2 (many robots, large tables) to 13 with 8 numbers a vector, lost ones 0.9 to 1.5; one scalar call
goes unseen."""
AGENTS, POPULATION = 400, 20
SLOW = ("16 robots", "64 robots")
PATIENCE = 60
"""Seconds until a spec counts as too slow to compile."""

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


def section(*, quick: bool) -> tuple[str, list[Asked]]:
    """The text of the section, and the guard's bounds."""
    names = ["lifting", *(name for name in SHAPES if not quick or name == "generated")]
    found = {name: gain_of(name, 3 if quick else 7) for name in names}
    asked = [
        Asked(f"guard: vectorized, {name}", figure, LEAST, least=True)
        for name, figure in found.items()
        if figure is not None
    ]
    rows = [
        [name, f"{figure:.2f}", "yes" if figure >= LEAST else "**lost**"]
        if figure is not None
        else [name, "", f"not measured: more than {PATIENCE} s to compile"]
        for name, figure in found.items()
    ]
    return "\n".join(
        [
            "## The guard",
            "",
            (
                "Time of the same kernel compiled for one lane, relative to the one for 40 lanes that a design runs. "
                f"Below {LEAST:g} the benchmark fails: the loop over lanes is no longer vectorized."
            ),
            "",
            *table(["spec", "gain", "vectorized"], rows),
        ]
    ), asked


def gain_of(name: str, rounds: int) -> float | None:
    """The gain of a spec by name; of many robots in a process of its own, and None where compiling takes too long."""
    if name not in SLOW:
        return gain(SPEC.read_text(encoding="utf-8") if name == "lifting" else text_of(SHAPES[name]), rounds)
    command = [sys.executable, "-m", "benchmarks.guard", name, str(rounds)]
    try:
        done = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True, timeout=PATIENCE)
    except subprocess.TimeoutExpired:
        return None
    return float(done.stdout)


def gain(text: str, rounds: int) -> float:
    """How much faster lanes in lock-step are."""
    times = alternated({"scalar": rollout(text, 1), "lanes": rollout(text, None)}, rounds)
    return float(np.median(times["scalar"] / times["lanes"]))


def rollout(text: str, lanes: int | None) -> Callable[[], object]:
    """An episode of random agents in that many lanes."""
    problem = compiled(text, lanes)
    agents = random_agents(problem, KEY, POPULATION)[np.arange(AGENTS) % POPULATION]
    team, streams = problem.assemble(agents.pools, agents.members, 1), keys(KEY, 0, AGENTS)
    return lambda: team.episode(streams, agents.structures)


if __name__ == "__main__":
    print(gain(text_of(SHAPES[sys.argv[1]]), int(sys.argv[2])))
