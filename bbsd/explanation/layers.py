"""The explanation of an architecture, layer by layer: rules in words, and what higher layers always prevent."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from bbsd.architecture.boxes import first_match
from bbsd.architecture.policy import controlling, decisions, joint_space, own_cells
from bbsd.architecture.rules import boxes_of, n_words_of, sizes_of
from bbsd.architecture.spec_changes import MOST_WORDS
from bbsd.explanation.conditions import condition_text, condition_texts
from bbsd.explanation.vocabulary import GlossaryEntry, actions_of, inputs_of
from bbsd.language.models import NO_ACTION_TEXT

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bbsd.architecture import Architecture, JointSpace
    from bbsd.language.field_types import Expression
    from bbsd.language.meaning import Meaning
    from bbsd.language.meaning.behaviors import Module


@dataclass(frozen=True, slots=True)
class RuleInWords:
    """The decision where a condition holds ('' is otherwise), and whether higher layers always prevent it."""

    decision: str
    where: str
    overruled: bool


@dataclass(frozen=True, slots=True)
class CellsInWords:
    """The number of cells of a table with one decision."""

    decision: str
    cells: int


@dataclass(frozen=True, slots=True)
class LayerInWords:
    """A layer and its behavior.

    The first rule that holds decides; the last one's condition is always ''. If the rules would be too long to read,
    there are none, and `counted` has the number of cells of each decision instead. If higher layers always prevent some
    actions of the behavior, `overruled` says where (except for rules that are overruled as a whole), `effective` where
    it can control, and `overruled_by` names the behaviors that prevent it, highest first; the first two are empty if
    they would be too long to read. `cells` counts the joint cells in which it controls.
    """

    layer: int
    behavior: str
    excited: str | None
    expects: str | None
    rules: tuple[RuleInWords, ...]
    counted: tuple[CellsInWords, ...]
    overruled: tuple[str, ...]
    effective: tuple[str, ...]
    overruled_by: tuple[str, ...]
    cells: int | None

    @property
    def acts(self) -> bool:
        """Whether the behavior has an action in any cell."""
        decisions = [rule.decision for rule in self.rules] + [cells.decision for cells in self.counted]
        return any(decision != NO_ACTION_TEXT for decision in decisions)


@dataclass(frozen=True, slots=True)
class Explanation:
    """An architecture in words, its layers from the highest down.

    If the joint input space is too large to enumerate, everything that depends on it is empty, and numbers of cells
    are None.
    """

    name: str
    layers: tuple[LayerInWords, ...]
    left_out: tuple[str, ...]
    joint_size: int
    nobody: tuple[str, ...]
    nobody_cells: int | None
    inputs: tuple[GlossaryEntry, ...]
    actions: tuple[GlossaryEntry, ...]

    def to_plain(self) -> dict[str, Any]:
        """Return the explanation as plain data for JSON."""
        return asdict(self)


@dataclass(frozen=True, slots=True, eq=False)
class _Control:
    """Where a behavior has an action and where it can control, for each cell of its own table (n_cells,)."""

    acts: NDArray[np.bool_]
    controls: NDArray[np.bool_]
    prevented_by: tuple[int, ...]
    """The behaviors that prevent it in some joint cells where it has an action and never controls."""


def explain_architecture(meaning: Meaning, architecture: Architecture) -> Explanation:
    """Explain an architecture of a spec; numbers of cells count joint cells, not time spent in them."""
    space = joint_space(meaning)
    order = architecture.structure.tolist()
    control = controlling(space, architecture) if space.is_small else None
    nobody = np.zeros(0, bool) if control is None else control < 0
    behaviors = list(meaning.spec.behaviors)
    return Explanation(
        name=meaning.spec.name,
        layers=tuple(
            _layer(meaning, space, architecture, layer, control) for layer in reversed(range(len(order)))
        ),
        left_out=tuple(name for index, name in enumerate(behaviors) if index not in order),
        joint_size=space.joint_size,
        nobody=condition_texts(nobody, np.zeros_like(nobody), space.dimensions) if nobody.any() else (),
        nobody_cells=None if control is None else int(nobody.sum()),
        inputs=inputs_of(meaning.spec, [behaviors[behavior] for behavior in reversed(order)]),
        actions=actions_of(meaning.spec, [behaviors[behavior] for behavior in reversed(order)]),
    )


def _layer(
    meaning: Meaning,
    space: JointSpace,
    architecture: Architecture,
    layer: int,
    controls: NDArray[np.int64] | None,
) -> LayerInWords:
    behavior = int(architecture.structure[layer])
    module, table = meaning.episode.modules[behavior], architecture.tables[behavior]
    written = meaning.spec.behaviors[module.name]
    control = _control(space, behavior, table, controls)
    lost = control.acts & ~control.controls
    rules, whole = _rules(module, table, control)
    names = list(meaning.spec.behaviors)
    above = [other for other in architecture.structure[::-1].tolist() if other in control.prevented_by]
    return LayerInWords(
        layer=layer + 1,
        behavior=module.name,
        excited=_one_line(written.excited),
        expects=_one_line(written.expects),
        rules=rules,
        counted=() if rules else _counted(module, table),
        overruled=condition_texts(lost & ~whole, whole | ~control.acts, module.inputs),
        effective=condition_texts(control.controls, ~control.acts, module.inputs) if lost.any() else (),
        overruled_by=tuple(names[other] for other in above),
        cells=None if controls is None else int(np.count_nonzero(controls == behavior)),
    )


def _one_line(condition: Expression | None) -> str | None:
    return None if condition is None else " ".join(condition.text.split())


def _control(
    space: JointSpace, behavior: int, table: NDArray[np.uint8], controller: NDArray[np.int64] | None
) -> _Control:
    """Return where a behavior acts and controls; without `controller`, it controls wherever it acts."""
    if controller is None:
        return _Control(table > 0, table > 0, ())
    acts = np.broadcast_to(decisions(space, behavior, table) > 0, space.sizes).ravel()
    own = np.broadcast_to(own_cells(space, behavior), space.sizes).ravel()
    controls = _any_of(own[acts & (controller == behavior)], len(table))
    prevented = acts & ~controls[own]
    return _Control(
        _any_of(own[acts], len(table)), controls, tuple(np.unique(controller[prevented]).tolist())
    )


def _any_of(cells: NDArray[np.int64], n_cells: int) -> NDArray[np.bool_]:
    return np.bincount(cells, minlength=n_cells) > 0


def _rules(
    module: Module, table: NDArray[np.uint8], control: _Control
) -> tuple[tuple[RuleInWords, ...], NDArray[np.bool_]]:
    """Return a behavior's rules, none if they would be too long, and the cells of those overruled as a whole."""
    boxes, default = boxes_of(table, module.inputs)
    words, sizes = (NO_ACTION_TEXT, *module.actions), sizes_of(module.inputs)
    whole, rules = np.zeros(len(table), bool), []
    if n_words_of(boxes, module.inputs) > MOST_WORDS:
        return (), whole
    cells = np.arange(len(table)).reshape(sizes)
    elsewhere = np.flatnonzero(first_match([box for box, _ in boxes], sizes) < 0)
    boxes_in_words = [
        (condition_text(box, module.inputs), decision, cells[np.ix_(*box)].ravel()) for box, decision in boxes
    ]
    for where, decision, matched in [*boxes_in_words, ("", default, elsewhere)]:
        acting = matched[(table[matched] == decision) & control.acts[matched]]
        overruled = bool(acting.size and not control.controls[acting].any())
        whole[acting] |= overruled
        rules.append(RuleInWords(words[decision], where, overruled))
    return tuple(rules), whole


def _counted(module: Module, table: NDArray[np.uint8]) -> tuple[CellsInWords, ...]:
    """Return the number of cells of each decision that a table has, the most frequent first."""
    counts = np.bincount(table).tolist()
    words = (NO_ACTION_TEXT, *module.actions)
    cells = [CellsInWords(words[decision], count) for decision, count in enumerate(counts) if count]
    return tuple(sorted(cells, key=lambda counted: -counted.cells))
