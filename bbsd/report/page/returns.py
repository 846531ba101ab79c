"""What a design earns, as plain data: quantiles, a histogram, reward terms and shares."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bbsd.evaluation.spread import spread_of
from bbsd.report.page.columns import shortened
from bbsd.report.plain import finite_or_none

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bbsd.api.paging import Page
    from bbsd.evaluation import Interval
    from bbsd.report.plain import Plain

BINS = 40


def earns_plain(page: Page) -> dict[str, Plain]:
    """Return what a design earns on average, beside random agents where they are known."""
    measured = page.evaluation
    names = [*page.loaded.spec.behaviors, "nobody"]
    numbers = {name: index for index, name in enumerate(names[:-1])} | {"nobody": -1}
    spread = spread_of(page.returns, numbered=False)
    quantiles = {"median" if each == 50 else f"{each} %": value for each, value in spread.quantiles.items()}
    return {
        **_interval(measured.returns),
        "episodes": measured.episodes,
        "steps": measured.steps,
        "quantiles": [
            [name, shortened(value)]
            for name, value in {"worst": spread.worst, **quantiles, "best": spread.best}.items()
        ],
        "random": None if page.run is None else _interval(page.run.random),
        "terms": [[name, finite_or_none(value)] for name, value in measured.reward_terms.items()],
        "control": [
            [numbers[name], measured.control_share[name]]
            for name in [*(layer.behavior for layer in page.explanation.layers), "nobody"]
        ],
        "expectations": [[name, finite_or_none(share)] for name, share in measured.expectation_share.items()],
    }


def _interval(interval: Interval) -> dict[str, Plain]:
    return {name: finite_or_none(getattr(interval, name)) for name in ("mean", "low", "high")}


def histogram_plain(returns: NDArray[np.float64]) -> dict[str, Plain]:
    """Return the numbers of episodes (n_bins,) between edges (n_bins + 1,)."""
    low, high = float(returns.min()), float(returns.max())
    margin = 0.5 * max(abs(low), 1.0) if low == high else 0.0
    counts, edges = np.histogram(returns, bins=BINS if high > low else 1, range=(low - margin, high + margin))
    return {"counts": counts.tolist(), "edges": [shortened(edge) for edge in edges.tolist()]}
