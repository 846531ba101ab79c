"""A comparison as tables, printed by rich. Names from specs are printed as they are, never read as markup."""

from __future__ import annotations

from itertools import zip_longest
from typing import TYPE_CHECKING

from rich.console import Group
from rich.text import Text

from bbsd.errors import escape
from bbsd.explanation.conditions import join_words
from bbsd.report.tables import INTERVAL, plain_table
from bbsd.report.wording.numbers import changes, column, count, percent

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from rich.console import RenderableType
    from rich.table import Table

    from bbsd.evaluation import Interval
    from bbsd.explanation.comparison import Comparison
    from bbsd.explanation.comparison.results import Command, Commands, RuleChange, Source

MOST_ROWS = 12
"""Rows of a table that are shown."""
MOST_PLACES = 4
"""Conditions that are shown of a row."""


def comparison_table(comparison: Comparison) -> RenderableType:
    """Return what a comparison says: what both earn, where commands differ, what was changed, and its worth."""
    parts: list[RenderableType] = []
    for part in _parts(comparison):
        parts += [part] if not parts else ["", part]
    return Group(*parts)


def _parts(comparison: Comparison) -> Iterator[RenderableType]:
    yield Group(_line(f"A  {comparison.a}"), _line(f"B  {comparison.b}"))
    if comparison.notes:
        yield Group(*(Text(escape(note), "yellow") for note in comparison.notes))
    same = "" if comparison.is_paired else ", not paired"
    yield Group(_returns(comparison), f"{count(comparison.episodes, 'episode')} of each{same}")
    if comparison.is_same:
        yield "Tables and structure are the same."
    if comparison.commands is not None:
        yield _commands(comparison.commands)
    if comparison.rules:
        yield _rules(comparison.rules)
    for each in comparison.redefined:
        yield Text(escape(f"{each.behavior} has other {join_words(each.parts, 'and')}."))
    if comparison.order.a != comparison.order.b:
        yield _order(comparison)
    if comparison.sources:
        yield _sources(comparison)


def _line(text: str) -> Text:
    # People copy paths, so they are never broken into lines.
    return Text(escape(text), no_wrap=True, overflow="ignore")


def _returns(comparison: Comparison) -> Table:
    table = plain_table("", "A", "B", "B - A", INTERVAL, right=[1, 2, 3])
    difference = comparison.difference
    rows: list[tuple[str, float | None, float | None, Interval | None]]
    rows = [("return", comparison.return_a.mean, comparison.return_b.mean, difference)]
    rows += [(term.term, term.a, term.b, term.difference) for term in comparison.terms]
    texts = column([value for _, a, b, _ in rows for value in (a, b) if value is not None])
    left = iter(texts)
    differences = [each for _, _, _, each in rows if each is not None]
    right = iter(_intervals(differences))
    for index, (name, a, b, each) in enumerate(rows):
        values = [next(left) if value is not None else "" for value in (a, b)]
        interval = next(right) if each is not None else ("", "")
        style = "" if index else "bold"
        table.add_row(Text(escape(name)), *values, Text(interval[0], style), interval[1])
    return table


def _intervals(intervals: Sequence[Interval]) -> list[tuple[str, str]]:
    """Return differences with a sign, and their intervals, with the same decimals."""
    numbers = [number for each in intervals for number in (each.mean, each.low, each.high)]
    texts = changes(numbers)
    return [(texts[index], f"{texts[index + 1]} to {texts[index + 2]}") for index in range(0, len(texts), 3)]


def _commands(commands: Commands) -> RenderableType:
    watched = count(commands.episodes, "episode")
    if not commands.differences:
        return f"In the situations that were met, in {watched} of each, both command the same."
    shares = percent(commands.share_a), percent(commands.share_b)
    head = (
        f"In {shares[0]} of A's robot-steps B would have commanded something else, in {shares[1]} of B's A would have "
        f"({watched} of each):"
    )
    table = plain_table("of A", "of B", "A does, and B", right=[0, 1])
    shown, rest = commands.differences[:MOST_ROWS], commands.differences[MOST_ROWS:]
    for each in shown:
        what = f"{_command(each.a)}; {_command(each.b)}"
        table.add_row(percent(each.share_a), percent(each.share_b), _with_places(what, each.where, each.left))
    if rest:
        share_a, share_b = sum(each.share_a for each in rest), sum(each.share_b for each in rest)
        table.add_row(percent(share_a), percent(share_b), f"{len(rest)} more pairs of commands")
    return Group(head, table)


