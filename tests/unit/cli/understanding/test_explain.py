import json
import re

import pytest

from tests.unit.architecture.designs import SPECS
from tests.unit.cli.commands import run

HAND = SPECS / "object_lifting_hand.yaml"


@pytest.mark.parametrize(
    ("form", "part"),
    [
        ("text", "4  slow_down       slower where place is highest and tilted\n"),
        ("table", "highest  yes     slower\n"),
        ("tree", "4  slow_down\n"),
        ("mermaid", 'layer4["4 slow_down<br>slower: place is highest and tilted'),
        ("dot", 'layer4 [label="4 slow_down\\lslower: place is highest and tilted'),
        ("json", '"behavior": "slow_down"'),
    ],
)
def test_every_format_is_printed(form, part, capsys):
    assert run("explain", HAND, "--format", form) == 0
    out, err = capsys.readouterr()
    assert part in out
    assert err == ""


def test_json_has_conditions_for_programs(capsys):
    assert run("explain", HAND, "--format", "json") == 0
    plain = json.loads(capsys.readouterr().out)
    assert plain["layers"][1]["rules"][0]["when"][0] == {
        "input": "place",
        "cells": [1],
        "labels": ["highest"],
    }
    assert plain["rows"][0]["behavior"] == "stop_at_goal"
    assert plain["watched"] is None


def test_visits_are_counted_on_demand(capsys):
    assert run("explain", HAND, "--episodes", 2) == 0
    text = " ".join(capsys.readouterr().out.split())
    assert re.search(r"In 2 episodes, stop_at_goal controlled \d\d\.\d % of the time, ", text)
    assert run("explain", HAND, "--episodes", 2) == 0
    assert " ".join(capsys.readouterr().out.split()) == text


def test_no_episodes_are_a_mistake(capsys):
    assert run("explain", HAND, "--episodes", 0) == 2


def test_the_worth_of_what_seems_useless_is_measured_on_demand(tmp_path, capsys):
    rare = """behaviors:
  rare:
    inputs:
      wild: tilt > 60
    actions: {halt: {speed: 0}}
    rules: [{when: {wild: true}, do: halt}, otherwise: no action]
"""
    text = HAND.read_text(encoding="utf-8").replace("behaviors:\n", rare, 1)
    design = tmp_path / "rare.yaml"
    design.write_text(text.replace("structure: [", "structure: [rare, "), encoding="utf-8")
    assert run("explain", design, "--episodes", 3, "--worth") == 0
    out = capsys.readouterr().out
    assert "  rare: never controlled in 3 episodes; without it the return never changes\n" in out
    assert "explain --worth" not in out
    assert run("explain", design, "--episodes", 3) == 0
    assert "  (bbsd explain --worth measures" in capsys.readouterr().out


@pytest.mark.parametrize("command", [["explain", HAND], ["why", HAND, "--step", 3]])
def test_json_is_the_format_json(command, capsys):
    assert run(*command, "--json") == run(*command, "--format", "json") == 0
    out = capsys.readouterr().out
    assert out[: len(out) // 2] == out[len(out) // 2 :]
    assert json.loads(out[: len(out) // 2])


def test_of_a_spec_with_holes_there_is_nothing_to_explain_yet(capsys):
    assert run("explain", SPECS / "object_lifting.yaml") == 2
    told = capsys.readouterr().err
    assert "there is nothing to explain yet: the spec has holes (push_more: 1 of 1 cell open" in told
    assert "have it designed: bbsd design" in told
