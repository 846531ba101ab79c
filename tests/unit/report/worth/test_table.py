import json
from io import StringIO

import pytest
from rich.console import Console

from bbsd.evaluation import Interval
from bbsd.explanation.worth import Swap
from bbsd.report.plain import json_text
from bbsd.report.worth import order_dot, order_mermaid, worth_plain, worth_table
from bbsd.report.worth.table import _verdict
from tests.unit.explanation.worth.planted import appraisal_of, planted


@pytest.fixture(scope="module")
def worth():
    return appraisal_of(planted(cost=0)).worth()


@pytest.fixture(scope="module")
def text(worth):
    console = Console(file=StringIO(), width=80, color_system=None)
    console.print(worth_table(worth), crop=False)
    return "\n".join(line.rstrip() for line in console.file.getvalue().splitlines())


def test_what_stands_out_comes_first(worth, text):
    lines = text.splitlines()
    assert lines[:2] == ["return   95 % interval", lines[1]]
    assert lines[2] == "200 episodes of 10 steps; all changes are in the same episodes"
    first = lines.index(worth.findings[0].text)
    assert first == 4
    assert lines[first : first + len(worth.findings)] == [finding.text for finding in worth.findings]


def test_layers_are_shown_from_the_top(text):
    rows = [line.split() for line in text.splitlines()]
    layers = [(row[0], row[1]) for row in rows if len(row) > 2 and row[0] in "123" and row[1] != "order"]
    assert layers == [("3", "guard"), ("2", "grab"), ("1", "work")]


def test_what_is_earned_adds_up(worth, text):
    table = text.split("earned in control")[1].split("\n\n")[0].splitlines()[1:]
    rows = {line.rsplit(maxsplit=4)[0]: [float(word) for word in line.split()[-4:]] for line in table}
    assert [*rows] == ["guard", "grab", "work", "nobody", "in all"]
    for column in range(4):
        assert sum(row[column] for name, row in rows.items() if name != "in all") == pytest.approx(
            rows["in all"][column], abs=1e-3
        )
    assert rows["in all"][3] == pytest.approx(worth.returns.mean, abs=1e-3)


def test_rules_are_shown_but_not_what_leaves_cells_to_others(text):
    table = text.split("rule   ")[1].split("\n\n")[0]
    assert "  take where tempted" in table
    assert "  stay where sure is 3" in table
    assert "no action otherwise" not in table


def test_the_order_is_shown(text):
    assert "what must stand above what\ngrab  above  work\nanywhere: guard" in text
    assert "of 6 orders (all), chosen in other episodes than these" in text


def test_names_with_markup_are_shown_as_they_are():
    text = planted(cost=0).replace("guard", "bold")
    console = Console(file=StringIO(), width=80, color_system=None)
    console.print(worth_table(appraisal_of(text, episodes=2).worth()))
    assert "bold" in console.file.getvalue()


def test_programs_get_all_of_it(worth):
    plain = json.loads(json_text(worth_plain(worth)))
    assert [each["behavior"] for each in plain["behaviors"]] == ["guard", "grab", "work"]
    earned = [*plain["behaviors"], plain["nobody"]]
    assert sum(sum(each["earned"].values()) for each in earned) == pytest.approx(
        plain["return"]["mean"], abs=1e-9
    )
    grab = plain["behaviors"][1]
    assert grab["dropped"]["ci95"] == [worth.behaviors[1].dropped.low, worth.behaviors[1].dropped.high]
    assert grab["rules"][0]["where"] == "tempted"
    assert grab["rules"][1]["dropped"] is None
    assert plain["orders"]["above"] == [["grab", "work"]]
    assert plain["findings"][0] == {
        "kind": worth.findings[0].kind,
        "subjects": list(worth.findings[0].subjects),
        "text": worth.findings[0].text,
    }


def test_the_order_is_drawn(worth):
    assert order_dot(worth) == (
        'digraph order {\n  node [shape=box];\n  "guard";\n  "grab";\n  "work";\n  "grab" -> "work";\n}'
    )
    assert order_mermaid(worth) == 'flowchart TD\n  b0["guard"]\n  b1["grab"]\n  b2["work"]\n  b1 --> b2'


def test_a_single_layer_has_no_order():
    worth = appraisal_of(planted().replace("[guard, grab, work]", "[work]"), episodes=2).worth()
    console = Console(file=StringIO(), width=80, color_system=None)
    console.print(worth_table(worth))
    text = console.file.getvalue()
    assert "orders" not in text
    assert "not in the structure: grab, guard" in text
    assert worth_plain(worth)["orders"]["above"] == []
    assert order_dot(worth) == 'digraph order {\n  node [shape=box];\n  "work";\n}'


def test_a_behavior_that_does_nothing_has_no_rules_to_drop():
    text = planted().replace(
        "do: take\n      - otherwise: no action", "do: no action\n      - otherwise: no action"
    )
    console = Console(file=StringIO(), width=80, color_system=None)
    console.print(worth_table(appraisal_of(text, episodes=2).worth()))
    assert "grab\n  no action" in "\n".join(line.rstrip() for line in console.file.getvalue().splitlines())


@pytest.mark.parametrize(
    ("low", "high", "sd", "verdict"),
    [
        (-3.3, -2.7, 5.0, ""),
        (2.7, 3.3, 5.0, "better"),
        (-0.1, 0.3, 3.3, "no measurable change"),
        (0.1, 0.7, 5.0, "not certain"),
        (-0.7, -0.1, 5.0, "not certain"),
        (0.0, 0.0, 0.0, "never any change"),
    ],
)
def test_an_exchange_has_a_verdict(low, high, sd, verdict):
    change = Interval((low + high) / 2, sd, low, high, 1000)
    assert _verdict(Swap("a", "b", change, None)) == verdict
    assert _verdict(Swap("a", "b", change, True)) == "proven equal by the tables"
