"""A call of `bbsd.Agent` in one's own loop, beside the exported Python module, and many robots at once."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

import bbsd
from benchmarks.report import Goal, Section, table
from benchmarks.timing import alternating_times, spread
from benchmarks.workloads.specs import SPECS

if TYPE_CHECKING:
    from collections.abc import Callable

    from bbsd.agent import AgentInput

DESIGNS = (
    "object_lifting_hand",
    "mobile_robot_hand",
    "pursuit_hand",
    "forager_hand",
    "tasks/aggregation_hand",
)
MOST_MICROSECONDS = 10.0
ROBOTS = 1000
MICRO = 1e6


def section(*, quick: bool) -> Section:
    """Measure calls of agents of shipped designs."""
    calls, rounds = (2_000, 3) if quick else (20_000, 9)
    rows, goals = [], []
    for name in DESIGNS[:2] if quick else DESIGNS:
        times = alternating_times(_calls(name, calls), rounds)
        one, module, many = (spread(times[each]).median * MICRO / calls for each in ("one", "module", "many"))
        rows.append([name, f"{one:.2f}", f"{one / module:.1f}", f"{many:.3f}"])
        goals.append(Goal(f"bbsd.Agent, {name}: microseconds a call", one, MOST_MICROSECONDS))
    return Section(
        "Agents",
        [
            (
                "`Agent.act` of designs made by hand: microseconds a call, what it reads and checks, senses, decides "
                "and sets; times the `command` of the exported module, which is given cells and only decides; and "
                f"`act_many` of {ROBOTS:,} robots, microseconds a robot."
            ),
            table(["", "one, µs", "times the exported module", "of many, µs"], rows),
        ],
        goals,
    )


def _calls(name: str, calls: int) -> dict[str, Callable[[], Any]]:
    """Return functions that make so many decisions: one by one, by the exported module, and many at once."""
    path = SPECS / f"{name}.yaml"
    agent = bbsd.Agent(path)
    rng = np.random.default_rng(0)
    one = {each.name: _value(each, rng) for each in agent.inputs.values()}
    many = {key: np.array([value] * ROBOTS) for key, value in one.items()}
    exported: dict[str, Any] = {}
    exec(bbsd.export(path, "python").text, exported)
    command, cells = exported["command"], (0,) * len(exported["_SIZES"])

    def act() -> None:
        for _ in range(calls):
            agent.act(one)

    def decide() -> None:
        for _ in range(calls):
            command(*cells)

    def act_many() -> None:
        for _ in range(calls // ROBOTS):
            agent.act_many(many)

    return {"one": act, "module": decide, "many": act_many}


def _value(each: AgentInput, rng: np.random.Generator) -> Any:  # noqa: ANN401 - a number, a truth, a label, or lists
    if each.kind == "cell":
        return 0
    if each.kind == "truth":
        return False
    numbers = (
        np.floor(rng.uniform(0, 4, each.shape)) if each.kind == "whole number" else rng.random(each.shape)
    )
    return numbers.tolist()
