from __future__ import annotations

from bbsd.report.csv_text import csv_text


def test_an_episode_has_a_line_for_each_step(trace):
    header, *lines = [line.split(",") for line in csv_text(trace).splitlines()]
    assert [line[0] for line in lines] == ["1", "2", "3"]
    second = dict(zip(header, lines[1], strict=True))
    assert second["height_0"] == "2.5"
    assert second["place_1"] == "lowest"
    assert (second["controlling_0"], second["action_0"]) == ("push_more", "push")
    assert (second["controlling_1"], second["action_1"]) == ("nobody", "")
    assert second["reward_near_goal_1"] == "0.2"
