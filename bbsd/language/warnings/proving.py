"""Proofs that conditions always or never hold, as many as there is time for."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.graph import needed, value_of
from bbsd.expression.operations import COMPARISONS
from bbsd.language.meaning.proofs.coverage import covers_everything
from bbsd.language.warnings.bounds import Bounds

if TYPE_CHECKING:
    from bbsd.expression.graph import Node
    from bbsd.language.meaning import Meaning

MOST_PROOFS = 300
"""Proofs by cases that are tried for one spec; what is not proven is not told."""
MOST_EVALUATIONS = 3_000
MOST_COMPARISONS = 40
"""Comparisons in the conditions of one proof."""


class Prover:
    """Proves by the bounds of values, and by the cases of comparisons, whatever state, sensors and constants are.

    What would follow from constants alone is not proven, since a constant may be a switch.
    """

    def __init__(self, meaning: Meaning) -> None:
        self.bounds = Bounds(meaning)
        self._graph = meaning.graph.fork()
        self._left = MOST_PROOFS

    def always(self, condition: Node) -> bool:
        """Return whether a condition provably always holds."""
        return bool(self.bounds.of(condition)[0]) or self.one_holds([condition])

    def never(self, condition: Node, others: tuple[Node, ...] = ()) -> bool:
        """Return whether a condition provably holds only where one of the others does, if any."""
        return not self.bounds.of(condition)[1] or self.one_holds(
            [*others, self._graph.apply("not", condition)]
        )

    def one_holds(self, conditions: list[Node]) -> bool:
        """Return whether provably one of some conditions holds in every case."""
        if len(conditions) == 1 and conditions[0].literal:
            return bool(value_of(conditions[0]))
        self._left -= 1
        if (
            self._left < 0
            or sum(each.operation in COMPARISONS for each in needed(conditions)) > MOST_COMPARISONS
        ):
            return False
        return covers_everything(conditions, self._graph, most_evaluations=MOST_EVALUATIONS)
