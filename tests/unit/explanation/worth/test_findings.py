import pytest

from tests.unit.explanation.worth.planted import appraisal_of, planted


@pytest.fixture(scope="module")
def worth():
    return appraisal_of(planted()).worth()


def found(worth, kind):
    return [finding for finding in worth.findings if finding.kind == kind]


def test_a_selfish_behavior_is_named(worth):
    (finding,) = found(worth, "selfish")
    assert finding.subjects == ("grab",)
    assert finding.text.startswith(
        "grab is selfish: it earns 3 in each step that it controls, where the mean is -"
    )
    grab = worth.behaviors[1]
    assert f"return +{grab.dropped.low:.3f} to +{grab.dropped.high:.3f}" in finding.text
    assert finding == worth.findings[0]


def test_an_idle_behavior_is_named(worth):
    (finding,) = found(worth, "idle")
    assert finding.subjects == ("guard",)
    assert finding.text == "guard never controls: it can be removed, the return never changes"


def test_a_useless_rule_is_named(worth):
    useless = found(worth, "useless rule")
    assert [finding.text for finding in useless] == [
        "work: the rule go where sure is 0 can be removed: the return never changes",
        "work: the rule stay where sure is 3 is never used, it can be removed",
    ]


def test_two_robots_that_do_the_same_are_named():
    worth = appraisal_of(planted(robots=2, mood="0")).worth()
    (finding,) = found(worth, "robots alike")
    assert finding.subjects == ("0", "1")
    assert finding.text == (
        "robots 0 and 1 did the same in 100.0 % of the steps, and were in the same state after 100.0 %"
    )


def test_robots_that_differ_are_not_named():
    worth = appraisal_of(planted(robots=2).replace("tempted: calls", "tempted: chance(0.5)")).worth()
    assert len(worth.alike) == 1
    assert worth.alike[0].same_action < 0.9
    assert not found(worth, "robots alike")


def test_a_broken_expectation_is_named(worth):
    assert not found(worth, "broken expectation")
    broken = appraisal_of(planted(expects="x + debt < 3")).worth()
    (finding,) = found(broken, "broken expectation")
    assert finding.subjects == ("work",)
    share = next(each for each in broken.behaviors if each.behavior == "work").expectation
    assert 0 < share < 0.9
    assert finding.text == f"work breaks its expectation: it held after {100 * share:.1f} % of its steps"


def test_an_order_that_does_better_is_named(worth):
    (finding,) = found(worth, "better order")
    assert finding.subjects.index("work") < finding.subjects.index("grab")


def test_nothing_is_said_of_a_good_design():
    useless = "      - when: {sure: 0}\n        do: go\n      - when: {sure: 3}\n        do: stay\n"
    text = planted(cost=0).replace(useless, "").replace("guard, grab, work", "grab, work")
    good = text.replace("loot: 3 * took", "loot: 3 * took if before(calls) else 0")
    assert appraisal_of(good).worth().findings == ()
