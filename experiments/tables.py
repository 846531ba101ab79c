"""Gymnasium's environments with a table of transitions, designed: exact returns beside the optimum: `make tables`.

The figure asked for: within 1 % of what any controller that sees the state could earn, in two minutes. A design that
sees only the state, and not the time, can do no more than the best policy that always does the same in a state: that
stands beside.
"""

from __future__ import annotations

import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path
from statistics import median

import bbsd
from experiments.designs import spec_path

SPECS = ("lake", "cliff_walking", "taxi", "lake_8x8")
SEEDS = range(5)
ALLOWED = ("gymnasium",)
WITHIN, SECONDS = 0.01, 120.0
"""How far below the optimum a design may be, of its size; and the time it may take."""


@dataclass(frozen=True)
class Row:
    """A design of a spec."""

    seed: int
    mean: float
    best: float
    fixed: float
    seconds: float
    episodes: int

    @property
    def below(self) -> float:
        """How far it is below the optimum, of the optimum's size."""
        return (self.best - self.mean) / abs(self.best)

    @property
    def below_fixed(self) -> float:
        """How far it is below the best that always does the same in a state."""
        return (self.fixed - self.mean) / abs(self.fixed)


def designed(spec: Path, seed: int, folder: Path) -> Row:
    """Design a spec by the default method with the default budget, and evaluate the design exactly."""
    found = bbsd.design(spec, seed=seed, jobs=2, out=folder / f"{spec.stem}-{seed}", allow_import=ALLOWED)
    exact = bbsd.evaluate(found.architecture, exact=True, allow_import=ALLOWED)
    if exact.optimum is None:
        raise RuntimeError(f"{spec} was not stepped by a table")
    return Row(seed, exact.mean, exact.optimum.best, exact.optimum.fixed, found.seconds, found.spent)


def line(name: str, row: Row) -> str:
    """Return a design as a line of text."""
    return (
        f"{name:<14} {row.seed:4} {row.mean:10.4f} {row.best:10.4f} {row.below:8.2%} {row.fixed:10.4f} "
        f"{row.below_fixed:8.2%} {row.episodes:10,} {row.seconds:8.0f}"
    )


def main() -> int:
    """Design the specs named as arguments, or all, with some seeds; return 1 if one misses the figure."""
    names = sys.argv[1:] or SPECS
    headings = f"{'below':>8} {'fixed':>10} {'below':>8} {'episodes':>10} {'seconds':>8}"
    print(f"{'':<14} {'seed':>4} {'exact':>10} {'optimum':>10} {headings}", flush=True)
    holds = True
    with tempfile.TemporaryDirectory() as folder:
        for name in names:
            rows = []
            for seed in SEEDS:
                rows.append(designed(spec_path(f"gymnasium/{name}"), seed, Path(folder)))
                print(line(name, rows[-1]), flush=True)
            reached = sum(row.below <= WITHIN for row in rows)
            seconds = median(row.seconds for row in rows)
            print(f"{name:<14} within {WITHIN:.0%}: {reached} of {len(rows)}; {seconds:.0f} s in the middle")
            holds = holds and reached == len(rows) and seconds <= SECONDS
    return 0 if holds else 1


if __name__ == "__main__":
    sys.exit(main())
