"""What a user asked for and can mend, other than a mistake in a spec."""

from __future__ import annotations


class UsageError(ValueError):
    """Something that cannot be done as asked; the message says what is wrong, the advice what to do."""

    advice = ""
