"""Several designs in the same episodes: what each earned in each of them, and differences with intervals.

Two designs that face the same episodes differ by far less than two that face others, so a difference of pairs needs
few episodes. The designs may be agents of one problem, or of several problems whose random streams have the same names,
as a spec's and those of the same spec under a fault have: `joined` puts their episodes side by side.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from bbsd.evaluation.episodes import batches_of
from bbsd.evaluation.finite import require_finite
from bbsd.evaluation.statistics import Interval, interval

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from bbsd.compiler import Problem
    from bbsd.evaluation.agents import Agents

Floats = npt.NDArray[np.float64]
Keys = npt.NDArray[np.uint64]


@dataclass(frozen=True, slots=True, eq=False)
class PairedEpisodes:
    """What designs earned in the same episodes.

    `returns` is (n_designs, n_episodes); `terms` has the part of each reward term in the same shape, and is empty where
    terms were not asked for.
    """

    returns: Floats
    terms: Mapping[str, Floats]

    def __len__(self) -> int:
        return len(self.returns)

    def difference(self, design: int, base: int = 0) -> Interval:
        """Return what a design earned more than another in the same episodes, with the interval of the mean.

        It is NaN where a return is infinite or not a number.
        """
        with np.errstate(invalid="ignore"):
            return interval(self.returns[design] - self.returns[base])

    def joined(self, *others: PairedEpisodes) -> PairedEpisodes:
        """Return these designs and those of others behind them; a term that a spec does not have gave 0.

        Raises:
            ValueError: the numbers of episodes differ.
        """
        parts = [self, *others]
        terms = dict.fromkeys(term for part in parts for term in part.terms)
        return PairedEpisodes(
            np.concatenate([part.returns for part in parts]),
            {
                term: np.concatenate([part.terms.get(term, np.zeros_like(part.returns)) for part in parts])
                for term in terms
            },
        )


def paired_episodes(
    problem: Problem,
    agents: Agents,
    keys: Keys,
    generation: int,
    *,
    with_terms: bool = False,
    labels: Sequence[str] = (),
    all_finite: bool = True,
) -> PairedEpisodes:
    """Run all agents in the same episodes, as lanes of one team, batch by batch.

    Args:
        problem: the spec of all these agents.
        agents: one for each design.
        keys: name the random streams of the episodes, (n_episodes,); `evaluation_keys` are those of `evaluate`.
        generation: in whose constants they run.
        with_terms: whether to keep what each reward term gave; the kernel that tells it is slower.
        labels: what to call each design in the error of a reward that is not finite.
        all_finite: whether a reward that is not finite is an error for all designs, or for the first one alone.

    Raises:
        RewardNotFinite: a reward was infinite or not a number.
    """
    n_episodes, reward = len(keys), problem.meaning.episode.reward if with_terms else {}
    returns = np.empty(len(agents) * n_episodes)
    terms = np.empty((len(reward), len(returns)))
    for lanes, batch, streams in batches_of(agents, keys):
        team = problem.assemble(agents.pools, batch.members, generation)
        if with_terms:
            outcome = team.detailed_episode(streams, batch.structures)
            returns[lanes], terms[:, lanes] = outcome.returns, outcome.terms.T
        else:
            returns[lanes] = team.episode(streams, batch.structures).returns
        end = lanes.stop if all_finite else min(lanes.stop, n_episodes)
        for lane in np.flatnonzero(~np.isfinite(returns[lanes.start : end]))[:1]:
            design, episode = divmod(lanes.start + int(lane), n_episodes)
            label = f", {labels[design]}" if labels else ""
            one = slice(lane, lane + 1)
            place = f"episode {episode + 1}{label}"
            require_finite(
                problem, batch[np.array([lane])], streams[one], returns[lanes][one], generation, place
            )
    shape = len(agents), n_episodes
    named = {term: values.reshape(shape) for term, values in zip(reward, terms, strict=True)}
    return PairedEpisodes(returns.reshape(shape), named)
