from __future__ import annotations

import csv
from io import StringIO

import numpy as np

from bbsd.evaluation import EachEpisode
from bbsd.report.csv_text import csv_text, returns_text


def lines_of(text):
    return list(csv.DictReader(StringIO(text)))


def test_an_episode_has_a_line_for_the_start_and_for_each_step(trace):
    start, _, second, _ = lines = lines_of(csv_text(trace))
    assert [line["step"] for line in lines] == ["0", "1", "2", "3"]
    assert second["height_0"] == "2.5"
    assert second["place_1"] == "lowest"
    assert (second["controlling_0"], second["action_0"]) == ("push_more", "push")
    assert (second["controlling_1"], second["action_1"]) == ("nobody", "")
    assert second["reward_near_goal_1"] == "0.2"
    assert (start["height_0"], start["controlling_0"], start["reward_near_goal_0"]) == ("2.0", "", "")


def test_truths_are_true_and_false(trace):
    assert [line["tilted_0"] for line in lines_of(csv_text(trace))] == ["true", "true", "false", "false"]


def test_each_layer_tells_whether_it_was_excited_its_cell_and_its_wish(trace):
    start, _, second, third = lines_of(csv_text(trace))
    assert second["cell_push_more_1"] == "place=highest"
    assert (second["excited_push_more_1"], second["wish_push_more_1"]) == ("true", "no action")
    assert (third["wish_stop_at_goal_0"], third["wish_push_more_0"]) == ("stop", "push")
    assert "cell_stop_at_goal_0" not in third  # it has no inputs
    assert "wish_idle_0" not in third  # it is in no layer
    assert start["wish_push_more_0"] == ""


def test_a_long_trace_has_a_line_for_each_value_of_each_step(trace):
    wide, long = lines_of(csv_text(trace)), lines_of(csv_text(trace, long=True))
    assert [*long[0]] == ["step", "robot", "name", "value"]
    by_key = {(line["step"], f"{line['name']}_{line['robot']}"): line["value"] for line in long}
    assert len(by_key) == len(long)
    assert by_key == {
        (line["step"], name): value
        for line in wide
        for name, value in line.items()
        if name != "step" and value != ""
    }


def test_each_episode_has_a_line():
    each = EachEpisode(np.array([1.5, 2.0]), {"near": np.array([1.0, 3.0])}, np.array([4.0, 5.0]))
    assert returns_text(each) == "episode,return,reward_near,steps\n0,1.5,1.0,4\n1,2.0,3.0,5\n"


def test_each_episode_tells_its_agent_or_its_probability_where_there_are_several():
    returns, terms, steps = np.arange(4.0), {}, np.full(4, 9.0)
    by_agent = returns_text(EachEpisode(returns, terms, steps, agents=2)).splitlines()
    assert by_agent[0] == "agent,episode,return,steps"
    assert [line[:4] for line in by_agent[1:]] == ["0,0,", "0,1,", "1,0,", "1,1,"]
    by_start = returns_text(EachEpisode(returns, terms, steps, probabilities=np.full(4, 0.25))).splitlines()
    assert by_start[1] == "0,0.25,0.0,9"
