"""The size of a design task, in one line."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.language.meaning.size import size_of
from bbsd.report.wording.numbers import count

if TYPE_CHECKING:
    from bbsd.language.meaning import Meaning


def size_text(meaning: Meaning) -> str:
    """Return the numbers of behaviors and of holes: `5 behaviors, 21 open cells, 5 open layers, ...`."""
    modules = meaning.episode.modules
    size = size_of(modules, meaning.structure)
    behaviors = count(len(modules), "behavior")
    if not size.open_cells and not size.open_layers:
        return f"{behaviors}, no holes"
    cells = [count(size.open_cells, "open cell")] * bool(size.open_cells)
    layers = [count(size.open_layers, "open layer")] * bool(size.open_layers)
    return ", ".join([behaviors, *cells, *layers, f"search space 10^{size.decades:.1f}"])
