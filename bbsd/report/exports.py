"""What came of verifying an export, in sentences."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.errors import escape

if TYPE_CHECKING:
    from bbsd.api.exporting import Export
    from bbsd.exports.verification.comparing import Verified
    from bbsd.exports.verification.following import Followed

LONGEST = 9
"""Digits of a number that is written out."""


def verified_lines(export: Export) -> list[str]:
    """Return a line for each tool that ran an export, and one for a cell in which it differs."""
    if not export.verified:
        return [f"nothing here runs {export.target}: not verified"]
    lines = [line for verified in export.verified for line in _lines(verified)]
    if export.followed is not None and not export.followed.missing:
        lines += _followed_lines(export.followed)
    return [escape(line) for line in lines]


def _lines(verified: Verified) -> list[str]:
    if verified.missing:
        return [f"{verified.tool} was not found: not verified"]
    if verified.failure:
        return [f"{verified.tool}: not verified: {verified.failure}"]
    counts = f"{verified.tool}: {verified.equal:,} of {verified.compared:,} cells equal"
    proof = "" if verified.is_proof else f" (tested, not proven: there are {_magnitude(verified.joint_size)})"
    lines = [counts + proof]
    if verified.first_difference is not None:
        cells = ", ".join(f"{name} {label}" for name, label in verified.first_difference.cells)
        design, target = verified.first_difference.design, verified.first_difference.target
        lines.append(f"  where {cells}: the design decides {design}, {verified.tool} {target}")
    return lines


def _magnitude(number: int) -> str:
    """Return a number whose digits nobody would read as a power of ten."""
    digits = len(str(number))
    return f"{number:,}" if digits <= LONGEST else f"about 10^{digits - 1}"


def _followed_lines(followed: Followed) -> list[str]:
    """Return what came of running sensors and assignments beside the design; its last line is a difference."""
    tool = f"{followed.tool} with sensing"
    if followed.failure:
        return [f"{tool}: not verified: {followed.failure}"]
    situations = (
        f"{_of(followed.equal_situations, followed.situations)} situations at edges of cells and elsewhere"
    )
    if followed.episodes:
        episodes = f"{followed.episodes} recorded episode{'' if followed.episodes == 1 else 's'}"
        steps = f"{_of(followed.equal_steps, followed.steps)} steps of {episodes}"
        lines = [f"{tool}: {steps} and {situations} equal (tested, not proven)"]
    else:
        why = "no episodes, as the environment is stepped in Python"
        lines = [f"{tool}: {situations} equal (tested, not proven); {why}"]
    return lines if followed.is_equal else [*lines, f"  where {followed.first_difference}"]


def _of(equal: int, compared: int) -> str:
    return f"{equal:,} of {compared:,}"
