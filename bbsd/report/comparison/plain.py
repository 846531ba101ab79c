"""A comparison as plain data for JSON."""

from __future__ import annotations

from dataclasses import asdict
from typing import TYPE_CHECKING

from bbsd.report.plain import finite_or_none, interval_plain

if TYPE_CHECKING:
    from bbsd.evaluation import Interval
    from bbsd.explanation.comparison import Comparison
    from bbsd.explanation.comparison.results import Commands
    from bbsd.report.plain import Plain


def comparison_plain(comparison: Comparison) -> dict[str, Plain]:
    """Return a comparison; what was not measured is null."""
    return {
        "a": comparison.a,
        "b": comparison.b,
        "episodes": comparison.episodes,
        "paired": comparison.is_paired,
        "return": {
            "a": interval_plain(comparison.return_a),
            "b": interval_plain(comparison.return_b),
            "difference": interval_plain(comparison.difference),
        },
        "reward_terms": {
            term.term: {
                "a": None if term.a is None else finite_or_none(term.a),
                "b": None if term.b is None else finite_or_none(term.b),
                "difference": _interval(term.difference),
            }
            for term in comparison.terms
        },
        "commands": None if comparison.commands is None else _commands(comparison.commands),
        "rules": [asdict(change) for change in comparison.rules],
        "order": asdict(comparison.order),
        "redefined": [asdict(each) for each in comparison.redefined],
        "sources": [
            {
                "kind": source.kind,
                "behavior": source.behavior,
                "before": source.before,
                "after": source.after,
                "where": source.where,
                "taken_over_into_a": _interval(source.in_a),
                "taken_back_in_b": _interval(source.in_b),
            }
            for source in comparison.sources
        ],
        "not_measured": comparison.unmeasured,
        "notes": comparison.notes,
    }


def _interval(value: Interval | None) -> Plain:
    return None if value is None else interval_plain(value)


def _commands(commands: Commands) -> dict[str, Plain]:
    return {
        "share_of_a": commands.share_a,
        "share_of_b": commands.share_b,
        "episodes": commands.episodes,
        "robot_steps_of_a": commands.steps_a,
        "robot_steps_of_b": commands.steps_b,
        "differences": [
            {
                "a": asdict(each.a),
                "b": asdict(each.b),
                "share_of_a": each.share_a,
                "share_of_b": each.share_b,
                "where": each.where,
                "situations_left": each.left,
            }
            for each in commands.differences
        ],
    }
