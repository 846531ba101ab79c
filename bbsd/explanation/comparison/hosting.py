"""Two designs in one problem: the episodes of one, in which the behaviors of the other can control too."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bbsd.architecture import Architecture, joint_space
from bbsd.errors import UsageError
from bbsd.explanation.comparison.common import definition_differences
from bbsd.language.meaning import elaborate
from bbsd.language.meaning.tables.table import NO_ACTION
from bbsd.language.validation import validate

if TYPE_CHECKING:
    from collections.abc import Mapping

    from bbsd.architecture import JointSpace
    from bbsd.compiler import Problem
    from bbsd.language.loading import Loaded
    from bbsd.language.meaning import Meaning
    from bbsd.language.meaning.behaviors import Module
    from bbsd.language.meaning.tables.labels import Labels
    from bbsd.text import Data


class CannotHost(UsageError):
    """Behaviors that cannot act in the episodes of another spec; the message says why."""


@dataclass(frozen=True, slots=True, eq=False)
class Design:
    """A spec without holes: what was loaded, its problem, and its architecture."""

    loaded: Loaded
    problem: Problem
    architecture: Architecture

    @property
    def modules(self) -> Mapping[str, Module]:
        """The behaviors by their names."""
        return {module.name: module for module in self.loaded.meaning.episode.modules}

    @property
    def order(self) -> tuple[str, ...]:
        """The names of the structure's behaviors, highest layer first."""
        return tuple(self.problem.names[index] for index in reversed(self.architecture.structure.tolist()))


@dataclass(frozen=True, slots=True, eq=False)
class Hosted:
    """The problem of a host, with behaviors of a guest behind its own where they are not the same.

    Both architectures have tables for all behaviors. `names` are those by which people know the behaviors; the host's
    and the guest's may have the same one.
    """

    problem: Problem
    space: JointSpace
    own: Architecture
    guest: Architecture
    names: tuple[str, ...]
    n_own: int
    """The number of the host's behaviors, which come first."""
    dimensions: Mapping[str, Labels]
    """Those of the joint space, with names for people."""


def same_behaviors(one: Design, other: Design) -> tuple[str, ...]:
    """Return the behaviors that both designs have, with the same cells, excitement and actions."""
    ours, theirs = one.loaded.spec.behaviors, other.loaded.spec.behaviors
    return tuple(
        name
        for name in ours
        if name in theirs
        and not definition_differences(ours[name], theirs[name])
        and dict(one.modules[name].inputs) == dict(other.modules[name].inputs)
    )


def hosted(host: Design, guest: Design, guest_name: str) -> Hosted:
    """Return the problem of a host in which the guest's behaviors can control too.

    Args:
        host: in whose episodes they act.
        guest: whose behaviors they are.
        guest_name: what people call the guest, where its inputs have to be told from those of the host.

    Raises:
        CannotHost: a behavior of the guest has no meaning in the host's environment.
    """
    same = same_behaviors(host, guest)
    foreign = [name for name in guest.order if name not in same]
    problem = host.problem
    if foreign:
        problem = problem.with_meaning(_with_behaviors(host, guest, foreign))
    meaning = problem.meaning
    n_own = len(host.modules)
    tables = dict(zip(guest.problem.names, guest.architecture.tables, strict=True))
    index = {name: number for number, name in enumerate(host.problem.names) if name in same}
    index |= {name: n_own + number for number, name in enumerate(foreign)}
    nothing = [np.full(len(tables[name]), NO_ACTION, np.uint8) for name in foreign]
    own = Architecture((*host.architecture.tables, *nothing), host.architecture.structure)
    lent = [
        tables[name] if name in same else table
        for name, table in zip(host.problem.names, host.architecture.tables, strict=True)
    ]
    structure = np.array([index[name] for name in reversed(guest.order)], np.int64)
    space = joint_space(meaning)
    known = zip(meaning.episode.modules[n_own:], foreign, strict=True)
    return Hosted(
        problem,
        space,
        own,
        Architecture((*lent, *(tables[name] for name in foreign)), structure),
        (*host.problem.names, *foreign),
        n_own,
        _for_people(space.dimensions, {module.name: f"{guest_name}'s {name}" for module, name in known}),
    )


def _for_people(dimensions: Mapping[str, Labels], names: Mapping[str, str]) -> dict[str, Labels]:
    """Return dimensions with the names by which people know behaviors."""
    return {
        " of ".join(names.get(part, part) for part in dimension.split(" of ")): labels
        for dimension, labels in dimensions.items()
    }


def _with_behaviors(host: Design, guest: Design, names: list[str]) -> Meaning:
    """Return the host's meaning with behaviors of the guest behind its own, which have other names there."""
    data, theirs = host.loaded.data, guest.loaded.data
    if not isinstance(data, dict) or not isinstance(theirs, dict):
        raise TypeError("a spec is a mapping")
    behaviors, given = _mapping(data, "behaviors"), _mapping(theirs, "behaviors")
    taken = {*behaviors, *given}
    for name in names:
        new = _free_name(name, taken)
        written = given[name]
        if isinstance(written, dict):
            kept = {key: part for key, part in written.items() if key in ("inputs", "excited", "actions")}
            behaviors = {**behaviors, new: kept}
    environment, lent = _mapping(data, "environment"), _mapping(theirs, "environment")
    for block in ("sensors", "definitions"):
        environment = {**environment, block: {**_mapping(lent, block), **_mapping(environment, block)}}
    constants = {**_mapping(theirs, "constants"), **_mapping(data, "constants")}
    spec, errors = validate(
        {**data, "behaviors": behaviors, "environment": environment, "constants": constants}
    )
    if spec is None:
        raise CannotHost(f"the behaviors cannot stand in one spec: {errors[0]['msg']}")
    meaning, mistakes = elaborate(spec, host.loaded.meaning.seed)
    if meaning is None:
        raise CannotHost(_reason(mistakes[0][1].message, names))
    for name, module in zip(names, meaning.episode.modules[-len(names) :], strict=True):
        if dict(module.inputs) != dict(guest.modules[name].inputs):
            raise CannotHost(_reason(f"the inputs of {name} have other cells", [name]))
    return meaning


def _reason(message: str, names: list[str]) -> str:
    return f"{', '.join(names)} cannot act in the other environment: {message}"


def _mapping(data: Mapping[str, Data], key: str) -> dict[str, Data]:
    value = data.get(key)
    return dict(value) if isinstance(value, dict) else {}


def _free_name(name: str, taken: set[str]) -> str:
    new = f"{name}_of_other"
    while new in taken:
        new += "_"
    taken.add(new)
    return new
