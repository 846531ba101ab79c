from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from math import inf, nan

import numpy as np
import pytest
from matplotlib.figure import Figure

from bbsd.expression.node_data import Slot
from bbsd.language.models import Spec
from bbsd.report.figures import FigureError, draw_episode, names_to_show
from bbsd.report.figures.choice import MAX_PANELS, Curve, ValuePanel, choice_of
from bbsd.report.figures.control import (
    behavior_rows,
    draw_control_by_behavior,
    draw_control_by_robot,
    failures,
    stretches_of_control,
)
from bbsd.report.figures.files import _apart, color, label_ends
from bbsd.report.figures.layout import title_of
from bbsd.report.figures.panels import draw_values, earned_so_far, is_strip


@pytest.fixture
def spec():
    behavior = {"actions": {"act": {"height": 0}}}
    return Spec.model_validate(
        {
            "bbsd": 1,
            "name": "lifting",
            "environment": {
                "robots": 2,
                "steps": 3,
                "state": {"height": 2},
                "sensors": {
                    "tilt": "height",
                    "tilted": "height > 1",
                    "place": "values(height, 0, 3)",
                    "sonar": "height",
                },
            },
            "behaviors": {"push_more": behavior, "stop_at_goal": behavior, "idle": behavior},
            "structure": ["stop_at_goal", "push_more"],
            "reward": {"near_goal": 1},
        }
    )


def named(choice):
    return {panel.name: [(curve.label, curve.values) for curve in panel.curves] for panel in choice.panels}


def test_a_state_has_a_curve_for_each_robot_and_a_sensor_one_if_all_sense_alike(trace, spec):
    found = choice_of(trace, spec)
    assert named(found) == {
        "height": [("robot 0", (2.0, 2.0, 2.5, 3.0)), ("robot 1", (2.1, 2.1, 2.1, 2.1))],
        "tilt": [("", (9.0, 9.0, 4.0, 1.0))],
    }
    assert [panel.title for panel in found.panels] == ["height", "tilt, the same for all robots"]
    assert (found.reward, found.left_out) == (True, ("tilted", "place", "sonar"))


def test_what_is_shown_can_be_chosen(trace, spec):
    found = choice_of(trace, spec, show=["place", "tilted", "reward"])
    assert named(found) == {
        "place": [("robot 0", (0, 0, 1, 1)), ("robot 1", (1, 1, 0, 0))],
        "tilted": [("", (1, 1, 0, 0))],
    }
    assert [(panel.kind, panel.cells) for panel in found.panels] == [
        ("cell", ("lowest", "highest")),
        ("truth", ()),
    ]
    assert found.left_out == ()
    assert not choice_of(trace, spec, show=["place"]).reward
    with pytest.raises(FigureError, match=r'--show heigt: .* did you mean "height"'):
        choice_of(trace, spec, show=["heigt"])


def test_state_that_happens_to_be_0_or_1_is_shown(trace, spec):
    heights = {Slot("height", robot): [0.0, 1.0, 0.0] for robot in (0, 1)}
    start = {**trace.start, **dict.fromkeys(heights, 1.0)}
    found = choice_of(replace(trace, values={**trace.values, **heights}, start=start), spec)
    assert named(found)["height"] == [("", (1, 0, 1, 0))]


def test_at_most_eight_values_are_shown_and_the_others_are_named(trace, spec):
    names = [f"sense_{index}" for index in range(12)]
    more = {Slot(name, robot): [1, 2, 3] for name in names for robot in (0, 1)}
    many = replace(trace, values={**trace.values, **more}, start={**trace.start, **dict.fromkeys(more, 0)})
    sensing = spec.environment.model_copy(
        update={
            "sensors": {**spec.environment.sensors, **dict.fromkeys(names, spec.environment.state["height"])}
        }
    )
    found = choice_of(many, spec.model_copy(update={"environment": sensing}))
    assert len(found.panels) == MAX_PANELS == 8
    assert len({panel.name for panel in found.panels} | {*found.left_out}) == 5 + 12
    assert {panel.kind for panel in found.panels if panel.name.startswith("sense")} == {"whole"}


def test_what_a_figure_can_show_is_known_before_an_episode(spec):
    assert names_to_show(spec) == ["height", "tilt", "tilted", "place", "sonar", "reward"]


