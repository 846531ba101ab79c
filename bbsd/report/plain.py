"""Results as plain data for JSON; infinities and NaN, which JSON does not have, are null."""

from __future__ import annotations

import json
from math import isfinite
from typing import TYPE_CHECKING, TypeAlias

from bbsd.errors import inert_json
from bbsd.report.wording.warnings import disagreement, warnings_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from bbsd.api import Designed
    from bbsd.evaluation import Evaluation, Interval, Spread
    from bbsd.runs.rivals import Rival

Plain: TypeAlias = "Mapping[str, Plain] | Sequence[Plain] | str | int | float | bool | None"


def json_text(plain: Plain) -> str:
    """Return plain data as JSON of several lines, without a line break at the end."""
    return inert_json(json.dumps(plain, indent=2, allow_nan=False, ensure_ascii=False))


def evaluation_plain(evaluation: Evaluation) -> dict[str, Plain]:
    """Return the results of an evaluation; `expectation_share` and `not_finite` only if there are any."""
    plain: dict[str, Plain] = {
        "return": interval_plain(evaluation.returns),
        "episodes": evaluation.episodes,
        "agents": evaluation.agents,
        "exact": evaluation.exact,
        "steps": finite_or_none(evaluation.steps),
        "reward_terms": {name: finite_or_none(value) for name, value in evaluation.reward_terms.items()},
        "control_share": {name: finite_or_none(value) for name, value in evaluation.control_share.items()},
    }
    if evaluation.optimum is not None:
        optimum = evaluation.optimum
        plain["optimum"] = {"best": finite_or_none(optimum.best), "fixed": finite_or_none(optimum.fixed)}
    if evaluation.spread is not None:
        plain["spread"] = spread_plain(evaluation.spread)
    if evaluation.expectation_share:
        shares = evaluation.expectation_share
        plain["expectation_share"] = {name: finite_or_none(value) for name, value in shares.items()}
    if evaluation.not_finite:
        plain["not_finite"] = dict(evaluation.not_finite)
    return plain


def design_plain(designed: Designed, seed: int, runs: int) -> dict[str, Plain]:
    """Return the result of a design, with its seed and number of runs; runs and rivals only if there are several."""
    plain: dict[str, Plain] = {
        "architecture": None if designed.written is None else str(designed.architecture),
        "return": interval_plain(designed.evaluation.returns),
        "episodes": designed.evaluation.episodes,
        "lifetime": None if designed.lifetime is None else interval_plain(designed.lifetime),
        "random": interval_plain(designed.random),
        "method": designed.method,
        "structure": list(designed.structure),
        "seconds": finite_or_none(designed.seconds),
        "compile_seconds": finite_or_none(designed.compile_seconds),
        "seed": seed,
        "runs": runs,
        "search_episodes": designed.spent,
    }
    if designed.ended:
        plain["ended"] = [each.plain() for each in designed.ended]
    if designed.joint is not None:
        plain["joint_policy"] = interval_plain(designed.joint)
    if designed.each:
        plain["each_run"] = [
            {"return": interval_plain(returns), "structure": list(structure)}
            for returns, structure in designed.each
        ]
    if len(designed.rivals) == 1:
        plain["rival"] = rival_plain(designed.rivals[0])
    elif designed.rivals:
        plain["rivals"] = [rival_plain(rival) for rival in designed.rivals]
    if warnings := warnings_of(designed):
        plain["warnings"] = warnings
    return plain


def disagreement_plain(designs: Iterable[Designed]) -> dict[str, Plain]:
    """Return a warning where designs of several seeds disagree, else nothing."""
    warning = disagreement([designed.evaluation.returns for designed in designs])
    return {"warnings": [warning]} if warning else {}


def rival_plain(rival: Rival) -> dict[str, Plain]:
    """Return what another method achieved."""
    return {
        "method": rival.method,
        "return": None if rival.returns is None else finite_or_none(rival.returns.mean),
        "ci95": None if rival.returns is None else interval_plain(rival.returns)["ci95"],
        "episodes": rival.episodes,
        "structure": list(rival.structure),
        **({"reason": rival.reason} if rival.reason else {}),
        **({} if rival.joint is None else {"joint_policy": interval_plain(rival.joint)}),
    }


def interval_plain(interval: Interval) -> dict[str, Plain]:
    """Return a mean with its standard deviation and its 95 % interval."""
    return {
        "mean": finite_or_none(interval.mean),
        "sd": finite_or_none(interval.sd),
        "ci95": [finite_or_none(interval.low), finite_or_none(interval.high)],
    }


def spread_plain(spread: Spread) -> dict[str, Plain]:
    """Return how the returns of single episodes are spread, and the numbers of the episodes if they have any."""
    return {
        "worst": finite_or_none(spread.worst),
        "best": finite_or_none(spread.best),
        "quantiles": {str(percent): finite_or_none(value) for percent, value in spread.quantiles.items()},
        "episodes": {str(rank): number for rank, number in spread.episodes.items()},
    }


def finite_or_none(value: float) -> float | None:
    """Return the value, or None if it is infinite or NaN."""
    return value if isfinite(value) else None
