import pytest

from bbsd.architecture import architecture_of
from bbsd.exports.exported import Options, exported_design
from bbsd.exports.sensing.header import sensing_of, write
from bbsd.exports.verification.compilers import STRICT
from bbsd.exports.verification.following import FLAGS, follow
from tests.unit.architecture.designs import meaning_of, small
from tests.unit.exports.designs import SHIPPED, tool
from tests.unit.exports.sensing.robots import robots, shipped

SANITIZED = (*STRICT, "-O1", "-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=all")
CPP = ("-x", "c++", "-std=c++11", "-Wall", "-Wextra", "-Werror", "-O1")
LONG = {"tasks/aggregation_hand": ["environment.steps=15"]}
"""Changes of specs whose episodes take long in plain Python."""
HOLED = ("abstract", "tasks/taxi", "tasks/lake", "tasks/four_rooms", "tasks/cliff_walking", "object_lifting")


def followed(exported, episodes, flags=SANITIZED, change=lambda text: text, **options):
    options = Options(sensing=True, **options)
    ((name, text),) = write(exported, options).items()
    tool("gcc")
    return follow(exported, options, {name: change(text)}, episodes, flags=flags)


def assert_equal(found):
    assert not found.failure
    assert found.is_equal, found.first_difference


@pytest.mark.slow
@pytest.mark.parametrize("name", SHIPPED)
def test_shipped_designs_do_the_same_in_three_episodes(name):
    found = followed(shipped(name, *LONG.get(name, ())), 3)
    assert_equal(found)
    assert (found.episodes, found.steps > 30, found.situations > 500) == (3, True, True)


@pytest.mark.slow
@pytest.mark.parametrize("name", HOLED)
def test_drawn_designs_of_shipped_specs_do_the_same(name):
    assert_equal(followed(shipped(name), 3))


@pytest.mark.parametrize("count", [1, 3])
@pytest.mark.parametrize("seed", range(2))
def test_memory_draws_lists_and_robots_that_differ_are_the_same(count, seed):
    assert_equal(followed(robots(count, seed), 2))


@pytest.mark.parametrize("flags", [FLAGS, CPP], ids=["optimized", "as C++"])
def test_it_is_the_same_however_it_is_compiled(flags):
    assert_equal(followed(robots(3), 1, flags))


def test_what_is_measured_or_remembered_is_the_same():
    options = {
        "measured": ("charge", "light", "shape", "field", "rising", "signal"),
        "remembered": ("clock",),
    }
    assert_equal(followed(robots(2), 2, **options))


def replaced(old, new):
    def change(text):
        assert old in text
        return text.replace(old, new)

    return change


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("small_tilt = 5.0", "small_tilt = 5.0000000001"),
        ("height[robot] >= goal", "height[robot] > goal"),
        ("1.7320508075688772", "1.7320508075688"),
        ("memory->speed = outputs->speed", "memory->speed = 0.0"),
        ("memory->speed = 0.0", "memory->speed = 1.0"),
        ("top_speed = 5.0", "top_speed = 4.0"),
        ("x < (double)last ? (int)x : last", "x < (double)last ? (int)x : last - 1"),
        ("return x * 57.29577951308232;", "return x * 57.2957795130823;"),
    ],
)
def test_what_is_not_the_design_is_found(old, new):
    found = followed(shipped("object_lifting_hand"), 3, FLAGS, replaced(old, new))
    assert not found.failure
    assert not found.is_equal
    assert "the design has" in found.first_difference


def test_a_header_that_does_not_compile_is_told():
    found = followed(shipped("object_lifting_hand"), 1, FLAGS, replaced("const bool reached", "const bool"))
    assert "gcc failed" in found.failure
    assert not found.is_equal


def test_robots_that_differ_only_in_how_they_start_are_told_apart_at_the_start_alone():
    meaning = meaning_of(
        small(
            "  go: {inputs: {far: x > 2}, actions: {go: {x: x + 1}}, rules: [{when: {far: false}, do: go}, "
            "{otherwise: no action}]}\nstructure: [go]\n",
            robots=3,
        ).replace("{x: 0}", "{x: robot}")
    )
    exported = exported_design(meaning, architecture_of(meaning))
    found = sensing_of(exported, Options(sensing=True))
    assert [member.identifier for member in found.members["memory"]] == ["x"]
    assert_equal(followed(exported, 2))
