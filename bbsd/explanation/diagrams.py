"""The architecture as a diagram, for Mermaid or Graphviz: its layers, what they perceive, and who suppresses whom."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.errors import escape
from bbsd.language.models import NO_ACTION_TEXT

if TYPE_CHECKING:
    from bbsd.explanation.words import Explanation, LayerInWords

MOST_RULES = 8
"""Rules of a behavior that a diagram shows."""
PLAIN = frozenset(" _-.,:()=+/%*!?")
"""Characters that Mermaid takes as they are in a text, besides letters and digits."""


def mermaid_text(explanation: Explanation) -> str:
    """Return the architecture in the language of Mermaid; it ends with a line break."""
    lines = ["flowchart TB", f'  sensors(["{_mermaid("inputs")}"])', '  commands(["commands"])']
    layers = explanation.layers
    for index, layer in enumerate(layers):
        text = "<br>".join(_mermaid(line) for line in _layer_texts(layer))
        lines.append(f'  layer{layer.layer}["{text}"]')
        if layer.inputs:
            inputs = _mermaid(", ".join(each.name for each in layer.inputs))
            lines.append(f'  sensors -->|"{inputs}"| layer{layer.layer}')
        lines.append(f'  layer{layer.layer} -->|"{_mermaid(_actions(layer))}"| commands')
        if index + 1 < len(layers):
            lines.append(f'  layer{layer.layer} -.->|"no action"| layer{layers[index + 1].layer}')
    return "\n".join(lines) + "\n"


def _mermaid(text: str) -> str:
    """Return a text in which every character that Mermaid or HTML could understand is its number."""
    return "".join(
        character if character.isalnum() or character in PLAIN else f"#{ord(character)};"
        for character in escape(text)
    )


def dot_text(explanation: Explanation) -> str:
    """Return the architecture in the language of Graphviz; it ends with a line break."""
    lines = [
        f"digraph {_quoted(explanation.name)} {{",
        "  rankdir=TB;",
        "  node [shape=box];",
        '  sensors [label="inputs", shape=ellipse];',
        '  commands [label="commands", shape=ellipse];',
    ]
    layers = explanation.layers
    for index, layer in enumerate(layers):
        label = "".join(f"{_dot(line)}\\l" for line in _layer_texts(layer))
        lines.append(f'  layer{layer.layer} [label="{label}"];')
        if layer.inputs:
            inputs = _quoted(", ".join(each.name for each in layer.inputs))
            lines.append(f"  sensors -> layer{layer.layer} [label={inputs}];")
        lines.append(f"  layer{layer.layer} -> commands [label={_quoted(_actions(layer))}];")
        if index + 1 < len(layers):
            below = f"layer{layers[index + 1].layer}"
            lines.append(f'  layer{layer.layer} -> {below} [label="no action", style=dashed];')
    return "\n".join([*lines, "}"]) + "\n"


def _quoted(text: str) -> str:
    return f'"{_dot(text)}"'


def _dot(text: str) -> str:
    """Return a text as it stands in a quoted string of Graphviz, where a backslash begins an escape."""
    return escape(text).replace("\\", "\\\\").replace('"', '\\"')


def _layer_texts(layer: LayerInWords) -> list[str]:
    """Return the lines of a layer's box: its name, when it is excited, and its rules."""
    head = [f"{layer.layer} {layer.behavior}"]
    excited = [] if layer.excited is None else [f"when {layer.excited}"]
    if layer.counted:
        return [*head, *excited, f"a table of {sum(each.cells for each in layer.counted):,} cells"]
    rules = [f"{rule.decision}: {rule.where or 'otherwise'}" for rule in layer.rules]
    n_more = len(rules) - MOST_RULES
    shown = [*rules[:MOST_RULES], f"and {n_more} more rules"] if n_more > 1 else rules
    return [*head, *excited, *shown]


def _actions(layer: LayerInWords) -> str:
    """Return the actions that a behavior's rules name, in their order."""
    decisions = [rule.decision for rule in layer.rules] + [cells.decision for cells in layer.counted]
    actions = [decision for decision in dict.fromkeys(decisions) if decision != NO_ACTION_TEXT]
    return ", ".join(actions) or "never an action"
