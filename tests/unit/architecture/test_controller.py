from itertools import product

import numpy as np
import pytest

from bbsd.architecture import Architecture, architecture_of, joint_space, policy
from bbsd.architecture.controller import command, controller_of
from tests.unit.architecture.designs import SHIPPED, meaning_of, random_architecture, shipped, small


def given(behaviors):
    meaning = meaning_of(small(behaviors))
    return controller_of(meaning, architecture_of(meaning))


HAND = """
  near:
    inputs: {zone: "cut(x, 1, 2)"}
    excited: x > 5
    actions: {stay: {x: 0}, go: {x: "x  +  1"}}
    rules: [{when: {zone: below 1}, do: go}, {otherwise: no action}]
  far:
    inputs: {count: "values(floor(x), 0, 3)", ready: x > 5}
    actions: {back: {x: x - 1}}
    rules: [{when: {ready: true, count: 2}, do: back}, {otherwise: no action}]
structure: [near, far]
"""


@pytest.mark.parametrize("name", SHIPPED)
@pytest.mark.parametrize("seed", range(3))
def test_a_controller_decides_every_joint_cell_as_the_design_does(name, seed):
    meaning = meaning_of(shipped(name))
    design = random_architecture(meaning, seed)
    controller = controller_of(meaning, design)
    cells = product(*(range(size) for size in controller.sizes))
    assert [command(controller, cell) for cell in cells] == policy(joint_space(meaning), design).tolist()


def test_it_says_what_the_design_tells_apart_and_does():
    controller = given(HAND)
    assert [(each.name, each.text, each.size) for each in controller.dimensions] == [
        ("zone", "cut(x, 1, 2)", 3),
        ("count", "values(floor(x), 0, 3)", 4),
        ("ready", "x > 5", 2),
    ]
    assert [(each.behavior, each.name, dict(each.sets)) for each in controller.actions] == [
        ("near", "stay", {"x": "0"}),
        ("near", "go", {"x": "x + 1"}),
        ("far", "back", {"x": "x - 1"}),
    ]
    high, low = controller.layers
    assert (high.number, high.behavior, high.excited, high.excitement, high.excited_at) == (
        2,
        "near",
        "x > 5",
        2,
        1,
    )
    assert (low.number, low.axes, low.sizes, low.excitement) == (1, (1, 2), (4, 2), None)
    assert high.table == bytes([2, 0, 0])
    assert command(controller, (0, 2, 1)) == 2
    assert command(controller, (1, 2, 1)) == 3
    assert command(controller, (1, 2, 0)) == 0


def test_a_condition_that_is_no_input_is_a_dimension_that_says_so():
    controller = given(
        "  push: {excited: x > 3, actions: {go: {x: 1}}, rules: [{otherwise: go}]}\nstructure: [push]\n"
    )
    (dimension,) = controller.dimensions
    assert (dimension.name, dimension.text, dimension.is_condition) == ("push", "x > 3", True)
    assert [command(controller, (cell,)) for cell in (0, 1)] == [0, 1]


def test_a_behavior_that_is_never_excited_has_no_layer():
    controller = given(
        "  push: {excited: 1 > 3, actions: {go: {x: 1}}, rules: [{otherwise: go}]}\nstructure: [push]\n"
    )
    assert controller.layers == ()
    assert command(controller, ()) == 0


def test_the_digest_is_of_the_content_not_of_how_it_is_written_or_called():
    digest = given(HAND).digest
    assert len(digest) == 32
    assert given(HAND.replace("floor(x), 0", "floor(x),  0")).digest == digest
    meaning = meaning_of(small(HAND).replace("name: small", "name: other"))
    assert controller_of(meaning, architecture_of(meaning)).digest == digest
    for old, new in (("do: go", "do: stay"), ("go: {", "gone: {"), ("cut(x, 1, 2)", "cut(x, 1, 3)")):
        changed = HAND.replace(old, new).replace("do: go}", "do: gone}" if new == "gone: {" else "do: go}")
        assert given(changed).digest != digest, new


def test_the_digest_is_of_the_world_too_that_gives_cells_and_actions_their_meaning():
    one = "{inputs: {near: tilt > most}, actions: {go: {x: 1}}, rules: [{otherwise: go}]}"
    behaviors = f"  one: {one}\nstructure: [one]\n"
    world = (
        "constants: {most: 3, least: [1, [2]]}\nenvironment: {sensors: {tilt: x * 2}, dynamics: {x: x + 1}, "
    )
    text = small(behaviors).replace("environment: {", world)

    def digest(text):
        meaning = meaning_of(text)
        return controller_of(meaning, architecture_of(meaning)).digest

    same = [
        ("x * 2", "x  *  2"),
        ("most: 3, least: [1, [2]]", "least: [1, [2]], most: 3"),
        ("right: x", "right: -x"),
    ]
    others = [
        ("most: 3", "most: 4"),
        ("[2]", "[5]"),
        ("x * 2", "x * 3"),
        ("x: x + 1", "x: x + 2"),
        ("x: 0", "x: 1"),
    ]
    assert all(digest(text.replace(*change)) == digest(text) for change in same)
    assert len({digest(text), *(digest(text.replace(*change)) for change in others)}) == 1 + len(others)


def test_a_dimension_of_many_numbers_is_not_written_out():
    controller = given(
        "  push: {inputs: {n: 'values(floor(x), 0, 900000)'}, actions: {go: {x: 1}}, rules: [{otherwise: go}]}\n"
        "structure: [push]\n"
    )
    assert controller.joint_size == 900_001
    assert controller.dimensions[0].cells[7] == "7"


def test_tables_of_an_architecture_that_is_not_the_specs_own_are_used():
    meaning = meaning_of(small(HAND))
    design = Architecture((np.zeros(3, np.uint8), np.ones(8, np.uint8)), np.array([1, 0]))
    assert command(controller_of(meaning, design), (0, 0, 0)) == 3


def test_an_input_that_is_read_by_its_name_has_that_name_as_its_text():
    behavior = "  one: {inputs: [lit], actions: {go: {x: 1}}, rules: [{otherwise: go}]}\nstructure: [one]\n"
    meaning = meaning_of(small(behavior).replace("state: {x: 0}", "state: {x: 0, lit: x > 3}"))
    (lit,) = controller_of(meaning, architecture_of(meaning)).dimensions
    assert (lit.name, lit.text, lit.is_condition) == ("lit", "lit", False)
    meaning = meaning_of(shipped("gymnasium/lake"))
    controller = controller_of(meaning, random_architecture(meaning, 0))
    assert [(each.name, each.text, each.size) for each in controller.dimensions] == [
        ("row", "row", 4),
        ("column", "column", 4),
    ]
