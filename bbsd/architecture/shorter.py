"""A design in fewer words, proven to be the same policy: shorter rules, and no layers that never control."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bbsd.architecture.architecture import Architecture, architecture_of
from bbsd.architecture.boxes import FREE
from bbsd.architecture.policy import MAX_JOINT_CELLS, controlling, joint_space, policy
from bbsd.architecture.rules import conditions, sizes_of
from bbsd.architecture.shortest import rule_list
from bbsd.architecture.tidy import where_decisions_matter
from bbsd.errors import UsageError
from bbsd.language.loading import load
from bbsd.language.models import NO_ACTION_TEXT, Otherwise
from bbsd.text import Source
from bbsd.text.writing.patch import DELETE, replace_blocks

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from bbsd.architecture.boxes import Box
    from bbsd.architecture.rules import RuleData
    from bbsd.language.loading import Loaded
    from bbsd.language.meaning import Meaning
    from bbsd.language.meaning.behaviors import Module
    from bbsd.language.models import Behavior, Rule
    from bbsd.text import Data, DataPath
    from bbsd.text.writing.patch import Deletion


class TooLargeToProve(UsageError):
    """The joint space has too many cells to go through."""

    advice = "bbsd explain shows short rules of each behavior, without such a proof"


@dataclass(frozen=True, slots=True)
class Shortened:
    """What became shorter of a behavior: its words before and now, each a decision or a named cell."""

    behavior: str
    before: int
    now: int
    was_table: bool
    """Whether `before` counts the cells of a table written as text."""


@dataclass(frozen=True, slots=True)
class Shorter:
    """A design in fewer words."""

    text: str
    """The designer's file with shorter rules, and all else as it was."""
    shortened: tuple[Shortened, ...]
    removed: tuple[str, ...]
    """Behaviors that never control, which are no longer in the structure."""
    joint_cells: int
    """The joint cells in all of which the policy was found to be the same."""

    @property
    def is_changed(self) -> bool:
        """Whether anything became shorter."""
        return bool(self.shortened or self.removed)


def shorter(loaded: Loaded) -> Shorter:
    """Return a design in the fewest words, and prove that it does the same in every joint cell.

    Only rules that become shorter are written anew. The proof reads the new text, and compares the controlling
    behavior and its action in each joint cell.

    Raises:
        HolesLeft: the spec has holes.
        TooLargeToProve: the joint space is too large to go through.
    """
    meaning, before = loaded.meaning, architecture_of(loaded.meaning)
    space = joint_space(meaning)
    if not space.is_small:
        raise TooLargeToProve(
            f"the behaviors can tell {space.joint_size:,} situations apart, more than {MAX_JOINT_CELLS:,}, too many "
            "to prove that a shorter design does the same"
        )
    control = np.unique(controlling(space, before))
    order = before.structure.tolist()
    kept = [behavior for behavior in order if behavior in control] or order
    names = [*meaning.spec.behaviors]
    shortened, changes = _changes(meaning, before, kept, where_decisions_matter(space, before))
    if len(kept) < len(order):
        changes["structure",] = [names[behavior] for behavior in reversed(kept)]
    text = replace_blocks(loaded.lineage.flat, changes, after="behaviors") if changes else loaded.source.text
    if changes:
        _prove(loaded, before, text)
    removed = tuple(names[behavior] for behavior in reversed(order) if behavior not in kept)
    return Shorter(text, tuple(reversed(shortened)), removed, space.joint_size)


def _changes(
    meaning: Meaning, before: Architecture, behaviors: Sequence[int], matters: Sequence[NDArray[np.bool_]]
) -> tuple[list[Shortened], dict[DataPath, Data | Deletion]]:
    """Return what becomes shorter of some behaviors, and the changes of the spec that make it so."""
    shortened: list[Shortened] = []
    changes: dict[DataPath, Data | Deletion] = {}
    for behavior in behaviors:
        module = meaning.episode.modules[behavior]
        written = meaning.spec.behaviors[module.name]
        found = _shortened(module, written, before.tables[behavior], matters[behavior])
        if found is not None:
            shortened.append(found[0])
            changes["behaviors", module.name, "rules"] = [*found[1]]
            if written.table is not None:
                changes["behaviors", module.name, "table"] = DELETE
    return shortened, changes


def _shortened(
    module: Module, written: Behavior, table: NDArray[np.uint8], matters: NDArray[np.bool_]
) -> tuple[Shortened, list[RuleData]] | None:
    """Return shorter rules of a behavior; None where what the file has is not longer."""
    values = np.where(matters, table.astype(np.int64), FREE)
    boxes = rule_list(values, sizes_of(module.inputs)).boxes
    rules = _rules(boxes, module)
    now = sum(_n_words(rule) for rule in rules)
    was_table = written.rules is None
    before = len(table) if was_table else sum(_n_written(rule) for rule in written.rules or ())
    return (Shortened(module.name, before, now, was_table), rules) if now < before else None


def _rules(boxes: Sequence[tuple[Box, int]], module: Module) -> list[RuleData]:
    words = (NO_ACTION_TEXT, *module.actions)
    *special, (_, default) = boxes
    rules: list[RuleData] = [
        {"when": conditions(box, module.inputs), "do": words[value]} for box, value in special
    ]
    return [*rules, {"otherwise": words[default]}]


def _n_words(rule: RuleData) -> int:
    when = rule.get("when")
    named = when.values() if isinstance(when, dict) else ()
    return 1 + sum(len(cells) if isinstance(cells, list) else 1 for cells in named)


def _n_written(rule: Rule) -> int:
    return 1 if isinstance(rule, Otherwise) else 1 + sum(len(cells) for cells in rule.when.values())


def _prove(loaded: Loaded, before: Architecture, text: str) -> None:
    """Raise RuntimeError unless the new text has the same policy in every joint cell; that would be a bug."""
    again = load(Source(loaded.source.file, text)).meaning
    policies = (
        policy(joint_space(loaded.meaning), before),
        policy(joint_space(again), architecture_of(again)),
    )
    if not np.array_equal(*policies):
        raise RuntimeError("a shorter design does not do the same in every joint cell")
