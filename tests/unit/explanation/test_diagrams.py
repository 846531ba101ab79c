import re
from dataclasses import replace

import pytest

from bbsd.explanation import dot_text, mermaid_text
from tests.unit.explanation.test_layers import UPPER_NEAR, explained

EXPLANATION = explained(UPPER_NEAR, [[0, 0, 2, 0, 1, 1], [0, 1]], [0, 1])
NASTY = 'a "b" <script>; }\\n--> ]#\x1b'


def nasty():
    """The same with names that mean something to Mermaid, HTML and Graphviz."""
    layers = [
        replace(
            layer,
            behavior=NASTY,
            excited=NASTY,
            inputs=tuple(replace(each, name=NASTY) for each in layer.inputs),
            rules=tuple(replace(rule, decision=NASTY, where=NASTY) for rule in layer.rules),
        )
        for layer in EXPLANATION.layers
    ]
    return replace(EXPLANATION, name=NASTY, layers=tuple(layers))


def test_every_layer_is_in_the_diagram_with_its_rules():
    text = mermaid_text(EXPLANATION)
    assert text.startswith("flowchart TB\n")
    assert '  layer2["2 upper<br>a: near<br>no action: otherwise"]\n' in text
    assert '  layer2 -.->|"no action"| layer1\n' in text
    assert '  sensors -->|"near, pace"| layer1\n' in text
    dot = dot_text(EXPLANATION)
    assert '  layer2 [label="2 upper\\la: near\\lno action: otherwise\\l"];\n' in dot
    assert '  layer2 -> layer1 [label="no action", style=dashed];\n' in dot


def test_names_cannot_end_a_text_of_mermaid():
    for line in mermaid_text(nasty()).splitlines()[1:]:
        texts = re.findall(r'"([^"]*)"', line)
        assert line.count('"') == 2 * len(texts)
        for text in texts:
            assert not re.search(r"[<>\"\\\x1b]|#(?!\d+;)", text.replace("<br>", ""))


def test_names_cannot_end_a_text_of_graphviz():
    string = r'"(?:[^"\\]|\\.)*"'
    for line in dot_text(nasty()).splitlines():
        outside = re.sub(string, "", line)
        assert '"' not in outside
        assert re.fullmatch(r"[\w\s\[\]=,;{}>-]*", outside)


@pytest.mark.parametrize("form", [mermaid_text, dot_text])
def test_many_rules_are_cut(form):
    upper = EXPLANATION.layers[0]
    many = replace(EXPLANATION, layers=(replace(upper, rules=upper.rules[:1] * 20),))
    assert "and 12 more rules" in form(many)
