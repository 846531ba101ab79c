"""The `environment` of a spec for an environment that was looked at, ready to paste: names, with what they may be."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.environments.spaces.naming import action_names, proposals
from bbsd.environments.spaces.sending import n_sent, taken_text, takes
from bbsd.errors import escape
from bbsd.text.writing.writer import write

if TYPE_CHECKING:
    from bbsd.environments.spaces.kinds import Space
    from bbsd.language.outside import Outside

STEPS = 500
"""Steps that are proposed for an environment without a limit of its own."""
COLUMN = 34
"""Where comments begin, at least."""


def environment_text(
    outside: Outside, observed: Space, taken: Space | None, robots: int, steps: int | None, label: str
) -> str:
    """Return the block of a spec as YAML text, with a comment for each name.

    Args:
        outside: what the spec, or a command, says of the environment.
        observed: its space of observations.
        taken: its space of actions; None where it names none.
        robots: its agents; 1 of an environment for one robot.
        steps: the episode's limit, of the spec or else of the environment; None where neither has one.
        label: its name without version.
    """
    lines = ["environment:", f"  {outside.kind}: {outside.target}"]
    if outside.arguments:
        lines += [f"  {line}" for line in write({"with": dict(outside.arguments)}).splitlines()]
    lines += [f"  robots: {robots}"] if robots > 1 else []
    lines += [f"  steps: {steps or STEPS}", *_observation_lines(observed, label)]
    lines += _action_lines(taken, [each.name for each in proposals(observed, label)])
    return "\n".join(lines) + "\n"


def _observation_lines(space: Space, label: str) -> list[str]:
    found = proposals(space, label)
    if not found:
        return [f"  # nothing of an observation is a number: {escape(str(space))}"]
    lines = ["  observation:"]
    for name, source, comment in found:
        lines.append(_commented(f"    {name}: {source}" if source else f"    - {name}", comment))
    return lines


def _action_lines(space: Space | None, observed: list[str]) -> list[str]:
    n_values = n_sent(space)
    if n_values == 0:
        return [f"  # what it takes is not made of numbers: {escape(str(space))}"]
    names = action_names(n_values or 1, observed)
    comments = (
        ["it names no space of actions"]
        if space is None
        else [taken_text(space, i) for i in range(len(names))]
    )
    if len(names) == 1:
        lines = [_commented(f"  action: {names[0]}", comments[0])]
    else:
        lines = [
            "  action:",
            *(_commented(f"    - {name}", each) for name, each in zip(names, comments, strict=True)),
        ]
    starts = [0.0 if space is None else _first_value(space, index) for index in range(len(names))]
    return [
        *lines,
        "  state:",
        *(f"    {name}: {start:.7g}" for name, start in zip(names, starts, strict=True)),
    ]


def _first_value(space: Space, index: int) -> float:
    """Return the value nearest to 0 that is taken, of the numbers that are tried."""
    return next(
        (value for value in (0.0, 1.0, -1.0, *_ends(space, index)) if takes(space, index, value)), 0.0
    )


def _ends(space: Space, index: int) -> tuple[float, ...]:
    from bbsd.environments.spaces.kinds import Box, Discrete, MultiDiscrete, Several

    match space:
        case Discrete(_, start):
            return (float(start),)
        case Box(_, low, high):
            return (low[index], high[index])
        case MultiDiscrete(_, starts):
            return (float(starts[index]),)
        case Several(parts):
            return _ends(parts[index], 0)
    return ()


def _commented(text: str, comment: str) -> str:
    return f"{text:<{COLUMN}}  # {escape(comment)}"
