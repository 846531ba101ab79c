import numpy as np

from bbsd.explanation.worth.orders import tried_orders
from tests.unit.explanation.worth.planted import appraisal_of, planted


def test_all_orders_of_few_layers_are_tried():
    orders, whole = tried_orders(np.array([2, 0, 1]))
    assert whole
    assert orders[0].tolist() == [2, 0, 1]
    assert len({tuple(order.tolist()) for order in orders}) == 6


def test_of_many_layers_any_two_are_exchanged():
    structure = np.arange(7)
    orders, whole = tried_orders(structure)
    assert not whole
    assert orders[0].tolist() == structure.tolist()
    assert len({tuple(order.tolist()) for order in orders}) == 1 + 21
    assert all(int((order != structure).sum()) == 2 for order in orders[1:])


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
