from pathlib import Path

import pytest

from bbsd.compiler import compile_meaning
from bbsd.compiler.details import Detail
from bbsd.compiler.kernels import kernel_source
from bbsd.expression.graph import Node, needed
from bbsd.language.loading import load
from bbsd.language.meaning.episode.picture import Picture
from bbsd.text import Source
from tests.unit.language.specs import codes, meaning_of, messages

SPECS = Path(__file__).parents[5] / "specs"
WORLDS = ("mobile_robot", "pursuit", "forager", "grid_world")
FULL = """
constants: {rocks: [[1, 2, 0.5], [3, 4, 1]], maze: [[1, 0, 1]], rocky: [[1, 2], [3, 4], [5, 6]]}
environment:
  world: {sun: 3}
  definitions: {middle: "mean(height[r] for r in team)", place: "list(robot, height)"}
view:
  at: place
  heading: tilt / 2
  area: [0, 0, robots, 3]
  circles: rocks
  grid: maze
  paths: {lane: rocky, wall: [[0, 0], [sun, 1]]}
  marks: {sun: [sun, 9, 0.5], middle: [1, middle]}
"""


def picture(part: str) -> Picture:
    found = meaning_of(part).episode.picture
    assert found is not None
    return found


def read(*nodes: Node) -> list[object]:
    """The stored values that nodes are computed from."""
    return [node.data for node in needed(nodes) if node.operation == "slot"]


def test_a_spec_without_a_view_has_no_picture() -> None:
    assert meaning_of().episode.picture is None
    assert meaning_of("view: null").episode.picture is None


def test_a_picture_reads_what_is_stored_robot_by_robot() -> None:
    found = picture(FULL)
    assert [read(*place) for place in found.places] == [[("height", robot, ())] for robot in range(3)]
    assert found.headings is not None
    assert [read(heading) for heading in found.headings] == [[("tilt", robot, ())] for robot in range(3)]
    assert read(*found.marks["sun"]) == [("sun", None, ())]
    assert read(*found.marks["middle"]) == [("height", robot, ()) for robot in range(3)]


def test_a_picture_has_the_shapes_of_its_lists() -> None:
    found = picture(FULL)
    assert found.area is not None
    assert found.grid is not None
    assert [len(found.area), *map(len, found.circles), *map(len, found.grid)] == [4, 3, 3, 3]
    assert [len(place) for place in found.marks.values()] == [3, 2]
    assert {name: [*map(len, path)] for name, path in found.paths.items()} == {
        "lane": [2, 2, 2],
        "wall": [2, 2],
    }


@pytest.mark.parametrize("world", WORLDS)
def test_a_view_changes_no_byte_of_a_kernel(world: str) -> None:
    source = Source.read(SPECS / f"{world}.yaml")
    texts = []
    for overrides in (["view=null"], ["view.marks=null", "view.heading=(step + 1) / 7"]):
        problem = compile_meaning(load(source, overrides=overrides).meaning)
        texts.append(kernel_source(problem.meaning, problem.tables, 8, (Detail.CREDIT, Detail.TRACE)))
    assert texts[0] == texts[1]


@pytest.mark.parametrize(
    ("view", "code"),
    [
        ("{at: [robot, tilted]}", "BB055"),
        ("{at: [robot, 'list(1, 2)']}", "BB056"),
        ("{at: [robot, 'uniform(0, 1)']}", "BB058"),
        ("{at: [robot, before(height)]}", "BB065"),
        ("{at: [robot, generation]}", "BB066"),
        ("{at: [robot, hieght]}", "BB052"),
        ("{at: [robot, height], heading: tilted}", "BB055"),
        ("{at: [robot, height], area: [0, 0, height, 1]}", "BB059"),
        ("{at: [robot, height], circles: 3}", "BB049"),
        ("{at: [robot, height], grid: []}", "BB049"),
        ("{at: [robot, height], paths: {track: [[1, 2]]}}", "BB049"),
        ("{at: [robot, height], paths: {track: [[1, 2], [3]]}}", "BB049"),
        ("{at: [robot, height], paths: {track: [[1, 2], [3, hieght]]}}", "BB052"),
        ("{at: [robot, height], grid: [[]]}", "BB049"),
        ("{at: [robot, height], area: [0, 1, 1, 1]}", "BB049"),
        ("{at: 'list(list(height, speed)[floor(tilt)], list(1, 2)[tilt])'}", "BB064"),
    ],
)
def test_a_mistake_is_told_once(view: str, code: str) -> None:
    assert codes(f"view: {view}") == [code]


def test_what_is_unknown_makes_no_second_mistake() -> None:
    assert codes("view: {at: plcae, circles: rokcs, grid: mzae, area: aera}") == ["BB052"] * 4


def test_mistakes_of_a_view_are_told_beside_those_of_behaviors() -> None:
    part = "view: {at: height}\nbehaviors: {stop: {inputs: {reached: heihgt > 3}}}"
    assert codes(part) == ["BB052", "BB049"]


def test_a_message_says_what_is_needed_and_what_is_there() -> None:
    assert messages("view: {at: height}") == ["this must be a place, [x, y] or [x, y, radius], not one value"]
    assert messages("view: {at: [1, 2], grid: [[1, 2], [1]]}") == [
        "this must be a row of 2 numbers, not a list of 1"
    ]
