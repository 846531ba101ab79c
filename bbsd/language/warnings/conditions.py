"""Conditions that hold never, or always."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.graph import value_of
from bbsd.expression.syntax.mistakes import WHOLE, Mistake
from bbsd.language.meaning.proofs.coverage import covers_everything

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from bbsd.expression.graph import Graph, Node
    from bbsd.language.meaning import Meaning
    from bbsd.language.validation import LocatedMistake
    from bbsd.language.warnings.intervals import Bounds


def vain_conditions(meaning: Meaning, bounds: Bounds) -> Iterator[LocatedMistake]:
    """Yield a warning for each behavior that is never excited, and for an end that never comes or comes at once.

    Where that follows from constants alone, nothing is said: a constant may be a switch.
    """
    graph = meaning.graph.fork()
    for module in meaning.episode.modules:
        behavior = meaning.spec.behaviors[module.name]
        if behavior.excited is not None and _never(module.excited, bounds, graph):
            message, advice = (
                f"{module.name} is never excited: this never holds",
                "mend it, or leave the behavior out",
            )
            yield ("behaviors", module.name, "excited"), Mistake("BB209", message, WHOLE, advice)
    ends, written = meaning.episode.ends, meaning.spec.environment.ends
    if ends is not None and written is not None and meaning.spec.environment.outside is None:
        path = ("environment", "ends")
        if _never([ends], bounds, graph):
            yield (
                path,
                Mistake(
                    "BB209", "this never holds, so no episode ends by it", WHOLE, "mend it, or leave it out"
                ),
            )
        elif _always(ends, graph):
            message = "this always holds, so every episode ends after its first step"
            yield path, Mistake("BB209", message, WHOLE, "mend it, or write steps: 1")


def _never(nodes: Iterable[Node], bounds: Bounds, graph: Graph) -> bool:
    """Return whether conditions provably never hold."""
    return all(
        not bounds.of(node)[1] or _always(graph.apply("not", node), graph)
        for node in {node.number: node for node in nodes}.values()
    )


def _always(node: Node, graph: Graph) -> bool:
    return bool(value_of(node)) if node.literal else covers_everything([node], graph)
