"""`bbsd worth`."""

import json

import pytest

import bbsd
from tests.end_to_end.commands import bbsd as command
from tests.unit.explanation.worth.planted import planted

HAND = "specs/object_lifting_hand.yaml"


@pytest.fixture(scope="module")
def printed():
    code, out, _ = command("worth", HAND, "--episodes", 100)
    assert code == 0
    return out


@pytest.mark.slow
def test_the_hand_made_lifting_controller(printed):
    assert "hurry_up can be removed: the return never changes" in printed
    assert "what must stand above what\nstop_at_goal  above  slow_down, " in printed
    assert "anywhere: hurry_up" in printed


@pytest.mark.slow
def test_the_same_seed_gives_the_same_bytes(printed):
    assert command("worth", HAND, "--episodes", 100, "--jobs", 2, "--lanes", 16)[1] == printed
    assert command("worth", HAND, "--episodes", 100, "--seed", 1)[1] != printed


@pytest.mark.slow
def test_the_return_is_that_of_an_evaluation():
    code, out, _ = command("worth", HAND, "--episodes", 100, "--format", "json")
    assert code == 0
    plain = json.loads(out)
    assert plain["return"]["mean"] == bbsd.evaluate(HAND, episodes=100).mean
    earned = [*plain["behaviors"], plain["nobody"]]
    assert sum(sum(each["earned"].values()) for each in earned) == pytest.approx(
        plain["return"]["mean"], abs=1e-9
    )


@pytest.mark.slow
def test_what_was_planted_is_found(tmp_path):
    path = tmp_path / "planted.yaml"
    path.write_text(planted(robots=2, mood="0"))
    code, out, _ = command("worth", path)
    text = " ".join(out.split())
    assert code == 0
    assert "grab is selfish: it earns 3 in each step that it controls" in text
    assert "guard never controls: it can be removed" in text
    assert "work: the rule stay where sure is 3 is never used, it can be removed" in text
    assert "robots 0 and 1 did the same in 100.0 % of the steps" in text


def test_mistakes_of_users():
    assert command("worth", HAND, "--episodes", 1)[0] == 2
    code, out, err = command("worth", "specs/object_lifting.yaml")
    assert (code, out) == (2, "")
    assert "the design has holes" in err
    with pytest.raises(ValueError, match="2 or more"):
        bbsd.worth(HAND, episodes=1)