def test_whole_numbers_and_truths_are_steps_and_numbers_are_not(trace, spec):
    styles = {}
    for panel in choice_of(trace, spec, show=["height", "tilted", "place"]).panels:
        axes = Figure().subplots()
        draw_values(axes, panel)
        styles[panel.name] = {line.get_drawstyle() for line in axes.lines}
    assert styles == {"height": {"default"}, "tilted": {"steps-mid"}, "place": {"steps-mid"}}


def test_many_robots_have_a_strip_each_with_a_scale():
    curves = tuple(Curve(f"robot {robot}", (robot, 2.0 * robot)) for robot in range(9))
    panel = ValuePanel("x", "number", curves)
    assert is_strip(panel, in_gray=False)
    assert not is_strip(replace(panel, curves=curves[:8]), in_gray=False)
    assert is_strip(replace(panel, curves=curves[:4]), in_gray=True)
    axes = Figure().subplots()
    draw_values(axes, panel)
    (image,) = axes.images
    assert image.get_array().tolist() == [[robot, 2 * robot] for robot in range(9)]
    assert [label.get_text() for label in axes.get_yticklabels()] == ["0", "2", "4", "6", "8"]
    assert not axes.lines


@pytest.mark.parametrize("n_curves", [2, 9])
def test_values_that_are_not_finite_can_be_drawn(n_curves, trace, spec, tmp_path):
    start = {slot: value for slot, value in trace.start.items() if slot.name != "height"}
    values = {slot: column for slot, column in trace.values.items() if slot.name != "height"}
    for name, kept in (("height", 1.0), ("tilt", inf)):
        for robot in range(n_curves):
            values[Slot(name, robot)] = [nan, inf, kept + robot]
            start[Slot(name, robot)] = -inf
    odd = replace(trace, values=values, start=start)
    draw_episode(odd, spec, tmp_path / "episode.svg", show=["height", "tilt"])
    text = (tmp_path / "episode.svg").read_text()
    assert "<!-- height -->" in text
    assert "tilt" in text
    assert "no finite value -->" in text


def test_what_was_earned_so_far_adds_up_to_the_return(trace):
    found = earned_so_far(trace)
    assert found["near_goal"] == pytest.approx([0, 0.1, 0.3, 0.95])
    assert found["return"] == pytest.approx(found["near_goal"])
    terms = {f"term_{index}": [np.full(3, float(index)), np.full(3, 0.0)] for index in range(9)}
    found = earned_so_far(replace(trace, rewards=terms))
    assert [*found] == [*(f"term_{index}" for index in range(4, 9)), "4 other terms", "return"]
    assert found["4 other terms"][-1] == pytest.approx(3 * (0 + 1 + 2 + 3) / 2)
    assert found["return"][-1] == pytest.approx(3 * 36 / 2)


def test_who_can_be_in_control_is_listed_from_the_highest_layer_down(trace):
    assert behavior_rows(trace) == ["stop_at_goal", "push_more", "nobody"]
    assert behavior_rows(replace(trace, controlling=[["push_more"]])) == ["stop_at_goal", "push_more"]


def test_stretches_of_control_cover_every_step_once():
    controlling = ["a", "a", "b", "a", "nobody"]
    assert stretches_of_control(controlling) == {
        "a": [(0.5, 2), (3.5, 1)],
        "b": [(2.5, 1)],
        "nobody": [(4.5, 1)],
    }


def test_the_steps_in_which_an_expectation_failed_are_crossed_out(trace):
    found = replace(trace, expectations=[["held", "failed", ""], ["failed", "", "held"]])
    rows = ["stop_at_goal", "push_more", "nobody"]
    assert failures(found) == [(2, "push_more", 0), (1, "push_more", 1)]
    assert failures(trace) == []
    panel = Figure().subplots()
    draw_control_by_behavior(panel, found, rows, ["#000000", "#111111"])
    assert {tuple(line.get_xdata()) for line in panel.lines} == {(2, 1)}
    for line in panel.lines:
        assert line.get_ydata() == pytest.approx(
            [0.8, 1.2]
        )  # the middles of the robots' bars beside push_more
    assert "×" in panel.get_title()


