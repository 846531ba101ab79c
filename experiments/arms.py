"""The paper's arms of the lifting task, and its claims L1 to L5 on them: `make arms`.

An arm is a shipped spec, maybe with one setting changed. As in Fig. 13 to 21 the figures are those of the whole
population, not of its best: the mean fitness and lifetime fitness of the agents of the last five generations.
"""

from __future__ import annotations

import json
import sys
import tempfile
from collections import Counter
from dataclasses import dataclass
from math import sqrt
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

import bbsd
from bbsd.expression.node_data import Slot
from experiments.designs import Floats, spec_path, verdict
from experiments.quantiles import SEEDS, above_line, quartiles_text

if TYPE_CHECKING:
    from collections.abc import Sequence

LAST = 5
"""Generations that a figure is the mean of."""
CLOSE = 0.95
"""The share of the hand-made design's return from which on another counts as close to it."""
COLLAPSED = 150
"""A population below this has lost the task: the others are above 220, random agents near -338."""

NO_CULTURE, VALUE = "design.culture=none", "design.sharing=value"
DIFFERENCE = "design.sharing=difference"
UNJUDGED = ("design.answer.candidates=1", "design.answer.episodes=100", "design.answer.judged=100")
"""Settings that spend no time on the final race, since only the population's figures count here."""
HIGHER = "environment.state.height=2.5 if robot == 0 else 2"

ARMS = {
    "order learned, no culture": ("paper/object_lifting_order", [NO_CULTURE]),
    "order learned, culture": ("paper/object_lifting_order", []),
    "uniform, order given": ("paper/object_lifting_rules", []),
    "uniform, no culture": ("paper/object_lifting_no_culture", []),
    "uniform, culture": ("paper/object_lifting", []),
    "value, order given": ("paper/object_lifting_rules", [VALUE]),
    "value, no culture": ("paper/object_lifting_value", [NO_CULTURE]),
    "value, culture": ("paper/object_lifting_value", []),
    "difference, no culture": ("paper/object_lifting", [DIFFERENCE, NO_CULTURE]),
    "difference, culture": ("paper/object_lifting", [DIFFERENCE]),
}


@dataclass(frozen=True)
class Arm:
    """Figures of an arm's populations, one for each seed; `spread` is the standard deviation within a population."""

    fitness: Floats
    lifetime: Floats
    spread: Floats
    curve: Floats
    """The mean fitness in each generation, (n_seeds, n_generations)."""

    def at(self, generation: int) -> Floats:
        """Return the mean fitness in a generation, which counts from 1, one for each seed."""
        column: Floats = self.curve[:, generation - 1]
        return column


@dataclass(frozen=True)
class Lift:
    """An episode in which robot 0 starts higher: mean speeds while the object is tilted, and how it ends."""

    higher: float
    lower: float
    holding: str
    """Who controls the higher robot most of that time."""
    hurrying: float
    """The share of that time in which hurry_up controls the two lower robots."""
    stands: bool
    """Whether all robots end within 0.2 of the goal, without speed."""


def population(spec: str, overrides: Sequence[str], folder: Path) -> Arm:
    """Design with every seed and return the figures of the last generations."""
    rows = []
    for seed in SEEDS:
        designed = bbsd.design(
            spec_path(spec), seed=seed, out=folder / str(seed), set=(*overrides, *UNJUDGED)
        )
        lines = (designed.folder / "metrics.jsonl").read_text().splitlines()
        rows.append([[json.loads(line)[key] for key in ("mean", "lifetime", "sd")] for line in lines])
    return arm_of(np.array(rows))


def arm_of(rows: Floats) -> Arm:
    """Return the figures of an arm from mean, lifetime fitness and spread, (n_seeds, n_generations, 3)."""
    fitness, lifetime, spread = rows[:, -LAST:].mean(axis=1).T
    return Arm(fitness, lifetime, spread, rows[:, :, 0])


def lift(seed: int, folder: Path) -> Lift:
    """Design the task with a seed, and run an episode of the design in which robot 0 starts higher (Fig. 22)."""
    designed = bbsd.design(spec_path("paper/object_lifting"), seed=seed, out=folder / f"lift-{seed}")
    episode = bbsd.trace(designed.architecture, set=[HIGHER])
    speeds, heights = (
        np.array([episode.values[Slot(name, robot)] for robot in range(3)], dtype=float)
        for name in ("speed", "height")
    )
    tilted = np.array(episode.values[Slot("tilted", 0)], dtype=float) > 0
    hurrying = np.array([episode.controlling[robot] for robot in (1, 2)]) == "hurry_up"
    holding, _ = Counter(np.array(episode.controlling[0])[tilted].tolist()).most_common(1)[0]
    stands = bool(np.all(np.abs(heights[:, -1] - 3) < 0.2) and np.all(speeds[:, -1] == 0))
    lower = float(speeds[1:, tilted].mean())
    return Lift(float(speeds[0, tilted].mean()), lower, holding, float(hurrying[:, tilted].mean()), stands)


def arm_line(name: str, arm: Arm) -> str:
    """Return a row of the table of arms as text."""
    fitness, lifetime = quartiles_text(arm.fitness), quartiles_text(arm.lifetime)
    return f"{name:<26} {fitness:<25} {arm.fitness.min():7.1f}   {lifetime:<25} {np.median(arm.spread):6.1f}"


def collapse_lines(arms: dict[str, Arm]) -> list[str]:
    """Return the seeds whose populations collapsed, arm by arm."""
    lines = []
    for name, arm in arms.items():
        collapsed = [
            f"seed {seed} ({value:.0f})"
            for seed, value in zip(SEEDS, arm.fitness, strict=True)
            if value < COLLAPSED
        ]
        if collapsed:
            lines.append(f"collapsed: {name}: {', '.join(collapsed)}")
    return lines


