"""An explanation as plain text, for people."""

from __future__ import annotations

from itertools import groupby
from typing import TYPE_CHECKING

from bbsd.explanation.conditions import join_words
from bbsd.explanation.decision_tables import decision_table, whole_table
from bbsd.explanation.lines import LINE_WIDTH, hanging, percent, wrapped
from bbsd.language.models import NO_ACTION_TEXT

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bbsd.explanation.vocabulary import GlossaryEntry
    from bbsd.explanation.words import Explanation, LayerInWords, PlaceInWords, Useless, Watched

NAME_WIDTH = 24
"""The widest column of names; a longer name stands on a line of its own."""
MAX_PLACES = 6
"""The number of conditions under which nobody controls that are listed, at most."""
LONG = 90
"""Characters from which on it is not said where higher layers always act: they are listed above anyway."""
MOST_INPUTS_IN_PROSE, MOST_RULES_IN_PROSE = 3, 8
"""Inputs and rules of a behavior up to which they are sentences; of more, they are a decision table."""
MOST_USELESS_RULES = 2
"""Useless rules of a behavior that are written out; of more, the numbers are given."""
ASKED = (
    "(asked: share of time in which a behavior was excited, no higher layer acted, and the row fitted first)"
)
MOST_UNASKED = 4
"""Conditions in which a table says something else than the rules, and was never asked, that are listed, at most."""


def explanation_text(explanation: Explanation) -> str:
    """Return an explanation in lines of 80 columns, without color; it ends with a line break."""
    blocks = [
        _heading(explanation),
        _layers(explanation, all_tables=False),
        _control(explanation),
        *_useless(explanation.useless),
        *_glossary("Inputs", explanation.inputs),
        *_glossary("Actions", explanation.actions),
    ]
    return "\n".join("\n".join(block) + "\n" for block in blocks)


def table_text(explanation: Explanation) -> str:
    """Return the decision table of each behavior, and the whole architecture as one table."""
    blocks = [
        _heading(explanation),
        _layers(explanation, all_tables=True),
        [
            "The whole: of the rows that hold, the one of the highest layer counts.",
            "",
            *whole_table(explanation),
        ],
        _control(explanation),
        *_useless(explanation.useless),
    ]
    return "\n".join("\n".join(block) + "\n" for block in blocks)


def _heading(explanation: Explanation) -> list[str]:
    n_layers = len(explanation.layers)
    layers = "1 layer" if n_layers == 1 else f"{n_layers} layers, highest first"
    lines = wrapped(f"{explanation.name}: {layers}")
    if n_layers > 1:
        lines += wrapped("The highest layer that has an action for the situation controls.")
    if explanation.left_out:
        verb = "are" if len(explanation.left_out) > 1 else "is"
        lines += wrapped(f"{join_words(explanation.left_out, 'and')} {verb} not in the structure.")
    if long := [layer.behavior for layer in explanation.layers if layer.rules and not layer.is_shortest]:
        lines += wrapped(
            f"The rules of {join_words(long, 'and')} are short, found step by step; all others are the shortest."
            if len(long) < n_layers
            else "The rules are short, found step by step; there may be shorter ones."
        )
    return lines


def _layers(explanation: Explanation, *, all_tables: bool) -> list[str]:
    layers = explanation.layers
    digits = len(str(len(layers)))
    width = min(max(len(layer.behavior) for layer in layers), NAME_WIDTH)
    lines: list[str] = []
    has_shares = False
    for layer in layers:
        is_long = _n_inputs(layer) > MOST_INPUTS_IN_PROSE or len(layer.rules) > MOST_RULES_IN_PROSE
        is_table = len(layer.rules) > 1 and (all_tables or is_long)
        head, column = f"{layer.layer:>{digits}}  {layer.behavior:<{width}}  ", digits + width + 4
        if not is_table:
            lines += hanging(
                head, column, [*_excited(layer), *_rules(layer), *_remarks(layer, explanation.watched)]
            )
            continue
        has_shares = explanation.watched is not None
        table = decision_table(layer, " " * (digits + 2), explanation.watched)
        lines += [*hanging(head, column, [*_excited(layer), table.how]), "", *table.lines, ""]
        indent = " " * column
        lines += [
            line
            for each in _remarks(layer, explanation.watched)
            for line in wrapped(each, indent, indent + "  ")
        ]
    return [*lines, *(wrapped(ASKED) if has_shares else [])]


