"""Why runs ended before their budget was spent, in words."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Sequence

REASONS = {
    "return": "the best so far earns enough (design.stop.return)",
    "unimproved": "nothing got better for long enough (design.stop.unimproved)",
    "time": "the time was over; --more goes on",
}


def ending_lines(ended: Sequence[dict[str, Any]], n_runs: int) -> list[str]:
    """Return a sentence for each run that ended early, as `run.json` holds it; what is of another form is left out."""
    return [_sentence(each, n_runs) for each in ended if _is_ending(each)]


def _sentence(ending: dict[str, Any], n_runs: int) -> str:
    which = f"run {ending['run']} " if n_runs > 1 else ""
    reason = REASONS[ending["ended_by"]]
    if ending["unit"] == "generations":
        reason = reason.removesuffix("; --more goes on")
    return f"{which}ended early, after {ending['done']:,} of {ending['of']:,} {ending['unit']}: {reason}"


def _is_ending(value: object) -> bool:
    return (
        isinstance(value, dict)
        and value.get("ended_by") in REASONS
        and value.get("unit") in ("episodes", "generations")
        and all(type(value.get(key)) is int for key in ("run", "done", "of"))
    )
