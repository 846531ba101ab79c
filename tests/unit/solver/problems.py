"""Small problems to be designed, as plain Python."""

from dataclasses import replace

from bbsd.solver.paper.genetics import Breeding
from bbsd.solver.paper.settings import settings_of
from tests.unit.problems import problem_of

GUESS = """
bbsd: 1
name: guess
environment:
  steps: 2
  state: {{at: "integers(0, 3)", said: 0}}
  sensors: {{seen: "values(at, 0, 3)"}}
behaviors:
  odd: {{inputs: [seen], actions: {{one: {{said: 1}}, three: {{said: 3}}}}}}
  even: {{inputs: [seen], actions: {{none: {{said: 0}}, two: {{said: 2}}}}, rules: [{{when: {{seen: "2"}}, do: two}}]}}
  reckless: {{actions: {{nine: {{said: 9}}}}, rules: [otherwise: nine]}}
{structure}
reward: {{right: 1 if said == at else 0, wild: -1 if said > 3 else 0}}
design:
  sharing: {sharing}
  coevolution: {{generations: 4, population: 5, agents: 12, hard_mutation: 0.2, soft_mutation: 0.1}}
  learning: {{episodes: 4, last: 2, rate: 0.5, search: {search}}}
  culture: {culture}
  answer: {{candidates: 5, episodes: 100, judged: 100}}
"""
"""Say where you are; the behaviors know a part of the answers each, one cell is given and one behavior harmful."""


BREEDING = Breeding(tournament=3, elites=1, crossover=0.5, children=1, hard_mutation=0.0, soft_mutation=0.0)
"""Table 1 but without mutation."""


def guess(structure="", sharing="uniform", search="sampled", culture="{size: 3}", lanes=None, seed=0):
    """The problem and its settings."""
    text = GUESS.format(structure=structure, sharing=sharing, search=search, culture=culture)
    problem = problem_of(text, lanes=lanes, seed=seed)
    return problem, settings_of(problem.meaning)


def learning(settings, **changed):
    """The settings with other ones of a lifetime."""
    return replace(settings, learning=settings.learning.model_copy(update=changed))
