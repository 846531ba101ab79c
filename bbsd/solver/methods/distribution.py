"""A distribution over designs in which every open cell, and every open layer, is drawn for itself."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bbsd.kernel.jit import jit
from bbsd.kernel.streams import fold, name_word, unit, word_of
from bbsd.solver.paper.sharing import in_order
from bbsd.solver.space import Designs

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bbsd.solver.space import Space

CELLS, ORDERS = name_word("cells"), name_word("orders")


@dataclass(frozen=True, slots=True, eq=False)
class Distribution:
    """How probable each choice of each open cell is, and each candidate in each open layer."""

    choices: NDArray[np.float64]
    """(n_open_cells, most choices), rows that add up to 1; 0 where a cell has fewer choices."""
    layers: NDArray[np.float64]
    """(n_open_layers, n_candidates), rows that add up to 1.

    Layers are drawn from the top down; a candidate that stands above is left out, the others keep their proportions.
    """

    def drawn(self, space: Space, key: int, which: NDArray[np.int64]) -> Designs:
        """Return the designs of those numbers in a stream: the same number is the same design."""
        cells = np.empty((len(which), len(self.choices)), np.uint8)
        draw_choices(np.uint64(fold(key, CELLS)), which, np.cumsum(self.choices, axis=1), cells)
        hands = np.empty((len(which), len(self.layers)), np.int64)
        draw_hands(np.uint64(fold(key, ORDERS)), which, self.layers, hands)
        return designs_of(space, cells, hands)

    def most_probable(self, space: Space) -> Designs:
        """Return the design of the most probable choices and, from the top layer down, candidates; one row."""
        hand = np.empty((1, len(self.layers)), np.int64)
        free = np.ones(self.layers.shape[1])
        for layer in reversed(range(len(self.layers))):
            hand[0, layer] = int(np.argmax(self.layers[layer] * free))
            free[hand[0, layer]] = 0.0
        return designs_of(space, np.argmax(self.choices, axis=1).astype(np.uint8)[None], hand)

    def moved(self, space: Space, designs: Designs, step: float, floor: float) -> Distribution:
        """Return the distribution moved by a step toward the frequencies in designs.

        No choice becomes less probable than `floor` shared among all choices of its cell.
        """
        cells, layers = designs.tables[:, space.open_cells], designs.structures[:, space.open_layers]
        return Distribution(
            _moved(self.choices, cells, np.arange(self.choices.shape[1]), step, floor),
            _moved(self.layers, layers, space.problem.candidates, step, floor),
        )


def uniform_distribution(space: Space) -> Distribution:
    """Return the distribution in which all choices of a cell, and all candidates, are equally probable."""
    n_choices = space.choices[space.open_cells]
    possible = np.arange(max(n_choices, default=1)) < n_choices[:, None]
    shape = (len(space.open_layers), len(space.problem.candidates))
    return Distribution(possible / n_choices[:, None], np.full(shape, 1.0 / max(1, shape[1])))


def designs_of(space: Space, cells: NDArray[np.uint8], hands: NDArray[np.int64]) -> Designs:
    """Return designs of choices (n, n_open_cells) and the numbers of candidates (n, n_open_layers)."""
    tables = np.tile(space.blank, (len(cells), 1))
    tables[:, space.open_cells] = cells
    structures = np.tile(space.problem.layers, (len(hands), 1))
    structures[:, space.open_layers] = space.problem.candidates[hands]
    return Designs(tables, structures)


def _moved(
    probabilities: NDArray[np.float64],
    drawn: NDArray[np.generic],
    values: NDArray[np.int64],
    step: float,
    floor: float,
) -> NDArray[np.float64]:
    if not probabilities.size:
        return probabilities
    counts = np.stack([np.count_nonzero(drawn == value, axis=0) for value in values], axis=1)
    possible = probabilities > 0.0
    least = floor / np.count_nonzero(possible, axis=1)[:, None]
    moved = (1.0 - step) * probabilities + step * (counts / len(drawn))
    moved = np.where(possible, np.maximum(moved, least), 0.0)
    return moved / in_order(moved.T)[:, None]


@jit
def draw_choices(
    key: np.uint64,
    which: NDArray[np.int64],
    ends: NDArray[np.float64],
    cells: NDArray[np.uint8],
) -> None:
    """Draw the open cells of the designs `which` (n,) into `cells` (n, n_open_cells).

    `ends` (n_open_cells, most choices) says where the sector of each choice ends.
    """
    for row in range(len(which)):
        stream = fold(int(key), word_of(which[row]))
        for cell in range(len(ends)):
            place = unit(fold(stream, word_of(cell))) * ends[cell, -1]
            choice = 0
            while choice < ends.shape[1] - 1 and place >= ends[cell, choice]:
                choice += 1
            cells[row, cell] = choice


@jit
def draw_hands(
    key: np.uint64,
    which: NDArray[np.int64],
    probabilities: NDArray[np.float64],
    hands: NDArray[np.int64],
) -> None:
    """Draw the numbers of the candidates of the designs `which` (n,) into `hands`, (n, n_open_layers)."""
    n_layers, n_candidates = probabilities.shape
    free = np.empty(n_candidates)
    for row in range(len(which)):
        stream = fold(int(key), word_of(which[row]))
        free[:] = 1.0
        for layer in range(n_layers - 1, -1, -1):
            total = 0.0
            for candidate in range(n_candidates):
                total += free[candidate] * probabilities[layer, candidate]
            place = unit(fold(stream, word_of(layer))) * total
            chosen, end = -1, 0.0
            for candidate in range(n_candidates):
                if free[candidate] > 0.0 and (chosen < 0 or place >= end):
                    chosen = candidate
                    end += probabilities[layer, candidate]
            hands[row, layer] = chosen
            free[chosen] = 0.0
