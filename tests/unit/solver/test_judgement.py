from dataclasses import replace

import pytest

from bbsd.evaluation import agents_of, detailed_outcomes, evaluation
from bbsd.kernel.keys import keys
from bbsd.solver.answer import answer
from bbsd.solver.judgement import judge, random_sample
from bbsd.solver.paper.generation import initial_state, next_generation
from bbsd.solver.paper.settings import settings_of
from bbsd.solver.random_agents import random_agents
from tests.unit.compiler.twins import CORRIDOR_OUTSIDE, Corridor
from tests.unit.problems import problem_of
from tests.unit.solver.problems import guess


def answer_of(problem, settings, key):
    state = initial_state(problem, settings, key)
    for _ in range(settings.coevolution.generations):
        state, _ = next_generation(state, problem, settings, key)
    return answer(state, problem, settings, key)


def test_the_best_of_the_runs_answers_is_taken():
    problem, settings = guess(lanes=50)
    answers = [answer_of(problem, settings, key) for key in range(3)]
    best = judge(answers, problem, settings, seed=11)
    means = []
    for each in answers:
        outcomes = detailed_outcomes(problem, agents_of([each]), keys(1, 0, 2000), 4)
        means.append(evaluation(problem, outcomes, 1).mean)
    outcomes = detailed_outcomes(problem, agents_of([best.architecture]), keys(1, 0, 2000), 4)
    assert evaluation(problem, outcomes, 1).mean == pytest.approx(max(means), abs=0.05)


def test_where_python_steps_the_environment_fewer_random_agents_stand_beside():
    short = CORRIDOR_OUTSIDE.replace("steps: 9", "steps: 2") + "design: {method: hill}\n"
    problem = replace(problem_of(short), stepper=Corridor)
    agents = random_agents(problem, 1, 1)
    judged = judge([agents.architecture(0)], problem, settings_of(problem.meaning), 1)
    assert judged.evaluation.episodes == 1000
    assert random_sample(problem) == (200, 5)
    assert (judged.selection.agents, judged.selection.episodes) == (200, 1000)
