import pytest

from bbsd.evaluation import Interval
from bbsd.explanation.worth import BehaviorWorth, Order, RobotsAlike, RuleWorth
from bbsd.explanation.worth.findings import findings_of
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


GOOD = Interval(10.0, 2.0, 9.9, 10.1, 1000)
NOTHING, SMALL = Interval(0.0, 0.0, 0.0, 0.0, 1000), Interval(0.01, 0.5, -0.02, 0.04, 1000)
LOSS, GAIN = Interval(-3.0, 5.0, -3.3, -2.7, 1000), Interval(3.0, 5.0, 2.7, 3.3, 1000)
UNKNOWN = Interval(0.1, 15.0, -0.8, 1.0, 1000)


def behavior(dropped, *, control=0.5, own=1.0, rules=(), expectation=None):
    return BehaviorWorth(
        "seek", 1, control, 1.0, 1.0, 0.0, {"term": own}, dropped, LOSS, expectation, tuple(rules)
    )


def judged(worth, orders=()):
    return [(finding.kind, finding.text) for finding in findings_of([worth], orders, [], GOOD, 100.0)]


def test_a_behavior_is_judged_by_what_happens_without_it():
    assert judged(behavior(LOSS)) == []
    assert judged(behavior(UNKNOWN)) == []
    assert judged(behavior(SMALL)) == [("removable", "seek can be removed: return -0.020 to +0.040")]
    assert judged(behavior(SMALL, control=0.004)) == [
        ("idle", "seek is hardly in control and can be removed: return -0.020 to +0.040")
    ]
    tiny = Interval(1e-6, 1e-4, -5e-6, 7e-6, 1000)
    assert judged(behavior(tiny)) == [
        ("removable", "seek can be removed: the return changes by less than 0.001")
    ]
    assert judged(behavior(NOTHING)) == [("removable", "seek can be removed: the return never changes")]
    assert judged(behavior(NOTHING, control=0.0)) == [
        ("idle", "seek never controls: it can be removed, the return never changes")
    ]


def test_who_does_harm_is_selfish_if_it_earns_more_than_the_mean():
    # 50 steps in control; the mean of all steps is 0.1
    assert judged(behavior(GAIN, own=4.9))[0] == (
        "harmful", "the team does better without seek: return +2.700 to +3.300",
    )  # fmt: skip
    kind, text = judged(behavior(GAIN, own=6.0))[0]
    assert kind == "selfish"
    assert text == (
        "seek is selfish: it earns 0.12 in each step that it controls, where the mean is 0.1, "
        "and the team does better without it: return +2.700 to +3.300"
    )


def test_rules_are_judged_where_the_behavior_is_worth_something():
    used, unused = RuleWorth("near", "go", 0.2, SMALL), RuleWorth("far", "stop", 0.0, NOTHING)
    harm, rest = RuleWorth("", "go", 0.1, GAIN), RuleWorth("", "no action", 0.0, None)
    assert judged(behavior(LOSS, rules=[used, unused, harm, rest])) == [
        ("harmful rule", "seek: the rule go otherwise does harm, without it return +2.700 to +3.300"),
        ("useless rule", "seek: the rule go where near can be removed: return -0.020 to +0.040"),
        ("useless rule", "seek: the rule stop where far is never used, it can be removed"),
    ]
    assert [kind for kind, _ in judged(behavior(SMALL, rules=[used, unused, harm]))] == ["removable"]
    assert judged(behavior(LOSS, rules=[harm])) == []


def test_another_order_must_be_clearly_better():
    better, perhaps = (Order(("a", "b"), change, 1) for change in (GAIN, UNKNOWN))
    assert judged(behavior(LOSS), [better]) == [
        ("better order", "another order does better: a b, return +2.700 to +3.300")
    ]
    assert judged(behavior(LOSS), [perhaps]) == []
    assert judged(behavior(LOSS), [perhaps, better]) == judged(behavior(LOSS), [better])


def alike(*pairs):
    return [finding.text for finding in findings_of([], [], pairs, GOOD, 100.0)]


def test_robots_in_the_same_place_are_alike():
    assert alike(RobotsAlike(0, 1, 0.5, 0.0, 0.99, 10), RobotsAlike(0, 2, 0.5, 0.0, 0.4, 10)) == [
        "robots 0 and 1 did the same in 50.0 % of the steps, and stood in the same place after 99.0 %"
    ]
    assert alike(RobotsAlike(1, 2, 0.5, 0.96, None, 10)) == [
        "robots 1 and 2 did the same in 50.0 % of the steps, and were in the same state after 96.0 %"
    ]


def test_more_than_two_that_are_alike_are_named_together():
    pairs = [
        RobotsAlike(one, other, 1.0, 0.9 + 0.01 * other, None, 10)
        for one, other in ((0, 3), (1, 4), (3, 5), (4, 6))
    ]
    first, second = alike(*pairs)
    assert first.startswith("robots 0, 3 and 5 did the same in at least 100.0 % of the steps")
    assert first.endswith(", and were in the same state after at least 93.0 %")
    assert second.startswith("robots 1, 4 and 6 did the same in at least 100.0 % of the steps")
    assert second.endswith(", and were in the same state after at least 94.0 %")
