"""A program of a user, beside the spec that `bbsd new minimal` writes; its types are checked, and it is run."""

from collections.abc import Iterator
from pathlib import Path
from typing import assert_type

import bbsd
from bbsd.api import (
    Act,
    AnyProgress,
    Comparison,
    Designed,
    Diagnosis,
    Evaluation,
    Explanation,
    Loaded,
    Trace,
    Watched,
    Worth,
)


def show(progress: AnyProgress) -> None:
    """Print how far a design is."""
    print(progress.done, "of", progress.total)


spec = Path("minimal.yaml")
assert_type(bbsd.check(spec), tuple[Diagnosis, ...])
assert_type(bbsd.load(spec), Loaded)
designed = bbsd.design(spec, seed=1, progress=show)
assert_type(designed, Designed)
assert_type(designed.evaluation, Evaluation)
assert_type(designed.structure, tuple[str, ...])

evaluation = bbsd.evaluate(designed, episodes=100)
assert_type(evaluation, Evaluation)
assert_type(evaluation.mean, float)
assert_type(evaluation.ci95, tuple[float, float])
assert_type(evaluation.reward_terms, dict[str, float])

agent = bbsd.Agent(designed)
assert_type(agent, bbsd.Agent)
act = agent.act({"position": 3.0})
assert_type(act, Act)
assert_type(act.action, str | None)
assert_type(list(act.sets), list[str])

assert_type(bbsd.trace(designed, episode="worst"), Trace)
assert_type(bbsd.explain(designed), Explanation)
assert_type(bbsd.worth(designed, episodes=50), Worth)
assert_type(bbsd.compare(designed, designed, episodes=50), Comparison)
assert_type(bbsd.watch("runs/minimal"), Iterator[Watched])
