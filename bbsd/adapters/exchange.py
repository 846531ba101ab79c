"""What another program observes of a spec's world, and what it can choose."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, reduce
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from bbsd.architecture.policy import joint_space
from bbsd.errors import UsageError
from bbsd.expression.graph import Level
from bbsd.expression.kinds import Kind

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from bbsd.architecture.policy import JointSpace
    from bbsd.expression.graph import Node
    from bbsd.expression.node_data import Slot
    from bbsd.language.meaning import Meaning

Observe = Literal["sensors", "cells"]
"""What is observed: what behaviors may know, or only the cells that they tell apart."""
NOBODY = "nobody"
"""The choice that no behavior controls: commands stay."""


class NotOurWorld(UsageError):
    """A spec whose world is an environment of somebody else."""

    advice = "use that environment itself: gymnasium.make, or the module of PettingZoo"


@dataclass(frozen=True)
class Exchange:
    """What each robot of a world is observed to know, and what it can do.

    A choice is an action of the spec, or nobody's; actions of several behaviors that set the same values are one.
    """

    meaning: Meaning
    observe: Observe = "sensors"

    def __post_init__(self) -> None:
        """Refuse a spec whose world is not its own."""
        outside = self.meaning.episode.outside
        if outside:
            raise NotOurWorld(f"the world of {self.meaning.spec.name} is stepped in Python already")

    @property
    def n_robots(self) -> int:
        """The number of robots."""
        return self.meaning.spec.environment.robots

    @property
    def n_steps(self) -> int:
        """The steps of an episode."""
        return self.meaning.spec.environment.steps

    @cached_property
    def _space(self) -> JointSpace:
        return joint_space(self.meaning)

    # --- What is observed

    @cached_property
    def slots(self) -> tuple[Slot, ...]:
        """Of robot 0, the state and the sensors that are observed as `sensors`."""
        return tuple(slot for slot in self.meaning.episode.start if slot.robot == 0)

    @cached_property
    def names(self) -> tuple[str, ...]:
        """The names of what is observed of a robot, a name for each number."""
        if self.observe == "cells":
            return tuple(self._space.dimensions)
        return tuple(slot.label(1) for slot in self.slots)

    @property
    def sizes(self) -> tuple[int, ...]:
        """The numbers of cells of each dimension that is observed as `cells`."""
        return self._space.sizes

    @cached_property
    def nodes(self) -> tuple[Node, ...]:
        """The values that are observed, all of robot 0 first."""
        if self.observe == "cells":
            return tuple(robots[robot] for robot in range(self.n_robots) for robots in self._space.nodes)
        return tuple(
            self._leaf(slot._replace(robot=robot)) for robot in range(self.n_robots) for slot in self.slots
        )

    def _leaf(self, slot: Slot) -> Node:
        return self.meaning.graph.leaf("slot", slot, self.meaning.episode.start[slot].kind, Level.LANE)

    def of_robots(self, observed: NDArray[np.float64]) -> NDArray[Any]:
        """Return what is observed (n, ...) robot by robot, (n_robots, n_names, ...): cells as whole numbers."""
        values = observed.reshape(self.n_robots, len(self.names), *observed.shape[1:])
        return values.astype(np.int64) if self.observe == "cells" else values.copy()

    def named(self, observed: Sequence[float]) -> dict[str, Any]:
        """Return what a robot observes (n_names,) by name, as a `bbsd.Agent` is given it.

        Truths are truths, cells of a sensor are indices, and sensors with several values are nested lists.
        """
        if self.observe == "cells":
            return dict(zip(self.names, map(int, observed), strict=True))
        values = dict[str, Any]()
        for slot, value in zip(self.slots, observed, strict=True):
            kind = self.meaning.episode.start[slot].kind
            read = bool(value) if kind is Kind.TRUTH else int(value) if kind is Kind.CELL else float(value)
            if slot.place:
                _put(values.setdefault(slot.name, []), slot.place, read)
            else:
                values[slot.name] = read
        return values

    # --- What can be chosen

    @cached_property
    def numbers(self) -> NDArray[np.int64]:
        """The number of an action for each choice, counted over all behaviors as kernels do, (n_choices,)."""
        return np.unique(self._space.effects).astype(np.int64)

    @cached_property
    def choices(self) -> NDArray[np.int64]:
        """The choice that each action is, by its number, (n_actions + 1,); 0 is nobody's."""
        return np.searchsorted(self.numbers, self._space.effects).astype(np.int64)

    @cached_property
    def actions(self) -> tuple[str, ...]:
        """The names of the choices: each action that it is, as `behavior action`; nobody's first."""
        names = [NOBODY]
        names += [
            f"{module.name} {action}" for module in self.meaning.episode.modules for action in module.actions
        ]
        return tuple(
            ", ".join(names[number] for number in np.flatnonzero(self.choices == choice))
            for choice in range(len(self.numbers))
        )

    # --- What is earned

    def of_team(self, earned: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the mean of what robots earned (n_robots, ...), added up as a return is."""
        total: NDArray[np.float64] = reduce(np.add, earned)
        return total if self.n_robots == 1 else total / self.n_robots


def _put(lists: list[Any], place: tuple[int, ...], value: object) -> None:
    """Put a value at a place of nested lists that are filled in order."""
    for index in place[:-1]:
        if index == len(lists):
            lists.append([])
        lists = lists[index]
    lists.append(value)
