from __future__ import annotations

from dataclasses import replace
from math import nan

import numpy as np
import pytest
from matplotlib.figure import Figure

from bbsd.evaluation import Scene
from bbsd.language.models import Spec
from bbsd.report.figures import draw_episode
from bbsd.report.figures.marks import _moved, _room, draw_mark, draw_names
from bbsd.report.figures.paths import _angle, draw_ends, stretches_of
from bbsd.report.figures.plane import Limits, draw_surroundings, limits_of
from bbsd.report.figures.scene import _names_in_view, legend_lines


def scene(places=((0, 0), (4, 3)), **changes):
    whole = Scene(np.array([places], float), None, None, np.empty((0, 3)), None, {})
    return replace(whole, **{key: value if value is None or key == "marks" else np.array(value, float)
                             for key, value in changes.items()})  # fmt: skip


@pytest.fixture
def spec():
    behavior = {"actions": {"act": {"x": 0}}}
    return Spec.model_validate(
        {
            "bbsd": 1,
            "name": "walk",
            "environment": {"robots": 2, "steps": 3, "state": {"x": 0, "height": 2}},
            "view": {"at": ["x", "height + 1"], "heading": "height", "marks": {"lamp": [1, "w"]}},
            "behaviors": {"push_more": behavior, "stop_at_goal": behavior},
            "reward": {"near": 1},
        }
    )


@pytest.fixture
def seen(trace):
    """Return the trace with a scene of its two robots."""
    places = np.array([[[0, 0, 0.2], [1, 0, 0.2], [2, 1, 0.2], [2, 1, 0.2]], [[3, 3, 0.2]] * 4], float)
    lamp = np.array([[4, 4, 0.5], [4, 4, 0.5], [4, 4, 0.5], [1, 4, 0.5]])
    return replace(trace, scene=Scene(places, np.zeros((2, 4)), None, np.empty((0, 3)), None, {"lamp": lamp}))


def test_limits_show_what_is_around_with_a_margin():
    assert limits_of(scene(area=[0, 0, 10, 5])) == Limits((-0.3, 10.3), (-0.3, 5.3))
    x, y = limits_of(scene(grid=[[0, 1, 0], [1, 0, 0]], places=((0, 0), (2, 1))))
    assert x == pytest.approx((-0.59, 2.59))
    assert y == pytest.approx((1.59, -0.59))


def test_limits_show_what_went_beyond_and_follow_turned_axes():
    found = limits_of(
        scene(area=[0, 2, 1, 0], places=((-1, 0), (0, nan)), marks={"far": np.array([[9.0, 1, 0.1]])})
    )
    assert found == Limits((-1.3, 9.3), (2.3, -0.3))
    assert found.signs == (1, -1)


def test_limits_without_any_extent_can_be_drawn():
    assert limits_of(scene(places=((1, 1), (1, 1)))).shape == 1
    assert limits_of(scene(places=((nan, nan),))) == Limits((-1, 1), (-1, 1))


def test_stretches_of_a_path_join_each_other():
    points = np.arange(10.0).reshape(5, 2)
    found = stretches_of(points, ["a", "a", "b", "a"])
    assert [(name, part.tolist()) for name, part in found] == [
        ("a", points[:3].tolist()), ("b", points[2:4].tolist()), ("a", points[3:].tolist())
    ]  # fmt: skip


def test_what_stays_not_finite_has_not_moved():
    points = np.array([[nan, 1], [nan, 1], [2, 1], [2, 3], [2, 3]])
    assert _moved(points).tolist() == [False, True, True, False]


def test_a_robot_faces_where_the_axes_take_it():
    turned = Limits((0, 1), (1, 0))
    found = scene(headings=[[0, 0.5]])
    assert _angle(found, 0, Limits((0, 1), (0, 1))) == pytest.approx(0.5)
    assert _angle(found, 0, turned) == pytest.approx(-0.5)
    assert _angle(scene(headings=[[0, nan]]), 0, turned) is None
    assert _angle(scene(), 0, turned) is None


def test_a_label_has_no_room_across_a_border_nor_where_something_is():
    limits, at = Limits((0, 10), (0, 10)), np.array([9.0, 5.0])
    nothing = np.array([[0.0, 0.0]])
    assert _room(at, 9, nothing, limits, (1, 1)) == -1
    assert _room(at, 9, nothing, limits, (-1, 1)) > 5
    assert (
        _room(at, 9, np.array([[8.5, 5.2]]), limits, (-1, 1))
        < 0.5
        < _room(at, 9, at[None], limits, (-1, -1)) + 0.5
    )


