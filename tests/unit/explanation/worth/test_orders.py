import numpy as np

from bbsd.explanation.worth.orders import tried_orders
from tests.unit.explanation.worth.planted import appraisal_of, needed, planted


def test_all_orders_of_few_layers_are_tried():
    orders, whole = tried_orders(np.array([2, 0, 1]))
    assert whole
    assert orders[0].tolist() == [2, 0, 1]
    assert len({tuple(order.tolist()) for order in orders}) == 6


def test_of_many_layers_two_are_exchanged_or_one_has_another_place():
    structure = np.arange(7)
    orders, whole = tried_orders(structure)
    assert not whole
    assert orders[0].tolist() == structure.tolist()
    distinct = {tuple(order.tolist()) for order in orders}
    exchanged, moved = 21, 7 * 6 - 6  # a move by one place is the same for two behaviors
    assert len(orders) == len(distinct) == 1 + exchanged + moved - 6  # and is an exchange
    assert all(sorted(order) == list(range(7)) for order in distinct)
    assert (6, 1, 2, 3, 4, 5, 0) in distinct
    assert (1, 2, 3, 4, 5, 6, 0) in distinct


def test_orders_that_must_do_the_same_count_as_one():
    # Who may take must stand above who works; where `guard` stands is all the same in episodes, not by the tables.
    worth = appraisal_of(planted(cost=0)).worth()
    assert worth.precedence.above == (("grab", "work"),)
    assert worth.precedence.tried == 6
    assert worth.precedence.whole
    assert [order.change.mean for order in worth.orders[:3]] == [0, 0, 0]
    assert all(order.structure.index("grab") < order.structure.index("work") for order in worth.orders[:3])
    assert worth.orders[3].change.mean < 0


def test_the_tables_prove_that_an_exchange_changes_nothing():
    text = (
        planted(cost=0)
        .replace("excited: x > 9", "excited: not tempted")
        .replace("rest: {x: 0}", "rest: {x: 1, took: 0}")
    )
    worth = appraisal_of(text).worth()
    swap = worth.swaps[0]
    assert (swap.upper, swap.lower) == ("guard", "grab")
    assert swap.never
    assert swap.change.mean == swap.change.sd == 0
    assert not worth.swaps[1].never


def test_an_order_whose_rewards_are_not_finite_is_none_of_the_best():
    # Who always rests at 0 must stand below who works, else rewards are 1 / 0.
    text = needed().replace("    excited: x > 9\n", "").replace("rest: {x: 0}", "rest: {x: 0, took: 0}")
    worth = appraisal_of(text.replace("[guard, grab, work]", "[work, grab, guard]"), episodes=50).worth()
    assert sum(order.alike for order in worth.orders) == 3
    for order in worth.orders:
        assert np.isfinite(order.change.mean)
        assert order.structure.index("work") < order.structure.index("guard")
    assert worth.precedence.tried == 6
    assert ("work", "guard") in worth.precedence.above