def layer_sentences(layer: LayerInWords) -> list[str]:
    """Return what a layer does, in sentences: when it is excited, its rules, and where higher layers overrule it."""
    return [*_excited(layer), *_rules(layer), *_overruled(layer)]


def _n_inputs(layer: LayerInWords) -> int:
    return len({condition.input for rule in layer.rules for condition in rule.when})


def _excited(layer: LayerInWords) -> list[str]:
    return [] if layer.excited is None else [f"when {layer.excited}:"]


def _rules(layer: LayerInWords) -> list[str]:
    """Return what a behavior does; each text starts a line."""
    if layer.counted:
        n_cells = sum(counted.cells for counted in layer.counted)
        counts = [f"{counted.decision} in {counted.cells:,}" for counted in layer.counted]
        return [f"a table of {n_cells:,} cells: {join_words(counts, 'and')}"]
    *special, last = layer.rules
    decisions = {rule.decision for rule in special}
    if not special:
        return ["does nothing" if last.decision == NO_ACTION_TEXT else f"always {last.decision}"]
    if last.decision == NO_ACTION_TEXT and len(decisions) == 1:
        return _alternatives(f"{special[0].decision} where ", [rule.where for rule in special])
    if decisions == {NO_ACTION_TEXT}:
        return _alternatives(f"{last.decision} except where ", [rule.where for rule in special])
    lines = [f"{rule.decision} where {rule.where}" for rule in special]
    return [lines[0], *(f"else {line}" for line in lines[1:]), f"else {last.decision}"]


def _alternatives(start: str, conditions: Sequence[str]) -> list[str]:
    return [start + conditions[0], *(f"  or {condition}" for condition in conditions[1:])]


def _remarks(layer: LayerInWords, watched: Watched | None) -> list[str]:
    """Return what higher layers always prevent, what was never asked, and what the behavior expects."""
    expects = [] if layer.expects is None else [f"Expects afterwards: {layer.expects}"]
    return [*_overruled(layer), *_never_asked(layer, watched), *expects]


def _overruled(layer: LayerInWords) -> list[str]:
    by = join_words(layer.overruled_by, "or")
    if by and not layer.cells:
        one = "one of " if len(layer.overruled_by) > 1 else ""
        return [f"Never controls: {one}{by} above always does."]
    if not layer.covered or not by:
        return []
    lost, left = (
        "; or where ".join(place.where for place in places) for places in (layer.covered, layer.effective)
    )
    if min(map(len, filter(None, (lost, left)))) > LONG:
        return [f"Overruled by {by} in part."]
    if layer.effective and len(left) < len(lost):
        return [f"Controls only where {left}; otherwise overruled by {by}."]
    return [f"Overruled by {by} where {lost}."]


def _never_asked(layer: LayerInWords, watched: Watched | None) -> list[str]:
    n_cells = layer.kinds.never_asked
    if not n_cells or watched is None:
        return []
    cells = "1 cell was" if n_cells == 1 else f"{n_cells:,} cells were"
    start = f"{cells} never asked in {_episodes(watched)}"
    others = [f"{each.decision} where {each.where}" for each in layer.never_asked if not each.agrees]
    if not others:
        return [f"({start}; the rules hold there too.)"]
    n_more = len(others) - MOST_UNASKED
    listed = [*others[:MOST_UNASKED], *([f"and more in {n_more} other places"] if n_more > 0 else [])]
    return [f"({start}; there the table says {'; '.join(listed)}.)"]


def _episodes(watched: Watched) -> str:
    return "1 episode" if watched.episodes == 1 else f"{watched.episodes:,} episodes"


def _control(explanation: Explanation) -> list[str]:
    """Return which behavior controls in how many joint cells, and where nobody does."""
    return [*_situations(explanation), *_time(explanation)]


