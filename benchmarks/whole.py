"""The whole design of the paper's two experiments beside the same algorithm with DEAP and NumPy."""

from __future__ import annotations

import json
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

import bbsd
from bbsd.solver.settings import settings_of
from benchmarks.page import Asked, table
from benchmarks.processes import ABSTRACT, LIFTING, design_command, spent

if TYPE_CHECKING:
    from collections.abc import Callable

    from bbsd.language.loading import Loaded

    Design = Callable[[int], list[float]]
    """Of a seed: the mean fitness of each generation that was lived."""


@dataclass(frozen=True, slots=True)
class Experiment:
    """A spec, and how many of its generations the peer lives."""

    name: str
    spec: str
    part: int


EXPERIMENTS = (Experiment("object lifting", LIFTING, 5), Experiment("abstract", ABSTRACT, 10))


@dataclass(frozen=True, slots=True)
class Found:
    """What a round found: seconds of the processor, and the mean fitness of the part's last generation."""

    seconds: float
    fitness: float


def section(*, quick: bool) -> tuple[str, list[Asked]]:
    """The text of the section; nothing is asked but that it is shown."""
    try:
        rows = [row(each, quick=quick) for each in EXPERIMENTS]
    except ImportError as missing:
        rows = [[each.name, "", "", "", f"missing: {missing}"] for each in EXPERIMENTS]
    return "\n".join(
        [
            "## Whole designs",
            "",
            (
                "`bbsd design` as a whole process, kernels cached, final race and judgement included, beside the "
                "generations alone of the same algorithm written with DEAP for the pools and NumPy, all agents at once,"
                " for episodes and structure search. The peer lives the first generations only, and its time for all "
                "of them is extrapolated from these. Each draws its own numbers; that both do the same is seen by the "
                "mean fitness that they reached by then. Seconds of the processor, medians of three seeds."
            ),
            "",
            *table(
                [
                    "",
                    "bbsd, whole, s",
                    "peer, measured, s",
                    "peer, extrapolated, s",
                    "bbsd is faster by",
                    "fitness reached",
                ],
                rows,
            ),
        ]
    ), []


def row(experiment: Experiment, *, quick: bool) -> list[str]:
    """A line of the table."""
    loaded = bbsd.load(experiment.spec)
    generations = loaded.spec.design.coevolution.generations
    part = 2 if quick else experiment.part
    peer = peer_of(experiment, loaded, part)
    ours, theirs = [], []
    with tempfile.TemporaryDirectory() as folder:
        warm = Path(folder) / "warm"
        spent(design_command(experiment.spec, Path(folder) / "first"), warm)
        for seed in range(1 if quick else 3):
            ours.append(by_bbsd(experiment.spec, seed, Path(folder), part))
            theirs.append(measured(peer, seed))
    bbsd_s, peer_s = (float(np.median([each.seconds for each in found])) for found in (ours, theirs))
    fitness = [f"{np.median([each.fitness for each in found]):.3g}" for found in (ours, theirs)]
    whole = peer_s / part * generations
    return [
        experiment.name,
        f"{bbsd_s:.2f}",
        f"{peer_s:.1f} for {part} generations",
        f"{whole:.0f} for {generations}",
        f"{whole / bbsd_s:.3g}",
        f"generation {part}: bbsd {fitness[0]}, peer {fitness[1]}",
    ]


def peer_of(experiment: Experiment, loaded: Loaded, part: int) -> Design:
    """The peer's design of so many generations; ImportError where DEAP is missing."""
    from benchmarks.peers import design_by_deap as peer

    settings = settings_of(loaded.meaning)
    if experiment.spec == LIFTING:
        return lambda seed: peer.design(peer.live_lifting, peer.LIFTING_CELLS, settings, part, seed)

    def abstract(seed: int) -> list[float]:
        live = peer.live_abstract(policy_of(bbsd.load(experiment.spec, seed=seed)))
        return peer.design(live, peer.ABSTRACT_CELLS, settings, part, seed)

    return abstract


def policy_of(loaded: Loaded) -> Any:  # noqa: ANN401 - an array
    """The answers of the abstract problem that a seed draws."""
    return np.array(loaded.meaning.constants.vector(1)[:25]).reshape(5, 5)


def by_bbsd(spec: str, seed: int, folder: Path, part: int) -> Found:
    """A whole design in a process of its own."""
    out = folder / f"{Path(spec).stem}-{seed}"
    taken = spent([*design_command(spec, out), "--seed", str(seed)], folder / "warm")
    lines = [json.loads(line) for line in (out / "metrics.jsonl").read_text().splitlines()]
    return Found(taken.processor, lines[part - 1]["mean"])


def measured(peer: Design, seed: int) -> Found:
    """The peer's part."""
    began = time.process_time()
    means = peer(seed)
    return Found(time.process_time() - began, means[-1])
