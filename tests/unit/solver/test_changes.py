import numpy as np

from bbsd.solver.changes import changes_of
from bbsd.solver.space import Space
from tests.unit.solver.problems import guess


def changes(structure="", key=1):
    problem, _ = guess(structure)
    space = Space(problem)
    return space, changes_of(space, space.random(key, 1))


def test_there_is_one_change_for_every_other_choice_of_every_open_cell():
    space, all_changes = changes()
    (table,) = all_changes.design.tables
    rows = all_changes.applied(np.arange(len(all_changes.cells)))
    # Two behaviors with 4 cells each, one of them given, and two actions and No Action in each: 7 x 2.
    assert len(rows) == 14
    assert (rows.tables != table).sum(axis=1).tolist() == [1] * 14
    assert len({row.tobytes() for row in rows.tables}) == 14
    assert set(np.flatnonzero((rows.tables != table).any(axis=0))) == set(space.open_cells)
    assert (rows.tables < space.choices).all()
    assert (rows.structures == all_changes.design.structures).all()


def test_the_other_changes_are_the_neighboring_orders():
    space, all_changes = changes()
    rows = all_changes.applied(np.arange(len(all_changes.cells), len(all_changes)))
    assert [row.tolist() for row in rows.structures] == [
        order.tolist() for order in space.neighboring_orders(all_changes.design.structures[0])
    ]
    assert (rows.tables == all_changes.design.tables).all()


def test_a_given_order_has_no_changes():
    _, all_changes = changes("structure: [odd, even, reckless]")
    assert len(all_changes) == len(all_changes.cells)


def test_changes_are_made_one_after_another():
    _, all_changes = changes()
    which = np.array([0, len(all_changes.cells), 5])
    by_themselves, together = all_changes.applied(which), all_changes.applied_together(which)
    (table,), (order,) = all_changes.design.tables, all_changes.design.structures
    assert (together.tables[0] == by_themselves.tables[0]).all()
    assert (together.structures[0] == order).all()
    assert (together.tables[1] == by_themselves.tables[0]).all()
    assert (together.structures[1] == by_themselves.structures[1]).all()
    assert np.flatnonzero(together.tables[2] != table).tolist() == all_changes.cells[[0, 5]].tolist()
    assert (together.structures[2] == by_themselves.structures[1]).all()


def test_of_changes_of_one_cell_and_of_orders_only_the_first_is_compatible():
    _, all_changes = changes()
    first_order = len(all_changes.cells)
    which = np.array([5, first_order + 1, 4, 0, first_order, 3])
    assert all_changes.compatible(which).tolist() == [5, first_order + 1, 0, 3]
