"""What would have had to be different: the smallest change of what was perceived, and of the design."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

from bbsd.architecture import Architecture
from bbsd.architecture.policy import policy
from bbsd.errors import UsageError
from bbsd.evaluation.tracing.decisions import layers_of
from bbsd.explanation.why.aim import act_name, acts_named, acts_of
from bbsd.explanation.why.perception import joint_cell, nearest_perception
from bbsd.explanation.why.redesign import Exchange, NewWish, Replacement, deciding, smallest_changes

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from bbsd.architecture import JointSpace
    from bbsd.explanation.why.perception import InputChange
    from bbsd.explanation.why.redesign import Change, Changes
    from bbsd.explanation.why.situation import Situation
    from bbsd.language.meaning.behaviors import Module

MOST_CELLS_COMPARED = 5_000_000
"""Joint cells of all ways together, up to which it is counted where else a way changes what is done."""

MOST_WAYS = 20
"""Ways that are told."""


class AsItWas(UsageError):
    """What should not have been was not, or what should have been was."""


@dataclass(frozen=True, slots=True)
class DesignChange:
    """A change of rules or order in words.

    `cell`: the behavior decides otherwise in the cell of its table that it is in. `exchange`: the behavior exchanges
    its layer with another one. `replacement`: the behavior takes the place of another one, and is in no layer yet.
    """

    kind: Literal["cell", "exchange", "replacement"]
    behavior: str
    cell: Mapping[str, str] | None = None
    was: str | None = None
    becomes: str | None = None
    other: str | None = None
    layer: int | None = None
    """The behavior's layer after the change, counted from 1."""


@dataclass(frozen=True, slots=True)
class Way:
    """Changes of the design, what then controls, and in how many joint cells they change what is done."""

    changes: tuple[DesignChange, ...]
    then: str
    elsewhere: int | None
    """The number of joint cells, this one included; None where it is not counted."""


@dataclass(frozen=True, slots=True)
class Otherwise:
    """What would have had to be different for something to control, or not to."""

    name: str
    wanted: bool
    """Whether it should have controlled, or should not."""
    inputs: tuple[InputChange, ...]
    """The smallest change of what was perceived; empty where none was found."""
    then: str | None
    """What controls after this change of inputs."""
    equally_small: int
    """Changes of as many inputs, this one included."""
    tried: str
    """`all` joint cells; or `pairs`, single inputs and pairs of inputs; or `some pairs`."""
    joint_size: int
    """The number of joint cells; of a small space, of those that can occur."""
    ways: tuple[Way, ...]
    """The smallest changes of rules or order, first those that change the least elsewhere."""
    ways_in_all: int
    """How many there are; of many only the first are among `ways`."""
    is_excited: bool
    """Whether any behavior of that name was excited; where none was, no rule could help."""


def otherwise(
    modules: Sequence[Module],
    architecture: Architecture,
    space: JointSpace,
    situation: Situation,
    name: str,
    *,
    wanted: bool,
    possible: NDArray[np.bool_] | None = None,
) -> Otherwise:
    """Return what would have had to be different for something of that name to control, or not to (`wanted`).

    Of a small space only joint cells count that are `possible`, an array of the shape `space.sizes`; all without it.

    Raises:
        NoSuchAction: the name stands for nothing.
        AsItWas: it did control, or did not.
    """
    named, acts = acts_named(name, modules), acts_of(modules)
    now = deciding(architecture, situation)
    _require_otherwise(name, wanted=wanted, did=now.act in named, instead=act_name(now.act, modules))
    aimed = [number for number, act in enumerate(acts) if (act in named) is wanted]
    found = nearest_perception(space, architecture, joint_cell(space, situation), aimed, possible)
    n_actions = [len(module.actions) for module in modules]
    options = smallest_changes(now, n_actions, {acts[number] for number in aimed})
    counted = space.is_small and space.joint_size * len(options) <= MOST_CELLS_COMPARED
    before = policy(space, architecture) if counted else None
    occurring = np.ones(space.joint_size, np.bool_) if counted and possible is None else possible

    def way_of(changes: Changes) -> Way:
        after, elsewhere = changed(architecture, situation, changes), None
        if before is not None and occurring is not None:
            elsewhere = int(np.count_nonzero((policy(space, after) != before) & occurring.ravel()))
        words = tuple(_in_words(change, modules, architecture, situation) for change in changes)
        return Way(words, act_name(deciding(after, situation).act, modules), elsewhere)

    ways = [way_of(changes) for changes in options]
    return Otherwise(
        name=name,
        wanted=wanted,
        inputs=found.changes,
        then=act_name(acts[found.act], modules) if found.is_found else None,
        equally_small=found.equally_small,
        tried=found.tried,
        joint_size=space.joint_size if possible is None else int(np.count_nonzero(possible)),
        ways=tuple(sorted(ways, key=lambda way: way.elsewhere or 0))[:MOST_WAYS],
        ways_in_all=len(ways),
        is_excited=any(act.behavior < 0 or now.excited[act.behavior] for act in named),
    )


def _require_otherwise(name: str, *, wanted: bool, did: bool, instead: str) -> None:
    if did is not wanted:
        return
    error = AsItWas(f"{name} did control: {instead}" if did else f"{name} did not control: {instead} did")
    error.advice = f"ask --not {name}" if did else f"ask --why-not {name}"
    raise error


def changed(architecture: Architecture, situation: Situation, changes: Changes) -> Architecture:
    """Return an architecture after changes that are made for a situation."""
    tables = [table.copy() for table in architecture.tables]
    now = deciding(architecture, situation)
    for change in changes:
        now = change.apply(now)
        if isinstance(change, NewWish):
            tables[change.behavior][situation.cells[change.behavior]] = change.wish
    return Architecture(tuple(tables), np.array(now.structure, np.int64))


def _in_words(
    change: Change, modules: Sequence[Module], architecture: Architecture, situation: Situation
) -> DesignChange:
    structure = architecture.structure.tolist()
    match change:
        case NewWish(behavior, wish):
            (layer,) = layers_of(modules, np.array([behavior]))
            cell = situation.cells[behavior]
            was = layer.wish(int(architecture.tables[behavior][cell]))
            return DesignChange("cell", layer.behavior, layer.cell_labels(cell), was, layer.wish(wish))
        case Exchange(lower, higher):
            names = (modules[structure[place]].name for place in (lower, higher))
            return DesignChange("exchange", next(names), other=next(names), layer=higher + 1)
        case Replacement(layer_index, behavior):
            other = modules[structure[layer_index]].name
            return DesignChange("replacement", modules[behavior].name, other=other, layer=layer_index + 1)
