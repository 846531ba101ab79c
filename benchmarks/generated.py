"""Specs made to measure: any number of robots, behaviors, cells and steps, and what else may stop vectorization."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from bbsd.compiler import compile_meaning
from bbsd.language.loading import load
from bbsd.text import Source

if TYPE_CHECKING:
    from bbsd.compiler import Problem


@dataclass(frozen=True, slots=True)
class Shape:
    """How large a generated spec is, and expressions that it has beside."""

    robots: int = 3
    behaviors: int = 5
    cells: int = 8
    steps: int = 300
    ends: str = ""
    dynamics: str = "x + 0.01 * v"
    sensors: dict[str, str] = field(default_factory=dict)
    excited: str = ""
    seen: str = "8 * x"


def text_of(shape: Shape) -> str:
    """The spec: robots move along a line toward a goal that its team's mean should reach."""
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
    """The spec's problem."""
    return compile_meaning(load(Source("generated.yaml", text)).meaning, lanes=lanes)
