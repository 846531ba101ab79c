from __future__ import annotations

from dataclasses import replace

import pytest
from matplotlib.figure import Figure

from bbsd.language.models import Spec
from bbsd.report.figures import draw_episode
from bbsd.report.figures.panels import _stretches, behavior_rows, draw_control, failures, panels_of


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


def test_a_state_has_a_line_for_each_robot_and_a_sensor_one_if_all_sense_alike(trace, spec):
    assert panels_of(trace, spec) == {
        "height": {"robot 0": [2.0, 2.5, 3.0], "robot 1": [2.1, 2.1, 2.1]},
        "tilt": {"": [9.0, 4.0, 1.0]},
    }


def test_who_can_be_in_control_is_listed_from_the_highest_layer_down(trace, spec):
    assert behavior_rows(trace, spec) == ["stop_at_goal", "push_more", "nobody"]
    assert behavior_rows(replace(trace, controlling=[["push_more"]]), spec) == ["stop_at_goal", "push_more"]


def test_stretches_of_control_cover_every_step_once():
    controlling = ["a", "a", "b", "a", "nobody"]
    assert _stretches(controlling) == {"a": [(0.5, 2), (3.5, 1)], "b": [(2.5, 1)], "nobody": [(4.5, 1)]}


def test_the_steps_in_which_an_expectation_failed_are_crossed_out(trace):
    found = replace(trace, expectations=[["held", "failed", ""], ["failed", "", "held"]])
    rows = ["stop_at_goal", "push_more", "nobody"]
    first, second = pytest.approx(0.8), pytest.approx(1.2)  # the middles of the robots' bars beside push_more
    assert failures(found, rows) == [(2, first), (1, second)]
    assert failures(trace, rows) == []
    panel = Figure().subplots()
    draw_control(panel, found, rows, ["#000000", "#111111"])
    assert {tuple(line.get_xdata()) for line in panel.lines} == {(2, 1)}
    assert "×" in panel.get_title()


def test_nothing_is_crossed_out_where_all_that_is_expected_holds(trace):
    panel = Figure().subplots()
    draw_control(panel, replace(trace, expectations=[["held"] * 3, ["", "", "held"]]),
                 ["push_more", "stop_at_goal", "nobody"], ["#000000", "#111111"])  # fmt: skip
    assert (len(panel.lines), panel.get_title()) == (0, "in control")


def test_the_same_episode_gives_the_same_bytes(trace, spec, tmp_path):
    for name in ("first.svg", "second.svg"):
        draw_episode(trace, spec, tmp_path / name)
    text = (tmp_path / "first.svg").read_text()
    assert text == (tmp_path / "second.svg").read_text()
    for words in ("height", "tilt", "in control", "stop_at_goal", "robot 1", "step"):
        assert f"<!-- {words} -->" in text


def test_an_episode_of_one_step_can_be_drawn(trace, spec, tmp_path):
    values = {slot: line[:1] for slot, line in trace.values.items()}
    short = replace(trace, steps=trace.steps[:1], values=values, controlling=[["push_more"], ["nobody"]])
    draw_episode(short, spec, tmp_path / "episode.png")
    assert (tmp_path / "episode.png").stat().st_size > 1000


def test_an_episode_without_numbers_to_show_still_shows_who_was_in_control(trace, spec, tmp_path):
    draw_episode(replace(trace, values={}), spec, tmp_path / "episode.svg")
    assert "<!-- in control -->" in (tmp_path / "episode.svg").read_text()
