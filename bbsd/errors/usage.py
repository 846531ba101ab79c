"""Errors that a user can mend, other than mistakes in a spec."""

from __future__ import annotations


class UsageError(ValueError):
    """A request that cannot be fulfilled; the message says what is wrong, the advice what to do."""

    advice = ""
