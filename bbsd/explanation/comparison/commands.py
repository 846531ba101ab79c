"""In which situations two designs command something else, weighted by how often they are met."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from bbsd.architecture.deciding import asked_at, cells_at, policy_at
from bbsd.evaluation.situations import situations
from bbsd.explanation.comparison.places import Places, places
from bbsd.explanation.comparison.results import Command, CommandDifference, Commands

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

    from bbsd.evaluation.situations import Situations
    from bbsd.explanation.comparison.hosting import Hosted
    from bbsd.explanation.comparison.results import RuleChange

MOST_ROBOT_STEPS = 2_000_000
"""Robot-steps of each design that are watched."""
FEWEST = 10
"""Episodes that are watched at least."""
MOST_IN_WORDS = 24
"""Pairs of commands of which is said where they are given."""


@dataclass(frozen=True, slots=True, eq=False)
class Watched:
    """A host's episodes: which situations it met, and what itself and the guest do there.

    `own` and `guest` (n_situations,) are numbers of actions over all behaviors, `differ` whether they do something
    else.
    """

    host: Hosted
    met: Situations
    own: NDArray[np.int64]
    guest: NDArray[np.int64]
    differ: NDArray[np.bool_]

    @property
    def share(self) -> float:
        """Of the host's robot-steps, those in which the guest would have commanded something else."""
        return self.share_of(self.differ)

    def share_of(self, which: NDArray[np.bool_]) -> float:
        """Return which part of all robot-steps began in some of the situations, (n_situations,)."""
        return int(self.met.visits[which].sum()) / max(1, self.met.steps)


def watched(host: Hosted, streams: NDArray[np.uint64], generation: int) -> Watched:
    """Run episodes of the host, as many as can be watched, and find where the guest would have commanded otherwise."""
    environment = host.problem.meaning.spec.environment
    most = max(FEWEST, MOST_ROBOT_STEPS // (environment.steps * environment.robots))
    met = situations(host.problem, host.space, host.own, streams[:most], generation)
    own, guest = (policy_at(host.space, design, met.cells) for design in (host.own, host.guest))
    effects = host.space.effects
    return Watched(host, met, own, guest, effects[own] != effects[guest])


def commands(a: Watched, b: Watched) -> Commands:
    """Return how A and B differ along the episodes of each; `b` has B as its host."""
    shares: dict[tuple[Command, Command], tuple[float, float]] = {}
    groups_a = dict(_groups(a))
    groups_b = {(own, guest): which for (guest, own), which in _groups(b)}
    for pair in [*groups_a, *groups_b]:
        share_a = a.share_of(groups_a[pair]) if pair in groups_a else 0.0
        share_b = b.share_of(groups_b[pair]) if pair in groups_b else 0.0
        shares[pair] = share_a, share_b
    differences: list[CommandDifference] = []
    for pair, (share_a, share_b) in sorted(shares.items(), key=lambda item: -sum(item[1])):
        found = Places((), 0)
        if len(differences) < MOST_IN_WORDS:
            found = _where(a, groups_a.get(pair), b, groups_b.get(pair), in_a=share_a >= share_b)
        differences.append(CommandDifference(*pair, share_a, share_b, *found))
    return Commands(
        a.share,
        b.share,
        a.met.steps,
        b.met.steps,
        a.met.episodes,
        tuple(differences),
    )


def _groups(watched: Watched) -> Iterable[tuple[tuple[Command, Command], NDArray[np.bool_]]]:
    """Yield what the host and the guest do where that differs, and the situations, (n_situations,)."""
    pairs = np.unique(np.stack([watched.own, watched.guest], axis=1)[watched.differ], axis=0)
    groups: dict[tuple[Command, Command], NDArray[np.bool_]] = {}
    for own, guest in pairs.tolist():
        pair = _command(watched.host, own), _command(watched.host, guest)
        which = watched.differ & (watched.own == own) & (watched.guest == guest)
        groups[pair] = groups[pair] | which if pair in groups else which
    return groups.items()


def _command(host: Hosted, number: int) -> Command:
    """Return the behavior and the action of a number that counts over all behaviors; 0 is nobody's."""
    if number == 0:
        return Command("", "")
    behavior = int(np.searchsorted(host.space.first_actions, number, side="left")) - 1
    actions = list(host.problem.meaning.episode.modules[behavior].actions)
    return Command(host.names[behavior], actions[number - host.space.first_actions[behavior] - 1])


def _where(
    a: Watched,
    group_a: NDArray[np.bool_] | None,
    b: Watched,
    group_b: NDArray[np.bool_] | None,
    *,
    in_a: bool,
) -> Places:
    """Return where a group of situations is among all that were met by both; of one host where inputs are others."""
    met, groups = [a.met, b.met], [group_a, group_b]
    host = a.host if in_a else b.host
    if dict(a.host.dimensions) != dict(b.host.dimensions):
        which = 0 if in_a else 1
        met, groups = met[which : which + 1], groups[which : which + 1]
    meant = [
        np.zeros(len(each.cells), np.bool_) if group is None else group
        for each, group in zip(met, groups, strict=True)
    ]
    cells, visits = (np.concatenate([getattr(each, name) for each in met]) for name in ("cells", "visits"))
    return places(cells, np.concatenate(meant), visits, host.dimensions)


def with_asked(
    change: RuleChange, cells: NDArray[np.bool_], a: Watched | None, b: Watched | None
) -> RuleChange:
    """Return a change of rules with how often its cells were asked in the episodes of each design."""
    asked_a, asked_b = (
        None if watched is None else _asked(watched, change.behavior, cells) for watched in (a, b)
    )
    return replace(change, asked_a=asked_a, asked_b=asked_b)


def _asked(watched: Watched, name: str, cells: NDArray[np.bool_]) -> float:
    host = watched.host
    for behavior, asked in asked_at(host.space, host.own, watched.met.cells):
        if host.names[behavior] == name:
            return watched.share_of(asked & cells[cells_at(host.space, behavior, watched.met.cells)])
    return 0.0
