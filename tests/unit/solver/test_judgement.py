import pytest

from bbsd.evaluation import agents_of, detailed_outcomes, evaluation
from bbsd.kernel.keys import keys
from bbsd.solver.answer import answer
from bbsd.solver.judgement import judge
from bbsd.solver.paper.generation import initial_state, next_generation
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
