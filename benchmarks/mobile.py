"""The mobile robot's rollout beside C: sonars, noise, shadows; eighty elementary functions a step."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, cast

import numpy as np
import numpy.typing as npt

import bbsd
from bbsd.compiler import compile_meaning
from bbsd.kernel.keys import keys
from bbsd.solver.random_agents import random_agents
from benchmarks.lifting import KEY, SPECS
from benchmarks.page import Asked, table
from benchmarks.timing import alternated, spread

if TYPE_CHECKING:
    from collections.abc import Callable

    from bbsd.compiler import Problem
    from bbsd.expression.graph import Node
    from benchmarks.lifting import Floats

SPEC = SPECS / "mobile_robot.yaml"
AGENTS = 400
BEHAVIORS, CELLS, SONARS, EYES = 3, 8, 8, 4
TOP_BIT = 1 << 63
CLOSE = 1e-9
BBSD, LIBM, OWN = "bbsd", "C, scalar, with libm", "C, scalar, with bbsd's functions"
ASKED = 0.25


class Wandering(NamedTuple):
    """Agents with one episode each.

    keys (n_agents,) name their streams, words (4 + 1 + 8 + 4,) the draws; tables (n_agents, n_behaviors, n_cells), the
    cells of smaller tables first; structures (n_agents, n_layers), lowest layer first.
    """

    keys: npt.NDArray[np.uint64]
    words: npt.NDArray[np.uint64]
    tables: npt.NDArray[np.uint8]
    structures: npt.NDArray[np.int64]


def section(*, quick: bool) -> tuple[str, list[Asked]]:
    """The text of the section, and what was asked."""
    wandering, bbsd_lives = wanderers(40 if quick else AGENTS)
    ours, calls, notes = bbsd_lives(), {BBSD: bbsd_lives}, {BBSD: ""}
    for name, prepare in ((LIBM, "prepare_mobile"), (OWN, "prepare_mobile_own")):
        try:
            from benchmarks.peers import by_c

            calls[name] = getattr(by_c, prepare)(wandering)
        except (ImportError, OSError) as missing:
            notes[name] = f"missing: {missing}"
        else:
            notes[name] = agreement(calls[name](), ours)
    times = alternated(calls, 3 if quick else 11)
    asked = []
    if LIBM in times:
        figure = float(np.median(times[BBSD] / times[LIBM]))
        asked.append(Asked(f"mobile robot's rollout beside {LIBM}", figure, ASKED))
    return written(len(wandering.keys), times, notes), asked


def wanderers(n_agents: int) -> tuple[Wandering, Callable[[], Floats]]:
    """The workload, and bbsd's kernel ready to live it."""
    problem = compile_meaning(bbsd.load(SPEC).meaning)
    agents, streams = random_agents(problem, KEY, n_agents), keys(KEY, 0, n_agents)
    team = problem.assemble(agents.pools, agents.members, 1)
    tables = np.zeros((n_agents, BEHAVIORS, CELLS), np.uint8)
    for index, pool in enumerate(agents.pools):
        tables[:, index, : pool.shape[1]] = pool[agents.members[:, index]]
    wandering = Wandering(streams, words_of(problem), tables, agents.structures)
    return wandering, lambda: team.episode(streams, agents.structures).returns


def words_of(problem: Problem) -> npt.NDArray[np.uint64]:
    """The names of the draws: of the starting values, then of what is drawn in each step."""
    episode = problem.meaning.episode
    started = [episode.start[name, 0, ()] for name in ("x", "y", "heading", "whim")]
    sensed = [("sonar", 0, (place,)) for place in range(SONARS)] + [
        ("light", 0, (place,)) for place in range(EYES)
    ]
    drawn = [drawn_in(episode.after[slot]) for slot in [("whim", 0, ()), *sensed]]
    return np.array([word_of(node) | TOP_BIT for node in (*started, *drawn)], np.uint64)


def drawn_in(node: Node) -> Node:
    """The only draw in an expression."""
    if node.operation == "draw":
        return node
    [found] = {id(each): each for each in map(_draw_or_none, node.operands) if each is not None}.values()
    return found


def _draw_or_none(node: Node) -> Node | None:
    try:
        return drawn_in(node)
    except ValueError:
        return None


def word_of(node: Node) -> int:
    """The name of a draw."""
    return cast("tuple[str, int]", node.data)[1]


def agreement(theirs: Floats, ours: Floats) -> str:
    """In how many episodes the returns are the same."""
    if np.array_equal(theirs, ours):
        return f"the same bits in all {len(ours)}"
    close = int(np.count_nonzero(np.isclose(theirs, ours, rtol=CLOSE, atol=CLOSE)))
    return f"{close} of {len(ours)} the same to 1e-9"


def written(n_agents: int, times: dict[str, Floats], notes: dict[str, str]) -> str:
    """The section as Markdown."""
    base = times.get(LIBM, times[BBSD])
    rows = []
    for name, note in notes.items():
        if name in times:
            share = spread(times[name] / base)
            faster = float(np.median(times[name] / times[BBSD]))
            rows.append(
                [name, f"{share.median:.3g}", f"({share.low:.3g} to {share.high:.3g})", f"{faster:.3g}", note]
            )
        else:
            rows.append([name, "", "", "", note])
    return "\n".join(
        [
            "## The mobile robot's rollout",
            "",
            (
                f"One episode of each of {n_agents} random agents of `specs/mobile_robot.yaml`, up to 600 steps, until "
                "the lamp is reached. The C port was written by hand from the spec, with branches, and stops with each "
                "episode; bbsd goes on until all of its 40 lanes are through. All draw the same numbers, so the "
                "episodes are the same. The last bits of libm's functions are not bbsd's: a robot could by them sense "
                "another cell once and take another course from there. With bbsd's functions in C nothing differs."
            ),
            "",
            *table(["", "time, C with libm = 1", "", "bbsd is faster by", "returns beside bbsd's"], rows),
        ]
    )
