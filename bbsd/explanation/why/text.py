"""The answer to a why as plain text, for people."""

from __future__ import annotations

from textwrap import wrap
from typing import TYPE_CHECKING

from bbsd.errors import escape
from bbsd.explanation.conditions import join_words
from bbsd.explanation.why.aim import NOBODY

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from bbsd.evaluation.tracing.traced import Value
    from bbsd.explanation.why.answer import Answer, LayerAnswer
    from bbsd.explanation.why.otherwise import DesignChange, Otherwise, Way
    from bbsd.explanation.why.situation import Listed

LINE_WIDTH = 80
NAME_WIDTH = 24
MOST_OF_A_LIST, FIRST_OF_A_LIST = 12, 4
"""Values of a list that are shown; of a longer one only the first."""
"""The widest column of names; a longer name stands on a line of its own."""
MOST_SHOWN = 6
"""The number of ways that are listed, at most."""


def answer_text(answer: Answer) -> str:
    """Return an answer in lines of 80 columns, without color; it ends with a line break."""
    blocks = [_heading(answer), _layers(answer.layers, answer.behavior)]
    if answer.values:
        blocks.append(_values(answer))
    blocks += [_otherwise(each) for each in answer.otherwise]
    return "\n".join("\n".join(block) + "\n" for block in blocks)


def _heading(answer: Answer) -> list[str]:
    moment = [] if answer.episode is None else [f"episode {answer.episode}"]
    moment += ["the situation given"] if answer.step is None else [f"step {answer.step}"]
    moment += [f"robot {answer.robot}"] if answer.robots > 1 else []
    did = f"{answer.behavior} controlled: {answer.action}"
    if answer.behavior == NOBODY:
        did = "Nobody controlled, and commands stayed as they were"
    return [*_wrapped(f"{answer.design}: {', '.join(moment)}"), *_wrapped(f"{did}.")]


def _layers(layers: Sequence[LayerAnswer], controlling: str) -> list[str]:
    digits = len(str(len(layers)))
    width = min(max(len(layer.behavior) for layer in layers), NAME_WIDTH)
    lines = list[str]()
    for layer in layers:
        head, indent = f"{layer.layer:>{digits}}  {layer.behavior:<{width}}  ", " " * (digits + width + 4)
        first, *rest = _sentences(layer, controlling)
        if len(head) > len(indent):
            lines.append(escape(head.rstrip()))
            head = indent
        lines += _wrapped(first, head, indent + "  ")
        lines += [line for sentence in rest for line in _wrapped(sentence, indent, indent + "  ")]
    return lines


def _sentences(layer: LayerAnswer, controlling: str) -> list[str]:
    """Return what became of a layer's wish, whether it was excited, and what it perceived."""
    wishes = {
        "controlled": f"controlled: {layer.wish}",
        "suppressed": f"wanted {layer.wish}, suppressed by {controlling}",
        "no action": "no action",
        "not excited": f"not excited; would have wanted {layer.wish}",
    }
    sentences = [wishes[layer.role]]
    if layer.condition is not None:
        holds = "excited:" if layer.excited else "does not hold:"
        sentences.append(f"{holds} {layer.condition}")
    if layer.perceived:
        sentences.append(f"perceived: {_cell_text(layer.perceived)}")
    return sentences


def _cell_text(cell: Mapping[str, str]) -> str:
    return ", ".join(f"{name} {label}" for name, label in cell.items())


def _values(answer: Answer) -> list[str]:
    shown = ", ".join(f"{name} {_value_text(value)}" for name, value in answer.values.items())
    when = "Before the step" if answer.step is not None else "Given"
    return _wrapped(f"{when}: {shown}", "", "  ")


def _value_text(value: Listed) -> str:
    if isinstance(value, tuple):
        return _list_text(value)
    if isinstance(value, bool):
        return str(value).lower()
    return f"{value:.5g}" if isinstance(value, float) else str(value)


def _list_text(values: tuple[Listed, ...]) -> str:
    """Return a list, of a long one the first values and how many there are, of truths how many are true."""
    if (count := _count(values)) <= MOST_OF_A_LIST:
        return f"[{', '.join(map(_value_text, values))}]"
    truths = [each for each in _all(values) if isinstance(each, bool)]
    if len(truths) == count:
        return f"{sum(truths)} of {count} true"
    first = [_value_text(each) for each in _all(values)][:FIRST_OF_A_LIST]
    return f"[{', '.join(first)}, ... {count} in all]"


def _count(values: Listed) -> int:
    return len([*_all(values)])


def _all(values: Listed) -> Iterator[Value]:
    if isinstance(values, tuple):
        for each in values:
            yield from _all(each)
    else:
        yield values


def _otherwise(found: Otherwise) -> list[str]:
    verb = "let" if found.wanted else "kept"
    how = f"{found.name} control" if found.wanted else f"{found.name} from control"
    return [
        *_wrapped(f"What would have {verb} {how}:"),
        *_wrapped(_perception(found), "  ", "    "),
        *_redesign(found),
    ]


def _perception(found: Otherwise) -> str:
    where = {
        "all": f"all {found.joint_size:,} situations were tried",
        "pairs": "single inputs and pairs of inputs were tried",
        "some pairs": "single inputs and pairs of inputs were tried, but for those with too many cells",
    }[found.tried]
    if not found.inputs:
        return f"No change of what it perceived ({where})."
    changes = [f"{each.input} {each.becomes} instead of {each.was}" for each in found.inputs]
    count = "one input" if len(changes) == 1 else f"{len(changes)} inputs"
    others = f"; of {found.equally_small} ways with {count}" if found.equally_small > 1 else ""
    nearest = " this is the nearest" if others else ""
    return f"Perceiving {join_words(changes, 'and')}; then {found.then} ({where}{others}{nearest})."


def _redesign(found: Otherwise) -> list[str]:
    """Return the ways to change rules or order, each on lines of its own."""
    if not found.ways:
        why = "" if found.is_excited else f": {found.name} was not excited"
        return _wrapped(f"No change of rules or order{why}.", "  ", "    ")
    n_changes = len(found.ways[0].changes)
    count = (
        "One change of rules or order"
        if n_changes == 1
        else f"{n_changes} changes of rules or order together"
    )
    title = count + (", any of:" if found.ways_in_all > 1 else ":")
    shown = found.ways[:MOST_SHOWN]
    left = found.ways_in_all - len(shown)
    ways = [f"- {_way_text(way, found)}" for way in shown] + ([f"and {left} more"] if left else [])
    return [
        *_wrapped(title, "  ", "    "),
        *(line for way in ways for line in _wrapped(way, "    ", "      ")),
    ]


def _way_text(way: Way, found: Otherwise) -> str:
    elsewhere = f" (changes {way.elsewhere:,} of {found.joint_size:,} situations)" if way.elsewhere else ""
    return f"{join_words([*map(_change_text, way.changes)], 'and also')}; then {way.then}{elsewhere}"


def _change_text(change: DesignChange) -> str:
    match change.kind:
        case "cell":
            where = f" where {_cell_text(change.cell)}" if change.cell else ""
            return f"{change.behavior} decides {change.becomes} instead of {change.was}{where}"
        case "exchange":
            return f"{change.behavior} exchanges layers with {change.other}"
    return f"{change.behavior} takes the place of {change.other} in layer {change.layer}"


def _wrapped(text: str, first: str = "", rest: str = "") -> list[str]:
    return wrap(
        escape(text),
        LINE_WIDTH,
        initial_indent=first,
        subsequent_indent=rest,
        break_long_words=False,
        break_on_hyphens=False,
    )
