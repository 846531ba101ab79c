"""The lifting rollout beside what a user would pick instead."""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from typing import TYPE_CHECKING

import numpy as np

from benchmarks.report import Goal, Section, table
from benchmarks.timing import alternating_times, spread
from benchmarks.workloads.lifting import ROBOTS, STEPS, lifting

if TYPE_CHECKING:
    from collections.abc import Callable

    from benchmarks.timing import Floats
    from benchmarks.workloads.lifting import Earnings, Workload

AGENTS, EPISODES = 200, 25
TOLERANCE = 1e-9
BBSD = "bbsd"


@dataclass(frozen=True, slots=True)
class Peer:
    """Another program for the same work."""

    name: str
    module: str
    prepare: str = "prepare"
    part: int = 1
    """The peer is given one of so many lanes, and its time is multiplied by it."""
    goal: float | None = None
    """The largest share of the peer's time that bbsd should take."""


PEERS = (
    Peer("C, scalar, as the spec says it", "by_c", "prepare_scalar", goal=0.14),
    Peer("C, scalar, tuned by hand", "by_c", "prepare_tuned"),
    Peer("C, explicit SIMD, the same arctangent", "by_c", "prepare_simd", goal=1.25),
    Peer("Numba, one agent at a time", "by_numba"),
    Peer("NumPy in lock-step", "by_numpy", goal=1 / 15),
    Peer("JAX on the CPU: jit, vmap, scan", "by_jax", goal=1 / 3),
    Peer("a program with DEAP", "by_deap", part=100, goal=1 / 1000),
)


def section(*, quick: bool) -> Section:
    """Measure all peers that are installed, in alternation with bbsd."""
    workload, bbsd = lifting(AGENTS, 3 if quick else EPISODES)
    earnings = bbsd()
    calls, remarks = {BBSD: bbsd}, {}
    for peer in PEERS:
        try:
            calls[peer.name] = prepared(peer, workload.first(lanes_of(peer, workload)))
        except (ImportError, OSError) as missing:
            remarks[peer.name] = f"missing: {missing}"
        else:
            remarks[peer.name] = agreement(calls[peer.name](), earnings)
    times = alternating_times(calls, 3 if quick else 15)
    for peer in PEERS:
        if peer.name in times:
            times[peer.name] *= len(workload) / lanes_of(peer, workload)
    goals = [
        Goal(
            f"lifting rollout beside {peer.name}",
            float(np.median(times[BBSD] / times[peer.name])),
            peer.goal,
        )
        for peer in PEERS
        if peer.goal and peer.name in times
    ]
    return Section("The lifting rollout", blocks(workload, times, remarks), goals)


def lanes_of(peer: Peer, workload: Workload) -> int:
    """Return the number of lanes that a peer is given."""
    return max(len(workload) // peer.part, 1)


def prepared(peer: Peer, workload: Workload) -> Callable[[], Earnings]:
    """Return the peer's call; raise ImportError or OSError where it is missing."""
    prepare = getattr(import_module(f"benchmarks.peers.{peer.module}"), peer.prepare)
    call: Callable[[], Earnings] = prepare(workload)
    return call


def agreement(peer: Earnings, bbsd: Earnings) -> str:
    """Say in how many lanes the returns differ, as they may where an angle's last bit decides a comparison."""
    ours = bbsd.returns[: len(peer.returns)]
    if np.array_equal(peer.returns, ours):
        return "the same bits"
    differ = int(np.count_nonzero(~np.isclose(peer.returns, ours, rtol=TOLERANCE, atol=0)))
    return f"{differ} of {len(ours)} lanes differ" if differ else "the same to 1e-9"


def blocks(workload: Workload, times: dict[str, Floats], remarks: dict[str, str]) -> list[str]:
    """Return the text and the table of the section."""
    scalar = times.get(PEERS[0].name, times[BBSD])
    rows = [row(BBSD, times, scalar, "")]
    rows += [
        row(peer.name, times, scalar, remarks[peer.name])
        if peer.name in times
        else [peer.name, "", "", "", remarks[peer.name]]
        for peer in PEERS
    ]
    nanoseconds = 1e9 * float(np.median(times[BBSD])) / workload.robot_steps
    return [
        (
            f"One episode of each of {len(workload)} agents ({AGENTS} random agents of "
            f"`specs/object_lifting.yaml` in {len(workload) // AGENTS} episodes each), {STEPS} steps, {ROBOTS} "
            "robots; returns and credit. All programs start from the same heights. The generated kernel is the one "
            "that `bbsd design` runs, in strict floating point. The program with DEAP is given a hundredth of the "
            "work, and its time is multiplied. Times of the processor, medians of alternating rounds, quartiles in "
            f"brackets. Here bbsd took {nanoseconds:.2f} ns for each step of a robot."
        ),
        table(["", "time, scalar C = 1", "", "bbsd is faster by", "returns beside bbsd's"], rows),
    ]


def row(name: str, times: dict[str, Floats], scalar: Floats, remark: str) -> list[str]:
    """Return a row of the table."""
    share, faster = spread(times[name] / scalar), float(np.median(times[name] / times[BBSD]))
    return [name, f"{share.median:.3g}", f"({share.low:.3g} to {share.high:.3g})", f"{faster:.3g}", remark]
