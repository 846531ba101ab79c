"""A program of a user, beside the spec that `bbsd new minimal` writes; its types are checked, and it is run."""

from collections.abc import Iterator
from pathlib import Path
from typing import assert_type

import bbsd
from bbsd.agent.program import Act
from bbsd.api import AnyProgress, Designed
from bbsd.errors import Diagnosis
from bbsd.evaluation import Evaluation, Trace
from bbsd.explanation import Explanation
from bbsd.explanation.comparison import Comparison
from bbsd.explanation.worth import Worth
from bbsd.language.loading import Loaded
from bbsd.runs.storage.watching import Watched


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

evaluation = bbsd.evaluate(designed.folder, episodes=100)
assert_type(evaluation, Evaluation)
assert_type(evaluation.mean, float)
assert_type(evaluation.ci95, tuple[float, float])
assert_type(evaluation.reward_terms, dict[str, float])

agent = bbsd.Agent(designed.architecture)
assert_type(agent, bbsd.Agent)
act = agent.act({"position": 3.0})
assert_type(act, Act)
assert_type(act.action, str | None)
assert_type(act.sets, dict[str, float | bool])

assert_type(bbsd.trace(designed.folder, episode="worst"), Trace)
assert_type(bbsd.explain(designed.folder), Explanation)
assert_type(bbsd.worth(designed.folder, episodes=50), Worth)
assert_type(bbsd.compare(designed.folder, designed.architecture, episodes=50), Comparison)
assert_type(bbsd.watch(designed.folder), Iterator[Watched])