def test_what_a_view_shows_by_its_name_alone_needs_no_panel(spec):
    assert _names_in_view(spec.view) == {"x", "height", "w"}
    assert _names_in_view(None) == set()


def test_a_scene_shows_paths_marks_and_control_in_the_same_colors(seen, spec, tmp_path):
    for name in ("first.svg", "second.svg"):
        draw_episode(seen, spec, tmp_path / name)
    text = (tmp_path / "first.svg").read_text()
    assert text == (tmp_path / "second.svg").read_text()
    for words in (
        "from above",
        "in control of each robot",
        "push_more",
        "stop_at_goal",
        "start",
        "end",
        "nobody",
    ):
        assert f"<!-- {words} -->" in text
    assert "<!-- height -->" not in text
    assert text.count("#0072b2") >= 3
    assert "#9a9a9a" in text


def drawn_marks(track):
    """Return the labels, the lines of points, and the circles that a mark is drawn as."""
    panel = Figure().subplots()
    draw_mark(panel, "lamp", np.array(track, float), np.zeros((1, 2)), Limits((0, 10), (0, 10)))
    lines = [line.get_xydata().tolist() for line in panel.lines]
    return [text.get_text() for text in panel.texts], lines, len(panel.patches)


def test_a_mark_that_moves_leaves_a_trail_from_where_it_began():
    track = [[1, 1], [2, 1], [3, 1]]
    assert drawn_marks(track) == (["lamp"], [track, track[:1], track[2:]], 0)


def test_a_mark_that_mostly_rests_is_shown_where_it_was_with_its_radius():
    track = [[1, 1, 2], [1, 1, 2], [1, 1, 2], [3, 1, 2]]
    assert drawn_marks(track) == (["lamp"], [[[1, 1]], [[3, 1]]], 1)


def test_a_mark_that_is_nowhere_at_the_end_has_no_label():
    assert drawn_marks([[1, 1, 1], [1, 1, 1], [nan, 1, 1]]) == ([], [[[1, 1]]], 0)


def test_each_robot_of_a_team_has_its_number_at_its_ends():
    panel, places = Figure().subplots(), np.zeros((2, 3, 2))
    whole = replace(scene(), places=places)
    for robot in (0, 1):
        draw_ends(panel, whole, robot, limits_of(whole))
    assert [text.get_text() for text in panel.texts] == ["0", "0", "1", "1"]
    alone = Figure().subplots()
    draw_ends(alone, replace(whole, places=places[:1]), 0, limits_of(whole))
    assert {text.get_text() for text in alone.texts} == {""}


def test_places_that_are_not_finite_are_left_out(seen, spec, tmp_path):
    places = seen.scene.places.copy()
    places[0, 2:], places[1, :, 2] = nan, nan
    marks = {"gone": np.full((4, 3), nan), "late": np.array([[nan, 1], [nan, 1], [2, 2], [2, 2]])}
    strange = replace(seen.scene, places=places, headings=np.full((2, 4), nan), marks=marks,
                      circles=np.array([[1, 1, nan], [nan, 1, 1]]), area=np.array([0, 0, nan, 1]))  # fmt: skip
    draw_episode(replace(seen, scene=strange), spec, tmp_path / "strange.svg")
    text = (tmp_path / "strange.svg").read_text()
    assert "<!-- from above -->" in text
    assert "nan" not in text.lower()


def test_the_legend_has_a_line_for_every_three_entries_and_fewer_columns_of_long_names():
    assert [legend_lines(["walk"] * count) for count in (1, 2, 4, 5)] == [1, 2, 2, 3]
    assert legend_lines(["a_name_of_thirty_two_characters_"] * 25) == 27


def test_lines_of_a_view_are_drawn_with_their_names(seen, spec, tmp_path):
    paths = {"track": np.array([[0.0, 0], [9, 9]]), "wall": np.array([[nan, 1], [2, 2], [3, 3]])}
    whole = replace(seen.scene, paths=paths)
    assert limits_of(whole).x[1] > 9
    draw_episode(replace(seen, scene=whole), spec, tmp_path / "lines.svg")
    panel = Figure().subplots()
    draw_surroundings(panel, whole)
    assert len(panel.lines) == 2
    draw_names(panel, paths, np.zeros((1, 2)), limits_of(whole))
    assert [(text.get_text(), text.xy) for text in panel.texts] == [("track", (0, 0)), ("wall", (2, 2))]
