"""The paper's arms of the lifting task, and its claims L1, L2, L4 and L5 held against them: `make arms`.

An arm is a shipped spec, maybe with one setting changed. As in Fig. 13 to 21 the figures are those of the whole
population, not of its best: the mean fitness and lifetime fitness of the agents of the last five generations. The
intervals are over seeds.
"""

from __future__ import annotations

import json
import sys
import tempfile
from dataclasses import dataclass
from math import sqrt
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

import bbsd

if TYPE_CHECKING:
    from collections.abc import Sequence

SPECS = Path(__file__).parents[1] / "specs"
SEEDS = range(10)
STUDENT_95 = 2.262
"""The quantile of Student's t for the 95 % interval of the mean of ten."""
LAST = 5
CLOSE = 0.95
"""The part of the hand-made design's return from which on another counts as close to it."""

NO_CULTURE, VALUE = "design.culture=none", "design.sharing=value"
UNJUDGED = ("design.answer.candidates=1", "design.answer.episodes=100", "design.answer.judged=100")
"""Only the population's figures count here, so no time is spent on the final race."""
HIGHER = "environment.state.height=2.5 if robot == 0 else 2"

ARMS = {
    "order learned, no culture": ("object_lifting_order", [NO_CULTURE]),
    "order learned, culture": ("object_lifting_order", []),
    "uniform, order given": ("object_lifting_rules", []),
    "uniform, no culture": ("object_lifting_no_culture", []),
    "uniform, culture": ("object_lifting", []),
    "value, order given": ("object_lifting_rules", [VALUE]),
    "value, no culture": ("object_lifting_value", [NO_CULTURE]),
    "value, culture": ("object_lifting_value", []),
}

Floats = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Arm:
    """What the populations of an arm earned, one figure a seed; `spread` is the deviation within a population."""

    fitness: Floats
    lifetime: Floats
    spread: Floats


@dataclass(frozen=True)
class Lift:
    """An episode in which robot 0 starts higher: mean speeds while the object is tilted, and how it ends."""

    higher: float
    lower: float
    hurrying: float
    """The part of that time in which hurry_up controls the two lower robots."""
    stands: bool
    """Whether all robots end within 0.2 of the goal, without speed."""


def population(spec: str, overrides: Sequence[str], folder: Path) -> Arm:
    """Design with every seed and read the last generations' figures."""
    rows = []
    for seed in SEEDS:
        found = bbsd.design(
            SPECS / f"{spec}.yaml", seed=seed, out=folder / str(seed), overrides=(*overrides, *UNJUDGED)
        )
        lines = (found.folder / "metrics.jsonl").read_text().splitlines()[-LAST:]
        rows.append([[json.loads(line)[key] for key in ("mean", "lifetime", "sd")] for line in lines])
    return Arm(*np.mean(rows, axis=1).T)


def lift(seed: int, folder: Path) -> Lift:
    """Design the task with a seed, and let robot 0 of what comes of it start higher (Fig. 22)."""
    designed = bbsd.design(SPECS / "object_lifting.yaml", seed=seed, out=folder / f"lift-{seed}")
    episode = bbsd.trace(designed.architecture, overrides=[HIGHER])
    speeds, heights = (
        np.array([episode.values[name, robot, ()] for robot in range(3)], dtype=float)
        for name in ("speed", "height")
    )
    tilted = np.array(episode.values["tilted", 0, ()], dtype=float) > 0
    hurrying = np.array([episode.controlling[robot] for robot in (1, 2)]) == "hurry_up"
    stands = bool(np.all(np.abs(heights[:, -1] - 3) < 0.2) and np.all(speeds[:, -1] == 0))
    lower = float(speeds[1:, tilted].mean())
    return Lift(float(speeds[0, tilted].mean()), lower, float(hurrying[:, tilted].mean()), stands)


def spanned(values: Floats) -> tuple[float, float, float]:
    """The mean over seeds and its 95 % interval."""
    half = STUDENT_95 * float(values.std(ddof=1)) / sqrt(len(values))
    return float(values.mean()), float(values.mean()) - half, float(values.mean()) + half


def shown(values: Floats, sign: str = "") -> str:
    """A mean over seeds with its interval."""
    mean, low, high = (f"{value:{sign}.1f}" for value in spanned(values))
    return f"{mean} ({low} to {high})"


