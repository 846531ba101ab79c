"""The lifting rollout beside what a user would pick instead."""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from typing import TYPE_CHECKING

import numpy as np

from benchmarks.lifting import ROBOTS, STEPS, lifting
from benchmarks.page import Asked, table
from benchmarks.timing import alternated, spread

if TYPE_CHECKING:
    from collections.abc import Callable

    from benchmarks.lifting import Floats, Lived, Workload

AGENTS, EPISODES = 200, 25
CLOSE = 1e-9
BBSD = "bbsd"


@dataclass(frozen=True, slots=True)
class Peer:
    """Someone else's way to do it, and what the issue asks: bbsd's time as a share of the peer's."""

    name: str
    module: str
    prepare: str = "prepare"
    part: int = 1
    """It is given one lane in so many."""
    asked: float | None = None


PEERS = (
    Peer("C, scalar, as the spec says it", "by_c", "prepare_scalar", asked=0.14),
    Peer("C, scalar, tuned by hand", "by_c", "prepare_tuned"),
    Peer("C, explicit SIMD, the same arctangent", "by_c", "prepare_simd", asked=1.25),
    Peer("Numba, one agent at a time", "by_numba"),
    Peer("NumPy in lock-step", "by_numpy", asked=1 / 15),
    Peer("JAX on the CPU: jit, vmap, scan", "by_jax", asked=1 / 3),
    Peer("a program with DEAP", "by_deap", part=100, asked=1 / 1000),
)


def section(*, quick: bool) -> tuple[str, list[Asked]]:
    """The text of the section, and what was asked."""
    workload, bbsd = lifting(AGENTS, 3 if quick else EPISODES)
    lived = bbsd()
    calls, notes = {BBSD: bbsd}, {}
    for peer in PEERS:
        part = workload.first(max(len(workload) // peer.part, 1))
        try:
            calls[peer.name] = prepared(peer, part)
        except (ImportError, OSError) as missing:
            notes[peer.name] = f"missing: {missing}"
        else:
            notes[peer.name] = agreement(calls[peer.name](), lived)
    times = alternated(calls, 3 if quick else 15)
    for peer in PEERS:
        if peer.name in times:
            times[peer.name] *= len(workload) / max(len(workload) // peer.part, 1)
    asked = [
        Asked(
            f"lifting rollout beside {peer.name}",
            float(np.median(times[BBSD] / times[peer.name])),
            peer.asked,
        )
        for peer in PEERS
        if peer.asked and peer.name in times
    ]
    return written(workload, times, notes), asked


def prepared(peer: Peer, workload: Workload) -> Callable[[], Lived]:
    """The peer's call; ImportError or OSError where it is missing."""
    prepare = getattr(import_module(f"benchmarks.peers.{peer.module}"), peer.prepare)
    call: Callable[[], Lived] = prepare(workload)
    return call


def agreement(peer: Lived, lived: Lived) -> str:
    """In how many lanes a peer earned something else; a threshold may decide otherwise by the last bit of an angle."""
    ours = lived.returns[: len(peer.returns)]
    if np.array_equal(peer.returns, ours):
        return "the same bits"
    differ = int(np.count_nonzero(~np.isclose(peer.returns, ours, rtol=CLOSE, atol=0)))
    return f"{differ} of {len(ours)} lanes differ" if differ else "the same to 1e-9"


def written(workload: Workload, times: dict[str, Floats], notes: dict[str, str]) -> str:
    """The section as Markdown."""
    scalar = times.get(PEERS[0].name, times[BBSD])
    rows = [row(BBSD, times, scalar, "")]
    rows += [
        row(peer.name, times, scalar, notes[peer.name])
        if peer.name in times
        else [peer.name, "", "", "", notes[peer.name]]
        for peer in PEERS
    ]
    nanoseconds = 1e9 * float(np.median(times[BBSD])) / workload.robot_steps
    return "\n".join(
        [
            "## The lifting rollout",
            "",
            (
                f"One episode of each of {len(workload)} agents ({AGENTS} random agents of "
                f"`specs/object_lifting.yaml` in {len(workload) // AGENTS} episodes each), {STEPS} steps, {ROBOTS} "
                "robots; returns and credit. All start from the same heights. The generated kernel is the one that "
                "`bbsd design` runs, in strict floating point. DEAP's program lives a hundredth of it. Times of the "
                "processor, medians of alternated rounds, quartiles in brackets. Here bbsd took "
                f"{nanoseconds:.2f} ns a robot and step."
            ),
            "",
            *table(["", "time, scalar C = 1", "", "bbsd is faster by", "returns beside bbsd's"], rows),
        ]
    )


def row(name: str, times: dict[str, Floats], scalar: Floats, note: str) -> list[str]:
    """A line of the table."""
    share, faster = spread(times[name] / scalar), float(np.median(times[name] / times[BBSD]))
    return [name, f"{share.median:.3g}", f"({share.low:.3g} to {share.high:.3g})", f"{faster:.3g}", note]