def _command(command: Command) -> str:
    return f"{command.action} by {command.behavior}" if command.behavior else "nobody"


def _with_places(what: str, where: Sequence[str], left: int = 0) -> Text:
    """Return what happens, and below it where: a few conditions, each on lines of its own.

    `left` situations fulfill none of the conditions.
    """
    text = Text(escape(what))
    for index, condition in enumerate(where[:MOST_PLACES]):
        text.append(
            f"\n{'or ' if index else 'where '}{escape(condition)}" if condition else "\nanywhere", "dim"
        )
    if len(where) > MOST_PLACES or left:
        text.append("\nor elsewhere", "dim")
    return text


def _rules(rules: Sequence[RuleChange]) -> RenderableType:
    table = plain_table("in A", "in B", "rules that differ", right=[0, 1])
    for rule in rules[:MOST_ROWS]:
        what = f"{rule.behavior}: {rule.before} becomes {rule.after}"
        if not rule.where:
            what += f" in {count(rule.cells, 'cell')}"
        table.add_row(_share(rule.asked_a), _share(rule.asked_b), _with_places(what, rule.where))
    if len(rules) > MOST_ROWS:
        table.add_row("", "", f"{len(rules) - MOST_ROWS} more")
    return Group(table, "(how often the behavior was asked there, of all robot-steps)")


def _share(share: float | None) -> str:
    return "" if share is None else "never" if share == 0 else percent(share)


def _order(comparison: Comparison) -> RenderableType:
    order = comparison.order
    table = plain_table("order in A", "order in B, highest layer first")
    for names in zip_longest(order.a, order.b, fillvalue=""):
        table.add_row(*(Text(escape(name)) for name in names))
    only = [
        f"{join_words(names, 'and')} {'is' if len(names) == 1 else 'are'} in {where} alone."
        for names, where in (
            ([name for name in order.a if name not in order.b], "A"),
            ([name for name in order.b if name not in order.a], "B"),
        )
        if names
    ]
    moved = [f"{join_words(order.moved, 'and')} moved."] if order.moved else []
    return Group(table, *(Text(escape(line)) for line in (*only, *moved)))


def _sources(comparison: Comparison) -> RenderableType:
    table = plain_table("change", "taken over into A", "taken back in B", right=[1, 2])
    measured = [
        each for source in comparison.sources for each in (source.in_a, source.in_b) if each is not None
    ]
    texts = iter(_intervals(measured))
    without: list[str] = []
    for source in comparison.sources:
        cells = ["" if each is None else "\n".join(next(texts)) for each in (source.in_a, source.in_b)]
        if all(each is not None and each.low == each.high == 0.0 for each in (source.in_a, source.in_b)):
            without.append(_name(source))
        else:
            table.add_row(_with_places(_name(source), source.where[:2]), *cells)
    lines = []
    if without:
        lines.append(f"Without any effect in these episodes: {'; '.join(without)}.")
    if comparison.unmeasured:
        lines.append(f"{count(comparison.unmeasured, 'change')} more, asked less often, not measured.")
    head = (
        "Where the difference comes from: what A earns more with one change alone, and what B earns more with it than "
        "without it, with 95 % intervals. Changes work together, so these need not add up."
    )
    return Group(head, *([table] if table.row_count else []), *(Text(escape(line)) for line in lines))


def _name(source: Source) -> str:
    match source.kind:
        case "order":
            return "the order of the layers"
        case "definition":
            return f"{source.behavior} as it is in B"
        case "behavior":
            return f"{source.behavior}: all changed rules"
        case _:
            return f"{source.behavior}: {source.before} becomes {source.after}"
