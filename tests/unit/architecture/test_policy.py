from itertools import product

import numpy as np
import pytest

from bbsd.architecture import Architecture, behavior_keys, joint_space, policy
from bbsd.architecture.policy import EXCITEMENT, MAX_JOINT_CELLS, controlling
from tests.unit.architecture.designs import SHIPPED, meaning_of, random_architecture, shipped, small


def behavior_key(space, architecture):
    return behavior_keys(space, [architecture])[0]


def architecture(tables, structure):
    return Architecture(tuple(np.array(table, np.uint8) for table in tables), np.array(structure))


def expected(meaning, space, architecture):
    """The controlling action in every joint cell, found cell by cell from the definition of (3)."""
    modules, found = meaning.episode.modules, []
    for joint in product(*(range(size) for size in space.sizes)):
        number = 0
        for behavior in architecture.structure[::-1]:
            view, module = space.projections[behavior], modules[behavior]
            is_excited = (
                view.excited_at == 1 if view.excitement is None else joint[view.excitement] == view.excited_at
            )
            shape = [len(cells) for cells in module.inputs.values()]
            table = architecture.tables[behavior].reshape(shape)
            action = int(table[tuple(joint[axis] for axis in view.axes)])
            if not number and is_excited and action:
                number = sum(len(other.actions) for other in modules[:behavior]) + action
        found.append(number)
    return found


@pytest.mark.parametrize("name", SHIPPED)
@pytest.mark.parametrize("seed", range(3))
def test_in_every_joint_cell_the_highest_layer_with_an_action_controls(name, seed):
    meaning = meaning_of(shipped(name))
    space, design = joint_space(meaning), random_architecture(meaning, seed)
    assert policy(space, design).tolist() == expected(meaning, space, design)


def test_behaviors_that_see_through_the_same_partition_share_a_dimension():
    space = joint_space(meaning_of(shipped("object_lifting")))
    assert {name: len(cells) for name, cells in space.dimensions.items()} == {
        "pace": 6,
        "reached": 2,
        "place": 3,
        "tilted": 2,
    }
    assert space.joint_size == 72
    assert space.projections[3].axes == space.projections[4].axes == (2, 3)


EXCITED = """
  one: {inputs: {near: x > 1}, actions: {a: {x: 1}, b: {x: 2}}}
  two: {inputs: {near: x > 2}, excited: x > 1, actions: {a: {x: 2}}}
  three: {excited: not x > 1, actions: {a: {x: x}}}
  four: {excited: x > 3, actions: {a: {x: 3}}}
  five: {excited: "false", actions: {a: {x: 4}}}
"""


def test_an_excitation_shares_the_dimension_of_the_same_condition_and_of_its_opposite():
    space = joint_space(meaning_of(small(EXCITED)))
    assert space.dimensions == {
        "near": ("false", "true"),
        "near of two": ("false", "true"),
        "four": EXCITEMENT,
    }
    assert [(view.excitement, view.excited_at) for view in space.projections] == [
        (None, 1),
        (0, 1),
        (0, 0),
        (2, 1),
        (None, 0),
    ]


def test_excited_behaviors_control_and_others_do_not():
    meaning = meaning_of(small(EXCITED))
    space = joint_space(meaning)
    design = architecture([[0, 0], [1, 1], [1], [1], [1]], [0, 1, 2, 3, 4])
    assert policy(space, design).tolist() == expected(meaning, space, design)
    assert controlling(space, design).tolist() == [2, 3, 2, 3, 1, 3, 1, 3]


def test_a_role_of_one_robot_is_no_certainty_for_the_team():
    roles = """
  leader: {excited: robot == 0, actions: {a: {x: 1}}}
  follower: {excited: robot != 0, actions: {a: {x: 2}}}
"""
    space = joint_space(meaning_of(small(roles, robots=2)))
    assert space.dimensions == {"leader": EXCITEMENT, "follower": EXCITEMENT}


def test_two_inputs_of_a_behavior_may_be_the_same_partition():
    twice = """
  one: {inputs: {near: x > 1, close: x > 1}, actions: {a: {x: 1}, b: {x: 2}, c: {x: 3}}}
"""
    space = joint_space(meaning_of(small(twice)))
    assert policy(space, architecture([[1, 2, 3, 0]], [0])).tolist() == [1, 0]


def test_behaviors_without_inputs_have_one_joint_cell():
    space = joint_space(meaning_of(small("  one: {actions: {a: {x: 1}}}")))
    assert space.joint_size == 1
    assert policy(space, architecture([[1]], [0])).tolist() == [1]
    assert controlling(space, architecture([[0]], [0])).tolist() == [-1]


def test_architectures_that_behave_the_same_have_the_same_key():
    space = joint_space(meaning_of(small(EXCITED)))
    one = architecture([[1, 1], [0, 0], [0], [0], [0]], [1, 2, 3, 4, 0])
    other_below = architecture([[1, 1], [1, 1], [1], [1], [1]], [4, 3, 2, 1, 0])
    other_action = architecture([[2, 1], [0, 0], [0], [0], [0]], [1, 2, 3, 4, 0])
    assert behavior_key(space, one) == behavior_key(space, other_below)
    assert behavior_key(space, one) != behavior_key(space, other_action)


def test_actions_that_set_the_same_are_the_same():
    space = joint_space(meaning_of(small(EXCITED)))
    by_one = architecture([[0, 2], [0, 0], [0], [0], [0]], [1, 2, 3, 4, 0])
    by_two = architecture([[0, 0], [1, 1], [0], [0], [0]], [0, 2, 3, 4, 1])
    assert behavior_key(space, by_one) == behavior_key(space, by_two)


def test_an_action_that_sets_nothing_is_as_good_as_none():
    space = joint_space(meaning_of(small("  one: {actions: {wait: {}, go: {x: 1}}}")))
    keys = [behavior_key(space, architecture([[action]], [0])) for action in range(3)]
    assert keys[0] == keys[1] != keys[2]


def test_in_a_large_space_the_tables_of_the_structure_are_compared():
    inputs = ", ".join(f"i{place}: 'values(floor(x) * {place + 1}, 0, 9)'" for place in range(3))
    others = ", ".join(f"j{place}: 'values(floor(x) + {place + 1}, 0, 9)'" for place in range(3))
    behaviors = f"""
  one: {{inputs: {{{inputs}}}, actions: {{a: {{x: 1}}}}}}
  two: {{inputs: {{{others}}}, actions: {{a: {{x: 1}}}}}}
  three: {{actions: {{a: {{x: 1}}}}}}
"""
    space = joint_space(meaning_of(small(behaviors)))
    assert space.joint_size > MAX_JOINT_CELLS
    zeros = [0] * 1000
    key = behavior_key(space, architecture([zeros, zeros, [0]], [0, 1]))
    assert key == behavior_key(space, architecture([zeros, zeros, [1]], [0, 1]))
    assert key != behavior_key(space, architecture([zeros, zeros, [0]], [1, 0]))
    assert key != behavior_key(space, architecture([[1, *zeros[1:]], zeros, [0]], [0, 1]))


def test_dimensions_have_different_names_whatever_inputs_and_behaviors_are_called():
    space = joint_space(
        meaning_of(
            small("""
  a: {inputs: {b: x > 1}, actions: {p: {x: 1}}}
  b: {inputs: {b: x > 2}, excited: x > 3, actions: {p: {x: 1}}}
""")
        )
    )
    assert [*space.dimensions] == ["b", "b of b", "b of b, excited"]
