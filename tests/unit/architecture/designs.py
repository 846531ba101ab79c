"""Specs and architectures for the tests of architecture and explanation."""

from pathlib import Path

import numpy as np

from bbsd.architecture import Architecture
from bbsd.language.loading import load
from bbsd.text import Source

SPECS = Path(__file__).parents[3] / "specs"
SHIPPED = ("abstract", "object_lifting", "object_lifting_hand")

SMALL = """
bbsd: 1
name: small
environment: {{robots: {robots}, steps: 1, state: {{x: 0}}}}
behaviors:
{behaviors}
reward: {{right: x}}
"""


def shipped(name):
    """The text of a spec of the project."""
    return (SPECS / f"{name}.yaml").read_text()


def small(behaviors, robots=1):
    """The text of a spec with these behaviors and one number of state, x."""
    return SMALL.format(behaviors=behaviors, robots=robots)


def meaning_of(text, seed=0):
    return load(Source("spec.yaml", text), seed=seed).meaning


def random_architecture(meaning, seed):
    """Tables and a structure that agree with what the spec gives."""
    rng, structure = np.random.default_rng(seed), meaning.structure
    tables = []
    for module in meaning.episode.modules:
        given = np.frombuffer(module.table.given, np.uint8)
        drawn = rng.integers(0, len(module.actions) + 1, len(given))
        tables.append(np.where(given == 255, drawn, given).astype(np.uint8))
    fillers = iter(rng.permutation(np.array(structure.candidates, np.int64)))
    layers = [next(fillers) if layer < 0 else layer for layer in structure.layers]
    return Architecture(tuple(tables), np.array(layers, np.int64))
