"""The comparison of two designs: what changed in behavior, what it is worth, and which change it comes from."""

from __future__ import annotations

from math import sqrt
from typing import TYPE_CHECKING

from bbsd.evaluation import agents_of, paired_episodes
from bbsd.evaluation.situations import TooLongToWatch
from bbsd.evaluation.statistics import QUANTILE_95, Interval, interval
from bbsd.explanation.comparison.changes import order, redefined, rule_changes
from bbsd.explanation.comparison.commands import commands, watched, with_asked
from bbsd.explanation.comparison.common import reward_differences, sense_differences, world_differences
from bbsd.explanation.comparison.hosting import CannotHost, hosted
from bbsd.explanation.comparison.results import Comparison, TermDifference
from bbsd.explanation.comparison.sources import MOST_CHANGES, changes, measured, most_asked

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    import numpy as np
    from numpy.typing import NDArray

    from bbsd.evaluation import PairedEpisodes
    from bbsd.explanation.comparison.commands import Watched
    from bbsd.explanation.comparison.hosting import Design, Hosted

MOST_LISTED = 6
"""Names that a note lists."""


def earned_by(design: Design, streams: NDArray[np.uint64]) -> PairedEpisodes:
    """Return what a design earns in episodes, named by their keys (n_episodes,).

    Raises:
        RewardNotFinite: a reward was infinite or not a number.
    """
    agents, labels = agents_of([design.architecture]), [design.loaded.source.file]
    generation = _generation(design)
    return paired_episodes(design.problem, agents, streams, generation, with_terms=True, labels=labels)


def compare_designs(
    a: Design, b: Design, streams: NDArray[np.uint64], earned: tuple[PairedEpisodes, PairedEpisodes]
) -> Comparison:
    """Compare two designs.

    Args:
        a, b: the designs.
        streams: the keys of the episodes in which both act, (n_episodes,).
        earned: what each of them earns there.
    """
    world = world_differences(a.loaded, b.loaded)
    is_paired, notes = not world, [*_notes(a, b, world)]
    host_a, host_b = _hosted(a, b, "B", notes), _hosted(b, a, "A", notes)
    watched_a, watched_b = (
        _watched(host, design, streams, notes) for host, design in ((host_a, a), (host_b, b))
    )
    rules = [(with_asked(change, cells, watched_a, watched_b), cells) for change, cells in rule_changes(a, b)]
    rules = list(most_asked(rules))
    found = changes(rules, redefined(a, b), order(a, b))
    hosts = [
        None if host is None else (host, _generation(design)) for host, design in ((host_a, a), (host_b, b))
    ]
    if len(found) < 2 or not any(hosts):  # a single change is the whole difference
        found = []
    returns = [each.returns[0] for each in earned]
    return Comparison(
        a=a.loaded.source.file,
        b=b.loaded.source.file,
        episodes=len(streams),
        is_paired=is_paired,
        return_a=interval(returns[0]),
        return_b=interval(returns[1]),
        difference=_difference(returns[0], returns[1], is_paired=is_paired),
        terms=tuple(_terms(*earned, is_paired=is_paired)),
        commands=commands(watched_a, watched_b) if watched_a and watched_b else None,
        rules=tuple(change for change, _ in rules),
        order=order(a, b),
        redefined=redefined(a, b),
        sources=measured(found[:MOST_CHANGES], hosts[0], hosts[1], streams),
        unmeasured=max(0, len(found) - MOST_CHANGES),
        notes=tuple(dict.fromkeys(notes)),
    )


def _notes(a: Design, b: Design, world: Sequence[str]) -> Iterator[str]:
    """Yield what makes the two less comparable than two designs of one spec."""
    if world:
        yield (
            f"the worlds differ ({_listed(world)}), so the episodes with the same numbers are not the same: "
            "returns are compared without pairs"
        )
    if senses := sense_differences(a.loaded, b.loaded):
        yield f"each design has its own {_listed(senses)}"
    if reward := reward_differences(a.loaded, b.loaded):
        yield f"the rewards differ ({_listed(reward)}), so the returns do not measure the same"


def _listed(words: Sequence[str]) -> str:
    """Return words with commas, and how many more there are."""
    more = [f"{len(words) - MOST_LISTED} more"] if len(words) > MOST_LISTED else []
    return ", ".join([*words[:MOST_LISTED], *more])


def _generation(design: Design) -> int:
    return design.loaded.spec.design.coevolution.generations


def _hosted(host: Design, guest: Design, guest_name: str, notes: list[str]) -> Hosted | None:
    try:
        return hosted(host, guest, guest_name)
    except CannotHost as error:
        notes.append(f"in {host.loaded.source.file}, {error}")
        return None


def _watched(
    host: Hosted | None, design: Design, streams: NDArray[np.uint64], notes: list[str]
) -> Watched | None:
    if host is None:
        return None
    try:
        return watched(host, streams, _generation(design))
    except TooLongToWatch as error:
        notes.append(f"commands are not compared: {error}")
        return None


def _difference(a: NDArray[np.float64], b: NDArray[np.float64], *, is_paired: bool) -> Interval:
    """Return B minus A with the 95 % interval of the mean: that of pairs, or that of two samples."""
    if is_paired:
        return interval(b - a)
    one, other = interval(a), interval(b)
    center, half = other.mean - one.mean, QUANTILE_95 * sqrt((one.sd**2 + other.sd**2) / len(a))
    return Interval(center, sqrt(one.sd**2 + other.sd**2), center - half, center + half, len(a))


def _terms(a: PairedEpisodes, b: PairedEpisodes, *, is_paired: bool) -> Iterator[TermDifference]:
    for term in dict.fromkeys([*a.terms, *b.terms]):
        parts = [each.terms[term][0] if term in each.terms else None for each in (a, b)]
        one, other = parts
        yield TermDifference(
            term,
            None if one is None else interval(one).mean,
            None if other is None else interval(other).mean,
            None if one is None or other is None else _difference(one, other, is_paired=is_paired),
        )
