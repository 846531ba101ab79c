"""The worth of a design's parts as plain data for JSON."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.report.plain import interval_plain

if TYPE_CHECKING:
    from bbsd.evaluation import Interval
    from bbsd.explanation.worth import BehaviorWorth, Worth
    from bbsd.report.plain import Plain


def worth_plain(worth: Worth) -> dict[str, Plain]:
    """Return the worth of all parts; layers go from the highest down, changes are of the return."""
    return {
        "name": worth.name,
        "return": interval_plain(worth.returns),
        "episodes": worth.returns.count,
        "steps": worth.steps,
        "robots": worth.robots,
        "random_tables": worth.random_tables,
        "behaviors": [_behavior(each) for each in worth.behaviors],
        "nobody": {"control": worth.nobody_control, "earned": dict(worth.nobody)},
        "left_out": list(worth.left_out),
        "swaps": [
            {
                "upper": swap.upper,
                "lower": swap.lower,
                "change": interval_plain(swap.change),
                "proven_equal": swap.never,
            }
            for swap in worth.swaps
        ],
        "orders": {
            "tried": worth.precedence.tried,
            "all": worth.precedence.whole,
            "best": [
                {
                    "structure": list(order.structure),
                    "change": interval_plain(order.change),
                    "alike": order.alike,
                }
                for order in worth.orders
            ],
            "above": [list(pair) for pair in worth.precedence.above],
        },
        "robots_alike": [
            {
                "robots": [pair.first, pair.second],
                "same_action": pair.same_action,
                "same_state": pair.same_state,
                "same_place": pair.same_place,
                "episodes": pair.episodes,
            }
            for pair in worth.alike
        ],
        "findings": [
            {"kind": finding.kind, "subjects": list(finding.subjects), "text": finding.text}
            for finding in worth.findings
        ],
    }


def _behavior(worth: BehaviorWorth) -> dict[str, Plain]:
    return {
        "behavior": worth.behavior,
        "layer": worth.layer,
        "control": worth.control,
        "excited": worth.excited,
        "activated": worth.activated,
        "suppressed": worth.suppressed,
        "earned": dict(worth.earned),
        "dropped": interval_plain(worth.dropped),
        "replaced_at_random": interval_plain(worth.random),
        "expectation": worth.expectation,
        "rules": [
            {
                "where": rule.where,
                "decision": rule.decision,
                "control": rule.control,
                "dropped": _change(rule.dropped),
            }
            for rule in worth.rules
        ],
    }


def _change(change: Interval | None) -> Plain:
    return None if change is None else interval_plain(change)