def close_line(claim: str, arms: Sequence[Floats], hand: float) -> str:
    """Return a claim that arms are close to the hand-made design, judged by the least of their medians."""
    least = min(float(np.median(arm)) for arm in arms) / hand
    seeds = np.count_nonzero(np.min(arms, axis=0) >= CLOSE * hand)
    return f"{verdict(least >= CLOSE):<6} {claim:<66} at least {least:.1%}, {seeds} of {len(SEEDS)}"


def claim_lines(arms: dict[str, Arm], hand: float, hand_spread: float) -> list[str]:
    """Return what the paper says of these arms (Fig. 13 to 19), each with its verdict."""
    uniform, cultured = arms["uniform, no culture"], arms["uniform, culture"]
    value, value_cultured = arms["value, no culture"], arms["value, culture"]
    value_fixed = arms["value, order given"]
    learned, fixed = arms["order learned, no culture"], arms["uniform, order given"]
    lifetime_gain, value_lifetime_gain = (
        with_culture.lifetime - without.lifetime
        for with_culture, without in ((cultured, uniform), (value_cultured, value))
    )
    gain, value_gain = (
        lifetime - (with_culture.fitness - without.fitness)
        for lifetime, with_culture, without in (
            (lifetime_gain, cultured, uniform),
            (value_lifetime_gain, value_cultured, value),
        )
    )
    zero = np.zeros(len(SEEDS))
    return [
        close_line("L1: everything learned is close to the hand-made design", [uniform.fitness], hand),
        above_line("L1: no culture: uniform sharing is above value-based", uniform.fitness, value.fitness),
        close_line("L1: a learned order of hand-made modules is close to it", [learned.fitness], hand),
        above_line("L1: with more variance among agents", learned.spread, zero + hand_spread),
        close_line(
            "L2: all arms with uniform sharing are close to it",
            [uniform.fitness, cultured.fitness, fixed.fitness],
            hand,
        ),
        above_line("L2: lifetime fitness is higher with culture", cultured.lifetime, uniform.lifetime),
        above_line("L2: and gains more by culture than final fitness does", gain, zero),
        above_line("L3: in generation 1 learners lead", uniform.at(1), fixed.at(1)),
        above_line("L3: in generation 5 learners with culture do", cultured.at(5), fixed.at(5)),
        above_line("L3: in generation 15 the order given leads", fixed.at(15), uniform.at(15)),
        above_line(
            "L4: order given: uniform sharing is above value-based", fixed.fitness, value_fixed.fitness
        ),
        above_line(
            "L4: with culture: uniform is above value-based", cultured.fitness, value_cultured.fitness
        ),
        above_line("L4: value-based: fitness is higher with culture", value_cultured.fitness, value.fitness),
        above_line(
            "L4: value-based: lifetime fitness is higher with culture",
            value_cultured.lifetime,
            value.lifetime,
        ),
        above_line("L4: value-based: and gains more than final fitness", value_gain, zero),
        above_line(
            "L4: culture adds more to lifetime fitness under uniform sharing",
            lifetime_gain,
            value_lifetime_gain,
        ),
        above_line(
            "L4: value-based, no culture: the order given is above learned ones",
            value_fixed.fitness,
            value.fitness,
        ),
    ]


def lift_lines(lifts: Sequence[Lift]) -> list[str]:
    """Return what the paper says of an episode in which robot 1 (here 0) starts higher (Fig. 22), with the counts."""
    waits = sum(one.higher < one.lower / 2 for one in lifts)
    hurries = sum(one.hurrying > 0.5 for one in lifts)
    stands = sum(one.stands for one in lifts)
    speeds = [float(np.mean([getattr(one, name) for one in lifts])) for name in ("higher", "lower")]
    mean_speeds, count = f"(mean speeds {speeds[0]:.2f} and {speeds[1]:.2f})", len(lifts)
    holding = Counter(one.holding for one in lifts).most_common()
    return [
        f"L5     while tilted, the higher robot is at most half as fast: {waits} of {count} {mean_speeds}",
        f"L5     who controls it most of that time: {', '.join(f'{name} {times}' for name, times in holding)}",
        f"L5     hurry_up controls the lower robots most of that time: {hurries} of {count}",
        f"L5     all stop at the goal: {stands} of {count}",
    ]


def main() -> int:
    """Print the arms and the claims, each as soon as its figures are there."""
    hand = bbsd.evaluate(spec_path("object_lifting_hand"), episodes=20_000)
    spread = hand.sd / sqrt(LAST)  # agents' fitness is the mean of five episodes
    print(f"{'':<26} {'fitness':<25} {'least':>7}   {'lifetime fitness':<25} {'sd':>6}")
    by_hand = f"{hand.mean:.1f} ({hand.ci95[0]:.1f} to {hand.ci95[1]:.1f})"
    print(f"{'by hand':<26} {by_hand:<25} {'':7}   {'':<25} {spread:6.1f}", flush=True)
    arms = {}
    with tempfile.TemporaryDirectory() as name:
        for arm, (spec, overrides) in ARMS.items():
            arms[arm] = population(spec, overrides, Path(name) / arm)
            print(arm_line(arm, arms[arm]), flush=True)
        print("\n".join(["", *collapse_lines(arms), *claim_lines(arms, hand.mean, spread)]), flush=True)
        print("\n".join(lift_lines([lift(seed, Path(name)) for seed in SEEDS])))
    return 0


if __name__ == "__main__":
    sys.exit(main())
