"""How an environment is made: the class or function that a spec's target names, found among what may be imported."""

from __future__ import annotations

import copy
import pkgutil
import re
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from bbsd.environments.importing.modules import NoSuchModule, imported
from bbsd.environments.spaces.misfits import Misfit, UnfitError
from bbsd.errors import did_you_mean

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping
    from types import ModuleType

    from bbsd.environments.importing.consent import Consent
    from bbsd.environments.importing.modules import Announce
    from bbsd.language.outside import Outside

VERSION = re.compile(r"(?P<name>.+?)(?P<mark>-v|_v)(?P<number>\d+)")
OF_MAKE = ("max_episode_steps", "disable_env_checker")
"""Arguments of Gymnasium's own `make`, which no environment is given."""
PACKAGES: Mapping[str, str] = {
    "ALE/": "ale_py",
    "BabyAI-": "minigrid",
    "MiniGrid-": "minigrid",
    "highway-": "highway_env",
}
"""Packages that register well-known ids when they are imported, by how these ids begin."""
MOVED: Mapping[str, str] = {"pettingzoo.mpe.": "mpe2."}
"""Where environments went that their package no longer has."""


@dataclass(frozen=True)
class Making:
    """What makes an environment, with which arguments; the modules that it is from; its own limit of steps."""

    create: Callable[..., Any]
    arguments: Mapping[str, Any]
    modules: tuple[str, ...]
    most_steps: int | None = None
    label: str = field(default="")
    """The name without version, by which well-known environments are known."""

    def make(self) -> Any:  # noqa: ANN401 - whatever environment
        """Return a new environment."""
        return self.create(**copy.deepcopy(dict(self.arguments)))


def making_of(outside: Outside, consent: Consent, announce: Announce | None = None) -> Making:
    """Return how the environment of a spec is made; to be called inside `importing.searching`.

    Raises:
        ImportNotAllowed: a module that it needs was not allowed; none was imported then.
        NoSuchModule: a module is not installed.
        EnvironmentFailed: a module raised an error.
        UnfitError: there is no such environment in it.
    """
    match outside.kind:
        case "gymnasium":
            return _of_gymnasium(outside, consent, announce)
        case "pettingzoo":
            return _of_pettingzoo(outside, consent, announce)
        case "python":
            return _of_python(outside, consent, announce)


def _of_gymnasium(outside: Outside, consent: Consent, announce: Announce | None) -> Making:
    plugin, _, name = outside.target.rpartition(":")
    modules = ["gymnasium", *([plugin] if plugin else [])]
    for module in modules:  # all is asked for before any of it is imported
        consent.require(module, outside.target)
    gymnasium, *_ = [imported(module, consent, outside.target, announce) for module in modules]
    registry = gymnasium.registry
    if name not in registry:
        raise UnfitError(_unknown_id(name, registry, plugin))
    registered = registry[name]
    if registered.additional_wrappers:
        wrappers = ", ".join(wrapper.name for wrapper in registered.additional_wrappers)
        message = f"{name} is registered with wrappers ({wrappers}), which bbsd does not apply"
        raise _unknown(outside, message, "write a class that makes it with them, and name that by python:")
    create, module = _entry(registered.entry_point, outside, consent, announce)
    arguments = {**registered.kwargs, **outside.arguments}
    return Making(
        create,
        {key: value for key, value in arguments.items() if key not in OF_MAKE},
        tuple(dict.fromkeys([*modules, module])),
        _most_steps(outside.arguments.get("max_episode_steps", registered.max_episode_steps)),
        str(registered.name),
    )


def _most_steps(wanted: object) -> int | None:
    """Return a limit of steps as `gymnasium.make` takes it: None and -1 are none."""
    if wanted is None or wanted == -1:
        return None
    if isinstance(wanted, int) and not isinstance(wanted, bool) and wanted > 0:
        return wanted
    path = ("environment", "with", "max_episode_steps")
    raise UnfitError(
        Misfit("BB122", path, "max_episode_steps is a whole number from 1 on, or -1 for no limit")
    )


def _entry(
    entry: Any,  # noqa: ANN401 - a text or what it names
    outside: Outside,
    consent: Consent,
    announce: Announce | None,
) -> tuple[Callable[..., Any], str]:
    """Return what a registered entry point names, and its module, which must be allowed too."""
    if isinstance(entry, str):
        module, _, name = entry.partition(":")
        create = getattr(imported(module, consent, outside.target, announce), name, None)
    else:
        module, name, create = getattr(entry, "__module__", ""), repr(entry), entry
        consent.require(module, outside.target)
    if not callable(create):
        raise _unknown(outside, f"{outside.target} is registered, but its entry point {entry!r} is not there")
    return create, module


