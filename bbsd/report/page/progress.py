"""How a run went, as plain data: curves as means over the runs, with their spread."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from bbsd.report.page.columns import shortened

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from bbsd.report.plain import Plain

    Line = Mapping[str, Any]

FITNESS = {"mean": "mean of the agents", "best": "best agent", "lifetime": "mean lifetime fitness"}


def curves_plain(metrics: Sequence[Line]) -> dict[str, Plain] | None:
    """Return the curves of metrics: of generations the fitness, of a search the best so far; None where there are none.

    Each has its `mean` over the runs that have come so far, and `low` and `high` of them.
    """
    if not metrics:
        return None
    has_generations = all("generation" in line for line in metrics)
    across, keys = ("generation", FITNESS) if has_generations else ("episodes", {"mean": "best so far"})
    runs = [[line for line in metrics if line["run"] == run] for run in dict.fromkeys(_runs(metrics))]
    places = sorted({line[across] for line in metrics})
    curves = {key: [_held(run, across, key, places) for run in runs] for key in keys}
    return {
        "x": places,
        "label": across,
        "of": "fitness" if has_generations else "mean return in new episodes",
        "runs": len(runs),
        "lines": [{"name": keys[key], **_spread(values)} for key, values in curves.items()],
    }


def _runs(metrics: Sequence[Line]) -> list[int]:
    return [line["run"] for line in metrics]


def _held(run: Sequence[Line], across: str, key: str, places: Sequence[int]) -> list[float | None]:
    """Return a run's values at all places: the last one that it had reached, None before its first."""
    reached = {line[across]: float(line[key]) for line in run}
    held, value = [], None
    for place in places:
        value = reached.get(place, value)
        held.append(value)
    return held


def _spread(runs: Sequence[Sequence[float | None]]) -> dict[str, Plain]:
    columns = [[value for value in column if value is not None] for column in zip(*runs, strict=True)]
    return {
        "mean": [shortened(sum(values) / len(values)) for values in columns],
        "low": [shortened(min(values)) for values in columns],
        "high": [shortened(max(values)) for values in columns],
    }
