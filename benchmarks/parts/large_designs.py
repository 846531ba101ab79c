"""Large designs: the time to compile them on a machine that never saw them, and to run many agents."""

from __future__ import annotations

import resource
import sys
import tempfile
import time
from pathlib import Path

from bbsd.kernel.keys import keys
from benchmarks.processes import environment, figures_of
from benchmarks.report import Goal, Section, table
from benchmarks.workloads.generated import Shape, compiled, repeated_agents, spec_text
from benchmarks.workloads.specs import KEY

SHAPES = {
    "64 robots, 32 behaviors": Shape(robots=64, behaviors=32, steps=1000),
    "8 robots, 32 behaviors": Shape(robots=8, behaviors=32, steps=1000),
}
LARGEST, MOST_SECONDS = "64 robots, 32 behaviors", 10.0
AGENTS, EPISODES = 10_000, 2
PATIENCE = 60
"""Seconds after which a spec counts as too slow."""


def section(*, quick: bool) -> Section:
    """Measure each spec in a process of its own with an empty cache."""
    patience = 15 if quick else PATIENCE
    rows, goals = [], []
    for name in SHAPES:
        figures = measured(name, patience)
        if figures is None:
            rows.append([name, f"more than {patience}", "", ""])
        else:
            compiling, nanoseconds, megabytes = figures
            rows.append([name, f"{compiling:.2f}", f"{nanoseconds:.2f}", f"{megabytes:.0f}"])
        if name == LARGEST:
            seconds = float("inf") if figures is None else figures[0]
            goals.append(Goal(f"{name}: compiled on a fresh machine, seconds", seconds, MOST_SECONDS))
    text = (
        "Generated specs, each in a process of its own with an empty cache: seconds of the processor until the kernel "
        f"runs, then {AGENTS:,} agents in {EPISODES} episodes of 1,000 steps, and MB at the peak of all."
    )
    head = ["", "seconds to compile", "ns for a step of a robot", "MB at the peak"]
    return Section("Large designs", [text, table(head, rows)], goals)


def measured(name: str, patience: float) -> list[float] | None:
    """Return the seconds to compile, the nanoseconds for a step of a robot, and MB; None where it takes too long."""
    with tempfile.TemporaryDirectory() as folder:
        cache = Path(folder) / "cache"
        cache.mkdir(mode=0o700)
        return figures_of(__name__, name, patience=patience, env=environment(cache))


def main() -> None:
    """Compile a spec, run many agents, and print the figures."""
    shape = SHAPES[sys.argv[1]]
    problem = compiled(spec_text(shape))
    one, many, streams = repeated_agents(problem, 1), repeated_agents(problem, AGENTS), keys(KEY, 0, AGENTS)
    began = time.process_time()
    problem.assemble(one.pools, one.members, 1).episode(streams[:1], one.structures)
    compiling = time.process_time() - began
    team = problem.assemble(many.pools, many.members, 1)
    began = time.process_time()
    for _ in range(EPISODES):
        team.episode(streams, many.structures)
    seconds = (time.process_time() - began) / (EPISODES * AGENTS * shape.steps * shape.robots)
    print(compiling, seconds * 1e9, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)


if __name__ == "__main__":
    main()
