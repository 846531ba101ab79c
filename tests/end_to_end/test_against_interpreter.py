"""Generated kernels give the same bits as an interpreter written from the language's reference alone."""

from pathlib import Path

import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from bbsd.compiler import compile_meaning
from bbsd.compiler.passes.list_arrays import MOST_ELEMENTS_WRITTEN_OUT
from bbsd.language.loading import load
from bbsd.language.meaning import elaborate
from bbsd.language.models import Spec
from bbsd.text import Source
from tests.interpreter.cells import given_table
from tests.interpreter.constants import read_constants
from tests.interpreter.episode import run_episode
from tests.interpreter.made_up import specs
from tests.interpreter.made_up_designs import random_agents
from tests.interpreter.made_up_meanings import meaning_made_up
from tests.interpreter.made_up_outside import MadeUpLanes, MadeUpWorld, with_world_outside
from tests.unit.compiler.robots import with_loops

SPECS = Path(__file__).parents[2] / "specs"
SHIPPED = sorted((*SPECS.glob("*.yaml"), *SPECS.glob("tasks/*.yaml"), *SPECS.glob("everyday/*.yaml")))
COMPILED = ("abstract", "object_lifting", "object_lifting_hand", "forager")  # the others would take minutes
SHORTER = {"acrobot": 10, "aggregation": 3}
"""Steps of specs that the interpreter needs seconds for in each."""
ELEMENTS = st.sampled_from([0, MOST_ELEMENTS_WRITTEN_OUT])
"""The elements of a list up to which each has a variable: made-up lists are short."""


def meaning_of(spec, seed):
    meaning, mistakes = elaborate(spec, seed)
    assert mistakes == ()
    return meaning


def compared(problem, seed, generation, n_agents, agents_seed):
    """Live an episode of some agents in the kernel and in the interpreter, and compare all that comes out."""
    spec = problem.meaning.spec
    constants = read_constants(spec, seed, generation)
    assert [list(table.given) for table in problem.tables] == [
        given_table(behavior, spec, constants) for behavior in spec.behaviors.values()
    ]
    agents = random_agents(problem, n_agents, agents_seed)
    team = problem.assemble(agents.pools, agents.members, generation)
    outcome = team.episode(agents.keys, agents.structures)
    detailed = team.detailed_episode(agents.keys, agents.structures)
    for agent in range(n_agents):
        chosen = zip(agents.pools, agents.members[agent], strict=True)
        tables = [pool[member].tolist() for pool, member in chosen]
        structure, key = agents.structures[agent].tolist(), int(agents.keys[agent])
        world = MadeUpWorld(spec.environment, key) if spec.environment.outside else None
        expected = run_episode(spec, constants, tables, structure, key, world)
        assert digits([outcome.returns[agent]]) == digits([expected.return_])
        assert digits(outcome.credit[agent]) == digits(expected.credit)
        assert digits([detailed.returns[agent]]) == digits([expected.return_])
        assert digits(detailed.credit[agent]) == digits(expected.credit)
        assert digits(detailed.terms[agent]) == digits(expected.terms)
        assert detailed.steps_taken[agent] == expected.steps
        assert detailed.control[agent].tolist() == expected.controlled
        assert detailed.expectations_met[agent].tolist() == list(expected.held.values())


def digits(numbers):
    """All bits of numbers, NaN alike."""
    return [float(number).hex() for number in numbers]


@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.stem)
def test_kernels_of_the_shipped_specs(path):
    steps = SHORTER.get(path.stem.removesuffix("_hand"))
    overrides = [] if steps is None else [f"environment.steps={steps}"]
    meaning = load(Source.read(path), seed=5, overrides=overrides).meaning
    problem = compile_meaning(meaning, compiled=path.stem in COMPILED)
    compared(problem, seed=5, generation=1, n_agents=2, agents_seed=1)


def test_cells_at_and_beyond_their_bounds():
    partitions = {
        "a": "cut(count, 2, 5)",
        "b": "values(count, 1, 3)",
        "c": "values(-count, -4, -2)",
    }
    actions = {f"say_{number}": {"said": number} for number in range(1, 8)}
    spec = Spec.model_validate(
        {
            "bbsd": 1,
            "name": "bounds",
            "environment": {
                "steps": 9,
                "state": {"count": -1, "said": 0},
                "dynamics": {"count": "count + 1"},
            },
            "behaviors": {
                name: {"inputs": {"seen": partition}, "actions": actions}
                for name, partition in partitions.items()
            },
            "reward": {"heard": "said * 8 ** step"},
        }
    )
    problem = compile_meaning(meaning_of(spec, seed=1), compiled=False)
    compared(problem, seed=1, generation=1, n_agents=20, agents_seed=1)


@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(specs(), st.integers(0, 2**32), st.integers(1, 3), st.sampled_from([1, 2]), ELEMENTS)
def test_plain_kernels_of_specs_that_are_made_up(data, seed, generation, lanes, elements):
    problem = compile_meaning(meaning_made_up(data, seed), lanes=lanes, compiled=False)
    compared(with_loops(problem, elements=elements), seed, generation, n_agents=3, agents_seed=seed)


OUTSIDE = (
    (["x", "_"], ["place", "y"]),
    ({"place": 5, "unused": 3}, "x"),
    ({"x": "image[3,5]", "place": "deep.er"}, "y"),
)
"""What of a made-up spec is observed in a world stepped in Python, and what that is told."""


@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(specs(), st.sampled_from(OUTSIDE), st.integers(0, 2**32), st.sampled_from([1, 2]), ELEMENTS)
def test_plain_kernels_of_worlds_that_are_stepped_in_python(data, exchanged, seed, lanes, elements):
    spec = Spec.model_validate(with_world_outside(data, *exchanged))
    meaning, mistakes = elaborate(spec, seed)
    assume(not mistakes)  # an index by what need not be whole, now that it is observed
    episode = meaning.episode
    problem = compile_meaning(
        meaning,
        lanes=lanes,
        compiled=False,
        stepper=lambda: MadeUpLanes(spec.environment, episode.outside, episode.sent),
    )
    compared(with_loops(problem, elements=elements), seed, 1, n_agents=3, agents_seed=seed)
