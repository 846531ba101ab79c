"""What must stand above what, as a graph for Graphviz or Mermaid; arrows point from the upper behavior to the lower."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from bbsd.explanation.worth import Worth


def order_dot(worth: Worth) -> str:
    """Return the partial order of the layers in the language of Graphviz."""
    names = [each.behavior for each in worth.behaviors]
    lines = [f'  "{name}";' for name in names]
    lines += [f'  "{upper}" -> "{lower}";' for upper, lower in worth.precedence.above]
    return "\n".join(["digraph order {", "  node [shape=box];", *lines, "}"])


def order_mermaid(worth: Worth) -> str:
    """Return the partial order of the layers in the language of Mermaid."""
    numbers = {each.behavior: f"b{index}" for index, each in enumerate(worth.behaviors)}
    lines = [f'  {number}["{name}"]' for name, number in numbers.items()]
    lines += [f"  {numbers[upper]} --> {numbers[lower]}" for upper, lower in worth.precedence.above]
    return "\n".join(["flowchart TD", *lines])
