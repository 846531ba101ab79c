"""What a spec means: constants with values, the episode as one graph, tables with given cells, the structure, the rates."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from bbsd.expression.graph import Graph, Kind, whole_nodes
from bbsd.expression.mistakes import Mistake
from bbsd.expression.scope import Findings, Path, Shared, Unusable
from bbsd.expression.tree import Span
from bbsd.kernel.streams import name_word, word_of
from bbsd.spec.meaning.constants import Constants, read_constants
from bbsd.spec.meaning.definitions import blocks, cyclic, definitions, twice
from bbsd.spec.meaning.episode import Episode, episode
from bbsd.spec.meaning.names import Names, Slot
from bbsd.spec.meaning.rates import Rates, rates
from bbsd.spec.meaning.structure import Structure, structure
from bbsd.spec.models import Spec

__all__ = ["Meaning", "mean", "seed_key"]


@dataclass(frozen=True, slots=True)
class Meaning:
    """A spec without mistakes, elaborated for one seed."""

    spec: Spec
    seed: int
    constants: Constants
    episode: Episode
    structure: Structure
    rates: Rates


def seed_key(seed: int) -> int:
    """The key of all streams of a command."""
    return name_word(f"bbsd seed {seed}") ^ word_of(seed)


def mean(spec: Spec, seed: int, broken: frozenset[str] = frozenset()) -> tuple[Meaning | None, tuple[tuple[Path, Mistake], ...]]:
    """Elaborate a spec; all mistakes with their places in it, and the meaning if there are none.

    `broken` are names whose own mistakes were told before; nothing is said about their use.
    """
    graph, findings = Graph(), Findings()
    defined = definitions(spec.environment.definitions, findings)
    silent = {name: Unusable() for name in broken} | cyclic(spec, defined, findings)
    silent |= {name: Unusable() for name in twice(blocks(spec, defined), findings)}
    constants = read_constants(spec.constants, seed_key(seed), graph, findings, frozenset(silent))
    names = Names(spec, graph, findings, constants, defined, silent)
    meant = episode(names)
    layers = structure(spec, findings, broken)
    shared = {name: Shared(value) for name, value in constants.values.items()} | silent
    changing = rates(spec, graph, findings, shared)
    if meant is not None and not findings.mistakes:
        _check_wholes(meant, constants, findings)
    mistakes = tuple(findings.mistakes)
    if meant is None or mistakes or broken:
        return None, mistakes
    return Meaning(spec, seed, constants, meant, layers, changing), ()


def _check_wholes(meant: Episode, constants: Constants, findings: Findings) -> None:
    """Every value used as an index or in values(...) must be whole, given that the slots it reads are."""
    whole = _whole_slots(meant, constants)
    for path, span, purpose, node in findings.wholes:
        if not whole_nodes([node], whole, constants.whole)[node.number]:
            message = f"{purpose} must be a whole number, and this need not be one"
            findings.mistakes[path, Mistake("BB064", message, span, "round it: floor(...) or round(...)")] = None


def _whole_slots(meant: Episode, constants: Constants) -> Mapping[Slot, bool]:
    """The slots that hold whole numbers at all times: the largest set that starts so and is kept by every step."""
    whole = {slot: node.kind is Kind.NUMBER for slot, node in meant.start.items()}
    while True:
        found = whole_nodes([*meant.start.values(), *meant.after.values()], whole, constants.whole)
        kept = {
            slot: held and found[meant.start[slot].number] and found[meant.after[slot].number] for slot, held in whole.items()
        }
        if kept == whole:
            return whole
        whole = kept