def test_a_row_for_each_robot_says_whose_band_it_is(trace):
    found = replace(trace, expectations=[["held", "failed", ""], ["failed", "", "held"]])
    panel = Figure().subplots()
    colors = {"push_more": "#000001", "stop_at_goal": "#000002", "nobody": "#000003"}
    draw_control_by_robot(panel, found, colors)
    assert [label.get_text() for label in panel.get_yticklabels()] == ["0", "1"]
    assert panel.get_ylabel() == "robot"
    assert {tuple(line.get_ydata()) for line in panel.lines} == {(0, 1)}
    bars = [path.vertices.min(axis=0).tolist() for bars in panel.collections for path in bars.get_paths()]
    expected = [[0.5, -0.42], [0.5, 0.58], [1.5, 0.58], [2.5, -0.42], [2.5, 0.58]]
    assert np.array(sorted(bars)) == pytest.approx(np.array(expected))


def test_nothing_is_crossed_out_where_all_that_is_expected_holds(trace):
    panel = Figure().subplots()
    draw_control_by_behavior(panel, replace(trace, expectations=[["held"] * 3, ["", "", "held"]]),
                             ["push_more", "stop_at_goal", "nobody"], ["#000000", "#111111"])  # fmt: skip
    assert (len(panel.lines), panel.get_title()) == (0, "in control")


def test_labels_of_lines_do_not_lie_over_one_another():
    places = _apart([(0.5, "a"), (0.5, "b"), (0.52, "c"), (0.95, "d"), (1.0, "e")], 0.1)
    assert [name for _, name in places] == ["a", "b", "c", "d", "e"]
    assert all(after - before > 0.0999 for (before, _), (after, _) in pairwise(places))
    assert places[-1][0] <= 1
    assert places[1][0] == pytest.approx(0.5066667)
    assert _apart([], 0.1) == []


def test_lines_that_end_together_have_one_label():
    panel = Figure().subplots()
    panel.set_ylim(0, 1)
    label_ends(panel, [("one", 0.0), ("other", 0.001), ("high", 0.9), ("unknown", float("nan"))], 2.0)
    assert [text.get_text() for text in panel.texts] == ["one, other", "high"]


def test_colors_of_many_behaviors_differ():
    assert len({color(index) for index in range(24)}) == 24


@pytest.mark.parametrize("episode", [None, 7])
def test_a_title_names_the_spec_the_episode_and_its_return(trace, spec, episode):
    number = "" if episode is None else ", episode 7"
    assert title_of(trace, spec, episode) == f"lifting{number}: return 0.9500 in 3 steps"


def test_a_name_is_no_formula_and_cannot_hide_anything(trace, spec, tmp_path):
    odd = spec.model_copy(update={"name": "cost $\\wrong{$ \x1b[31m 作"})
    draw_episode(trace, odd, tmp_path / "episode.svg")
    assert "\x1b" not in (tmp_path / "episode.svg").read_text()


def test_what_is_left_out_is_named_in_the_figure(trace, spec, tmp_path):
    draw_episode(trace, spec, tmp_path / "episode.svg", episode=7)
    text = (tmp_path / "episode.svg").read_text()
    assert "Not shown: tilted, place, sonar (choose with" in text
    assert "<!-- lifting, episode 7: return 0.9500 in 3 steps -->" in text
    draw_episode(trace, spec, tmp_path / "episode.svg", show=["place"])
    assert "Not shown" not in (tmp_path / "episode.svg").read_text()


def test_the_same_episode_gives_the_same_bytes(trace, spec, tmp_path):
    for name in ("first.svg", "second.svg"):
        draw_episode(trace, spec, tmp_path / name)
    text = (tmp_path / "first.svg").read_text()
    assert text == (tmp_path / "second.svg").read_text()
    for words in ("height", "tilt, the same for all robots", "in control", "stop_at_goal", "robot 1", "step"):
        assert f"<!-- {words} -->" in text


def test_an_episode_of_one_step_can_be_drawn(trace, spec, tmp_path):
    values = {slot: line[:1] for slot, line in trace.values.items()}
    short = replace(trace, steps=trace.steps[:1], values=values, controlling=[["push_more"], ["nobody"]],
                    rewards={"near_goal": [np.array([0.1])] * 2})  # fmt: skip
    draw_episode(short, spec, tmp_path / "episode.png")
    assert (tmp_path / "episode.png").stat().st_size > 1000


def test_an_episode_without_numbers_to_show_still_shows_who_was_in_control(trace, spec, tmp_path):
    draw_episode(replace(trace, values={}), spec, tmp_path / "episode.svg")
    assert "<!-- in control -->" in (tmp_path / "episode.svg").read_text()
