"""A world that is stepped in Python: what it gives are digits of a digest of its key and of all that it was sent."""

from __future__ import annotations

from copy import deepcopy
from hashlib import blake2b
from typing import TYPE_CHECKING, Any

from bbsd.language.outside import EARNED

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    import numpy as np
    from numpy.typing import NDArray

    from bbsd.expression.node_data import Slot
    from bbsd.language.models import Environment

Given = dict[tuple[str, int], float]
"""What the world gives, by name and robot."""


class MadeUpWorld:
    """One episode of the world: it ends in about every twelfth step."""

    def __init__(self, environment: Environment, key: int) -> None:
        assert environment.outside is not None
        self.sizes = {field.name: field.size for field in environment.outside.fields if field.is_used}
        self.sent_names = environment.outside.actions
        self.robots = range(environment.robots)
        self.history = f"{key:x}"

    def begin(self) -> Given:
        """What is observed at first; nothing is earned."""
        return {**self._given(), **{(EARNED, robot): 0.0 for robot in self.robots}}

    def step(self, sent: Mapping[tuple[str, int], float]) -> tuple[Given, bool]:
        """What is given after a step, and whether the episode is over."""
        told = [float(sent[name, robot]).hex() for name in self.sent_names for robot in self.robots]
        self.history = blake2b("|".join([self.history, *told]).encode()).hexdigest()
        return self._given(), self._number("over", 0) % 12 == 0

    def _number(self, name: str, robot: int) -> int:
        text = f"{self.history} {name} {robot}".encode()
        return int.from_bytes(blake2b(text, digest_size=6).digest(), "big")

    def _given(self) -> Given:
        given: Given = {}
        for robot in self.robots:
            for name, size in {**self.sizes, EARNED: None}.items():
                number = self._number(name, robot)
                given[name, robot] = float(number % size) if size else number / 2.0**46 - 2.0
        return given


class MadeUpLanes:
    """The same world in lanes, as rollouts step it."""

    def __init__(self, environment: Environment, rows: Sequence[Slot], sent: Sequence[Slot]) -> None:
        self.environment, self.rows, self.sent_rows = environment, rows, sent
        self.worlds: dict[int, MadeUpWorld] = {}

    def reset(self, lanes: NDArray[np.int64], keys: NDArray[np.uint64], outside: NDArray[np.float64]) -> None:
        for lane in lanes.tolist():
            self.worlds[lane] = MadeUpWorld(self.environment, int(keys[lane]))
            self._fill(lane, self.worlds[lane].begin(), False, outside)

    def step(self, lanes: NDArray[np.int64], sent: NDArray[np.float64], outside: NDArray[np.float64]) -> None:
        for lane in lanes.tolist():
            told = {
                (slot.name, slot.robot or 0): float(sent[row, lane])
                for row, slot in enumerate(self.sent_rows)
            }
            self._fill(lane, *self.worlds[lane].step(told), outside)

    def _fill(self, lane: int, given: Given, over: bool, outside: NDArray[np.float64]) -> None:
        for row, slot in enumerate(self.rows):
            outside[row, lane] = float(over) if slot.robot is None else given[slot.name, slot.robot]


def with_world_outside(spec: Any, observation: Any, action: Any) -> Any:
    """The same spec with some of its state observed instead, in a world that is stepped in Python."""
    spec = deepcopy(spec)
    environment, observed = spec["environment"], set(observation)
    environment.update({"python": "made_up:World", "observation": observation, "action": action})
    blocks = [environment["state"], environment["dynamics"]]
    blocks += [sets for behavior in spec["behaviors"].values() for sets in behavior["actions"].values()]
    for block in blocks:
        for name in observed & block.keys():
            del block[name]
    return spec
