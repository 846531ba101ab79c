"""An explanation as plain text, for people."""

from __future__ import annotations

from textwrap import wrap
from typing import TYPE_CHECKING

from bbsd.errors import escape
from bbsd.explanation.conditions import join_words
from bbsd.language.models import NO_ACTION_TEXT

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bbsd.explanation.layers import Explanation, LayerInWords, RuleInWords
    from bbsd.explanation.vocabulary import GlossaryEntry

LINE_WIDTH = 80
NAME_WIDTH = 24
"""The widest column of names; a longer name stands on a line of its own."""
MAX_PLACES = 6
"""The number of conditions under which nobody controls that are listed, at most."""


def explanation_text(explanation: Explanation) -> str:
    """Return an explanation in lines of 80 columns, without color; it ends with a line break."""
    blocks = [
        _heading(explanation),
        _layers(explanation.layers),
        _control(explanation),
        *_glossary("Inputs", explanation.inputs),
        *_glossary("Actions", explanation.actions),
    ]
    return "\n".join("\n".join(block) + "\n" for block in blocks)


def _heading(explanation: Explanation) -> list[str]:
    n_layers = len(explanation.layers)
    layers = "1 layer" if n_layers == 1 else f"{n_layers} layers, highest first"
    lines = _wrapped(f"{explanation.name}: {layers}")
    if n_layers > 1:
        lines += _wrapped("The highest layer that has an action for the situation controls.")
    if explanation.left_out:
        verb = "are" if len(explanation.left_out) > 1 else "is"
        lines += _wrapped(f"{join_words(explanation.left_out, 'and')} {verb} not in the structure.")
    return lines


def _layers(layers: Sequence[LayerInWords]) -> list[str]:
    digits = len(str(len(layers)))
    width = min(max(len(layer.behavior) for layer in layers), NAME_WIDTH)
    return [
        line
        for layer in layers
        for line in _hanging(
            f"{layer.layer:>{digits}}  {layer.behavior:<{width}}  ", digits + width + 4, _sentences(layer)
        )
    ]


def _sentences(layer: LayerInWords) -> list[str]:
    """Return what a layer does, what higher layers prevent and what it expects; each text starts a line."""
    excited = [] if layer.excited is None else [f"when {layer.excited}:"]
    expects = [] if layer.expects is None else [f"Expects afterwards: {layer.expects}"]
    return [*excited, *_rules(layer), *_remarks(layer), *expects]


def _rules(layer: LayerInWords) -> list[str]:
    if layer.counted:
        n_cells = sum(counted.cells for counted in layer.counted)
        counts = [f"{counted.decision} in {counted.cells:,}" for counted in layer.counted]
        return [f"a table of {n_cells:,} cells: {join_words(counts, 'and')}"]
    *special, last = layer.rules
    decisions = {rule.decision for rule in special}
    if not special:
        return ["does nothing" if last.decision == NO_ACTION_TEXT else f"always {last.decision}"]
    if last.decision == NO_ACTION_TEXT and len(decisions) == 1:
        return _alternatives(f"{special[0].decision} where ", [_where(rule, layer) for rule in special])
    if decisions == {NO_ACTION_TEXT}:
        return _alternatives(f"{last.decision} except where ", [rule.where for rule in special])
    lines = [f"{rule.decision} where {_where(rule, layer)}" for rule in special]
    return [lines[0], *(f"else {line}" for line in lines[1:]), f"else {last.decision}{_mark(last, layer)}"]


def _alternatives(start: str, conditions: Sequence[str]) -> list[str]:
    return [start + conditions[0], *(f"  or {condition}" for condition in conditions[1:])]


def _where(rule: RuleInWords, layer: LayerInWords) -> str:
    return rule.where + _mark(rule, layer)


def _mark(rule: RuleInWords, layer: LayerInWords) -> str:
    return " (overruled)" if rule.overruled and layer.cells else ""


def _remarks(layer: LayerInWords) -> list[str]:
    """Return what higher layers always prevent, or what is left, whichever is shorter."""
    if not layer.overruled_by:
        return []
    by = join_words(layer.overruled_by, "or")
    if not layer.cells:
        one = "one of " if len(layer.overruled_by) > 1 else ""
        return [f"Never controls: {one}{by} above always does."]
    if not layer.overruled:
        return [f"Overruled by {by}."]
    lost, left = ("; or where ".join(conditions) for conditions in (layer.overruled, layer.effective))
    if layer.effective and len(left) < len(lost):
        return [f"Controls only where {left}; otherwise overruled by {by}."]
    return [f"Overruled by {by} where {lost}."]


def _control(explanation: Explanation) -> list[str]:
    """Return which behavior controls in how many joint cells, and where nobody does."""
    if explanation.nobody_cells is None:
        size = f"about 10^{len(str(explanation.joint_size)) - 1}"
        text = f"The behaviors can tell {size} situations apart, too many to say who controls in which."
        return _wrapped(text)
    counts = [(layer.behavior, layer.cells) for layer in explanation.layers if layer.cells]
    counts += [("nobody", explanation.nobody_cells)] if explanation.nobody_cells else []
    (first, cells), *others = counts
    if not others:
        return ["Nobody ever controls." if first == "nobody" else f"{first} always controls."]
    shares = [f"{first} controls {cells}", *(f"{name} {count}" for name, count in others)]
    text = f"Of the {explanation.joint_size} situations that the behaviors can tell apart, {join_words(shares, 'and')}."
    return [*_wrapped(f"{text} (This counts situations, not time.)"), *_nobody(explanation.nobody)]


def _nobody(conditions: Sequence[str]) -> list[str]:
    if not conditions:
        return []
    n_more = len(conditions) - MAX_PLACES
    listed = [*conditions[:MAX_PLACES], *([f"in {n_more} more places"] if n_more > 0 else [])]
    return [
        wrapped
        for line in _alternatives("Nobody controls where ", listed)
        for wrapped in _wrapped(line, "", "    ")
    ]


def _glossary(title: str, entries: Sequence[GlossaryEntry]) -> list[list[str]]:
    width = min(max((len(entry.word) for entry in entries), default=0), NAME_WIDTH)
    lines = [
        line
        for word, meaning in entries
        for line in _hanging(f"  {word:<{width}}  ", width + 4, _parts(meaning, LINE_WIDTH - width - 4))
    ]
    return [[title, *lines]] if lines else []


def _parts(meaning: str, width: int) -> list[str]:
    """Return a meaning on one line if it fits, else each of its cells or states on a line."""
    return [meaning] if len(meaning) <= width else meaning.split("; ")


def _hanging(head: str, column: int, sentences: Sequence[str]) -> list[str]:
    """Return sentences, each on lines of its own from a column on; the head is before the first, or above it."""
    indent = " " * column
    lines = [line for sentence in sentences for line in _wrapped(sentence, indent, indent + "  ")]
    return [head + lines[0][column:], *lines[1:]] if len(head) == column else [head.rstrip(), *lines]


def _wrapped(text: str, first: str = "", rest: str = "") -> list[str]:
    """Return a text in as many indented lines as it needs; its leading spaces are kept."""
    text = escape(text)
    lead = " " * (len(text) - len(text.lstrip(" ")))
    return wrap(
        text.lstrip(" "),
        LINE_WIDTH,
        initial_indent=first + lead,
        subsequent_indent=rest + lead,
        break_long_words=False,
        break_on_hyphens=False,
    )