def line(name: str, arm: Arm) -> str:
    """One row of the table of arms."""
    return f"{name:<26} {shown(arm.fitness):<25} {arm.fitness.min():7.1f}   {shown(arm.lifetime):<25}"


def more(claim: str, what: Floats, than: Floats) -> str:
    """A claim that one arm is above another, by the paired differences: holds, fails, or open."""
    _, low, high = spanned(what - than)
    verdict = "holds" if low > 0 else "fails" if high < 0 else "open"
    return f"{verdict:<6} {claim:<66} {shown(what - than, '+')}"


def near(claim: str, arms: Sequence[Floats], hand: float) -> str:
    """A claim that arms are close to the hand-made design."""
    least = min(spanned(arm)[0] for arm in arms) / hand
    return f"{'holds' if least >= CLOSE else 'fails':<6} {claim:<66} at least {least:.1%}"


def claims(arms: dict[str, Arm], hand: float) -> list[str]:
    """What the paper says of these arms (Fig. 13, 14, 18)."""
    uniform, cultured = arms["uniform, no culture"], arms["uniform, culture"]
    value, value_cultured = arms["value, no culture"], arms["value, culture"]
    value_fixed = arms["value, order given"]
    learned, fixed = arms["order learned, no culture"], arms["uniform, order given"]
    gain, value_gain = (
        with_culture.lifetime - without.lifetime - (with_culture.fitness - without.fitness)
        for with_culture, without in ((cultured, uniform), (value_cultured, value))
    )
    none = np.zeros(len(SEEDS))
    return [
        near("L1: everything learned is close to the hand-made design", [uniform.fitness], hand),
        more("L1: no culture: uniform sharing is above value-based", uniform.fitness, value.fitness),
        near("L1: a learned order of hand-made modules is close to it", [learned.fitness], hand),
        near(
            "L2: all arms with uniform sharing are close to it",
            [uniform.fitness, cultured.fitness, fixed.fitness],
            hand,
        ),
        more("L2: lifetime fitness is higher with culture", cultured.lifetime, uniform.lifetime),
        more("L2: and gains more by culture than final fitness does", gain, none),
        more("L4: order given: uniform sharing is above value-based", fixed.fitness, value_fixed.fitness),
        more("L4: with culture: uniform is above value-based", cultured.fitness, value_cultured.fitness),
        more("L4: value-based: fitness is higher with culture", value_cultured.fitness, value.fitness),
        more(
            "L4: value-based: lifetime fitness is higher with culture",
            value_cultured.lifetime,
            value.lifetime,
        ),
        more("L4: value-based: and gains more than final fitness", value_gain, none),
    ]


def higher(lifts: Sequence[Lift]) -> list[str]:
    """What the paper says of an episode in which robot 1 (here 0) starts higher (Fig. 22)."""
    waits = sum(each.higher < each.lower / 2 for each in lifts)
    hurries = sum(each.hurrying > 0.5 for each in lifts)
    stands = sum(each.stands for each in lifts)
    speeds = [float(np.mean([getattr(each, name) for each in lifts])) for name in ("higher", "lower")]
    mean_speeds, count = f"(mean speeds {speeds[0]:.2f} and {speeds[1]:.2f})", len(lifts)
    return [
        f"L5     while tilted, the higher robot is at most half as fast: {waits} of {count} {mean_speeds}",
        f"L5     hurry_up controls the lower robots most of that time: {hurries} of {count}",
        f"L5     all stop at the goal: {stands} of {count}",
    ]


def main() -> int:
    """Print the arms and the claims, each as soon as it is known."""
    hand = bbsd.evaluate(SPECS / "object_lifting_hand.yaml", episodes=20_000)
    print(f"{'':<26} {'fitness':<25} {'least':>7}   lifetime fitness")
    print(f"{'by hand':<26} {hand.mean:.1f} ({hand.ci95[0]:.1f} to {hand.ci95[1]:.1f})", flush=True)
    arms = {}
    with tempfile.TemporaryDirectory() as name:
        for arm, (spec, overrides) in ARMS.items():
            arms[arm] = population(spec, overrides, Path(name) / arm)
            print(line(arm, arms[arm]), flush=True)
        print("\n".join(["", *claims(arms, hand.mean)]), flush=True)
        print("\n".join(higher([lift(seed, Path(name)) for seed in SEEDS])))
    return 0


if __name__ == "__main__":
    sys.exit(main())
