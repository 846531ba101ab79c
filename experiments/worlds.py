"""The shipped worlds: learned designs beside the hand-made one and random agents: `make worlds`."""

from __future__ import annotations

import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

import bbsd
from bbsd.evaluation import Interval, interval
from bbsd.kernel.keys import keys
from bbsd.kernel.streams import name_word
from experiments.designs import SEEDS, Earnings, earnings, spec_path, verdict

if TYPE_CHECKING:
    from collections.abc import Iterator

WORLDS = ("mobile_robot", "pursuit", "forager", "grid_world")
FRESH = keys(name_word("worlds"), 0, 2000)
"""The episodes that all designs are compared on."""
BUMP = -5
"""The mobile robot's reward for a bump."""
MOST_BUMPS = 0.01
"""Bumps of an episode of the mobile robot, at most. The design by hand has none."""


@dataclass(frozen=True)
class Row:
    """A design of a world beside the hand-made one."""

    world: str
    design: str
    mean: float
    ahead: Interval | None
    """The difference from the hand-made design, paired by episode."""
    seconds: float | None
    holds: bool
    remark: str = ""


def by_hand(world: str) -> tuple[Row, Earnings]:
    """Evaluate the hand-made design."""
    hand = earnings(spec_path(f"{world}_hand"), FRESH)
    remark = lamp_and_bumps(hand)[0] if world == "mobile_robot" else ""
    return Row(world, "by hand", float(hand.returns.mean()), None, None, True, remark), hand


def at_random(world: str, hand: Earnings) -> Row:
    """Evaluate random agents, which should be clearly worse than the hand-made design."""
    evaluation = bbsd.evaluate(spec_path(world), fill="random", agents=200, episodes=20)
    worse = evaluation.ci95[1] < interval(hand.returns).low
    return Row(world, "random agents", evaluation.mean, None, None, worse)


def learned(world: str, seed: int, hand: Earnings, folder: Path) -> Row:
    """Design a world, whose mean return should be at least that of the hand-made design in the same episodes."""
    designed = bbsd.design(spec_path(world), seed=seed, out=folder / f"{world}-{seed}")
    earned = earnings(designed.architecture, FRESH)
    ahead = interval(earned.returns - hand.returns)
    holds, remark = ahead.mean >= 0, ""
    if world == "mobile_robot":
        remark, well = lamp_and_bumps(earned)
        holds = holds and well
    return Row(world, f"seed {seed}", float(earned.returns.mean()), ahead, designed.seconds, holds, remark)


def lamp_and_bumps(earned: Earnings) -> tuple[str, bool]:
    """Return how often the mobile robot reached the lamp, its bumps per episode, and whether both are as claimed.

    The claim: the lamp in at least 95 of 100 episodes, and at most one bump in 100 episodes.
    """
    reached = float(np.mean(earned.terms["arrived"] > 0))
    bumps = abs(float(np.mean(earned.terms["bump"])) / BUMP)
    return f"lamp {reached:.1%}, bumps {bumps:.4f}", bumps <= MOST_BUMPS and reached >= 0.95


def line(row: Row) -> str:
    """Return a row of the table as text."""
    ahead = f"{row.ahead.mean:+.2f} ({row.ahead.low:+.2f} to {row.ahead.high:+.2f})" if row.ahead else ""
    seconds = f"{row.seconds:.1f} s" if row.seconds is not None else ""
    return (
        f"{verdict(row.holds)}  {row.world:<13} {row.design:<14} {row.mean:8.2f}  {ahead:<28} {seconds:>7}  "
        f"{row.remark}"
    ).rstrip()


def rows(world: str, folder: Path) -> Iterator[Row]:
    """Yield all designs of a world, each as soon as it is evaluated."""
    row, hand = by_hand(world)
    yield row
    yield at_random(world, hand)
    for seed in SEEDS:
        yield learned(world, seed, hand, folder)


def main() -> int:
    """Print the table, of the worlds named as arguments or of all; return 1 if a row does not hold."""
    holds = True
    with tempfile.TemporaryDirectory() as name:
        for world in sys.argv[1:] or WORLDS:
            for row in rows(world, Path(name)):
                holds = holds and row.holds
                print(line(row), flush=True)
    return 0 if holds else 1


if __name__ == "__main__":
    sys.exit(main())
