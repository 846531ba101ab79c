"""What an environment that is stepped in Python did wrong, in words and with its own lines, never with ours."""

from __future__ import annotations

import importlib
import traceback
from pathlib import Path
from typing import TYPE_CHECKING

from bbsd.errors import UsageError, escape

if TYPE_CHECKING:
    from traceback import FrameSummary

OWN_FOLDER = str(Path(__file__).parents[1])
IMPORTLIB = str(Path(importlib.__file__).parent)
SHOWN = 3
"""Calls of an environment's own that are shown of an error, the last ones."""
MOST_CHARACTERS = 500
"""Characters of an error's message that are shown."""
INDENT = "\n      "


class EnvironmentFailed(UsageError):
    """An environment raised an error, or gave what it should not."""

    advice = "mend the environment, or give it other arguments (with:)"


class EnvironmentHangs(UsageError):
    """A call of an environment did not return in time."""

    advice = (
        "raise --step-limit if it is only slow; else mend the environment, or give it other arguments (with:)"
    )


class ActionRefused(UsageError):
    """A value that the environment does not take was to be sent to it."""

    advice = "let the actions, and the dynamics of what is sent, set only values that bbsd spaces shows"


def failure_text(what: str, error: BaseException) -> str:
    """Return an error of an environment in words, with the last calls that led to it, a line each.

    Args:
        what: what raised it, such as "CartPole-v1, in step 3 of an episode".
        error: the error; the calls of bbsd in its traceback are left out.
    """
    message = escape(" ".join(str(error).split()))[:MOST_CHARACTERS]
    first = f"{what} raised {type(error).__name__}" + (f": {message}" if message else "")
    frames = [frame for frame in traceback.extract_tb(error.__traceback__) if _is_theirs(frame)]
    return INDENT.join([first, *map(_frame_text, frames[-SHOWN:])])


def _is_theirs(frame: FrameSummary) -> bool:
    return not frame.filename.startswith((OWN_FOLDER, IMPORTLIB, "<frozen importlib"))


def _frame_text(frame: FrameSummary) -> str:
    line = f": {frame.line}" if frame.line else ""
    return escape(f"  {frame.filename}:{frame.lineno}, in {frame.name}{line}")
