"""The paper's arms of the abstract problem, and its claims A1, A2 and A4 on them: `make arms`.

The figures are means of the whole population, generation by generation, as in Fig. 5, 6 and 9. A lifetime's 100
episodes all count, so fitness and lifetime fitness are the same here.
"""

from __future__ import annotations

import json
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

import bbsd
from experiments.arms import NO_CULTURE, UNJUDGED, VALUE
from experiments.designs import Floats, spec_path, verdict
from experiments.quantiles import SEEDS, above_line, difference_text, quartiles_text

if TYPE_CHECKING:
    from collections.abc import Sequence

UNIFORM = "design.sharing=uniform"
ARMS = {
    "uniform, order given": ("paper/abstract_fixed", [UNIFORM]),
    "uniform, no culture": ("paper/abstract", [UNIFORM, NO_CULTURE]),
    "uniform, culture": ("paper/abstract", [UNIFORM]),
    "value, order given": ("paper/abstract_fixed", [VALUE]),
    "value, no culture": ("paper/abstract", [VALUE, NO_CULTURE]),
    "value, culture": ("paper/abstract", [VALUE]),
}
SHOWN = (1, 20, 50, 100, 200)
"""Generations of which figures are shown."""
NEAR = 0.95
"""The mean reward from which on a population counts as close to +1."""


def curves(spec: str, overrides: Sequence[str], folder: Path) -> Floats:
    """Design with every seed and return the mean fitness of each generation, (n_seeds, n_generations)."""
    rows = []
    for seed in SEEDS:
        designed = bbsd.design(
            spec_path(spec), seed=seed, out=folder / str(seed), set=(*overrides, *UNJUDGED)
        )
        lines = (designed.folder / "metrics.jsonl").read_text().splitlines()
        rows.append([json.loads(line)["mean"] for line in lines])
    return np.array(rows)


def at(arm: Floats, generation: int) -> Floats:
    """Return the figures of a generation, which counts from 1, one for each seed."""
    column: Floats = arm[:, generation - 1]
    return column


def arm_line(name: str, arm: Floats) -> str:
    """Return a row of the table of arms as text."""
    cells = " ".join(f"{np.median(at(arm, generation)):7.2f}" for generation in SHOWN[:-1])
    return f"{name:<22} {cells}   {quartiles_text(at(arm, SHOWN[-1]), 2):<22} {at(arm, SHOWN[-1]).min():6.2f}"


def near_line(claim: str, arm: Floats) -> str:
    """Return a claim that an arm ends close to +1, judged by its median."""
    median = float(np.median(at(arm, SHOWN[-1])))
    return f"{verdict(median >= NEAR):<6} {claim:<66} {median:.3f}"


def claim_lines(arms: dict[str, Floats]) -> list[str]:
    """Return what the paper says of these arms (Fig. 5, 6, 9), each with its verdict."""
    fixed, learned, cultured = (arms[f"uniform, {name}"] for name in ("order given", "no culture", "culture"))
    value_fixed, value, value_cultured = (
        arms[f"value, {name}"] for name in ("order given", "no culture", "culture")
    )
    last = SHOWN[-1]
    return [
        above_line(
            "A1: no culture: value-based sharing ends above uniform", at(value, last), at(learned, last), 3
        ),
        above_line("A2: uniform: the order given leads in generation 20", at(fixed, 20), at(learned, 20), 3),
        above_line("A2: and is behind the learned ones in the last", at(learned, last), at(fixed, last), 3),
        above_line("A2: where culture is above none", at(cultured, last), at(learned, last), 3),
        near_line("A4: value-based: the order given comes close to +1", value_fixed),
        near_line("A4: learners do so too", np.minimum(value, value_cultured)),
        above_line("A4: in generation 20 they are below it", at(value_fixed, 20), at(value, 20), 3),
        above_line("A4: and with culture above those without", at(value_cultured, 20), at(value, 20), 3),
    ]


def lead_lines(fixed: Floats, learned: Floats) -> list[str]:
    """Return how far the given order is above learned ones under uniform sharing, generation by generation."""
    lines = []
    for generation in (1, 10, 20, 30, 40, 50, 75, 100, 150, 200):
        ahead = difference_text(at(fixed, generation) - at(learned, generation), 3)
        lines.append(f"generation {generation:>3}: order given minus learned {ahead}")
    return lines


def main() -> int:
    """Print the arms and the claims, each as soon as its figures are there."""
    print(
        f"{'generation':<22} {' '.join(f'{generation:>7}' for generation in SHOWN)}   {'':<15} {'least':>6}"
    )
    arms = {}
    with tempfile.TemporaryDirectory() as name:
        for arm, (spec, overrides) in ARMS.items():
            arms[arm] = curves(spec, overrides, Path(name) / arm)
            print(arm_line(arm, arms[arm]), flush=True)
    print("\n".join(["", *claim_lines(arms)]))
    print("\n".join(lead_lines(arms["uniform, order given"], arms["uniform, no culture"])))
    return 0


if __name__ == "__main__":
    sys.exit(main())