def _unknown_id(name: str, registry: Mapping[str, Any], plugin: str) -> Misfit:
    path = ("environment", "gymnasium")
    others = _other_versions(name, registry)
    if others:
        newest = others[-1]
        advice = f"write gymnasium: {f'{plugin}:' if plugin else ''}{newest}"
        if _version(newest) > _version(name):
            return Misfit("BB121", path, f"{name} is no longer there; its successor is {newest}", advice)
        return Misfit("BB121", path, f"there is no {name}; the newest version is {newest}", advice)
    if plugin:
        hint = did_you_mean(name, registry)
        return Misfit("BB121", path, f"{plugin} and Gymnasium have no environment {name}{hint}")
    for beginning, package in PACKAGES.items():
        if name.startswith(beginning):
            advice = f"write gymnasium: {package}:{name}"
            return Misfit("BB121", path, f"Gymnasium has no environment {name} by itself", advice)
    advice = "for one that another package registers, write its module before it: module:Name-v0"
    return Misfit("BB121", path, f"Gymnasium has no environment {name}{did_you_mean(name, registry)}", advice)


def _other_versions(name: str, known: Iterable[str]) -> list[str]:
    """Return the names that differ only in their version, oldest first."""
    match = VERSION.fullmatch(name)
    if match is None:
        return []
    found = (VERSION.fullmatch(other) for other in known)
    same = [other[0] for other in found if other and other["name"].lower() == match["name"].lower()]
    return sorted(same, key=_version)


def _version(name: str) -> int:
    match = VERSION.fullmatch(name)
    return int(match["number"]) if match else -1


def _of_pettingzoo(outside: Outside, consent: Consent, announce: Announce | None) -> Making:
    for old, new in MOVED.items():
        if outside.target.startswith(old):
            raise _replaced(outside, new + outside.target.removeprefix(old))
    try:
        module = imported(outside.target, consent, outside.target, announce)
    except NoSuchModule:
        raise _not_among_siblings(outside, consent) from None
    create = getattr(module, "parallel_env", None)
    if not callable(create):
        advice = "environments in which agents take turns cannot be used"
        raise _unknown(
            outside, f"{outside.target} has no parallel_env, in which all agents act at once", advice
        )
    label = VERSION.sub(r"\g<name>", outside.target.rpartition(".")[2])
    return Making(create, outside.arguments, (outside.target,), label=label)


def _not_among_siblings(outside: Outside, consent: Consent) -> Exception:
    """Return the error of an environment that is not in its package, with what may be meant."""
    package, _, name = outside.target.rpartition(".")
    if not consent.covers(package):
        return _unknown(outside, f"there is no {outside.target}")
    parent = imported(package, consent, outside.target)
    siblings = [found.name for found in pkgutil.iter_modules(getattr(parent, "__path__", ()))]
    others = _other_versions(name, siblings)
    if others:
        return _replaced(outside, f"{package}.{others[-1]}")
    environments = [sibling for sibling in siblings if VERSION.fullmatch(sibling)]
    return _unknown(outside, f"{package} has no environment {name}{did_you_mean(name, environments)}")


def _replaced(outside: Outside, successor: str) -> UnfitError:
    message = f"{outside.target} is not there; its successor is {successor}"
    return _unknown(outside, message, f"write pettingzoo: {successor}")


def _of_python(outside: Outside, consent: Consent, announce: Announce | None) -> Making:
    name, _, attribute = outside.target.partition(":")
    module = imported(name, consent, outside.target, announce)
    return making_of_class(_class(module, attribute, outside, consent), outside)


def making_of_class(create: Callable[..., Any], outside: Outside) -> Making:
    """Return how a class that is at hand is made an environment with the arguments of a spec."""
    return Making(create, outside.arguments, (getattr(create, "__module__", "") or "",), label=outside.target)


def _class(module: ModuleType, name: str, outside: Outside, consent: Consent) -> Callable[..., Any]:
    """Return a class with `reset` and `step`: a function might do anything with arguments that a stranger chose."""
    found = getattr(module, name, None)
    if found is None:
        classes = [key for key, value in vars(module).items() if isinstance(value, type)]
        raise _unknown(outside, f"{module.__name__} has no class {name}{did_you_mean(name, classes)}")
    if not isinstance(found, type):
        advice = "write a class with reset and step; what makes a wrapped environment can be its __init__"
        raise _unknown(outside, f"{outside.target} is not a class", advice)
    missing = [method for method in ("reset", "step") if not callable(getattr(found, method, None))]
    if missing:
        advice = "an environment has reset(seed=...) and step(action), as Gymnasium's or PettingZoo's"
        raise _unknown(outside, f"{outside.target} has no {' and no '.join(missing)}", advice)
    consent.require(found.__module__, outside.target)
    return found


def _unknown(outside: Outside, message: str, advice: str = "") -> UnfitError:
    return UnfitError(Misfit("BB121", ("environment", outside.kind), message, advice))
