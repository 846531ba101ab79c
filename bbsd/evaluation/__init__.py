"""Episodes of agents and of finished designs, and their statistics."""

from bbsd.evaluation.agents import Agents, agents_of
from bbsd.evaluation.choosing import RANKS, NoSuchEpisode, Rank, chosen_episode
from bbsd.evaluation.episodes import detailed_outcomes, returns_of
from bbsd.evaluation.exact.enumeration import NotEnumerable, enumerate_starts
from bbsd.evaluation.finite import RewardNotFinite, require_finite
from bbsd.evaluation.paired import PairedEpisodes, paired_episodes
from bbsd.evaluation.spread import EachEpisode, Spread
from bbsd.evaluation.statistics import (
    Evaluation,
    Interval,
    evaluation,
    from_the_top,
    interval,
    weighted_evaluation,
)
from bbsd.evaluation.streams import episode_key, evaluation_key, evaluation_keys
from bbsd.evaluation.tracing.decisions import Decisions
from bbsd.evaluation.tracing.scene import Scene
from bbsd.evaluation.tracing.traced import Trace
from bbsd.evaluation.tracing.tracing import trace

__all__ = [
    "RANKS", "Agents", "Decisions", "EachEpisode", "Evaluation", "Interval", "NoSuchEpisode", "NotEnumerable",
    "PairedEpisodes", "Rank", "RewardNotFinite", "Scene", "Spread", "Trace", "agents_of", "chosen_episode",
    "detailed_outcomes", "enumerate_starts", "episode_key", "evaluation", "evaluation_key", "evaluation_keys",
    "from_the_top", "interval", "paired_episodes", "require_finite", "returns_of", "trace", "weighted_evaluation",
]  # fmt: skip
