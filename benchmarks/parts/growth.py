"""How the time of a generation's lifetimes grows with everything that makes it larger."""

from __future__ import annotations

import time
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from bbsd.kernel.keys import keys
from bbsd.solver.paper.lifetime import run_lifetimes
from bbsd.solver.paper.settings import settings_of
from benchmarks.report import Goal, Section, table
from benchmarks.timing import CORES, Floats, all_cores, alternating_times
from benchmarks.workloads.generated import POPULATION, Shape, compiled, repeated_agents, spec_text
from benchmarks.workloads.specs import KEY

if TYPE_CHECKING:
    from collections.abc import Callable

FIGURE = Path(__file__).parents[2] / "docs" / "images" / "growth.png"


@dataclass(frozen=True, slots=True)
class Size:
    """The size of a generation: its spec, agents, episodes of a lifetime, and jobs."""

    shape: Shape = field(default_factory=lambda: Shape(steps=400))
    agents: int = 400
    episodes: int = 10
    jobs: int = 1


USUAL = Size()
AGENTS_FOR_JOBS = 3200

AXES: dict[str, tuple[int, ...]] = {
    "agents": (400, 800, 1600, 3200),
    "steps": (200, 400, 800, 1600),
    "robots": (2, 4, 8, 16, 32, 64),
    "episodes": (10, 20, 40, 80),
    "behaviors": (2, 4, 8, 16, 32),
    "cells": (4, 16, 64, 1000, 10_000, 100_000),
    "jobs": (1, 2),
}
BOUNDED = ("agents", "steps", "robots", "episodes")
LARGEST_EXPONENT = 1.05
"""Of the bounded axes: time grows in proportion to them, but for noise."""


def section(*, quick: bool) -> Section:
    """Measure the exponent of each axis; draw the figure unless quick."""
    axes = {name: sizes[:2] if quick else sizes for name, sizes in AXES.items()}
    if len(CORES) < 2:
        del axes["jobs"]
    curves = {name: curve(name, sizes, 2 if quick else 5) for name, sizes in axes.items()}
    exponents = {name: exponent(axes[name], curves[name]) for name in axes}
    if not quick:
        draw(axes, curves, exponents)
    rows = [
        [
            name,
            ", ".join(f"{size:,}" for size in axes[name]),
            f"{curves[name][-1] / curves[name][0]:.2f}",
            f"{slope:.2f}",
        ]
        for name, slope in exponents.items()
    ]
    goals = [Goal(f"growth: exponent of {name}", exponents[name], LARGEST_EXPONENT) for name in BOUNDED]
    text = (
        "Time of the lifetimes of one generation, structure search and learning included, of generated specs: "
        f"{USUAL.agents} agents of pools of {POPULATION}, {USUAL.episodes} episodes, {USUAL.shape.steps} steps, "
        "3 robots, 5 behaviors, 8 cells each, except for what grows. The exponent is fitted to the logarithms: 1 is "
        "growth in proportion, 0 is no growth at all, and -1 would be that of jobs if nothing but episodes took time. "
        f"Jobs are measured with {AGENTS_FOR_JOBS:,} agents by the wall clock on {len(CORES)} cores; all else by the "
        "processor's time on one."
    )
    picture = "![Time against size, both relative to the smallest; cells continue beyond the edge](images/growth.png)"
    return Section(
        "Growth",
        [text, table(["what grows", "sizes", "time, last / first", "exponent"], rows), picture],
        goals,
    )


def curve(name: str, sizes: tuple[int, ...], rounds: int) -> Floats:
    """Return the seconds at each size, (n_sizes,)."""
    calls = {str(size): lifetimes(usual_but(name, size)) for size in sizes}
    if name == "jobs":
        with all_cores():
            times = alternating_times(calls, rounds, time.perf_counter)
    else:
        times = alternating_times(calls, rounds)
    return np.array([np.median(times[str(size)]) for size in sizes])


def usual_but(name: str, size: int) -> Size:
    """Return the usual size with one axis changed."""
    changed: dict[str, Any] = {name: size}
    if name == "jobs":
        return replace(USUAL, jobs=size, agents=AGENTS_FOR_JOBS)
    if name in ("agents", "episodes"):
        return replace(USUAL, **changed)
    if name == "cells":
        changed["seen"] = f"{size} * x"
    return replace(USUAL, shape=replace(USUAL.shape, **changed))


def lifetimes(size: Size) -> Callable[[], object]:
    """Return a call that runs the lifetimes of one generation."""
    design = f"design: {{learning: {{episodes: {size.episodes}, last: 1}}}}\n"
    problem = replace(compiled(spec_text(size.shape) + design), jobs=size.jobs)
    settings = settings_of(problem.meaning)
    agents = repeated_agents(problem, size.agents)
    streams = keys(KEY, 0, size.agents)
    return lambda: run_lifetimes(problem, agents, streams, 1, settings)


def exponent(sizes: tuple[int, ...], times: Floats) -> float:
    """Return the slope of a line fitted to the logarithms."""
    return float(np.polyfit(np.log(sizes), np.log(times), 1)[0])


def draw(axes: dict[str, tuple[int, ...]], curves: dict[str, Floats], exponents: dict[str, float]) -> None:
    """Write the figure."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(8, 5), layout="constrained")
    axis = figure.subplots()
    for (name, sizes), marker in zip(axes.items(), "osD^vP*", strict=False):
        relative = np.array(sizes) / sizes[0]
        label = f"{name}, {sizes[0]:,} to {sizes[-1]:,}: {exponents[name]:.2f}"
        axis.loglog(relative, curves[name] / curves[name][0], marker=marker, markersize=5, label=label)
    axis.axline((1, 1), (2, 2), color="0.6", linewidth=1, linestyle="--", zorder=0, label="in proportion: 1")
    axis.set_xlim(0.9, 50)
    axis.set_ylim(0.4, 50)
    axis.set_xlabel("size, relative to the smallest")
    axis.set_ylabel("time, relative to the smallest")
    axis.set_xticks([1, 2, 4, 8, 16, 32], ["1", "2", "4", "8", "16", "32"], minor=False)
    axis.set_yticks([0.5, 1, 2, 4, 8, 16], ["1/2", "1", "2", "4", "8", "16"], minor=False)
    axis.set_xticks([], minor=True)
    axis.set_yticks([], minor=True)
    axis.legend(title="exponent", frameon=False, loc="center left", bbox_to_anchor=(1, 0.5))
    FIGURE.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(FIGURE, dpi=120, metadata={"Software": None})
