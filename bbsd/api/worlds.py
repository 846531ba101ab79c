"""A spec's world as an environment of other libraries."""

from __future__ import annotations

from typing import Any, Literal

from bbsd.adapters.exchange import Exchange, Observe
from bbsd.api.given.arguments import Assignments, checked, require_none
from bbsd.api.specs import AnySpec, loaded_from
from bbsd.errors import UsageError

Library = Literal["gymnasium", "vector", "pettingzoo"]
LANES = 40
"""Lanes of a vector, by default."""


class LibraryMissing(UsageError):
    """A library that is not installed."""

    def __init__(self, library: str) -> None:
        super().__init__(f"{library} is not installed")
        self.advice = f'pip install "bbsd[{library}]"'


@checked()
def env(
    spec: AnySpec,
    *,
    api: Library = "gymnasium",
    observe: Observe = "sensors",
    lanes: int = LANES,
    seed: int = 0,
    set: Assignments = (),
    compiled: bool = True,
) -> Any:  # noqa: ANN401 - the libraries are optional
    """Return a spec's own world as an environment in which another program chooses what the robots do.

    Its rewards are those of the spec, and its episodes those of `evaluate`: `reset(seed=n)` begins episode n. A choice
    is an action of the spec, or 0, nobody's: then commands stay. `exchange` of what is returned has the names of what
    is observed and chosen, and the choice of each action by its number.

    Args:
        spec: Any spec whose world is its own; whether it has holes does not matter.
        api: `gymnasium` is a `gymnasium.Env` for all robots together, `vector` a `VectorEnv` of many lanes of that,
            `pettingzoo` a `ParallelEnv` with an agent for each robot.
        observe: `sensors`: a number for each value of the robot's own state and sensors, all that its behaviors may
            know (truths are 0 and 1, cells of a sensor indices). `cells`: the index of each cell that behaviors tell
            apart.
        lanes: Lanes of a `vector`.
        seed: The seed of the evaluation whose episodes are meant, and of the constants.
        set: Values that replace those of the spec.
        compiled: Whether as machine code, which takes some seconds at the first time.

    Raises:
        SpecError: with all mistakes of the spec.
        NotOurWorld: the spec's world is somebody else's environment.
        LibraryMissing: Gymnasium or PettingZoo is not installed.
        BadArgument: another `api` or `observe`, or lanes where there are none.
    """
    if api != "vector":
        require_none(["lanes"] if lanes != LANES else [], 'without api="vector"')
    loaded = loaded_from(spec, seed, set)
    exchange = Exchange(loaded.meaning, observe)
    generation = loaded.spec.design.coevolution.generations
    try:
        if api == "pettingzoo":
            from bbsd.adapters.pettingzoo import WorldParallelEnv

            return WorldParallelEnv(exchange, seed, generation, compiled=compiled)
        from bbsd.adapters.gymnasium import WorldEnv, WorldVectorEnv
    except ModuleNotFoundError as error:
        if error.name not in ("gymnasium", "pettingzoo"):
            raise
        raise LibraryMissing(error.name) from None
    if api == "vector":
        return WorldVectorEnv(exchange, lanes, seed, generation, compiled=compiled)
    return WorldEnv(exchange, seed, generation, compiled=compiled)
