import pytest

from bbsd.architecture import given_architecture
from bbsd.evaluation import evaluation_key, evaluation_keys
from bbsd.explanation.words import Useless
from bbsd.explanation.worth import Appraisal
from bbsd.explanation.worth.findings import change_text
from bbsd.explanation.worth.without import with_worth
from tests.unit.explanation.worth.planted import planted
from tests.unit.problems import problem_of

EPISODES = 40


@pytest.fixture(scope="module")
def problem():
    return problem_of(planted())


def part(kind, behavior, number=None, *, is_certain=False):
    return Useless(kind, behavior, "", "not used", is_certain, number)


def measured(problem, *useless):
    keys = evaluation_keys(0, EPISODES)
    return with_worth(problem, given_architecture(problem), useless, keys, 1)


def test_behaviors_and_rules_have_the_change_that_worth_shows(problem):
    behavior, rule = measured(problem, part("behavior", "grab"), part("rule", "work", 1))
    appraisal = Appraisal(problem, given_architecture(problem), evaluation_key(0), EPISODES, 1)
    returns, names = appraisal.worth().returns, problem.names
    assert behavior.worth == change_text(appraisal.dropped(names.index("grab")), returns)
    assert rule.worth == change_text(appraisal.dropped_rule(names.index("work"), 0), returns)
    assert behavior.worth.startswith("return +")


def test_what_is_proven_and_inputs_are_not_measured(problem):
    useless = (part("behavior", "grab", is_certain=True), part("input", "work"), part("rule", "work", 99))
    assert measured(problem, *useless) == useless


def test_what_never_controls_never_changes_the_return(problem):
    (found,) = measured(problem, part("behavior", "guard"))
    assert found.worth == "the return never changes"
