"""The shipped worlds: the learned designs against the hand-made one and random agents. `make worlds`."""

from __future__ import annotations

import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

import bbsd
from bbsd.architecture import given_architecture
from bbsd.compiler import compile_meaning
from bbsd.evaluation import Interval, agents_of, detailed_outcomes, interval
from bbsd.kernel.keys import keys
from bbsd.kernel.streams import name_word

if TYPE_CHECKING:
    from collections.abc import Iterator

SPECS = Path(__file__).parents[1] / "specs"
WORLDS = ("mobile_robot", "pursuit", "forager", "grid_world")
SEEDS = range(10)
FRESH = keys(name_word("worlds"), 0, 2000)
BUMP = -5
"""What the mobile robot gets for a bump."""

Floats = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Lived:
    """What a finished design earned in each of the fresh episodes that all designs share."""

    returns: Floats
    terms: dict[str, Floats]


@dataclass(frozen=True)
class Row:
    """A design of a world beside the hand-made one."""

    world: str
    design: str
    mean: float
    ahead: Interval | None
    """Of the hand-made design, paired by episode."""
    seconds: float | None
    holds: bool
    remark: str = ""


def lived(path: Path) -> Lived:
    """Let a finished design live the fresh episodes."""
    loaded = bbsd.load(path)
    problem = compile_meaning(loaded.meaning)
    generation = loaded.spec.design.coevolution.generations
    outcomes = list(detailed_outcomes(problem, agents_of([given_architecture(problem)]), FRESH, generation))
    terms = np.concatenate([each.terms for each in outcomes])
    return Lived(
        np.concatenate([each.returns for each in outcomes]),
        dict(zip(problem.meaning.episode.reward, terms.T, strict=True)),
    )


def by_hand(world: str) -> tuple[Row, Lived]:
    """The hand-made design."""
    found = lived(SPECS / f"{world}_hand.yaml")
    remark = lamp_and_bumps(found)[0] if world == "mobile_robot" else ""
    return Row(world, "by hand", float(found.returns.mean()), None, None, True, remark), found


def at_random(world: str, hand: Lived) -> Row:
    """Random agents: clearly worse than the hand-made design."""
    found = bbsd.evaluate(SPECS / f"{world}.yaml", fill="random", agents=200, episodes=20)
    worse = found.ci95[1] < interval(hand.returns).low
    return Row(world, "random agents", found.mean, None, None, worse)


def learned(world: str, seed: int, hand: Lived, folder: Path) -> Row:
    """A learned design: at least as good as the hand-made one, by the mean over the episodes that both lived."""
    designed = bbsd.design(SPECS / f"{world}.yaml", seed=seed, out=folder / f"{world}-{seed}")
    found = lived(designed.architecture)
    ahead = interval(found.returns - hand.returns)
    holds, remark = ahead.mean >= 0, ""
    if world == "mobile_robot":
        remark, well = lamp_and_bumps(found, hand)
        holds = holds and well
    return Row(world, f"seed {seed}", float(found.returns.mean()), ahead, designed.seconds, holds, remark)


def lamp_and_bumps(found: Lived, hand: Lived | None = None) -> tuple[str, bool]:
    """How often the mobile robot reached the lamp, its bumps an episode, and whether that is as claimed.

    At least 95 of 100 episodes, and not more bumps than by hand, by the paired 95 % interval.
    """
    reached = float(np.mean(found.terms["arrived"] > 0))
    bumped = found.terms["bump"]
    few = hand is None or interval(bumped - hand.terms["bump"]).high >= 0
    return f"lamp {reached:.1%}, bumps {abs(np.mean(bumped) / BUMP):.4f}", few and reached >= 0.95


def line(row: Row) -> str:
    """One row of the table."""
    ahead = f"{row.ahead.mean:+.2f} ({row.ahead.low:+.2f} to {row.ahead.high:+.2f})" if row.ahead else ""
    seconds = f"{row.seconds:.1f} s" if row.seconds is not None else ""
    verdict = "holds" if row.holds else "FAILS"
    return (
        f"{verdict}  {row.world:<13} {row.design:<14} {row.mean:8.2f}  {ahead:<28} {seconds:>7}  {row.remark}"
    ).rstrip()


def rows(world: str, folder: Path) -> Iterator[Row]:
    """All designs of a world, each as soon as it is known."""
    first, hand = by_hand(world)
    yield first
    yield at_random(world, hand)
    for seed in SEEDS:
        yield learned(world, seed, hand, folder)


def main() -> int:
    """Print the table, of the worlds named as arguments or of all; 1 if a row does not hold."""
    holds = True
    with tempfile.TemporaryDirectory() as name:
        for world in sys.argv[1:] or WORLDS:
            for row in rows(world, Path(name)):
                holds = holds and row.holds
                print(line(row), flush=True)
    return 0 if holds else 1


if __name__ == "__main__":
    sys.exit(main())
