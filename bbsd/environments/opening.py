"""An environment whose import was allowed, opened: its spaces, what identifies it, and what steps it."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

from bbsd.environments.importing.consent import Consent
from bbsd.environments.importing.modules import searching
from bbsd.environments.lanes.calling import calling
from bbsd.environments.lanes.common import Dealings, checked_start
from bbsd.environments.lanes.gymnasium import GymnasiumLanes
from bbsd.environments.lanes.pettingzoo import PettingZooLanes
from bbsd.environments.lanes.time_limit import DEFAULT_LIMIT, CallWatch
from bbsd.environments.making import making_of, making_of_class
from bbsd.environments.origin import NotPortable, importable, origin_of
from bbsd.environments.spaces.kinds import Space, space_of, space_of_value
from bbsd.environments.spaces.misfits import Misfit, UnfitError
from bbsd.environments.spaces.reading import reader_of
from bbsd.environments.spaces.sending import sender_of
from bbsd.environments.tables import NoTable, copied_table
from bbsd.errors import UsageError, escape
from bbsd.language.outside import Field, Outside

if TYPE_CHECKING:
    from collections.abc import Callable

    from bbsd.environments.importing.modules import Announce
    from bbsd.environments.lanes.common import Lanes
    from bbsd.environments.making import Making
    from bbsd.environments.tables import TransitionTable
    from bbsd.text import Data


class OtherEnvironment(UsageError):
    """Another process has another version of an environment."""

    advice = "install the same versions everywhere"


TABLE = "table"
"""Under which the digest of an environment's table of transitions is kept, where it is stepped by it."""


@dataclass(frozen=True)
class Recipe:
    """How to open an environment, also in another process: what the spec says of it, and the consent of the user."""

    outside: Outside
    robots: int
    """How many the spec has; 0 for as many as the environment has."""
    consent: Consent = field(default_factory=Consent)
    closed: tuple[str, ...] = ()
    """Folders from which nothing is imported unless the consent names them."""
    seconds: float = DEFAULT_LIMIT
    given: Callable[..., Any] | None = None
    """A class that the caller has in hand; nothing is imported then."""

    @property
    def is_portable(self) -> bool:
        """Whether another process can open it."""
        try:
            self.plain()
        except NotPortable:
            return False
        return True

    def plain(self) -> dict[str, Data]:
        """Return the recipe as plain data, from which `recipe_of` makes it again in another process.

        Raises NotPortable where a class is given that no other process can import.
        """
        outside, modules, folders = self.outside, self.consent.modules, self.consent.folders
        target = outside.target
        if self.given is not None:
            target, folder = importable(self.given)
            modules, folders = (target.partition(":")[0],), (folder,)
        return {
            "kind": outside.kind,
            "target": target,
            "arguments": dict(outside.arguments),
            "fields": [
                [each.name, each.size, None if each.path is None else [*each.path]] for each in outside.fields
            ],
            "actions": [*outside.actions],
            "robots": self.robots,
            "modules": [*modules],
            "folders": [*folders],
            "closed": [*self.closed],
            "seconds": self.seconds,
        }


def recipe_of(plain: Any) -> Recipe:  # noqa: ANN401 - what `Recipe.plain` returned
    """Return the recipe that is written as plain data: by this process's parent, never by a file."""
    fields = tuple(
        Field(name, size, None if path is None else tuple(path)) for name, size, path in plain["fields"]
    )
    outside = Outside(plain["kind"], plain["target"], plain["arguments"], fields, tuple(plain["actions"]))
    allowed = Consent(tuple(plain["modules"]), tuple(plain["folders"]))
    return Recipe(outside, plain["robots"], allowed, tuple(plain["closed"]), plain["seconds"])


@dataclass(frozen=True)
class Opened:
    """An environment that can be stepped."""

    recipe: Recipe
    making: Making
    observed: Space
    taken: Space | None
    """None where the environment names no space of actions."""
    agents: tuple[str, ...]
    """The agents of a PettingZoo environment; none of others."""
    origin: dict[str, str]
    """Versions of distributions by their modules, and a digest of the file that the environment is from."""
    table: TransitionTable | None = None
    """The transitions by which it is stepped, instead of in Python; None where it is not."""

    @property
    def name(self) -> str:
        """What the environment is called."""
        return self.recipe.outside.target

    def make(self) -> Any:  # noqa: ANN401 - whatever environment
        """Return a new environment, without the wrappers that `gymnasium.make` adds."""
        return self.making.make()

    def stepper(self) -> Lanes:
        """Return what steps the environment in lanes; the spec must fit it (`matching.misfits`)."""
        outside = self.recipe.outside
        dealings = Dealings(
            self.name,
            self.make,
            reader_of(outside.fields, self.observed),
            sender_of(self.taken, len(outside.actions)),
            sum(field.is_used for field in outside.fields),
            outside.actions,
            self.agents,
            self.making.most_steps,
            self.recipe.seconds,
        )
        return PettingZooLanes(dealings) if self.agents else GymnasiumLanes(dealings)

    def plain(self) -> dict[str, str]:
        """Return what identifies the environment, as `run.json` holds it."""
        return {
            "target": self.name,
            **self.origin,
            "observation space": str(self.observed),
            "action space": "unknown" if self.taken is None else str(self.taken),
            **({"agents": " ".join(self.agents)} if self.agents else {}),
            **({} if self.making.most_steps is None else {"step limit": str(self.making.most_steps)}),
            **({} if self.table is None else {TABLE: self.table.digest}),
        }

    def __reduce__(self) -> tuple[Callable[..., Opened], tuple[dict[str, Data], dict[str, str]]]:
        return opened_again, (self.recipe.plain(), self.plain())


