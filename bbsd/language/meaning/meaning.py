"""A spec's meaning, as one value."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from bbsd.kernel.streams import name_word, word_of

if TYPE_CHECKING:
    from bbsd.expression.graph import Graph, Node
    from bbsd.expression.scope import Path
    from bbsd.expression.syntax.tree import Span
    from bbsd.language.meaning.episode.episode import Episode
    from bbsd.language.meaning.naming.constants import Constants
    from bbsd.language.meaning.rates import Rates
    from bbsd.language.meaning.structure import Structure
    from bbsd.language.models import Spec


@dataclass(frozen=True, slots=True)
class Meaning:
    """A spec without mistakes, elaborated for one seed."""

    spec: Spec
    seed: int
    graph: Graph
    constants: Constants
    episode: Episode
    structure: Structure
    rates: Rates
    equalities: tuple[tuple[Path, Span, Node, Node], ...] = ()
    """Numbers that are compared by == or !=, each pair with its place, for each robot."""


def seed_key(seed: int) -> int:
    """Return the key of all random streams of a command."""
    return name_word(f"bbsd seed {seed}") ^ word_of(seed)
