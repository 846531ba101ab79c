"""Look at what an environment shows and takes, before or after a spec says so."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from bbsd.api.given.arguments import Assignments, assignments, checked, require_none
from bbsd.api.given.environments import users_consent
from bbsd.api.given.sources import AnySpec, source_of
from bbsd.api.specs import load
from bbsd.environments.for_spec import closed_folders, located, settings
from bbsd.environments.lanes.time_limit import DEFAULT_LIMIT
from bbsd.environments.opening import Recipe, open_environment
from bbsd.environments.spaces.matching import misfits
from bbsd.environments.spaces.misfits import UnfitError
from bbsd.environments.spaces.pasting import environment_text
from bbsd.errors import UsageError
from bbsd.language.lineage import read_lineage
from bbsd.language.loading import Loaded
from bbsd.language.outside import EXAMPLES, OUTSIDE_KINDS, Outside, is_target
from bbsd.language.overrides import read_overrides, with_overrides

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence
    from pathlib import Path

    from bbsd.environments.importing.modules import Announce
    from bbsd.environments.opening import Opened
    from bbsd.errors import SpecError
    from bbsd.language.lineage import Lineage
    from bbsd.text import Data


class NoEnvironment(UsageError):
    """A spec that names no environment, or not in the form of one."""

    advice = "write environment: {gymnasium: CartPole-v1}, or one of pettingzoo: or python:"


@dataclass(frozen=True, slots=True)
class Spaces:
    """What an environment shows and takes, and what a spec may say of it."""

    target: str
    origin: Mapping[str, str]
    """Versions by module, and a digest of the file that the environment is from."""
    observation: str
    """The space of observations, as Gymnasium writes it."""
    action: str
    agents: tuple[str, ...]
    """The agents of a PettingZoo environment, which are the robots; none of others."""
    step_limit: int | None
    """Steps after which the environment ends an episode by its registration."""
    proposal: str
    """The block `environment` of a spec, as YAML text with comments."""
    mistakes: SpecError | None = None
    """Where the spec that was given does not fit the environment."""

    def __str__(self) -> str:
        return self.proposal

    def __repr__(self) -> str:
        return f"<Spaces of {self.target}: {self.observation}, {self.action}>"


@checked()
def spaces(
    spec: AnySpec | None = None,
    *,
    gymnasium: str | None = None,
    pettingzoo: str | None = None,
    python: str | None = None,
    allow_import: Sequence[str] = (),
    import_from: Sequence[str | Path] = (),
    environment: Callable[..., Any] | None = None,
    step_limit: float = DEFAULT_LIMIT,
    set: Assignments = (),
    announce: Announce | None = None,
) -> Spaces:
    """Look at the spaces of an environment: that of a spec, which need not be complete, or one that is named.

    Args:
        spec: A spec whose `environment` says which; none where one is named by the next arguments.
        gymnasium: The id of a Gymnasium environment.
        pettingzoo: The module of a PettingZoo environment.
        python: A class, as module:Class.
        allow_import: Modules that may be imported, with all below them, besides those of the configuration file.
        import_from: Folders in which modules are looked for, after the installed environment.
        environment: A class in hand that is the spec's environment; nothing is imported for it.
        step_limit: Seconds that making it may take.
        set: Values that replace those of the spec.
        announce: Called with each module and its file before it is imported.

    Raises:
        NoEnvironment: the spec names none.
        SpecError: the spec cannot be read, or there is no such environment.
        ImportNotAllowed, NoSuchModule, EnvironmentFailed, EnvironmentHangs: it cannot be opened.
    """
    named = {"gymnasium": gymnasium, "pettingzoo": pettingzoo, "python": python}
    if spec is not None:
        others = [name for name, target in named.items() if target is not None]
        require_none(others, "beside a spec, which names its environment")
    else:
        require_none(["set"] if set else [], "without a spec")
    lineage, data = _spec_data(spec, set) if spec is not None else (None, _block(named))
    block = _environment(data)
    closed = closed_folders(lineage) if lineage is not None else ()
    allowed = users_consent(allow_import, import_from)
    recipe = Recipe(_outside(block), 0, allowed, closed, step_limit, environment)
    try:
        opened = open_environment(recipe, announce)
    except UnfitError as error:
        if lineage is None:
            misfit = error.misfits[0]
            refused = NoEnvironment(misfit.message)
            refused.advice = misfit.advice
            raise refused from None
        raise located(error.misfits, lineage) from None
    mistakes = _mistakes(spec, set, opened, block) if spec is not None else None
    return _described(opened, block, mistakes)


def _block(named: Mapping[str, str | None]) -> dict[str, Data]:
    return {"environment": {kind: target for kind, target in named.items() if target is not None}}


def _spec_data(spec: AnySpec, set: Assignments) -> tuple[Lineage, Data]:
    """Return a spec's files and its data, whether or not it is complete."""
    own = spec.overrides if isinstance(spec, Loaded) else ()
    lineage = spec.lineage if isinstance(spec, Loaded) else read_lineage(source_of(spec))
    if lineage.mistakes:
        raise lineage.error(lineage.mistakes)
    overrides = (*own, *assignments(set))
    return lineage, with_overrides(lineage.data, read_overrides(overrides), overrides)


def _environment(data: Data) -> dict[str, Data]:
    block = data.get("environment") if isinstance(data, dict) else None
    if not isinstance(block, dict):
        raise NoEnvironment("there is no block environment")
    return block


def _outside(block: Mapping[str, Data]) -> Outside:
    """Return which environment a block names, with its arguments alone."""
    kinds = [kind for kind in OUTSIDE_KINDS if block.get(kind) is not None]
    if len(kinds) != 1:
        found = " and ".join(kinds) or "none"
        raise NoEnvironment(f"environment must name one of {', '.join(OUTSIDE_KINDS)}, and there is {found}")
    kind, target, arguments = kinds[0], block[kinds[0]], block.get("with") or {}
    if not isinstance(target, str) or not is_target(kind, target):
        error = NoEnvironment(f"{target!r} cannot be the name of an environment")
        error.advice = f"write {EXAMPLES[kind]}"
        raise error
    if not isinstance(arguments, dict):
        raise NoEnvironment("with must be a mapping of arguments")
    return Outside(kind, target, arguments, (), ())


def _mistakes(spec: AnySpec, set: Assignments, opened: Opened, block: Mapping[str, Data]) -> SpecError | None:
    """Return where a spec that says what it observes or sends does not fit; None where it fits, or says neither yet."""
    if not {"observation", "action"} & block.keys():
        return None
    loaded = load(spec, set=set)
    outside = loaded.spec.environment.outside
    if outside is None:
        return None
    found = misfits(outside, opened.observed, opened.taken, settings(loaded.meaning), opened.making.label)
    return located(found, loaded.lineage) if found else None


def _described(opened: Opened, block: Mapping[str, Data], mistakes: SpecError | None) -> Spaces:
    steps, limit = block.get("steps"), opened.making.most_steps
    proposal = environment_text(
        opened.recipe.outside,
        opened.observed,
        opened.taken,
        max(1, len(opened.agents)),
        steps if isinstance(steps, int) else limit,
        opened.making.label,
    )
    action = "unknown" if opened.taken is None else str(opened.taken)
    return Spaces(
        opened.name, opened.origin, str(opened.observed), action, opened.agents, limit, proposal, mistakes
    )
