"""A large design: what it takes to compile it on a machine that never saw it, and to live with many agents."""

from __future__ import annotations

import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

from bbsd.kernel.keys import keys
from bbsd.solver.random_agents import random_agents
from benchmarks.generated import Shape, compiled, text_of
from benchmarks.lifting import KEY
from benchmarks.page import Asked, table
from benchmarks.processes import environment

SIZES = {
    "64 robots, 32 behaviors": Shape(robots=64, behaviors=32, steps=1000),
    "8 robots, 32 behaviors": Shape(robots=8, behaviors=32, steps=1000),
}
ASKED_OF, MOST = "64 robots, 32 behaviors", 10.0
AGENTS, POPULATION, EPISODES = 10_000, 20, 2
PATIENCE = 60
"""Seconds until it counts as too slow."""


def section(*, quick: bool) -> tuple[str, list[Asked]]:
    """The text of the section, and what was asked."""
    rows, asked = [], []
    for name in SIZES:
        found = measured(name, 15 if quick else PATIENCE)
        if found is None:
            rows.append([name, f"more than {15 if quick else PATIENCE}", "", ""])
        else:
            compiling, each, megabytes = found
            rows.append([name, f"{compiling:.2f}", f"{each:.2f}", f"{megabytes:.0f}"])
        if name == ASKED_OF:
            figure = float("inf") if found is None else found[0]
            asked.append(Asked(f"{name}: compiled on a fresh machine, seconds", figure, MOST))
    return "\n".join(
        [
            "## Large designs",
            "",
            (
                "Generated specs, each in a process of its own with an empty cache: seconds of the processor until the "
                f"kernel runs, then {AGENTS:,} agents in {EPISODES} episodes of 1,000 steps, and MB at the peak of all."
            ),
            "",
            *table(["", "seconds to compile", "ns a robot and step", "MB at the peak"], rows),
        ]
    ), asked


def measured(name: str, patience: int) -> list[float] | None:
    """Seconds to compile, nanoseconds a robot and step, MB; None where it takes too long."""
    with tempfile.TemporaryDirectory() as folder:
        cache = Path(folder) / "cache"
        cache.mkdir(mode=0o700)
        command = [sys.executable, "-m", "benchmarks.large", name]
        try:
            done = subprocess.run(
                command,
                check=True,
                stdout=subprocess.PIPE,
                text=True,
                timeout=patience,
                env=environment(cache),
            )
        except subprocess.TimeoutExpired:
            return None
    return [float(word) for word in done.stdout.split()]


def main() -> None:
    """Compile, live, print."""
    shape = SIZES[sys.argv[1]]
    problem = compiled(text_of(shape))
    agents = random_agents(problem, KEY, POPULATION)
    few, streams = agents[np.arange(1)], keys(KEY, 0, AGENTS)
    began = time.process_time()
    problem.assemble(few.pools, few.members, 1).episode(streams[:1], few.structures)
    compiling = time.process_time() - began
    many = agents[np.arange(AGENTS) % POPULATION]
    team = problem.assemble(many.pools, many.members, 1)
    began = time.process_time()
    for _ in range(EPISODES):
        team.episode(streams, many.structures)
    each = (time.process_time() - began) / (EPISODES * AGENTS * shape.steps * shape.robots)
    print(compiling, each * 1e9, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)


if __name__ == "__main__":
    main()
