import numpy as np
import pytest

from bbsd.architecture import given_architecture
from bbsd.evaluation import agents_of, evaluation_key, evaluation_keys, interval, returns_of
from bbsd.evaluation.faults import read_faults
from bbsd.explanation.faults import degradations
from bbsd.explanation.worth import Appraisal
from tests.unit.explanation.worth.planted import needed, planted
from tests.unit.problems import problem_of

EPISODES = 60


@pytest.fixture(scope="module")
def problem():
    return problem_of(planted(robots=2))


def found_with(problem, *texts, **how):
    faults = read_faults(texts, problem.meaning)
    return degradations(problem, given_architecture(problem), faults, evaluation_key(0), EPISODES, 1, **how)


def test_each_fault_is_alone_and_beside_the_undisturbed_design(problem):
    found = found_with(problem, "all", "sensor=tempted:lost", "robot=1:dead")
    base = returns_of(problem, agents_of([given_architecture(problem)]), evaluation_keys(0, EPISODES), 1)[0]
    assert found.returns == interval(base)
    assert found.structure == ("guard", "grab", "work")
    assert [each.fault.text for each in found.faults] == [
        "behavior=guard:silent", "behavior=grab:silent", "behavior=work:silent", "sensor=tempted:lost", "robot=1:dead",
    ]  # fmt: skip
    for each in found.faults:
        assert each.change.mean == pytest.approx(each.returns.mean - found.returns.mean)
        assert each.relearned is None
    # Who is never tempted never takes.
    assert found.faults[3].change == found.faults[1].change


def test_a_silent_behavior_is_a_dropped_one(problem):
    found = found_with(problem, "all")
    worth = Appraisal(problem, given_architecture(problem), evaluation_key(0), EPISODES, 1)
    for each in found.faults:
        assert each.change == worth.dropped(problem.names.index(each.fault.name))


def test_a_random_table_is_the_mean_of_many(problem):
    (each,) = found_with(problem, "behavior=grab:random").faults
    assert each.returns.count == each.change.count == 25
    assert each.change.sd > 0
    worth = Appraisal(problem, given_architecture(problem), evaluation_key(0), EPISODES, 1)
    assert each.change == worth.replaced(problem.names.index("grab"))


def test_the_order_is_learned_again_around_a_fault(problem):
    found = found_with(problem, "behavior=work:silent", "robot=1:dead", relearn=True)
    for each in found.faults:
        assert set(each.relearned.structure) == {"guard", "grab", "work"}
        assert each.relearned.gain.mean >= 0
        assert each.relearned.gain.mean == pytest.approx(each.relearned.returns.mean - each.returns.mean)
        assert each.relearned.change.mean == pytest.approx(each.relearned.returns.mean - found.returns.mean)
    # With who grabs below who works, nobody takes.
    order = found.faults[1].relearned.structure
    assert order.index("work") < order.index("grab")
    assert found.faults[1].relearned.gain.low > 0


def test_many_layers_are_exchanged_while_it_helps():
    extra = "".join(
        f"""  idle_{number}:
    excited: x > 9
    actions: {{rest: {{x: 0}}}}
    rules: [otherwise: rest]
"""
        for number in range(3)
    )
    text = planted().replace(
        "structure: [guard, grab, work]",
        f"{extra.rstrip()}\nstructure: [grab, guard, idle_0, idle_1, idle_2, work]",
    )
    (each,) = found_with(problem_of(text), "behavior=guard:silent", relearn=True).faults
    order = each.relearned.structure
    assert order.index("work") < order.index("grab")
    assert each.relearned.gain.low > 0


def test_progress_is_told(problem):
    told = []
    found_with(problem, "all", progress=lambda done, total: told.append((done, total)))
    assert told == [(1, 3), (2, 3), (3, 3)]


def test_one_layer_has_no_other_order():
    text = planted().replace("[guard, grab, work]", "[work]")
    (each,) = found_with(problem_of(text), "behavior=work:silent", relearn=True).faults
    assert each.relearned is None


def test_a_frame_has_a_row_for_each_fault(problem):
    pytest.importorskip("pandas")
    found = found_with(problem, "all", relearn=True)
    table = found.to_frame()
    assert list(table.index) == [each.fault.text for each in found.faults]
    assert table["change"].tolist() == [each.change.mean for each in found.faults]
    assert table["gain"].tolist() == [each.relearned.gain.mean for each in found.faults]
    assert repr(found) == f"<Degradations: mean return {found.returns.mean:.6g}, 3 faults>"


def test_rewards_that_are_not_finite_under_a_fault_have_no_mean():
    found = found_with(problem_of(needed()), "all", "behavior=work:random", relearn=True)
    _, grab, work, random = found.faults
    assert [grab.fault.name, work.fault.name, random.fault.name] == ["grab", "work", "work"]
    assert np.isnan([work.returns.mean, work.change.mean, random.returns.mean]).all()
    assert np.isfinite([grab.returns.mean, grab.change.mean, grab.relearned.gain.mean]).all()
    assert work.relearned.structure == found.structure
