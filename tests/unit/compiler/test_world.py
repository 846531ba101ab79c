"""A world that is stepped from outside earns what a rollout earns with the same choices."""

import numpy as np
import pytest

from bbsd.compiler.details import Column, traced_columns
from bbsd.compiler.world import World
from bbsd.expression.graph import Level
from bbsd.expression.node_data import Slot
from bbsd.kernel.keys import keys
from bbsd.solver.random_agents import random_agents
from tests.unit.architecture.designs import shipped
from tests.unit.problems import RICH, problem_of

N_AGENTS = 6
SPECS = {
    "rich": RICH,
    "lifting": shipped("object_lifting").replace("steps: 300", "steps: 20"),
    "cartpole": shipped("tasks/cartpole"),
}


@pytest.fixture(params=SPECS)
def lived(request):
    """A problem, its agents' keys, outcomes, and what was traced of each."""
    problem = problem_of(SPECS[request.param])
    agents = random_agents(problem, 5, N_AGENTS)
    team, streams = problem.assemble(agents.pools, agents.members, 1), keys(9, 0, N_AGENTS)
    outcome = team.detailed_episode(streams, agents.structures)
    columns, steps = traced_columns(problem.meaning), problem.meaning.spec.environment.steps
    records = []
    for agent in range(N_AGENTS):
        alone = problem.assemble(agents.pools, agents.members[agent : agent + 1], 1)
        record = np.zeros((steps, len(columns)))
        taken = alone.traced_episode(streams[agent], agents.structures[agent], record)
        records.append({column: values[:taken] for column, values in zip(columns, record.T, strict=True)})
    return problem, streams, outcome, records


def observed_of(problem):
    episode = problem.meaning.episode
    slots = [slot for slot in episode.start if slot.robot is not None]
    nodes = [problem.meaning.graph.leaf("slot", slot, episode.start[slot].kind, Level.LANE) for slot in slots]
    return slots, nodes


def choices_of(problem, record, step):
    robots = range(problem.meaning.spec.environment.robots)
    return np.array([[record[Column("choice", Slot("controlling", robot))][step]] for robot in robots])


@pytest.mark.parametrize("together", [True, False])
def test_the_choices_of_a_design_earn_its_returns(lived, together):
    problem, streams, outcome, records = lived
    slots, nodes = observed_of(problem)
    world = World(problem.meaning, nodes, N_AGENTS, 1, compiled=False)
    for lane in range(N_AGENTS):
        world.begin(np.array([lane]), streams[lane : lane + 1])
    lanes, step = np.arange(N_AGENTS), 0
    while lanes.size:
        choices = np.hstack([choices_of(problem, records[lane], step) for lane in lanes]).astype(np.int64)
        if together:
            world.step(lanes, choices)
        else:
            for lane in reversed(range(len(lanes))):
                world.step(lanes[lane : lane + 1], choices[:, lane : lane + 1])
        for lane in lanes:
            for row, slot in enumerate(slots):
                assert world.observed[row, lane] == records[lane][Column("slot", slot)][step]
        lanes, step = lanes[~world.over[lanes]], step + 1
    np.testing.assert_array_equal(world.steps, outcome.steps_taken)
    assert world.returns.tobytes() == outcome.returns.tobytes()


def test_lanes_at_other_steps_do_not_disturb_each_other(lived):
    problem, streams, _, _ = lived
    _, nodes = observed_of(problem)
    n_actions = sum(table.n_actions for table in problem.tables)
    robots = problem.meaning.spec.environment.robots
    choices = np.random.default_rng(0).integers(0, n_actions + 1, (20, robots, 2))

    def alone(lane):
        world = World(problem.meaning, nodes, 1, 1, compiled=False)
        world.begin(np.array([0]), streams[lane : lane + 1])
        return stepped(world, np.array([0]), choices[..., lane : lane + 1])

    def stepped(world, lanes, choices):
        seen = []
        for each in choices:
            if not world.over[lanes].any():
                world.step(lanes, each)
                seen += [world.observed[:, lanes].copy(), world.earned[:, lanes].copy(), world.returns[lanes]]
        return np.concatenate([np.zeros(0), *(each.ravel() for each in seen)])

    world = World(problem.meaning, nodes, 3, 1, compiled=False)
    world.begin(np.array([2]), streams[:1])
    first = stepped(world, np.array([2]), choices[:7, :, :1])
    world.begin(np.array([0]), streams[1:2])
    other = stepped(world, np.array([0]), choices[..., 1:])
    rest = stepped(world, np.array([2]), choices[7:, :, :1])
    assert np.concatenate([first, rest]).tobytes() == alone(0).tobytes()
    assert other.tobytes() == alone(1).tobytes()
