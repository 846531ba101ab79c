"""The same agents in the same environment, by its table and stepped in Python: the same returns to the last bit."""

from dataclasses import replace

import numpy as np
import pytest

from bbsd.compiler import compile_meaning
from bbsd.compiler.tabulated import STATE
from bbsd.environments.lanes.gymnasium import GymnasiumLanes
from bbsd.environments.opening import open_environment, recipe_of
from bbsd.environments.tables import copied_table
from bbsd.evaluation import evaluation_keys, returns_of
from bbsd.evaluation.tracing.scene import starting_values
from bbsd.solver.random_agents import random_agents
from tests.unit.architecture.designs import meaning_of
from tests.unit.tabular import CLIFF, ICE, LAKE, TAXI

OTHER_ICE = ICE.replace("earned: earned", "earned: earned, place: square / 7")


def opened(meaning):
    outside = meaning.spec.environment.outside
    fields = [[field.name, field.size, None] for field in outside.fields]
    arguments = {"arguments": dict(outside.arguments), "fields": fields, "actions": [*outside.actions]}
    allowed = {"robots": 1, "modules": ["gymnasium"], "folders": [], "closed": [], "seconds": 30.0}
    return open_environment(
        recipe_of({"kind": outside.kind, "target": outside.target, **arguments, **allowed})
    )


class SameStart(GymnasiumLanes):
    """Begins episodes in the state in which they begin by the table."""

    def __init__(self, dealings, by_table):
        super().__init__(dealings)
        self.by_table, self.keys = by_table, None

    def reset(self, lanes, keys, outside):
        self.keys = keys
        super().reset(lanes, keys, outside)

    def _begin(self, lane, seed):
        row = super()._begin(lane, seed)
        start = starting_values(self.by_table, int(self.keys[lane]), self.by_table.constants.vector(1))
        self._environments[lane].s = int(start[STATE])
        row[: self.dealings.n_fields] = self.dealings.read(int(start[STATE]))
        return row


def both(text):
    """The same problem by its table, and stepped in Python from the same starts."""
    meaning = meaning_of(text)
    environment = opened(meaning)
    table = replace(copied_table(environment.make()), most_steps=environment.making.most_steps)
    by_table = compile_meaning(meaning, table=table, compiled=False)
    stepper = environment.stepper()

    def same_start():
        return SameStart(stepper.dealings, by_table.meaning)

    return by_table, compile_meaning(meaning, stepper=same_start, compiled=False, lanes=10)


@pytest.mark.parametrize(
    "text",
    [TAXI, CLIFF, OTHER_ICE, OTHER_ICE.replace("steps: 40", "steps: 120")],
    ids=["taxi", "cliff", "ice", "beyond the limit of 100 steps"],
)
def test_the_same_returns_to_the_last_bit(text):
    by_table, stepped = both(text)
    agents, keys = random_agents(by_table, 2, 10), evaluation_keys(4, 4)
    ours, theirs = (returns_of(problem, agents, keys, 1) for problem in (by_table, stepped))

    assert len(np.unique(ours)) > 1, "else the test shows little"
    assert ours.tobytes() == theirs.tobytes()


def test_on_a_slippery_lake_returns_and_lengths_come_as_often():
    by_table, stepped = both(LAKE)
    agents = random_agents(by_table, 1, 200)
    best = returns_of(by_table, agents, evaluation_keys(0, 15), 1).mean(axis=1).argmax()
    agent = agents[np.array([best])]
    counts = []
    for problem in (by_table, stepped):
        team = problem.assemble(agent.pools, np.repeat(agent.members, 1000, axis=0), 1)
        outcome = team.detailed_episode(evaluation_keys(7, 1000), np.repeat(agent.structures, 1000, axis=0))
        short = outcome.steps_taken < np.median(outcome.steps_taken if problem is by_table else counts[0][1])
        counts.append(((outcome.returns, short), outcome.steps_taken))
    (returns, other_returns), (lengths, other_lengths) = zip(counts[0][0], counts[1][0], strict=True)

    for one, other in ((returns, other_returns), (lengths, other_lengths)):
        assert 0.0 < one.mean() < 1.0, "else the test shows nothing"
        deviation = np.sqrt((one.var() + other.var()) / 1000)
        assert abs(one.mean() - other.mean()) < 4 * deviation
