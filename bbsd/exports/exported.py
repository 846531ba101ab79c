"""What is exported: a design in the form from which every target is written."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from bbsd.architecture.controller import controller_of
from bbsd.explanation import explain_architecture
from bbsd.explanation.text import layer_sentences

if TYPE_CHECKING:
    from bbsd.architecture import Architecture
    from bbsd.architecture.controller import Controller
    from bbsd.language.meaning import Meaning

Files = Mapping[str, str]
"""The texts of files by their names, the main file first."""


@dataclass(frozen=True, slots=True)
class Exported:
    """A design without holes: its controller, what each layer does in sentences by its number, and its meaning."""

    controller: Controller
    sentences: Mapping[int, tuple[str, ...]]
    meaning: Meaning
    architecture: Architecture


@dataclass(frozen=True, slots=True)
class Options:
    """How a target is written: with sensors, excitation and assignments; and what a tree's leaves are."""

    sensing: bool = False
    leaves: Literal["script", "custom"] = "script"


def exported_design(meaning: Meaning, architecture: Architecture) -> Exported:
    """Return what writers need of a design."""
    explanation = explain_architecture(meaning, architecture)
    sentences = {layer.layer: tuple(layer_sentences(layer)) for layer in explanation.layers}
    return Exported(controller_of(meaning, architecture), sentences, meaning, architecture)
