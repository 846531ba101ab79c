"""The claims of README.md on the paper's method, each with the figure that was measured here: `make claims`."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import bbsd
from bbsd.evaluation import interval
from bbsd.kernel.keys import keys
from bbsd.kernel.streams import name_word
from experiments.designs import SEEDS, returns, spec_path, verdict

LIFTING, ABSTRACT = map(spec_path, ("paper/object_lifting", "paper/abstract"))
BY_HAND = spec_path("object_lifting_hand")
FRESH = keys(name_word("claims"), 0, 20_000)
"""The episodes that all designs are compared on."""
RANDOM_SEARCH = ("design.method=random", "design.budget=300_000")
"""About as many episodes as the paper's method takes on lifting, the race included."""


@dataclass(frozen=True)
class Row:
    """A claim, the measured figure, and whether the figure confirms the claim."""

    claim: str
    figure: str
    holds: bool


def hand_made() -> Row:
    """Evaluate the hand-made controller."""
    evaluation = bbsd.evaluate(BY_HAND, episodes=20_000)
    holds = abs(evaluation.mean - 301.37) < 0.2 and abs(evaluation.sd - 7) < 1
    return Row(
        "hand-made controller: 301.37 within 0.2, sd 7",
        f"{evaluation.mean:.2f}, sd {evaluation.sd:.2f}",
        holds,
    )


def lifting(folder: Path) -> list[Row]:
    """Design lifting with every seed, and compare each design with the hand-made one on the same episodes."""
    by_hand = returns(BY_HAND, FRESH)
    means, lows, at_random = [], [], []
    for seed in SEEDS:
        designed = bbsd.design(LIFTING, seed=seed, out=folder / f"lifting-{seed}")
        rival = bbsd.design(LIFTING, seed=seed, out=folder / f"random-{seed}", set=RANDOM_SEARCH)
        at_random.append(float(returns(rival.architecture, FRESH).mean()))
        earned = returns(designed.architecture, FRESH)
        means.append(float(earned.mean()))
        lows.append(interval(earned - by_hand).low)
        print(
            f"  seed {seed}: {means[-1]:.2f}, better than by hand by at least {lows[-1]:.2f}", file=sys.stderr
        )
    mean = float(np.mean(means))
    return [
        Row(
            "the paper's method, lifting, seeds 0..9: mean at least 303.0",
            f"{mean:.2f} (least {min(means):.2f})",
            mean >= 303,
        ),
        Row(
            "every seed above the hand-made one (paired 95 %)", f"by at least {min(lows):.2f}", min(lows) > 0
        ),
        Row(
            "but on average less than 1 above random search with as many episodes",
            f"{np.mean(at_random):.2f} (least {min(at_random):.2f})",
            mean - float(np.mean(at_random)) < 1,
        ),
    ]


def best_of_ten(folder: Path) -> Row:
    """Design lifting in ten independent runs and evaluate the best."""
    designed = bbsd.design(LIFTING, seed=0, runs=10, out=folder / "lifting-runs")
    earned = interval(returns(designed.architecture, FRESH))
    return Row(
        "the paper's method, lifting, best of 10 runs: at least 304",
        f"{earned.mean:.2f} ({earned.low:.2f} to {earned.high:.2f})",
        earned.mean >= 304,
    )


def abstract(folder: Path) -> Row:
    """Design the abstract problem with every seed and evaluate each design exactly, in all 25 states."""
    exact = []
    for seed in SEEDS:
        designed = bbsd.design(ABSTRACT, seed=seed, out=folder / f"abstract-{seed}")
        exact.append(bbsd.evaluate(designed.architecture, exact=True).mean)
        print(f"  abstract, seed {seed}: {exact[-1]:.4f}", file=sys.stderr)
    return Row(
        "the paper's method, abstract, seeds 0..9: all 25 states right",
        f"least mean reward {min(exact):.4f}",
        min(exact) == 1,
    )


def random_agents() -> Row:
    """Evaluate random agents on the abstract problem, whose expected return is (28)."""
    evaluation = bbsd.evaluate(ABSTRACT, fill="random", agents=20_000, episodes=100)
    return Row(
        "random agents, abstract: -0.7165 within 0.005",
        f"{evaluation.mean:.4f}",
        abs(evaluation.mean + 0.7165) < 0.005,
    )


def same_bytes(folder: Path) -> list[Row]:
    """Design with the same seed twice, with other lanes, and killed and resumed, and compare the files."""
    short = ["--seed", "3", "--set", "design.coevolution.generations=12"]
    first, again, lanes, killed = (folder / f"bytes-{name}" for name in ("first", "again", "lanes", "killed"))
    _design([*short, "--out", str(first)])
    _design([*short, "--out", str(again)])
    _design([*short, "--out", str(lanes), "--lanes", "16"])
    kills = _design_with_kills(short, killed)
    same, same_lanes, same_killed = (_same_files(first, other) for other in (again, lanes, killed))
    return [
        Row("same seed twice: same bytes", _sameness(same), same),
        Row("other --lanes: same bytes", _sameness(same_lanes), same_lanes),
        Row(
            "kill -9 and --resume: same bytes",
            f"{_sameness(same_killed)}, killed {kills} times",
            same_killed and kills > 0,
        ),
    ]


def _command(options: list[str]) -> list[str]:
    return [sys.executable, "-m", "bbsd", "design", str(LIFTING), "--quiet", *options]


def _design(options: list[str]) -> None:
    subprocess.run(_command(options), check=True, stdout=subprocess.DEVNULL)


def _design_with_kills(options: list[str], folder: Path) -> int:
    """Kill the design whenever it recorded a generation, up to three times, and resume it; return how often."""
    kills = 0
    while True:
        resume = ["--resume"] if folder.exists() else []
        process = subprocess.Popen(
            _command([*options, "--out", str(folder), *resume]), stdout=subprocess.DEVNULL
        )
        metrics, before = folder / "metrics.jsonl", _size(folder / "metrics.jsonl")
        while process.poll() is None and (_size(metrics) <= before or kills >= 3):
            time.sleep(0.001)
        if process.poll() is not None:
            return kills
        os.kill(process.pid, signal.SIGKILL)
        process.wait()
        kills += 1


def _size(path: Path) -> int:
    return path.stat().st_size if path.exists() else 0


def _same_files(one: Path, other: Path) -> bool:
    files = ("architecture.yaml", "metrics.jsonl")
    return all((one / file).read_bytes() == (other / file).read_bytes() for file in files)


def _sameness(same: bool) -> str:
    return "same" if same else "different"


def seconds(folder: Path) -> Row:
    """Time a whole design as a process of its own, kernels cached, on one core."""
    times = []
    for attempt in range(3):
        began = time.perf_counter()
        pinned = ["taskset", "-c", "0"] if Path("/usr/bin/taskset").exists() else []
        command = [*pinned, *_command(["--out", str(folder / f"timed-{attempt}")])]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        times.append(time.perf_counter() - began)
    median = sorted(times)[1]
    return Row(
        "the paper's method, a whole design of lifting, cached, one core: 5 s at most",
        f"{median:.2f} s",
        median <= 5,
    )


def main() -> int:
    """Check every claim and print the table; return 1 if one does not hold."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        rows = [hand_made(), *lifting(folder), best_of_ten(folder), abstract(folder), random_agents()]
        rows += [*same_bytes(folder), seconds(folder)]
    width = max(len(row.claim) for row in rows)
    for row in rows:
        print(f"{verdict(row.holds)}  {row.claim:<{width}}  {row.figure}")
    return 0 if all(row.holds for row in rows) else 1


if __name__ == "__main__":
    sys.exit(main())
