"""`bbsd evaluate --fault`."""

import json

import pytest

import bbsd
from tests.end_to_end.commands import bbsd as command

HAND = "specs/grid_world_hand.yaml"
SILENT = "behavior=seek_goal:silent"


@pytest.mark.slow
def test_a_fault_is_beside_the_undisturbed_design():
    code, out, _ = command("evaluate", HAND, "--episodes", 200, "--fault", "all", "--json")
    assert code == 0
    plain = json.loads(out)
    assert plain["return"]["mean"] == bbsd.evaluate(HAND, episodes=200).mean
    assert [each["name"] for each in plain["faults"]] == ["seek_goal", "follow_wall", "round_corner"]
    worth = bbsd.worth(HAND, episodes=200)
    changes = {each.behavior: each.dropped.mean for each in worth.behaviors}
    assert {each["name"]: each["change"]["mean"] for each in plain["faults"]} == changes


@pytest.mark.slow
def test_too_low_a_return_fails():
    code, out, err = command("evaluate", HAND, "--episodes", 200, "--fault", SILENT, "--at-least", 5)
    assert code == 1
    assert SILENT in out
    assert f"bbsd: with {SILENT} the mean return " in err
    assert "is below  5" in err or "is below 5" in err
    assert command("evaluate", HAND, "--episodes", 200, "--fault", SILENT, "--at-least", -50)[0] == 0


def test_mistakes_of_users():
    code, out, err = command("evaluate", HAND, "--fault", "behavior=seek_gaol:silent")
    assert (code, out) == (2, "")
    assert 'did you mean "seek_goal"?' in err
    assert command("evaluate", HAND, "--relearn")[0] == 2
    assert command("evaluate", HAND, "--fault", "all", "--exact")[0] == 2
    assert command("evaluate", HAND, "--fault", "all", "--episodes", 1)[0] == 2
    with pytest.raises(ValueError, match="2 or more"):
        bbsd.faults(HAND, ["all"], episodes=1)
