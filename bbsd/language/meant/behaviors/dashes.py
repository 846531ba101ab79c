"""Rules that a dash cuts in two, and `otherwise` that stands apart from what it does."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.syntax.mistakes import KEY, WHOLE, Rewriting
from bbsd.language.field_types import scalar_text
from bbsd.language.meant.edits.layout import correction
from bbsd.language.meant.words import RULE
from bbsd.text.nodes import Scalar, Sequence

if TYPE_CHECKING:
    from bbsd.errors import Edit
    from bbsd.expression.scope import Path
    from bbsd.language.meant.reading import Reading
    from bbsd.text import Data

OTHERWISE = frozenset({"otherwise", *(word for word, key in RULE.items() if key == "otherwise")})
DO = frozenset({"do", *(word for word, key in RULE.items() if key == "do")})
WHEN = frozenset({"when", *(word for word, key in RULE.items() if key == "when")})


def divided_rules(reading: Reading) -> None:
    """Join what a dash too many makes two items: `- when: ...` and `- do: ...`, `- otherwise:` and `- do: ...`."""
    for name in [*reading.mapping(("behaviors",))]:
        rules: Path = ("behaviors", name, "rules")
        at = 0
        while isinstance(items := reading.at(rules), list) and at < len(items):
            if at + 1 < len(items) and _are_halves(items[at], items[at + 1]):
                _join(reading, rules, at, items)
            else:
                at += 1


def _are_halves(first: Data, second: Data) -> bool:
    """Return whether two items are what stands before `do` in a rule, or an empty `otherwise`, and a `do` alone."""
    if not isinstance(second, dict) or len(second) != 1 or not {*second} <= DO:
        return False
    if isinstance(first, str):
        return first in OTHERWISE
    if not isinstance(first, dict) or len(first) != 1:
        return False
    ((key, value),) = first.items()
    return key in WHEN if value is not None else key in OTHERWISE


def _join(reading: Reading, rules: Path, at: int, items: list[Data]) -> None:
    first, second = items[at], items[at + 1]
    if not isinstance(second, dict):
        return
    ((do, action),) = second.items()
    word = first if isinstance(first, str) else next(iter(first)) if isinstance(first, dict) else ""
    if word in WHEN and isinstance(first, dict):
        edits = _without_dash(reading, rules, at + 1)
        number = _line(reading, (*rules, at))
        reading.tell(
            (*rules, at + 1, do),
            "BB022",
            f"a dash too many: {do} belongs to the rule that begins in line {number}",
            f"a rule is one item, with one dash: write {do} below {word}, in its column",
            correction(reading.document(rules), edits),
        )
        joined: Data = {**first, do: action}
        parts: list[tuple[Path, Path]] = [((at, do), (at + 1, do))]
    else:
        own: Path = (*rules, at, word) if isinstance(first, dict) else (*rules, at)
        _tell_apart(reading, own, (*rules, at + 1, do), word, action)
        joined = {"otherwise": action}
        parts = [((at, "otherwise"), (at + 1, do))]
    # The last of parts are looked up first, and no place that one gives may be one that another looks for.
    behind: list[tuple[Path, Path]] = [((k,), (k + 1,)) for k in range(at + 1, len(items) - 1)]
    reading.replace(rules, [*items[:at], joined, *items[at + 2 :]], [*parts, *behind])


def _without_dash(reading: Reading, rules: Path, at: int) -> list[Edit] | None:
    """Return the edit that writes a blank for the dash of an item."""
    node, source = reading.node(rules), reading.document(rules).source
    item = reading.node((*rules, at))
    if not isinstance(node, Sequence) or node.flow or item is None:
        return None
    dash = source.text.rfind("-", source.line_start(item.start), item.start)
    return [source.edit(dash, dash + 1, " ")] if dash >= 0 else None


def _line(reading: Reading, path: Path) -> int:
    node = reading.node(path)
    return reading.document(path).source.line_number(node.start) if node else 0


def otherwise_apart(reading: Reading) -> None:
    """Read `otherwise:` and below it `do: halt`, and `when: otherwise` with `do`, as `otherwise: halt`."""
    for name in [*reading.mapping(("behaviors",))]:
        rules: Path = ("behaviors", name, "rules")
        items = reading.at(rules)
        for at, item in enumerate(items if isinstance(items, list) else ()):
            if not isinstance(item, dict):
                continue
            path, keys = (*rules, at), [*item]
            word = keys[0] if keys else ""
            value = item.get(word)
            if len(keys) == 2 and keys[1] in DO and word in OTHERWISE and value is None:
                _tell_apart(reading, (*path, word), (*path, keys[1]), word, item[keys[1]])
                reading.replace(path, {"otherwise": item[keys[1]]}, [(("otherwise",), (keys[1],))])
            elif (
                len(keys) == 2
                and keys[1] in DO
                and word in WHEN
                and isinstance(value, str)
                and value in OTHERWISE
            ):
                _tell_apart(reading, (*path, word), (*path, keys[1]), str(value), item[keys[1]])
                reading.replace(path, {"otherwise": item[keys[1]]}, [(("otherwise",), (keys[1],))])
            elif keys == ["do"] and isinstance(items, list) and 0 < at == len(items) - 1:
                message = "this rule has no when: the last one, for all that is left, is called otherwise"
                written = Rewriting("otherwise", KEY, is_certain=False)
                reading.tell((*path, "do"), "BB021", message, "write otherwise, or add its when", written)
                reading.rename((*path, "do"), "otherwise")
            elif (
                keys == [word] and word in OTHERWISE and isinstance(value, dict) and {*value} <= DO and value
            ):
                ((do, action),) = value.items()
                _tell_apart(reading, (*path, word), (*path, word, do), word, action)
                reading.replace(path, {"otherwise": action}, [(("otherwise",), (word, do))])


def _tell_apart(reading: Reading, path: Path, do: Path, word: str, action: Data) -> None:
    """Tell once that what is done stands behind `otherwise`; `path` and `do` are the two parts."""
    document, node = reading.document(path), reading.node(do)
    begins = reading.key(path) if isinstance(path[-1], str) else reading.node(path)
    edits = None
    if begins is not None and isinstance(node, Scalar) and not node.is_unwritten:
        text = document.source.text[node.start : node.end]
        edits = [document.source.edit(begins.start, node.end, f"otherwise: {text}")]
    shown = scalar_text(action) or "..."
    reading.tell(
        path,
        "BB022",
        f"{word} and {do[-1]} are one: what is done stands behind otherwise",
        f"write - otherwise: {shown}",
        correction(document, edits),
        KEY if isinstance(path[-1], str) else WHOLE,
    )
