"""Structure learning in the zero-order representation (V.A): which behavior belongs in which layer.

A structure is an int64 array (n_layers,) of behavior indices, lowest layer first as in (2). `layers` has the
same shape: a behavior where the spec gives one, OPEN where one is learned. `candidates` are the
behaviors that may fill open layers. Ṽ of (12) is a float64 array (n_agents, n_layers, n_behaviors). Every
agent draws from a key of its own.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bbsd.kernel.jit import jit
from bbsd.kernel.streams import marked
from bbsd.solver.assignment import assign
from bbsd.solver.draws import below, marks, shuffle

if TYPE_CHECKING:
    from numpy.typing import NDArray

OPEN = -1


def candidates_for(layers: NDArray[np.int64], n_behaviors: int) -> NDArray[np.int64]:
    """Return the behaviors that may fill the open layers: those that no layer names, in ascending order.

    Raises:
        ValueError: there are fewer of them than open layers.
    """
    candidates = np.setdiff1d(np.arange(n_behaviors), layers)
    n_open = int(np.count_nonzero(layers == OPEN))
    if n_open > len(candidates):
        raise ValueError(f"{n_open} open layers, but only {len(candidates)} behaviors to fill them")
    return candidates


@jit
def open_layers(layers: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return the indices of the open layers, lowest first."""
    holes = np.empty_like(layers)
    n_holes = 0
    for layer in range(len(layers)):
        if layers[layer] == OPEN:
            holes[n_holes] = layer
            n_holes += 1
    return holes[:n_holes]


@jit
def pick_up(
    hand: NDArray[np.int64], structures: NDArray[np.int64], agent: int, holes: NDArray[np.int64]
) -> None:
    """Read the agent's behaviors in the open layers into `hand`."""
    for hole in range(len(holes)):
        hand[hole] = structures[agent, holes[hole]]


@jit
def lay_down(
    hand: NDArray[np.int64], structures: NDArray[np.int64], agent: int, holes: NDArray[np.int64]
) -> None:
    """Write the first cards of `hand` into the agent's open layers."""
    for hole in range(len(holes)):
        structures[agent, holes[hole]] = hand[hole]


@jit
def value_of(
    hand: NDArray[np.int64], values: NDArray[np.float64], agent: int, holes: NDArray[np.int64]
) -> float:
    """Return (9) by (12), the sum of Ṽ_ij over the open layers; given layers add the same to every structure."""
    value = 0.0
    for hole in range(len(holes)):
        value += values[agent, holes[hole], hand[hole]]
    return value


@jit
def random_structures(
    keys: NDArray[np.uint64], layers: NDArray[np.int64], candidates: NDArray[np.int64]
) -> NDArray[np.int64]:
    """Draw a structure for each agent, uniformly random in its open layers.

    Args:
        keys: (n_agents,).
        layers: (n_layers,).
        candidates: (n_candidates,), at least as many as there are open layers.

    Returns:
        (n_agents, n_layers).
    """
    holes = open_layers(layers)
    structures = np.empty((len(keys), len(layers)), np.int64)
    hand, places = np.empty_like(candidates), marks(len(holes))
    for agent in range(len(keys)):
        for layer in range(len(layers)):
            structures[agent, layer] = layers[layer]
        for card in range(len(candidates)):
            hand[card] = candidates[card]
        shuffle(int(keys[agent]), hand, len(holes), places)
        lay_down(hand, structures, agent, holes)
    return structures


@jit
def draw_swaps(
    key: int,
    samples: NDArray[np.uint64],
    places: NDArray[np.uint64],
    n_cards: int,
    streams: NDArray[np.uint64],
    swaps: NDArray[np.int64],
) -> None:
    """Draw which card `shuffle` swaps with each place, for all samples at once: such loops vectorize.

    Args:
        key: the agent's.
        samples: `marks` of the samples, (n_random,).
        places: `marks` of the places, (n_places,).
        n_cards: how many there are to deal from.
        streams: (n_random,), filled.
        swaps: (n_places, n_random), filled.
    """
    for sample in range(len(samples)):
        streams[sample] = marked(key, int(samples[sample]))
    for place in range(len(places)):
        mark = int(places[place])
        for sample in range(len(samples)):
            swaps[place, sample] = place + below(marked(int(streams[sample]), mark), n_cards - place)


@jit
def search_sampled(
    keys: NDArray[np.uint64],
    values: NDArray[np.float64],
    structures: NDArray[np.int64],
    layers: NDArray[np.int64],
    candidates: NDArray[np.int64],
    n_random: int,
) -> NDArray[np.int64]:
    """Find T* by simple stochastic search (V.A): the best sum of Ṽ_ij among the present structure and random ones.

    The present structure is replaced only by a strictly better one, so a meme survives Ṽ = 0.

    Args:
        keys: (n_agents,).
        values: Ṽ, (n_agents, n_layers, n_behaviors).
        structures: the present ones, (n_agents, n_layers).
        layers: (n_layers,).
        candidates: (n_candidates,), at least as many as there are open layers.
        n_random: how many random structures compete.

    Returns:
        (n_agents, n_layers).
    """
    holes = open_layers(layers)
    chosen = structures.copy()
    present = np.empty_like(holes)
    hand = np.empty_like(candidates)
    places, samples = marks(len(holes)), marks(n_random)
    streams, swaps = np.empty(n_random, np.uint64), np.empty((len(holes), n_random), np.int64)
    for agent in range(len(keys)):
        pick_up(present, structures, agent, holes)
        best = value_of(present, values, agent, holes)
        draw_swaps(int(keys[agent]), samples, places, len(candidates), streams, swaps)
        for card in range(len(candidates)):
            hand[card] = candidates[card]
        for sample in range(n_random):
            for place in range(len(holes)):
                other = swaps[place, sample]
                hand[place], hand[other] = hand[other], hand[place]
            value = value_of(hand, values, agent, holes)
            if value > best:
                best = value
                lay_down(hand, chosen, agent, holes)
    return chosen


@jit
def search_exact(
    values: NDArray[np.float64],
    structures: NDArray[np.int64],
    layers: NDArray[np.int64],
    candidates: NDArray[np.int64],
) -> NDArray[np.int64]:
    """Find T* of (5) under (9) exactly: the assignment of candidates to open layers with the greatest sum of Ṽ_ij.

    Shapes as in `search_sampled`, values finite; the present structure is kept on ties.
    """
    holes = open_layers(layers)
    chosen = structures.copy()
    present = np.empty_like(holes)
    costs = np.empty((len(holes), len(candidates)))
    for agent in range(len(structures)):
        for hole in range(len(holes)):
            for card in range(len(candidates)):
                costs[hole, card] = -values[agent, holes[hole], candidates[card]]
        hand = assign(costs)
        for hole in range(len(holes)):
            hand[hole] = candidates[hand[hole]]
        pick_up(present, structures, agent, holes)
        if value_of(hand, values, agent, holes) > value_of(present, values, agent, holes):
            lay_down(hand, chosen, agent, holes)
    return chosen