def _situations(explanation: Explanation) -> list[str]:
    if explanation.nobody_cells is None:
        size = f"about 10^{len(str(explanation.joint_size)) - 1}"
        text = f"The behaviors can tell {size} situations apart, too many to say who controls in which."
        return wrapped(text)
    counts = [(layer.behavior, layer.cells) for layer in explanation.layers if layer.cells]
    counts += [("nobody", explanation.nobody_cells)] if explanation.nobody_cells else []
    (first, cells), *others = counts
    if not others:
        return ["Nobody ever controls." if first == "nobody" else f"{first} always controls."]
    shares = [f"{first} controls {cells:,}", *(f"{name} {count:,}" for name, count in others)]
    situations = f"the {explanation.possible_cells or 0:,} situations that the behaviors can tell apart"
    text = f"Of {situations}, {join_words(shares, 'and')}."
    return [*wrapped(f"{text} (This counts situations, not time.)"), *_nobody(explanation.nobody)]


def _time(explanation: Explanation) -> list[str]:
    """Return the share of time that each behavior controlled."""
    watched = explanation.watched
    if watched is None:
        return []
    steps = max(1, watched.robot_steps)
    counts = [(layer.behavior, layer.controlled or 0) for layer in explanation.layers]
    counts += [("nobody", watched.nobody)] if watched.nobody else []
    ordered = sorted(counts, key=lambda each: -each[1])
    (first, share), *others = [(name, percent(count / steps)) for name, count in ordered]
    shares = [f"{first} controlled {share} of the time", *(f"{name} {share}" for name, share in others)]
    return wrapped(f"In {_episodes(watched)}, {join_words(shares, 'and')}.")


def _nobody(places: Sequence[PlaceInWords]) -> list[str]:
    if not places:
        return []
    n_more = len(places) - MAX_PLACES
    listed = [
        *(place.where for place in places[:MAX_PLACES]),
        *([f"in {n_more} more places"] if n_more > 0 else []),
    ]
    return [
        line for each in _alternatives("Nobody controls where ", listed) for line in wrapped(each, "", "    ")
    ]


def _useless(useless: Sequence[Useless]) -> list[list[str]]:
    """Return what is useless, many rules of a behavior in one sentence."""
    texts: list[str] = []
    for (behavior, why, is_rule, _), group in groupby(
        useless, lambda each: (each.behavior, each.why, each.kind == "rule", each.worth)
    ):
        alike = list(group)
        numbers = [str(each.number) for each in alike]
        if is_rule and len(alike) > MOST_USELESS_RULES:
            texts.append(f"{behavior}, rules {join_words(numbers, 'and')}: {why}{_worth(alike[0], 'each')}")
        else:
            texts += map(_useless_text, alike)
    lines = [line for text in texts for line in wrapped(text, "  ", "    ")]
    if any(not each.is_certain and not each.worth and each.kind != "input" for each in useless):
        lines += ["  (bbsd explain --worth measures what the design would earn without them.)"]
    return [["What it could do without", *lines]] if lines else []


def _useless_text(useless: Useless) -> str:
    what = f"{useless.behavior}, {useless.what}" if useless.what else useless.behavior
    return f"{what}: {useless.why}{_worth(useless, 'it')}"


def _worth(useless: Useless, it: str) -> str:
    return f"; without {it} {useless.worth}" if useless.worth else ""


def _glossary(title: str, entries: Sequence[GlossaryEntry]) -> list[list[str]]:
    width = min(max((len(entry.word) for entry in entries), default=0), NAME_WIDTH)
    lines = [
        line
        for word, meaning in entries
        for line in hanging(f"  {word:<{width}}  ", width + 4, _parts(meaning, LINE_WIDTH - width - 4))
    ]
    return [[title, *lines]] if lines else []


def _parts(meaning: str, width: int) -> list[str]:
    """Return a meaning on one line if it fits, else each of its cells or states on a line."""
    return [meaning] if len(meaning) <= width else meaning.split("; ")
