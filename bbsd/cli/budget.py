"""Budgets on the command line: a number of episodes, or a time."""

import re

import typer

TIME = re.compile(r"(?P<number>\d+(?:\.\d+)?)\s*(?P<unit>s|m|min|h)")
SECONDS = {"s": 1, "m": 60, "min": 60, "h": 3600}


def read_budget(text: str | None) -> tuple[list[str], float | None]:
    """Return what a budget overrides in the spec, and its seconds where it is a time.

    Raises:
        BadParameter: it is neither a whole number nor a time.
    """
    if text is None:
        return [], None
    if match := TIME.fullmatch(text.strip()):
        return [], float(match["number"]) * SECONDS[match["unit"]]
    try:
        return [f"design.budget={int(text)}"], None
    except ValueError:
        message = f'"{text}" is neither a number of episodes, such as 300_000, nor a time, such as 20s or 5m'
        raise typer.BadParameter(message, param_hint="--budget") from None
