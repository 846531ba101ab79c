"""How large a task of design a spec is, in one line."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bbsd.compiler import compile_meaning
from bbsd.report.numbers import count
from bbsd.spec.meaning.structure import OPEN_LAYER

if TYPE_CHECKING:
    from bbsd.spec.meaning import Meaning


def size_text(meaning: Meaning) -> str:
    """Return the number of behaviors and what is open: `5 behaviors, 21 open cells, 5 open layers, ...`."""
    problem = compile_meaning(meaning, compiled=False)
    behaviors = count(problem.n_behaviors, "behavior")
    if not problem.has_holes:
        return f"{behaviors}, nothing open"
    cells = sum(table.n_open for table in problem.tables)
    layers = int(np.count_nonzero(problem.layers == OPEN_LAYER))
    is_open = [count(cells, "open cell")] * bool(cells) + [count(layers, "open layer")] * bool(layers)
    return ", ".join([behaviors, *is_open, f"search space 10^{problem.decades:.1f}"])
