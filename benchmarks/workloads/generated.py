"""Specs generated for measuring: any number of robots, behaviors, cells and steps, and what may stop vectorization."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from bbsd.compiler import compile_meaning
from bbsd.language.loading import load
from bbsd.solver.random_agents import random_agents
from bbsd.text import Source
from benchmarks.workloads.specs import KEY

if TYPE_CHECKING:
    from bbsd.compiler import Problem
    from bbsd.evaluation import Agents

POPULATION = 20
"""Individuals of each pool, however many agents there are."""


@dataclass(frozen=True, slots=True)
class Shape:
    """The sizes of a generated spec, and the expressions in it."""

    robots: int = 3
    behaviors: int = 5
    cells: int = 8
    steps: int = 300
    ends: str = ""
    dynamics: str = "x + 0.01 * v"
    sensors: dict[str, str] = field(default_factory=dict)
    excited: str = ""
    seen: str = "8 * x"


def spec_text(shape: Shape) -> str:
    """Return a spec of that shape: robots move along a line toward a goal that their team's mean should reach."""
    lines = [
        "bbsd: 1",
        "name: generated",
        "environment:",
        f"  robots: {shape.robots}",
        f"  steps: {shape.steps}",
        "  state:",
        "    x: uniform(0, 1)",
        "    v: 0",
        "  dynamics:",
        f"    x: {shape.dynamics}",
        "  sensors:",
        "    gap: x - mean(x[r] for r in team)",
        *(f"    {name}: {expression}" for name, expression in shape.sensors.items()),
        *([f"  ends: {shape.ends}"] if shape.ends else []),
        "behaviors:",
    ]
    for number in range(shape.behaviors):
        lines += [
            f"  move_{number}:",
            *([f"    excited: {shape.excited}"] if shape.excited else []),
            "    inputs:",
            f"      seen: values(floor({shape.seen} + {number}), 0, {shape.cells - 1})",
            "    actions:",
            "      go:",
            f"        v: {number} - {shape.behaviors // 2}",
        ]
    lines += ["reward:", "  near: -abs(x - 1)", "  together: 0.1 if abs(gap) < 0.1 else 0"]
    return "\n".join(lines) + "\n"


def compiled(text: str, lanes: int | None = None) -> Problem:
    """Return the compiled problem of a spec, with that many lanes if given."""
    return compile_meaning(load(Source("generated.yaml", text)).meaning, lanes=lanes)


def repeated_agents(problem: Problem, n_agents: int) -> Agents:
    """Return agents that repeat those of a small random population."""
    return random_agents(problem, KEY, POPULATION)[np.arange(n_agents) % POPULATION]
