import pytest

from bbsd.runs.sampling import Sample, sample
from tests.unit.solver.problems import guess


def test_a_generation_is_what_is_bred_and_its_agents():
    taken = Sample(compiling=9.0, breeding=1.0, agent=0.5, episode=7.0, random_agent=8.0, speedup=1.0)
    assert taken.generation(4) == 3.0


@pytest.mark.parametrize("structure", ["", "structure: [even, odd]"])
def test_all_that_a_generation_takes_is_measured(structure):
    taken = sample(*guess(structure), key=1)
    assert min(taken.breeding, taken.episode, taken.random_agent) > 0
    assert min(taken.compiling, taken.agent) >= 0
    assert taken.speedup == 1.0
