"""The estimated cost of a design, as a text and as plain data."""

from __future__ import annotations

from dataclasses import asdict
from typing import TYPE_CHECKING

from bbsd.errors import escape
from bbsd.report.wording.numbers import count, duration

if TYPE_CHECKING:
    from bbsd.report.plain import Plain
    from bbsd.runs.pricing.price import Price


def price_plain(price: Price) -> dict[str, Plain]:
    """Return a price as plain data."""
    return asdict(price)


def price_text(price: Price) -> str:
    """Return a price as lines of text."""
    layers = f"{count(price.layers, 'layer')}, {price.open_layers} open"
    rows = {
        "structure": layers,
        "search space": f"10^{price.decades:.1f} designs",
        "episodes": _episodes(price),
        "steps": f"{price.steps:,} at most, counted for each robot",
        "memory": f"about {price.bytes / 1e6:,.0f} MB",
        "compiling": _compiling(price),
        "time": f"{_time(price)}: {price.microseconds:.1f} µs per episode, "
        f"{duration(price.starting + price.compiling)} to start, compile and draw",
    }
    if price.sampled_length is not None and price.most_seconds > price.seconds:
        rows["length"] = (
            f"measured in episodes of {price.sampled_length:.4g} steps on average; the better designs get, the longer "
            f"theirs may last, {price.most_length} steps at most, which is not known before"
        )
    return "\n".join([*_tables(price), "", *(f"{name:<14}{text}" for name, text in rows.items())])


def _time(price: Price) -> str:
    """Return the time, from that of episodes as they were sampled to that of episodes of full length."""
    least, most = duration(price.seconds), duration(price.most_seconds)
    return f"about {least}" if least == most else f"about {least} to {most}"


def _compiling(price: Price) -> str:
    if price.to_compile == 0.0:
        return "nothing: the kernels are in the cache"
    return f"about {duration(price.to_compile)} by the size of the kernels, once: they are kept in the cache"


def _episodes(price: Price) -> str:
    if price.method == "paper":
        return f"{price.episodes:,} in the generations, about {price.further_episodes:,} to choose and judge"
    return f"{price.episodes:,} to search and choose (method {price.method}), {price.further_episodes:,} to judge"


def _tables(price: Price) -> list[str]:
    names = [escape(table.behavior) for table in price.tables]
    width = max(map(len, (*names, "behavior")))
    lines = [f"{'behavior':<{width}}   cells    open   actions   designs"]
    return lines + [
        f"{name:<{width}} {table.cells:>7,} {table.open_cells:>7,} {table.actions:>9}   10^{table.decades:.1f}"
        for name, table in zip(names, price.tables, strict=True)
    ]
