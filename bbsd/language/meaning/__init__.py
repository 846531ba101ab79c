"""What a spec means: constants, the episode as one graph, tables, the structure, the rates."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING

from bbsd.expression.graph import Graph, GraphTooLargeError, Kind, needed, whole_nodes
from bbsd.expression.mistakes import Mistake, TooManyMistakesError
from bbsd.expression.scope import Findings, Path, Shared, Unusable
from bbsd.kernel.streams import name_word, word_of
from bbsd.language.meaning.constants import GENERATION, Constants, read_constants
from bbsd.language.meaning.definitions import blocks, definitions, twice, unordered
from bbsd.language.meaning.episode import Episode, episode
from bbsd.language.meaning.names import Names
from bbsd.language.meaning.rates import Rates, rates
from bbsd.language.meaning.structure import Structure, structure

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable, Sequence

    from bbsd.expression.graph import Node
    from bbsd.language.models import Spec

MAX_ROUNDS = 100
"""Steps in which a fraction can spread from one slot to the next before none is held for whole."""

__all__ = ["Meaning", "mean", "seed_key"]


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


def seed_key(seed: int) -> int:
    """The key of all streams of a command."""
    return name_word(f"bbsd seed {seed}") ^ word_of(seed)


def mean(
    spec: Spec, seed: int, broken: frozenset[str] = frozenset()
) -> tuple[Meaning | None, tuple[tuple[Path, Mistake], ...]]:
    """Elaborate a spec; all mistakes with their places in it, and the meaning if there are none.

    `broken` are names whose own mistakes were told before; nothing is said about their use.
    """
    findings = Findings()
    try:
        meaning = _meaning(spec, seed, broken, findings)
    except TooManyMistakesError:
        meaning = None
    except GraphTooLargeError:
        meaning, (path, span) = None, findings.entered
        advice = "use fewer robots, or shorter lists and ranges"
        findings.mistakes[
            path, Mistake("BB068", "the spec unrolls to too many values here", span, advice)
        ] = None
    mistakes = tuple(findings.mistakes)
    return None if mistakes or broken else meaning, mistakes


def _meaning(spec: Spec, seed: int, broken: frozenset[str], findings: Findings) -> Meaning | None:
    graph = Graph()
    defined = definitions(spec.environment.definitions, findings)
    silent = {name: Unusable() for name in broken}
    silent |= twice(blocks(spec, defined), findings) | unordered(spec, defined, findings)
    constants = read_constants(spec.constants, seed_key(seed), graph, findings, frozenset(silent))
    meant = episode(Names(spec, graph, findings, constants, defined, silent))
    layers = structure(spec, findings, broken)
    shared = {name: Shared(value) for name, value in constants.values.items()} | silent
    changing = rates(spec, graph, findings, shared)
    _check_wholes(meant, constants, findings)
    if meant is None:
        return None
    return Meaning(spec, seed, graph, constants, meant, layers, changing)


def _check_wholes(meant: Episode | None, constants: Constants, findings: Findings) -> None:
    """Every value used as an index or in values(...) must be whole, given that the slots it reads are.

    Where the episode could not be understood, all slots might be.
    """
    is_whole = cache(constants.whole)
    nodes = [node for *_, node in findings.wholes]
    slots = {**(_whole_slots(meant, is_whole) if meant else _slots_read(nodes)), GENERATION: True}
    whole = whole_nodes(nodes, slots, is_whole)
    for path, span, purpose, node in findings.wholes:
        if not whole[node.number]:
            message = f"{purpose} must be a whole number, and this need not be one"
            findings.tell(path, "BB064", message, span, "round it: floor(...) or round(...)")


def _slots_read(nodes: Sequence[Node]) -> dict[Hashable, bool]:
    return {node.data: True for node in needed(nodes) if node.operation == "slot"}


def _whole_slots(meant: Episode, is_whole: Callable[[Hashable], bool]) -> dict[Hashable, bool]:
    """The slots that always hold whole numbers: the largest set that starts so and that every step keeps."""
    whole: dict[Hashable, bool] = {slot: node.kind is Kind.NUMBER for slot, node in meant.start.items()}
    for _ in range(MAX_ROUNDS):
        found = whole_nodes([*meant.start.values(), *meant.after.values()], whole, is_whole)
        kept: dict[Hashable, bool] = {
            slot: whole[slot] and found[start.number] and found[meant.after[slot].number]
            for slot, start in meant.start.items()
        }
        if kept == whole:
            return whole
        whole = kept
    return dict.fromkeys(whole, False)
