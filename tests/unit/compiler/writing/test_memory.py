"""No two arrays of a rollout overlap, and each has a place for every lane."""

import numpy as np
import pytest

from bbsd.compiler.writing.memory import Memory
from bbsd.expression.kinds import Kind
from bbsd.kernel import memory as kernel_memory

LANES, ROBOTS = 4, 3
SIZE = 200


@pytest.fixture
def memory():
    memory = Memory()
    for name, kind, own in (
        ("wind", Kind.NUMBER, False),
        ("row", Kind.CELL, False),
        ("x", Kind.NUMBER, True),
        ("cell", Kind.CELL, True),
        ("armed", Kind.TRUTH, True),
        ("alarm", Kind.TRUTH, False),
    ):
        assert memory.add(name, kind, own=own) == name
    return memory


def run(lines):
    scope = {**vars(kernel_memory), "numbers": np.zeros(SIZE)}
    exec("\n".join(lines), scope)
    return scope


def test_every_element_is_apart(memory):
    scope = run([*memory.lines(LANES), *memory.own_lines(LANES, ROBOTS)])
    team = ["key", "wind", "row", "alarm"]
    assert [len(scope[name]) for name in team] == [LANES] * 4
    elements = [(scope[name], lane) for name in team for lane in range(LANES)]
    elements += [
        (scope[name], robot * scope["stride"] + lane)
        for name in ("x", "cell", "armed")
        for robot in range(ROBOTS)
        for lane in range(LANES)
    ]
    for number, (array, place) in enumerate(elements):
        array[place] = number
    assert [int(array[place]) for array, place in elements] == list(range(len(elements)))
    assert len(elements) == memory.size(LANES, ROBOTS) == memory.team_size(LANES) + len(scope["own_numbers"])
    assert (scope["numbers"][len(elements) :] == 0).all()


def test_every_element_of_a_list_is_apart(memory):
    memory.add("bins", Kind.NUMBER, own=False, length=5)
    memory.add("marks", Kind.TRUTH, own=True, length=3)
    memory.add("last", Kind.NUMBER, own=True)
    assert (memory.length_of("bins"), memory.length_of("last")) == (5, 1)
    scope = run([*memory.lines(LANES), *memory.own_lines(LANES, ROBOTS)])
    team, own = (
        {"wind": 1, "row": 1, "alarm": 1, "bins": 5},
        {"x": 1, "armed": 1, "marks": 3, "last": 1, "cell": 1},
    )
    elements = [(scope[name], place) for name, length in team.items() for place in range(length * LANES)]
    elements += [
        (scope[name], robot * scope["stride"] + place)
        for name, length in own.items()
        for robot in range(ROBOTS)
        for place in range(length * LANES)
    ]
    for number, (array, place) in enumerate(elements):
        array[place] = number
    assert [int(array[place]) for array, place in elements] == list(range(len(elements)))
    assert memory.size(LANES, ROBOTS) == LANES + len(elements)


def test_kinds_have_their_types(memory):
    scope = run([*memory.lines(LANES), *memory.own_lines(LANES, ROBOTS)])
    assert {name: scope[name].dtype for name in ("key", "wind", "row", "x", "cell", "armed")} == {
        "key": np.uint64,
        "wind": np.float64,
        "row": np.int64,
        "x": np.float64,
        "cell": np.int64,
        "armed": np.float64,
    }


def test_what_is_a_robot_s_own_is_known(memory):
    assert [name for name in ("wind", "row", "x", "cell", "armed") if memory.is_own(name)] == [
        "x",
        "cell",
        "armed",
    ]


def test_nothing_but_the_key_is_kept_of_nothing():
    scope = run([*Memory().lines(LANES), *Memory().own_lines(LANES, ROBOTS)])
    assert Memory().size(LANES, ROBOTS) == len(scope["key"]) == LANES
    assert (scope["stride"], len(scope["own_numbers"])) == (0, 0)
