from dataclasses import replace
from functools import partial

import pytest

from bbsd.runs.pricing.sampling import Sample, sample, sample_search
from bbsd.solver.paper.settings import settings_of
from tests.unit.compiler.twins import CORRIDOR_OUTSIDE, Corridor
from tests.unit.problems import problem_of
from tests.unit.solver.problems import guess


def test_a_generation_is_what_is_bred_and_its_agents():
    taken = Sample(compiling=9.0, breeding=1.0, agent=0.5, episode=7.0, random_agent=8.0, speedup=1.0)
    assert taken.generation(4) == 3.0


@pytest.mark.parametrize("structure", ["", "structure: [even, odd]"])
def test_all_that_a_generation_takes_is_measured(structure):
    taken = sample(*guess(structure), key=1, most_steps=2)
    assert min(taken.breeding, taken.episode, taken.random_agent) > 0
    assert min(taken.compiling, taken.agent) >= 0
    assert taken.speedup == 1.0
    assert (taken.longest, taken.length) == (1.0, None)


@pytest.mark.slow
@pytest.mark.parametrize("method", ["hill", "paper"])
def test_of_steps_in_python_one_process_is_measured_and_all_are_counted(method):
    text = f"{CORRIDOR_OUTSIDE}\ndesign: {{method: {method}}}\n"
    problem = replace(problem_of(text, jobs=3), stepper=Corridor)
    settings = settings_of(problem.meaning)
    measure = {"paper": sample, "hill": partial(sample_search, budget=5_000)}[method]
    taken = measure(problem, settings, 1, most_steps=90)
    assert 1 < taken.length < 9
    assert 5 < taken.longest < 90
    assert taken.speedup == 3
    assert taken.episode > 1e-5  # a step of nine in plain Python takes longer than a microsecond
