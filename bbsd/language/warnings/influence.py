"""Terms of the reward that no behavior can change."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.graph import needed
from bbsd.expression.syntax.mistakes import KEY, Mistake
from bbsd.expression.syntax.tree import names_used

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bbsd.expression.graph import Node
    from bbsd.expression.node_data import Slot
    from bbsd.language.meaning import Meaning
    from bbsd.language.meaning.episode.episode import Episode
    from bbsd.language.validation import LocatedMistake

MOST_LOOKS = 500_000
"""Nodes that are looked at in all passes together."""
MOST_PASSES = 50
"""Steps in which an influence spreads from one slot to the next; if it spreads on, everything counts as influenced."""


def uninfluenced_terms(meaning: Meaning) -> Iterator[LocatedMistake]:
    """Yield a warning for each term of the reward that is the same whatever behaviors do.

    Where they can change when an episode ends, they can change what any term adds up to. Where they change nothing at
    all, the cause is not in the reward.
    """
    episode = meaning.episode
    influenced = _influenced(episode)
    if influenced == set():
        return
    if episode.ends is not None and _is_influenced(episode.ends, influenced):
        return
    for term, nodes in episode.reward.items():
        if not any(_is_influenced(node, influenced) for node in nodes):
            message = f"no behavior can change what {term} adds up to"
            advice = "let it depend on what actions change, or leave it out: it is the same for all designs"
            for name in _set_again(meaning, term, influenced):
                message += f": dynamics has set {name} again by then, whatever an action set it to"
                advice = (
                    f"keep what the term needs of {name} in a state of its own, which dynamics sets from it"
                )
                break
            yield ("reward", term), Mistake("BB208", message, KEY, advice)


def _set_again(meaning: Meaning, term: str, influenced: set[Slot] | None) -> Iterator[str]:
    """Yield the state in a term that actions set, and of which nothing is left once dynamics has set it."""
    kept = {slot.name for slot in influenced or ()}
    names = names_used(meaning.spec.reward[term].tree) & meaning.spec.environment.dynamics.keys() - kept
    for slot, node in meaning.episode.acted.items():
        if slot.name in names and _is_influenced(node, set()):
            yield slot.name


def _influenced(episode: Episode) -> set[Slot] | None:
    """Return the slots whose values depend on what behaviors choose, at once or later; None if that cannot be told."""
    order = needed(episode.after.values())
    slots: set[Slot] = set()
    for _ in range(min(MOST_PASSES, MOST_LOOKS // max(1, len(order)))):
        touched: set[int] = set()
        for node in order:
            if _is_source(node, slots) or any(each.number in touched for each in node.operands):
                touched.add(node.number)
        found = {slot for slot, node in episode.after.items() if node.number in touched}
        if found == slots:
            return slots
        slots = found
    return None


def _is_influenced(node: Node, influenced: set[Slot] | None) -> bool:
    return influenced is None or any(_is_source(each, influenced) for each in needed([node]))


def _is_source(node: Node, influenced: set[Slot]) -> bool:
    return node.operation in ("choice", "outside") or (node.operation == "slot" and node.slot in influenced)
