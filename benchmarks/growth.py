"""How the time of a generation's lives grows with everything that makes it larger."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from bbsd.kernel.keys import keys
from bbsd.solver.lifetime import live
from bbsd.solver.random_agents import random_agents
from bbsd.solver.settings import settings_of
from benchmarks.generated import Shape, compiled, text_of
from benchmarks.lifting import KEY
from benchmarks.page import Asked, table
from benchmarks.timing import Floats, alternated

if TYPE_CHECKING:
    from collections.abc import Callable

FIGURE = Path(__file__).parents[1] / "docs" / "images" / "growth.png"
BOUND = 1.05


@dataclass(frozen=True, slots=True)
class Size:
    """A generation: its spec, agents and episodes of a lifetime."""

    shape: Shape = field(default_factory=lambda: Shape(steps=400))
    agents: int = 400
    episodes: int = 10


AXES: dict[str, tuple[int, ...]] = {
    "agents": (400, 800, 1600, 3200),
    "steps": (200, 400, 800, 1600),
    "robots": (2, 3, 4, 6, 8),
    "episodes": (10, 20, 40, 80),
    "behaviors": (2, 4, 8, 16),
    "cells": (4, 16, 64, 256, 1024),
}
BOUNDED = ("agents", "steps", "robots", "episodes")


def section(*, quick: bool) -> tuple[str, list[Asked]]:
    """The text of the section, and the exponents' bounds; draws the figure unless quick."""
    axes = {name: sizes[:2] if quick else sizes for name, sizes in AXES.items()}
    curves = {name: curve(name, sizes, 2 if quick else 5) for name, sizes in axes.items()}
    exponents = {name: exponent(axes[name], curves[name]) for name in axes}
    if not quick:
        draw(axes, curves, exponents)
    rows = [
        [name, ", ".join(map(str, axes[name])), f"{curves[name][-1] / curves[name][0]:.2f}", f"{found:.2f}"]
        for name, found in exponents.items()
    ]
    asked = [Asked(f"growth: exponent of {name}", exponents[name], BOUND) for name in BOUNDED]
    return "\n".join(
        [
            "## Growth",
            "",
            (
                "Time of the lives of one generation, structure search and learning included, of generated specs: "
                f"{Size().agents} agents, {Size().episodes} episodes, {Size().shape.steps} steps, 3 robots, "
                "5 behaviors, 8 cells each, but for what grows. The exponent is fitted to the logarithms."
            ),
            "",
            *table(["what grows", "sizes", "time, last / first", "exponent"], rows),
            "",
            "![Time against size, both relative to the smallest](images/growth.png)",
        ]
    ), asked


def curve(name: str, sizes: tuple[int, ...], rounds: int) -> Floats:
    """Seconds at each size, (n_sizes,)."""
    times = alternated({str(size): lives(sized(name, size)) for size in sizes}, rounds)
    return np.array([np.median(times[str(size)]) for size in sizes])


def sized(name: str, size: int) -> Size:
    """The usual size but for one thing."""
    usual = Size()
    changed: dict[str, Any] = {name: size}
    if name in ("agents", "episodes"):
        return replace(usual, **changed)
    return replace(usual, shape=replace(usual.shape, **changed))


def lives(size: Size) -> Callable[[], object]:
    """The lives of one generation."""
    design = f"design: {{learning: {{episodes: {size.episodes}, last: 1}}}}\n"
    problem = compiled(text_of(size.shape) + design)
    learning = settings_of(problem.meaning).learning
    agents, streams = random_agents(problem, KEY, size.agents), keys(KEY, 0, size.agents)
    return lambda: live(problem, agents, streams, 1, learning)


def exponent(sizes: tuple[int, ...], times: Floats) -> float:
    """The slope of a line through the logarithms."""
    return float(np.polyfit(np.log(sizes), np.log(times), 1)[0])


def draw(axes: dict[str, tuple[int, ...]], curves: dict[str, Floats], exponents: dict[str, float]) -> None:
    """Write the figure."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(6, 4), layout="constrained")
    axis = figure.subplots()
    for name, sizes in axes.items():
        relative = np.array(sizes) / sizes[0]
        axis.loglog(relative, curves[name] / curves[name][0], "o-", label=f"{name}: {exponents[name]:.2f}")
    axis.axline((1, 1), (2, 2), color="0.7", linewidth=0.8, zorder=0)
    axis.set_xlabel("size, relative to the smallest")
    axis.set_ylabel("time, relative to the smallest")
    axis.set_yticks([1, 2, 4, 8], ["1", "2", "4", "8"], minor=False)
    axis.set_yticks([], minor=True)
    axis.legend(title="exponent", frameon=False)
    FIGURE.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(FIGURE, dpi=120, metadata={"Software": None})
