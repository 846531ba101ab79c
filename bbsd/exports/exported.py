"""What is exported: a design in the form from which every target is written."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import isfinite
from typing import TYPE_CHECKING, Literal

from bbsd.architecture.controller import controller_of
from bbsd.explanation import explain_architecture
from bbsd.explanation.text import layer_sentences
from bbsd.expression.graph import value_of
from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import variable_text

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bbsd.architecture import Architecture
    from bbsd.architecture.controller import Controller
    from bbsd.expression.graph import Node
    from bbsd.language.meaning import Meaning

Files = Mapping[str, str]
"""The texts of files by their names, the main file first."""


@dataclass(frozen=True, slots=True)
class Exported:
    """A design without holes: its controller, what each layer does in sentences by its number, and its meaning.

    `fixed` has for each action, by its number less 1, the names that it sets to a number or a truth that is the same
    for all robots at all times, with that value; what else it sets is an expression of the design.
    """

    controller: Controller
    sentences: Mapping[int, tuple[str, ...]]
    meaning: Meaning
    architecture: Architecture
    fixed: tuple[Mapping[str, float | bool], ...]


@dataclass(frozen=True, slots=True)
class Options:
    """How a target is written: with sensors, excitation and assignments; and what a tree's leaves are.

    With `sensing`, values that are `measured` or `remembered` (`bbsd.architecture.needs.needs_of`).
    """

    sensing: bool = False
    measured: tuple[str, ...] = ()
    remembered: tuple[str, ...] = ()
    leaves: Literal["script", "custom"] = "script"


def exported_design(meaning: Meaning, architecture: Architecture) -> Exported:
    """Return what writers need of a design."""
    explanation = explain_architecture(meaning, architecture)
    sentences = {layer.layer: tuple(layer_sentences(layer)) for layer in explanation.layers}
    return Exported(
        controller_of(meaning, architecture), sentences, meaning, architecture, fixed_values(meaning)
    )


def fixed_values(meaning: Meaning) -> tuple[Mapping[str, float | bool], ...]:
    """Return the values of `Exported.fixed`."""
    return tuple(
        {
            variable_text(variable): value
            for variable, nodes in sets.items()
            if (value := _fixed(meaning, nodes)) is not None
        }
        for module in meaning.episode.modules
        for sets in module.actions.values()
    )


def _fixed(meaning: Meaning, nodes: Sequence[Node]) -> float | bool | None:
    """Return the one finite value of nodes, one for each robot; None where they have none."""
    values = {value_of(node) if node.literal else meaning.constants.static(node) for node in nodes}
    (value, *others) = values
    if others or value is None or not isfinite(value):
        return None
    return bool(value) if nodes[0].kind is Kind.TRUTH else float(value)
