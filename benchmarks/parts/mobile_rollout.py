"""The mobile robot's rollout beside C: sonars, noise, shadows; eighty elementary functions a step."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from benchmarks.peers import by_c
from benchmarks.report import Goal, Section, table
from benchmarks.timing import alternating_times, spread
from benchmarks.workloads.mobile_robot import mobile_robot

if TYPE_CHECKING:
    from benchmarks.timing import Floats

AGENTS = 400
TOLERANCE = 1e-9
BBSD, LIBM, SAME_FUNCTIONS = "bbsd", "C, scalar, with libm", "C, scalar, with bbsd's functions"
PEERS = {LIBM: by_c.prepare_mobile, SAME_FUNCTIONS: by_c.prepare_mobile_same_functions}
GOAL = 0.25
"""The largest share of the time of C with libm that bbsd should take."""


def section(*, quick: bool) -> Section:
    """Measure the two programs in C in alternation with bbsd."""
    workload, bbsd = mobile_robot(40 if quick else AGENTS)
    returns, calls, remarks = bbsd(), {BBSD: bbsd}, {BBSD: ""}
    for name, prepare in PEERS.items():
        try:
            calls[name] = prepare(workload)
        except OSError as missing:
            remarks[name] = f"missing: {missing}"
        else:
            remarks[name] = agreement(calls[name](), returns)
    times = alternating_times(calls, 3 if quick else 11)
    goals = []
    if LIBM in times:
        figure = float(np.median(times[BBSD] / times[LIBM]))
        goals.append(Goal(f"mobile robot's rollout beside {LIBM}", figure, GOAL))
    return Section("The mobile robot's rollout", blocks(len(workload.keys), times, remarks), goals)


def agreement(peer: Floats, bbsd: Floats) -> str:
    """Say in how many episodes the returns are the same."""
    if np.array_equal(peer, bbsd):
        return f"the same bits in all {len(bbsd)}"
    close = int(np.count_nonzero(np.isclose(peer, bbsd, rtol=TOLERANCE, atol=TOLERANCE)))
    return f"{close} of {len(bbsd)} the same to 1e-9"


def blocks(n_agents: int, times: dict[str, Floats], remarks: dict[str, str]) -> list[str]:
    """Return the text and the table of the section."""
    base = times.get(LIBM, times[BBSD])
    rows = []
    for name, remark in remarks.items():
        if name in times:
            share = spread(times[name] / base)
            faster = float(np.median(times[name] / times[BBSD]))
            quartiles = f"({share.low:.3g} to {share.high:.3g})"
            rows.append([name, f"{share.median:.3g}", quartiles, f"{faster:.3g}", remark])
        else:
            rows.append([name, "", "", "", remark])
    return [
        (
            f"One episode of each of {n_agents} random agents of `specs/mobile_robot.yaml`, up to 600 steps, until "
            "the lamp is reached. The program in C was written by hand from the spec, with branches, and stops with "
            "each episode; bbsd continues until all of its 40 lanes have ended. All draw the same numbers, so the "
            "episodes are the same. The last bits of libm's functions are not those of bbsd's: because of them a "
            "robot could once sense another cell and take another course from there. With bbsd's functions in C "
            "nothing differs."
        ),
        table(["", "time, C with libm = 1", "", "bbsd is faster by", "returns beside bbsd's"], rows),
    ]
