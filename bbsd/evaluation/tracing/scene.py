"""The scene of an episode: the values of the view's picture at the start and after every step."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from bbsd.expression.graph import evaluate
from bbsd.expression.kinds import Kind
from bbsd.kernel.streams import DISTRIBUTIONS, fold, word_of

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from bbsd.expression.graph import Node
    from bbsd.expression.node_data import Slot
    from bbsd.language.meaning import Meaning
    from bbsd.language.meaning.episode.picture import Picture

    Stored = Mapping[Slot, float]

Floats = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Scene:
    """Where things are in an episode, at its start and after each step; what is drawn once, as it is at the end.

    `places` are (n_robots, n_moments, 2 or 3): x, y and perhaps a radius; `headings` (n_robots, n_moments) in radians;
    `area` two corners (4,); `circles` (n_circles, 3); `grid` (n_rows, n_columns), not 0 where a wall is;
    `marks` (n_moments, 2 or 3) and `paths` (n_points, 2) by name.
    """

    places: Floats
    headings: Floats | None
    area: Floats | None
    circles: Floats
    grid: Floats | None
    marks: dict[str, Floats]
    paths: dict[str, Floats] = field(default_factory=dict)


def scene(picture: Picture, moments: Sequence[Stored], constants: Sequence[float]) -> Scene:
    """Evaluate a picture at moments of an episode, the start first."""

    def over_time(nodes: Sequence[Node]) -> Floats:
        return np.array([values_of(nodes, stored, step, constants) for step, stored in enumerate(moments)])

    def at_the_end(rows: Sequence[Sequence[Node]], width: int) -> Floats:
        nodes = [node for row in rows for node in row]
        return np.array(values_of(nodes, moments[-1], len(moments) - 1, constants)).reshape(len(rows), width)

    headings = None if picture.headings is None else over_time(picture.headings).T
    return Scene(
        places=np.array([over_time(place) for place in picture.places]),
        headings=headings,
        area=None if picture.area is None else at_the_end([picture.area], 4)[0],
        circles=at_the_end(picture.circles, 3),
        grid=None if picture.grid is None else at_the_end(picture.grid, len(picture.grid[0])),
        marks={name: over_time(place) for name, place in picture.marks.items()},
        paths={name: at_the_end(path, 2) for name, path in picture.paths.items()},
    )


def starting_values(
    meaning: Meaning, key: int, constants: Sequence[float], observed: Mapping[Slot, float] | None = None
) -> dict[Slot, float]:
    """Return all values stored when an episode starts.

    Args:
        meaning: the spec's.
        key: names the episode's random streams.
        constants: their values.
        observed: what an environment that is stepped in Python shows at the start.
    """

    def leaf(node: Node, operands: list[Any]) -> float:
        if node.operation == "outside":
            return (observed or {})[node.slot]
        if node.operation != "draw":
            return node.read(constants, operands)
        return DISTRIBUTIONS[node.draw.distribution](key, fold(node.draw.kernel_word, word_of(0)), *operands)

    start = meaning.episode.start
    with np.errstate(all="ignore"):
        return {slot: float(value) for slot, value in zip(start, evaluate(start.values(), leaf), strict=True)}


def values_of(nodes: Sequence[Node], stored: Stored, step: int, constants: Sequence[float]) -> list[float]:
    """Return the values of nodes that read what is stored before a step, or after; truths are stored as 0 and 1."""

    def leaf(node: Node, operands: list[Any]) -> Any:  # noqa: ANN401 - a number or a truth
        match node.operation:
            case "slot":
                value = stored[node.slot]
                return bool(value) if node.kind is Kind.TRUTH else value
            case "step":
                return float(step)
        return node.read(constants, operands)

    with np.errstate(all="ignore"):
        return [float(value) for value in evaluate(nodes, leaf)]
