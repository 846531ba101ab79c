"""Budgets on the command line, a number of episodes or a time; and several seeds."""

import re

import typer

TIME = re.compile(r"(?P<number>\d+(?:\.\d+)?)\s*(?P<unit>s|m|min|h)")
SEEDS = re.compile(r"(?P<first>\d+)-(?P<last>\d+)")
MOST_SEEDS = 10_000
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


def read_time(text: str | None) -> float | None:
    """Return the seconds of a time. Raises BadParameter where it is none."""
    match = None if text is None else TIME.fullmatch(text.strip())
    seconds = float(match["number"]) * SECONDS[match["unit"]] if match else 0.0
    if text is not None and seconds <= 0:
        message = f'"{text}" is no time, such as 90s, 10m or 2h'
        raise typer.BadParameter(message, param_hint="--time-limit")
    return seconds or None


def read_seeds(text: str) -> range:
    """Return the seeds from the first to the last one of A-B. Raises BadParameter for another text."""
    match = SEEDS.fullmatch(text.strip())
    seeds = range(int(match["first"]), int(match["last"]) + 1) if match else range(0)
    if not 0 < len(seeds) <= MOST_SEEDS:
        raise typer.BadParameter(f'"{text}" is not a range of seeds, such as 0-9', param_hint="--seeds")
    return seeds
