"""The worth of a design's parts as tables, printed by rich. Names from specs are printed as they are."""

from __future__ import annotations

from math import isnan
from typing import TYPE_CHECKING

from rich.console import Group
from rich.text import Text

from bbsd.errors import escape
from bbsd.explanation.worth.results import clearly_above, clearly_below, never_changes
from bbsd.report.tables import INTERVAL, plain_table
from bbsd.report.wording.numbers import column, count, percent, with_halves

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from rich.console import RenderableType
    from rich.table import Table

    from bbsd.explanation.worth import BehaviorWorth, Finding, Order, Precedence, RuleWorth, Swap, Worth

GRAVE = ("selfish", "harmful", "harmful rule", "broken expectation", "better order")
"""What is shown in color."""
MOST_RULES = 40
"""Rules that are shown of a behavior: those that control most."""


def worth_table(worth: Worth) -> RenderableType:
    """Return what stands out, and tables of behaviors, earnings, rules and the order of the layers."""
    parts: list[RenderableType] = []
    for part in _parts(worth):
        parts += [part] if not parts else ["", part]
    return Group(*parts)


def _parts(worth: Worth) -> Iterator[RenderableType]:
    yield _basis(worth)
    if worth.findings:
        yield Group(*(_finding(finding) for finding in worth.findings))
    yield _activity(worth)
    yield _changes(worth)
    yield _earned(worth)
    yield _rules(worth)
    if worth.swaps:
        yield _swaps(worth.swaps)
        yield _orders(worth.orders, worth.precedence)
        yield _precedence(worth.precedence, worth.behaviors)
    if worth.left_out:
        yield Text(escape(f"not in the structure: {', '.join(worth.left_out)}"))


def _basis(worth: Worth) -> RenderableType:
    mean, low, high = column([worth.returns.mean, worth.returns.low, worth.returns.high])
    table = plain_table("return", INTERVAL)
    table.add_row(Text(mean, "bold"), f"{low} to {high}")
    steps = f"{worth.steps:.1f} steps on average" if worth.steps % 1 else count(round(worth.steps), "step")
    return Group(
        table, f"{count(worth.returns.count, 'episode')} of {steps}; all changes are in the same episodes"
    )


def _finding(finding: Finding) -> Text:
    return Text(escape(finding.text), "yellow" if finding.kind in GRAVE else "")


def _activity(worth: Worth) -> Table:
    table = plain_table(
        "layer", "behavior", "in control", "activated", "suppressed", "excited", right=range(2, 6)
    )
    for each in worth.behaviors:
        shares = (each.control, each.activated, each.suppressed, each.excited)
        table.add_row(str(each.layer), Text(escape(each.behavior)), *map(percent, shares))
    table.add_row("", Text("nobody", "dim"), percent(worth.nobody_control))
    return table


def _changes(worth: Worth) -> RenderableType:
    """Return the changes of the return where behaviors are dropped, and where they are replaced at random."""
    table = plain_table("change of the return", "if dropped", "if random", right=[1, 2])
    texts = with_halves([change for each in worth.behaviors for change in (each.dropped, each.random)])
    for index, each in enumerate(worth.behaviors):
        table.add_row(Text(escape(each.behavior)), *texts[2 * index : 2 * index + 2])
    return Group(
        table, f"±: 95 % interval; random: the mean over {count(worth.random_tables, 'random table')}"
    )


def _earned(worth: Worth) -> Table:
    """Return what was earned while each behavior controlled, by reward term, with sums."""
    terms = list(worth.nobody)
    rows = {each.behavior: each.earned for each in worth.behaviors} | {"nobody": worth.nobody}
    cells = [[*(earned[term] for term in terms), sum(earned.values())] for earned in rows.values()]
    cells.append([sum(values) for values in zip(*cells, strict=True)])
    texts = column([value for row in cells for value in row])
    width = len(terms) + 1
    table = plain_table("earned in control", *map(escape, terms), "in all", right=range(1, width + 1))
    for index, name in enumerate([*rows, "in all"]):
        style = "bold" if index == len(rows) else "dim" if name == "nobody" else ""
        table.add_row(Text(escape(name), style), *texts[width * index : width * (index + 1)])
    return table


def _rules(worth: Worth) -> Table:
    """Return the rules of each behavior with their share of control, and the change of the return without them."""
    table = plain_table("rule", "in control", "if dropped", right=[1, 2])
    shown = {each.behavior: _most_used(each.rules) for each in worth.behaviors}
    none = {
        each.behavior: "no action" if each.rules else "too many to look at one by one"
        for each in worth.behaviors
    }
    changes = [rule.dropped for rules in shown.values() for rule in rules if rule.dropped is not None]
    texts = iter(with_halves(changes))
    for behavior, rules in shown.items():
        table.add_row(Text(escape(behavior), "bold"))
        if not rules:
            table.add_row(Text(f"  {none[behavior]}", "dim"))
        for rule in rules:
            named = Text(escape(f"  {rule.text}"), "" if rule.acts else "dim")
            table.add_row(
                named, percent(rule.control) if rule.acts else "", next(texts) if rule.dropped else ""
            )
    return table


def _most_used(rules: Sequence[RuleWorth]) -> list[RuleWorth]:
    """Return those rules that control most, in their order; not the one that leaves all other cells to others."""
    useful = [rule for rule in rules if rule.dropped is not None]
    last = sorted(useful, key=lambda rule: -rule.control)[:MOST_RULES]
    return [rule for rule in useful if any(rule is other for other in last)]


def _swaps(swaps: Sequence[Swap]) -> Table:
    table = plain_table("neighbors exchanged", "change of the return", "", right=[1])
    for swap, text in zip(swaps, with_halves([swap.change for swap in swaps]), strict=True):
        names = Text(escape(f"{swap.upper}, {swap.lower}"))
        table.add_row(names, text, _verdict(swap))
    return table


def _verdict(swap: Swap) -> str:
    """Return what an exchange of two layers comes to."""
    if swap.never:
        return "proven equal by the tables"
    if never_changes(swap.change):
        return "never any change"
    if clearly_above(swap.change):
        return "better"
    if isnan(swap.change.mean) or clearly_below(swap.change):
        return ""
    return "no measurable change" if swap.change.low <= 0 <= swap.change.high else "not certain"


def _orders(orders: Sequence[Order], precedence: Precedence) -> RenderableType:
    table = plain_table("change of the return", "best orders, highest layer first", right=[0])
    for order, text in zip(orders, with_halves([order.change for order in orders]), strict=True):
        alike = f", and {count(order.alike - 1, 'order')} that must do the same" if order.alike > 1 else ""
        table.add_row(text, Text(escape(f"{' '.join(order.structure)}{alike}")))
    tried = "all" if precedence.whole else "two behaviors exchanged, or one elsewhere"
    note = f"of {count(precedence.tried, 'order')} ({tried}), chosen in other episodes than these"
    return Group(table, note)


def _precedence(precedence: Precedence, behaviors: Sequence[BehaviorWorth]) -> RenderableType:
    """Return the partial order: below each behavior what must stand lower."""
    lines: list[RenderableType] = [Text("what must stand above what", "bold")]
    for each in behaviors:
        below = [lower.behavior for lower in behaviors if (each.behavior, lower.behavior) in precedence.above]
        if below:
            lines.append(Text(escape(f"{each.behavior}  above  {', '.join(below)}")))
    named = {name for pair in precedence.above for name in pair}
    free = [each.behavior for each in behaviors if each.behavior not in named]
    if free:
        lines.append(Text(escape(f"anywhere: {', '.join(free)}")))
    return Group(*lines)
