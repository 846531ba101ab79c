import pytest

from bbsd.environments.spaces.kinds import Box, Discrete, Mapping, MultiDiscrete, Other, Several
from bbsd.environments.spaces.matching import Setting, misfits
from bbsd.language.outside import Field, Outside

FOUR = Box((4,), (-1.0,) * 4, (1.0,) * 4, "float32")
IMAGE = Box((7, 7, 3), (0.0,) * 147, (9.0,) * 147, "uint8")
GRID = Mapping((("image", IMAGE), ("facing", Discrete(4)), ("mission", Other("Text"))))
TWO = Discrete(2)
OBSERVATION = ("environment", "observation")


def found(fields, space, actions=("push",), taken=TWO, settings=(), label=""):
    told = Outside("gymnasium", "It-v0", {}, tuple(fields), tuple(actions))
    return misfits(told, space, taken, settings, label)


def paths(*texts):
    return [Field(f"f{index}", path=path) for index, path in enumerate(texts)]


def names(count):
    return [Field(f"f{index}") for index in range(count)]


def sizes(*numbers):
    return [Field(f"f{index}", size) for index, size in enumerate(numbers)]


FITTING = [
    (names(4), FOUR),
    ([Field("_"), *names(3)], FOUR),
    (names(1), Discrete(9)),
    (names(3), Several((Discrete(2), Discrete(3), Discrete(4)))),
    (sizes(5, 5, 5, 4), Discrete(500)),
    (sizes(2, 3), MultiDiscrete((2, 3), (0, 0), (2,))),
    (sizes(2, 3), Several((Discrete(2), Discrete(3)))),
    (paths(("image", 6, 6, 2), ("facing",)), GRID),
    (paths((3,)), FOUR),
    (paths((1,)), Several((Discrete(2), Discrete(3)))),
]


@pytest.mark.parametrize(("fields", "space"), FITTING)
def test_what_fits_has_no_misfit(fields, space):
    assert found(fields, space) == []


WRONG = [
    (names(3), FOUR, "BB113", OBSERVATION, "4 numbers"),
    (names(2), Discrete(9), "BB113", OBSERVATION, "1 number, Discrete(9), and there are 2 names"),
    (names(4), GRID, "BB116", OBSERVATION, "not all numbers"),
    (
        sizes(5, 5),
        Discrete(500),
        "BB115",
        OBSERVATION,
        "one of 500 numbers, and the sizes are for 5 * 5 = 25",
    ),
    (sizes(3, 2), MultiDiscrete((2, 3), (0, 0), (2,)), "BB115", OBSERVATION, "[2, 3], not [3, 2]"),
    (sizes(2, 3), MultiDiscrete((2, 3), (1, 0), (2,)), "BB115", OBSERVATION, "of which no whole numbers"),
    (sizes(2, 2), FOUR, "BB115", OBSERVATION, "of which no whole numbers"),
    (
        paths(("imag", 0, 0, 0)),
        GRID,
        "BB114",
        (*OBSERVATION, "f0"),
        "has no part 'imag'; did you mean \"image\"?",
    ),
    (paths(("image", 0, 0)), GRID, "BB114", (*OBSERVATION, "f0"), "[0,0] is no number"),
    (paths(("image", 0, 7, 0)), GRID, "BB114", (*OBSERVATION, "f0"), "no [7]"),
    (paths(("image", "x")), GRID, "BB114", (*OBSERVATION, "f0"), "x is no number"),
    (paths(("facing", 0)), GRID, "BB114", (*OBSERVATION, "f0"), "facing is Discrete(4), which has no parts"),
    (paths(("mission",)), GRID, "BB114", (*OBSERVATION, "f0"), "mission is Text, not a number"),
    (paths(("image",)), GRID, "BB114", (*OBSERVATION, "f0"), "not a number"),
    (paths((2,)), Several((Discrete(2), Discrete(3))), "BB114", (*OBSERVATION, "f0"), "has no part 2"),
]


@pytest.mark.parametrize(("fields", "space", "code", "path", "words"), WRONG)
def test_what_does_not_is_told_with_its_place(fields, space, code, path, words):
    (misfit,) = found(fields, space)
    assert misfit.code == code
    assert misfit.path == path
    assert words in misfit.message
    assert misfit.advice


def test_sizes_and_paths_are_not_mixed():
    (misfit,) = found([*sizes(4), Field("p", path=("facing",))], GRID)
    assert (misfit.code, misfit.path) == ("BB115", (*OBSERVATION, "f0"))


def test_names_are_proposed():
    (misfit,) = found(names(3), FOUR, label="CartPole")
    assert misfit.advice == "write observation: [position, speed, angle, tip_speed]"


@pytest.mark.parametrize(
    ("actions", "taken", "code", "words"),
    [
        (("a", "b"), Discrete(2), "BB117", "takes one number, Discrete(2), and there are 2 names"),
        (("a",), FOUR, "BB117", "takes 4 numbers"),
        (("a",), Other("Text"), "BB119", "takes Text"),
        (("a",), Mapping((("x", Discrete(2)),)), "BB119", "not made of numbers"),
    ],
)
def test_so_are_actions(actions, taken, code, words):
    (misfit,) = found(names(4), FOUR, actions, taken)
    assert (misfit.code, misfit.path) == (code, ("environment", "action"))
    assert words in misfit.message


def test_an_environment_without_a_space_of_actions_takes_any():
    assert found(names(4), FOUR, ("a", "b"), None, [Setting("a", 9.5, ())]) == []


def test_literal_values_must_be_taken():
    settings = [
        Setting("push", 1.0, ("behaviors", "b", "actions", "right", "push")),
        Setting("push", 2.0, ("behaviors", "b", "actions", "far", "push")),
        Setting("push", 0.5, ("environment", "state", "push")),
        Setting("other", 9.0, ("environment", "state", "other")),
    ]
    wrong = found(names(4), FOUR, settings=settings)
    assert [(misfit.code, misfit.path[-2:]) for misfit in wrong] == [
        ("BB118", ("far", "push")),
        ("BB118", ("state", "push")),
    ]
    assert wrong[0].message == "push is 2 here, and the environment takes a whole number from 0 to 1"
