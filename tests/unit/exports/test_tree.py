import pytest
from hypothesis import given

from bbsd.architecture.controller import Action, Controller, Dimension, Layer
from bbsd.exports import tree
from bbsd.exports.tree import Act, Condition, Group, TooLongForATree, nodes_of, silent_said, tree_of
from tests.unit.exports.controllers import controllers, joint_cells
from tests.unit.exports.designs import SHIPPED, hand_made

NEVER = -1


def taken(node, cells):
    """The number of the action that a tree takes in a joint cell; None where it fails, NEVER of a condition."""
    match node:
        case Condition():
            return NEVER if cells[node.dimension] in node.cells else None
        case Act():
            return node.action
        case Group(kind="fallback"):
            return next(
                (number for child in node.children if (number := taken(child, cells)) is not None), None
            )
        case Group():
            numbers = [taken(child, cells) for child in node.children]
            return None if None in numbers else numbers[-1]


@given(controllers())
def test_a_tree_takes_the_actions_of_the_design_in_all_joint_cells(controller):
    cells, expected = joint_cells(controller)
    root = tree_of(controller).root
    assert [taken(root, cell) for cell in cells] == expected


@given(controllers())
def test_a_tree_of_a_joint_space_that_is_too_large_to_go_through_does_so_too(controller):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(tree, "MAX_JOINT_CELLS", 0)
        root = tree_of(controller).root
    cells, expected = joint_cells(controller)
    assert [taken(root, cell) for cell in cells] == expected


@given(controllers())
def test_groups_have_children_of_another_kind_and_conditions_say_something(controller):
    for node in nodes_of(tree_of(controller).root):
        match node:
            case Condition():
                assert 0 < len(node.cells) < controller.dimensions[node.dimension].size
            case Group():
                assert node.children or node.text == controller.name


@pytest.mark.parametrize("name", SHIPPED)
def test_shipped_designs_are_drawn_as_they_were_written(name):
    exported = hand_made(name)
    made = tree_of(exported.controller)
    heads = [child.text for child in made.root.children if isinstance(child, Group)]
    in_it = [layer for layer in exported.controller.layers if layer.behavior not in made.silent]
    assert heads == [f"layer {layer.number}: {layer.behavior}" for layer in in_it]


def with_tables(*tables):
    """A design of behaviors that are always excited and perceive one dimension of four cells, the highest first."""
    layers = tuple(
        Layer(len(tables) - index, f"b{index}", None, (0,), (4,), None, 1, bytes(table), 2 * index, 2)
        for index, table in enumerate(tables)
    )
    actions = tuple(
        Action(name, f"b{index}", {}) for index, _ in enumerate(tables) for name in ("go", "stay")
    )
    return Controller("c", "0" * 32, (Dimension("x", ("a", "b", "c", "d"), "x", False),), layers, actions)


def drawn(node):
    """A tree in few characters: [sequence], (fallback), conditions by their words, actions by their number."""
    match node:
        case Group():
            inner = ", ".join(map(drawn, node.children))
            return f"[{inner}]" if node.kind == "sequence" else f"({inner})"
        case Condition():
            return node.text
        case Act():
            return str(node.action)


@pytest.mark.parametrize(
    ("tables", "expected"),
    [
        ([[0, 1, 1, 0]], "([x is b or c, 1], 0)"),
        ([[1, 1, 2, 1]], "(([x is c, 2], 1))"),
        ([[1, 0, 1, 1]], "([x is not b, 1], 0)"),
        ([[1, 0, 1, 2]], "(([x is d, 2], [x is not b, 1]), 0)"),
        ([[1, 1, 0, 0], [2, 1, 1, 2]], "([x is a or b, 1], ([x is d, 4], 3))"),
        ([[0, 0, 0, 0], [1, 1, 1, 1]], "([3])"),
    ],
)
def test_rules_become_branches(tables, expected):
    assert drawn(tree_of(with_tables(*tables)).root) == expected


def test_a_behavior_that_never_controls_is_left_out_and_told():
    made = tree_of(with_tables([1, 1, 1, 1], [2, 1, 2, 1]))
    assert drawn(made.root) == "([1])"
    assert silent_said(made) == ["Never controls, and is left out: b1."]


def test_a_tree_is_never_deep_however_often_rules_change_to_no_action():
    size = 4000
    table = bytes(cell % 3 for cell in range(size))
    controller = Controller(
        "c",
        "0" * 32,
        (Dimension("x", tuple(map(str, range(size))), "x", False),),
        (Layer(1, "b", None, (0,), (size,), None, 1, table, 0, 2),),
        (Action("go", "b", {}), Action("stay", "b", {})),
    )
    root = tree_of(controller).root
    assert [taken(root, (cell,)) for cell in range(0, size, 7)] == [table[cell] for cell in range(0, size, 7)]
    assert depth(root) < 20


def depth(node):
    return 1 + max(map(depth, getattr(node, "children", ())), default=0)


def test_a_table_that_nobody_could_read_as_rules_is_refused():
    size = 8000
    table = bytes(cell * 7919 % 5 for cell in range(size))
    controller = Controller(
        "c",
        "0" * 32,
        (Dimension("x", tuple(map(str, range(size))), "x", is_condition=False),),
        (Layer(1, "b", None, (0,), (size,), None, 1, table, 0, 4),),
        tuple(Action(f"a{index}", "b", {}) for index in range(4)),
    )
    with pytest.raises(TooLongForATree, match=r"the rules of b have \d,\d\d\d words, more than 3,000"):
        tree_of(controller)
