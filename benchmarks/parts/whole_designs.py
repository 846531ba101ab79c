"""Whole designs of the paper's two experiments beside the same algorithm with DEAP and NumPy."""

from __future__ import annotations

import json
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

import bbsd
from bbsd.solver.paper.settings import settings_of
from benchmarks.processes import ABSTRACT, LIFTING, design_command, usage_of
from benchmarks.report import Section, table

if TYPE_CHECKING:
    from collections.abc import Callable

    from bbsd.language.loading import Loaded

    Design = Callable[[int], list[float]]
    """Maps a seed to the mean fitness of each generation that was computed."""


@dataclass(frozen=True, slots=True)
class Experiment:
    """A spec, and how many of its generations the peer computes."""

    name: str
    spec: str
    part: int


EXPERIMENTS = (Experiment("object lifting", LIFTING, 5), Experiment("abstract", ABSTRACT, 10))


@dataclass(frozen=True, slots=True)
class Measurement:
    """Seconds of the processor, and the mean fitness of the last generation that the peer computes."""

    seconds: float
    fitness: float


def section(*, quick: bool) -> Section:
    """Measure both experiments; there is no goal."""
    try:
        rows = [row(experiment, quick=quick) for experiment in EXPERIMENTS]
    except ImportError as missing:
        rows = [[experiment.name, "", "", "", "", f"missing: {missing}"] for experiment in EXPERIMENTS]
    text = (
        "`bbsd design` as a whole process, kernels cached, final race and judgement included, beside the generations "
        "alone of the same algorithm written with DEAP for the pools and NumPy, all agents at once, for episodes and "
        "structure search. The peer computes the first generations only, from which its time for all of them is "
        "extrapolated. Each draws its own numbers; the mean fitness reached by then shows that both do the same. "
        "Seconds of the processor, medians of three seeds."
    )
    head = [
        "",
        "bbsd, whole, s",
        "peer, measured, s",
        "peer, extrapolated, s",
        "bbsd is faster by",
        "fitness reached",
    ]
    return Section("Whole designs", [text, table(head, rows)])


def row(experiment: Experiment, *, quick: bool) -> list[str]:
    """Measure an experiment and return its row of the table."""
    loaded = bbsd.load(experiment.spec)
    generations = loaded.spec.design.coevolution.generations
    part = 2 if quick else experiment.part
    peer = peer_of(experiment, loaded, part)
    ours, theirs = [], []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        usage_of(design_command(experiment.spec, folder / "first"), folder / "warm")
        for seed in range(1 if quick else 3):
            ours.append(designed_by_bbsd(experiment.spec, seed, folder, part))
            theirs.append(designed_by_peer(peer, seed))
    bbsd_s, peer_s = (float(np.median([one.seconds for one in runs])) for runs in (ours, theirs))
    fitness = [f"{np.median([one.fitness for one in runs]):.3g}" for runs in (ours, theirs)]
    extrapolated = peer_s / part * generations
    return [
        experiment.name,
        f"{bbsd_s:.2f}",
        f"{peer_s:.1f} for {part} generations",
        f"{extrapolated:.0f} for {generations}",
        f"{extrapolated / bbsd_s:.3g}",
        f"generation {part}: bbsd {fitness[0]}, peer {fitness[1]}",
    ]


def peer_of(experiment: Experiment, loaded: Loaded, part: int) -> Design:
    """Return the peer's design of so many generations; raise ImportError where DEAP is missing."""
    from benchmarks.peers import design_by_deap as peer

    settings = settings_of(loaded.meaning)
    if experiment.spec == LIFTING:
        return lambda seed: peer.design(peer.run_lifting, peer.LIFTING_CELLS, settings, part, seed)

    def abstract(seed: int) -> list[float]:
        run = peer.run_abstract(right_answers(bbsd.load(experiment.spec, seed=seed)))
        return peer.design(run, peer.ABSTRACT_CELLS, settings, part, seed)

    return abstract


def right_answers(loaded: Loaded) -> Any:  # noqa: ANN401 - an array
    """Return the right answers of the abstract problem that a seed draws, (5, 5)."""
    return np.array(loaded.meaning.constants.vector(1)[:25]).reshape(5, 5)


def designed_by_bbsd(spec: str, seed: int, folder: Path, part: int) -> Measurement:
    """Measure a whole design in a process of its own."""
    out = folder / f"{Path(spec).stem}-{seed}"
    usage = usage_of(design_command(spec, out, "--seed", str(seed)), folder / "warm")
    lines = [json.loads(line) for line in (out / "metrics.jsonl").read_text().splitlines()]
    return Measurement(usage.processor, lines[part - 1]["mean"])


def designed_by_peer(peer: Design, seed: int) -> Measurement:
    """Measure the generations that the peer computes."""
    began = time.process_time()
    means = peer(seed)
    return Measurement(time.process_time() - began, means[-1])