def opened_again(recipe: dict[str, Data], expected: dict[str, str]) -> Opened:
    """Open an environment in another process, by the consent that its recipe brings along.

    Raises OtherEnvironment where it is not the one that is expected.
    """
    opened = open_environment(recipe_of(recipe))
    if TABLE in expected:
        opened = replace(opened, table=_table_again(opened))
    found = opened.plain()
    different = [key for key in {**expected, **found} if expected.get(key) != found.get(key)]
    if different:
        words = [f"{key} ({found.get(key, 'none')}, not {expected.get(key, 'none')})" for key in different]
        raise OtherEnvironment(f"{opened.name} is another one in a worker process: {', '.join(words)}")
    return opened


def _table_again(opened: Opened) -> TransitionTable | None:
    """Return the table of an environment that another process has compared with real steps."""
    try:
        return replace(copied_table(opened.make()), most_steps=opened.making.most_steps)
    except NoTable:
        return None


def open_environment(recipe: Recipe, announce: Announce | None = None) -> Opened:
    """Import what an environment needs as far as that was allowed, make one, and look at its spaces.

    Args:
        recipe: which environment, and what may be imported.
        announce: called with each module and its file before it is imported.

    Raises:
        ImportNotAllowed, NoSuchModule, EnvironmentFailed, EnvironmentHangs: what can happen on the way.
        UnfitError: there is no such environment, or it cannot be made with these arguments or for these robots.
    """
    outside = recipe.outside
    with searching(recipe.consent, recipe.closed):
        if recipe.given is not None:
            making = making_of_class(recipe.given, outside)
        else:
            making = making_of(outside, recipe.consent, announce)
        with calling(lambda: f"{outside.target}, when it was made,", CallWatch(recipe.seconds)):
            environment = _made(making, outside)
            agents = tuple(map(str, getattr(environment, "possible_agents", ())))
            _require_robots(recipe.robots, agents, outside)
            observed, taken = _spaces(environment, agents)
    modules = making.modules if recipe.given is None else ()
    return Opened(recipe, making, observed, taken, agents, origin_of(environment, modules))


def _made(making: Making, outside: Outside) -> Any:  # noqa: ANN401 - whatever environment
    try:
        return making.make()
    except (Exception, SystemExit) as error:  # noqa: BLE001 - all that somebody else's code may raise
        said = escape(" ".join(str(error).split()))
        message = f"{outside.target} cannot be made with these arguments: {type(error).__name__}: {said}"
        key = "with" if outside.arguments else outside.kind
        raise UnfitError(Misfit("BB122", ("environment", key), message)) from None


def _require_robots(robots: int, agents: tuple[str, ...], outside: Outside) -> None:
    path = ("environment", "robots")
    if outside.kind == "pettingzoo" and not agents:
        message = f"{outside.target} names no possible_agents"
        raise UnfitError(Misfit("BB121", ("environment", outside.kind), message))
    if not robots:
        return
    if not agents and robots != 1:
        message = f"{outside.target} has one robot, not {robots}"
        raise UnfitError(Misfit("BB120", path, message, "write robots: 1, or leave it out"))
    if agents and len(agents) != robots:
        message = f"{outside.target} has {len(agents)} agents, and robots is {robots}"
        raise UnfitError(Misfit("BB120", path, message, f"write robots: {len(agents)}"))


def _spaces(environment: Any, agents: tuple[str, ...]) -> tuple[Space, Space | None]:  # noqa: ANN401
    """Return the spaces of observations and of actions; where none is named, what a first observation suggests."""
    if agents:
        observed = {agent: space_of(environment.observation_space(agent)) for agent in agents}
        taken = {agent: space_of(environment.action_space(agent)) for agent in agents}
        _require_alike(observed, "observes")
        _require_alike(taken, "does")
        return observed[agents[0]], taken[agents[0]]
    space, actions = (getattr(environment, name, None) for name in ("observation_space", "action_space"))
    observed_space = (
        space_of_value(checked_start(environment.reset(seed=0))) if space is None else space_of(space)
    )
    return observed_space, None if actions is None else space_of(actions)


def _require_alike(spaces: dict[str, Space], what: str) -> None:
    (first, space), *others = spaces.items()
    for agent, other in others:
        if other != space:
            message = f"{agent} {what} {other}, and {first} {space}: one design cannot serve both"
            raise UnfitError(Misfit("BB124", ("environment", "pettingzoo"), message))
