"""`bbsd why` as a shell sees it."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

from tests.end_to_end.commands import bbsd

SPECS = Path(__file__).parents[2] / "specs"
LIFTING = SPECS / "object_lifting_hand.yaml"
AT = ("--at", "height=[3.1, 2.9, 3]", "--at", "speed=2")


def test_why_answers_for_a_step_of_an_episode():
    code, out, err = bbsd("why", LIFTING, "--episode", 3, "--step", 57, "--robot", 2)
    assert (code, err) == (0, "")
    assert out.startswith("object-lifting-by-hand: episode 3, step 57, robot 2\n")


def test_why_answers_for_a_situation_and_what_would_have_changed_it():
    code, out, err = bbsd(
        "why", LIFTING, *AT, "--not", "stop_at_goal", "--why-not", "hurry_up", "--format", "json"
    )
    assert (code, err) == (0, "")
    answer = json.loads(out)
    assert [each["name"] for each in answer["otherwise"]] == ["stop_at_goal", "hurry_up"]
    assert answer["values"] == {"height": 3.1, "speed": 2.0}


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ((), "a step of an episode or a situation is needed"),
        (("--step", 1, *AT), "both are given"),
        (("--step", 301), "there is no step 301: the episode has steps 1 to 300"),
        (("--step", 1, "--robot", 3), "there is no robot 3: robots are counted from 0 to 2"),
        (("--step", 1, "--episode", "bad"), "'bad' is neither a number from 0 nor worst, median or best"),
        (("--step", 1, "--not", "dance"), "there is no action or behavior dance"),
        ((*AT, "--not", "slow_down"), "slow_down did not control: stop_at_goal.stop did"),
        (("--at", "height=2"), "what decides is not all given: speed"),
        (("--at", "height"), "'height' is no NAME=VALUE"),
        (("--at", "height=[1, 2"), "--at:1:8: error"),
        (("--at", "height={a: 1}"), "gives no value"),
        (("--at", "height=\x1b[31m"), r"\x1b[31m"),
    ],
)
def test_why_says_what_is_wrong_with_a_question(words, message):
    code, out, err = bbsd("why", LIFTING, *words)
    assert (code, out) == (2, "")
    assert message in err
    assert "Traceback" not in err


def test_why_needs_no_compiler():
    command = [sys.executable, "-X", "importtime", "-m", "bbsd", "why", str(LIFTING), "--step", "57"]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    imported = {line.rpartition("|")[2].strip().partition(".")[0] for line in done.stderr.splitlines()}
    assert "bbsd" in imported
    assert not imported & {"numba", "rich", "matplotlib", "llvmlite"}
