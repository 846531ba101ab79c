"""Kernels with loops over robots beside those in which each robot is written out."""

from dataclasses import replace

import numpy as np

from bbsd.compiler import compile_meaning
from bbsd.compiler.details import Detail
from bbsd.compiler.kernels import kernel_source
from bbsd.compiler.passes.list_arrays import MOST_ELEMENTS_WRITTEN_OUT
from bbsd.language.meaning import elaborate
from bbsd.language.models import Spec
from bbsd.solver.random_agents import random_agents

DETAILS = (Detail.CREDIT, Detail.TERMS)
DETAILED = ("returns", "credit", "terms", "control", "steps_taken", "not_finite", "expectations_met")

STATE = {"x": "uniform(-2, 2)", "y": "normal(0, 1)", "n": "integers(0, 2)", "armed": "chance(0.5)"}


def moving(*, robots=4, lanes=1, compiled=False, state=(), left=(), right=(), reward=None, **environment):
    """A team that moves along a line; more of its environment and its two behaviors can be given."""
    left = {
        "inputs": {"side": "x > 0", "near": "cut(y, -1, 0, 1)"},
        "actions": {"go": {"x": "x - uniform(0, 1)"}, "turn": {"x": "-y", "armed": "not armed"}},
        **dict(left),
    }
    right = {
        "excited": "armed",
        "inputs": {"where": "cut(x, 0, 1)"},
        "actions": {"go": {"x": "x + 0.25", "n": 0}},
        **dict(right),
    }
    spec = {
        "bbsd": 1,
        "name": "moving",
        "constants": {"table": [[1, 5, 2], [7, 3, 4], [0, 9, 8], [6, 6, 1]]},
        "environment": {
            "robots": robots,
            "steps": 6,
            "world": {"wind": "normal(0, 1)"},
            "state": {**STATE, **dict(state)},
            **environment,
        },
        "behaviors": {"left": left, "right": right},
        "reward": reward or {"x": "x - abs(y)", "y": "y if armed else n"},
    }
    meaning, mistakes = elaborate(Spec.model_validate(spec), 1)
    assert mistakes == ()
    return compile_meaning(meaning, lanes=lanes, compiled=compiled)


def source_with(problem, written_out, details=DETAILS, elements=MOST_ELEMENTS_WRITTEN_OUT):
    return kernel_source(problem.meaning, problem.tables, problem.lanes, details, written_out, elements)


def with_loops(problem, written_out=1, elements=MOST_ELEMENTS_WRITTEN_OUT):
    """The same problem with a kernel that writes at most so many robots out, and elements of a list."""
    other = replace(problem)
    kernels = replace(problem.kernels, most_written_out=written_out, most_elements=elements)
    other.__dict__["kernels"] = kernels
    return other


def bits(problem, n_agents=5, seed=0, generation=1):
    """All bits of what comes out of an episode of random agents, by both kernels, by name."""
    agents = random_agents(problem, seed, n_agents)
    keys = np.random.default_rng(seed).integers(0, 2**64, n_agents, dtype=np.uint64)
    team = problem.assemble(agents.pools, agents.members, generation)
    detailed = team.detailed_episode(keys, agents.structures)
    found = {name: getattr(detailed, name).tobytes() for name in DETAILED}
    outcome = team.episode(keys, agents.structures)
    return {**found, "returns_alone": outcome.returns.tobytes(), "credit_alone": outcome.credit.tobytes()}


def assert_loops_change_no_bit(problem, *, looped=True, **wanted):
    """Whoever reads a robot's values, and in whichever loop; `looped` says whether there should be loops at all."""
    assert ("for robot in range(" in source_with(problem, 1)) is looped
    assert bits(with_loops(problem, 1), **wanted) == bits(with_loops(problem, 100), **wanted)


def assert_arrays_change_no_bit(problem, *, robots=100, kept=None, **wanted):
    """However lists are read and set; `kept` names lists that arrays should keep."""
    source = source_with(problem, robots, elements=0)
    for name in kept or ():
        assert f"{name} = part(" in source, f"{name} is not kept in an array"
    arrays, written = with_loops(problem, robots, 0), with_loops(problem, robots, 1000)
    assert bits(arrays, **wanted) == bits(written, **wanted)
    return source
