import json
from io import StringIO

import pytest
from rich.console import Console

from bbsd.evaluation import evaluation_keys
from bbsd.report.comparison import comparison_plain, comparison_table
from bbsd.report.plain import json_text
from tests.unit.explanation.comparison.designs import WALK, compared_designs, design_of, edited

OTHER = edited(
    WALK,
    ("rules: [otherwise: right]", "rules: [{when: {odd: true}, do: stay}, {otherwise: right}]"),
    ("[back, go]", "[go, back]"),
)


def compared(a, b, name="b.yaml"):
    return compared_designs(design_of(a, "a.yaml"), design_of(b, name), evaluation_keys(0, 12))


def printed(comparison, width=80):
    console = Console(file=StringIO(), width=width, color_system=None)
    console.print(comparison_table(comparison), crop=False)
    return "\n".join(line.rstrip() for line in console.file.getvalue().splitlines())


@pytest.fixture(scope="module")
def comparison():
    return compared(WALK, OTHER)


def test_a_comparison_shows_what_differs(comparison):
    text = printed(comparison)
    assert text.startswith("A  a.yaml\nB  b.yaml\n")
    assert "of A's robot-steps B would have commanded something else" in text
    assert "left by back; right by go" in text
    assert "go: right becomes stay\n                  where odd" in text
    assert [line.split() for line in text.splitlines() if line.startswith(("back ", "go "))] == [
        ["back", "go"],
        ["go", "back"],
        ["go", "moved."],
    ]
    assert "the order of the layers" in text
    assert max(map(len, text.splitlines())) <= 80


def test_differences_have_a_sign(comparison):
    line = next(line for line in printed(comparison).splitlines() if line.startswith("return"))
    mean = float(line.split()[3])
    assert mean == pytest.approx(comparison.difference.mean, abs=1e-4)
    assert line.split()[3][0] in "+-"


def test_the_same_design_is_said_to_be_the_same():
    text = printed(compared(WALK, WALK))
    assert "Tables and structure are the same." in text
    assert "both command the same" in text
    assert "Where the difference comes from" not in text


def test_a_changed_rule_that_never_mattered_is_said_to_have_no_effect():
    other = edited(
        WALK,
        ("structure:", ("  never: {inputs: {deep: x < -9}, actions: {up: {x: 5}}, "
         "rules: [{when: {deep: true}, do: up}, {otherwise: no action}]}\nstructure:")),
        ("structure: [back, go]", "structure: [never, back, go]"),
        ("rules: [otherwise: right]", "rules: [{when: {odd: true}, do: stay}, {otherwise: right}]"),
    )  # fmt: skip
    text = " ".join(printed(compared(WALK, other)).split())
    assert "Without any effect in these episodes: the order of the layers." in text
    assert "never is in B alone." in text


def test_names_cannot_steer_a_terminal(comparison):
    text = printed(compared(WALK, OTHER, name="b\x1b[31m.yaml"))
    assert "\x1b" not in text
    assert "b\\x1b[31m.yaml" in text


def test_json_has_all_of_it(comparison):
    plain = json.loads(json_text(comparison_plain(comparison)))
    assert plain["return"]["difference"]["mean"] == comparison.difference.mean
    assert plain["reward_terms"].keys() == {"here", "late"}
    keys = {"a", "b", "share_of_a", "share_of_b", "where", "situations_left"}
    assert plain["commands"]["differences"][0].keys() == keys
    assert plain["order"] == {"a": ["back", "go"], "b": ["go", "back"], "moved": ["go"]}
    assert [each["kind"] for each in plain["sources"]] == ["order", "rules"]
    assert plain["sources"][0]["taken_over_into_a"]["mean"] == comparison.sources[0].in_a.mean


def test_json_of_designs_that_cannot_be_compared_has_nulls():
    plain = json.loads(json_text(comparison_plain(compared(WALK, WALK.replace("x", "z")))))
    assert plain["commands"] is None
    assert plain["paired"] is False
    assert plain["notes"]
