"""How the time of a generation's lives grows with everything that makes it larger."""

from __future__ import annotations

import time
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from bbsd.kernel.keys import keys
from bbsd.solver.lifetime import run_lifetimes
from bbsd.solver.random_agents import random_agents
from bbsd.solver.settings import settings_of
from benchmarks.generated import Shape, compiled, text_of
from benchmarks.lifting import KEY
from benchmarks.page import Asked, table
from benchmarks.timing import CORES, Floats, alternated, on_all_cores

if TYPE_CHECKING:
    from collections.abc import Callable

FIGURE = Path(__file__).parents[1] / "docs" / "images" / "growth.png"
BOUND = 1.05
JOBS_AGENTS = 3200


@dataclass(frozen=True, slots=True)
class Size:
    """A generation: its spec, agents and episodes of a lifetime."""

    shape: Shape = field(default_factory=lambda: Shape(steps=400))
    agents: int = 400
    episodes: int = 10
    jobs: int = 1


POPULATION = 20
"""Individuals of a pool, however many agents are made of them."""

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


def section(*, quick: bool) -> tuple[str, list[Asked]]:
    """The text of the section, and the exponents' bounds; draws the figure unless quick."""
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
            f"{found:.2f}",
        ]
        for name, found in exponents.items()
    ]
    asked = [Asked(f"growth: exponent of {name}", exponents[name], BOUND) for name in BOUNDED]
    return "\n".join(
        [
            "## Growth",
            "",
            (
                "Time of the lives of one generation, structure search and learning included, of generated specs: "
                f"{Size().agents} agents of pools of {POPULATION}, {Size().episodes} episodes, {Size().shape.steps} "
                "steps, 3 robots, 5 behaviors, 8 cells each, but for what grows. The exponent is fitted to the "
                "logarithms: 1 is in proportion, 0 is no growth at all, and -1 would be that of jobs if nothing but "
                f"episodes took time. With jobs, {JOBS_AGENTS:,} agents are lived by the clock on "
                f"{len(CORES)} cores; all else is the processor's time on one."
            ),
            "",
            *table(["what grows", "sizes", "time, last / first", "exponent"], rows),
            "",
            "![Time against size, both relative to the smallest; cells go on beyond the edge](images/growth.png)",
        ]
    ), asked


def curve(name: str, sizes: tuple[int, ...], rounds: int) -> Floats:
    """Seconds at each size, (n_sizes,)."""
    calls = {str(size): lives(sized(name, size)) for size in sizes}
    if name == "jobs":
        with on_all_cores():
            times = alternated(calls, rounds, time.perf_counter)
    else:
        times = alternated(calls, rounds)
    return np.array([np.median(times[str(size)]) for size in sizes])


def sized(name: str, size: int) -> Size:
    """The usual size but for one thing."""
    usual = Size()
    changed: dict[str, Any] = {name: size}
    if name == "jobs":
        return replace(usual, jobs=size, agents=JOBS_AGENTS)
    if name in ("agents", "episodes"):
        return replace(usual, **changed)
    if name == "cells":
        changed["seen"] = f"{size} * x"
    return replace(usual, shape=replace(usual.shape, **changed))


def lives(size: Size) -> Callable[[], object]:
    """The lives of one generation."""
    design = f"design: {{learning: {{episodes: {size.episodes}, last: 1}}}}\n"
    problem = replace(compiled(text_of(size.shape) + design), jobs=size.jobs)
    settings = settings_of(problem.meaning)
    agents = random_agents(problem, KEY, POPULATION)[np.arange(size.agents) % POPULATION]
    streams = keys(KEY, 0, size.agents)
    return lambda: run_lifetimes(problem, agents, streams, 1, settings)


def exponent(sizes: tuple[int, ...], times: Floats) -> float:
    """The slope of a line through the logarithms."""
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
