"""Rules that are no list of `when`, `do` and `otherwise`."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from bbsd.expression.syntax.mistakes import KEY, WHOLE, Rewriting
from bbsd.language.field_types import scalar_text
from bbsd.language.meant.edits.layout import STEP, begins_line, column, correction, lines, stretch
from bbsd.language.meant.statements import cells_asked, inputs_of

if TYPE_CHECKING:
    from bbsd.errors import Edit
    from bbsd.expression.scope import Path
    from bbsd.language.meant.reading import Reading
    from bbsd.text import Data


def mapping_of_rules(reading: Reading) -> None:
    """Read `rules` that are one mapping of `when`, `do` and `otherwise` as a list of rules."""
    for name in [*reading.mapping(("behaviors",))]:
        path: Path = ("behaviors", name, "rules")
        value = reading.at(path)
        if not isinstance(value, dict) or not value:
            continue
        if not set(value) <= {"when", "do", "otherwise"}:
            _rules_by_cell(reading, path, value)
            continue
        rule = {key: item for key, item in value.items() if key != "otherwise"}
        items: list[Data] = [
            part for part in (rule, {k: v for k, v in value.items() if k == "otherwise"}) if part
        ]
        edits = _with_dashes(reading, path, value)
        message = "rules must be a list of rules, not a mapping: each rule begins with a dash"
        advice = "write - when: ..., and below it do: ..."
        written = correction(reading.document(path), edits, below=reading.key(path))
        reading.tell(path, "BB022", message, advice, written)
        parts: list[tuple[Path, Path]] = [
            ((at, key), (key,)) for at, item in enumerate(items) if isinstance(item, dict) for key in item
        ]
        reading.replace(path, items, parts)


def _with_dashes(reading: Reading, path: Path, value: dict[str, Data]) -> list[Edit] | None:
    source = reading.document(path).source
    edits: list[Edit] = []
    began = False
    for key in value:
        own = stretch(reading, (*path, key))
        key_node = reading.key((*path, key))
        if own is None or key_node is None:
            return None
        for offset, line in lines(source, *own):
            if not line.strip():
                continue
            is_first = offset == own[0] and (key == "otherwise" or not began)
            at = key_node.start if is_first else offset
            edits.append(source.edit(at, at, "- " if is_first else "  "))
        began = True
    return edits


def _rules_by_cell(reading: Reading, path: Path, value: dict[str, Data]) -> None:
    """Read `contact: halt`, a mapping from what is sensed to what is done, as rules."""
    inputs = inputs_of(reading, str(path[1]))
    rules = {key: _rule(key, text, inputs) for key, text in value.items()}
    if not all(rules.values()):
        return
    source = reading.document(path).source
    edits: list[Edit] = []
    for key, rule in rules.items():
        key_node, node = reading.key((*path, key)), reading.node((*path, key))
        if key_node is None or node is None or not begins_line(source, key_node.start):
            edits = []
            break
        indent = " " * column(source, key_node.start)
        edits.append(source.edit(key_node.start, node.end, _rule_text(rule or {}, indent)))
    message = "rules must be a list of rules, not a mapping: each rule begins with a dash"
    first = next(iter(rules.values())) or {}
    advice = f"write {_rule_text(first, '').replace(chr(10), ',').replace(',  ', ', and below it ')}"
    written = correction(reading.document(path), edits, below=reading.key(path))
    reading.tell(path, "BB022", message, advice, written)
    parts: list[tuple[Path, Path]] = []
    for at, (key, rule) in enumerate(rules.items()):
        parts.append(((at, "do" if rule and "do" in rule else "otherwise"), (key,)))
    reading.replace(path, [rule for rule in rules.values() if rule], parts)


def _rule(key: str, decision: Data, inputs: dict[str, Data]) -> dict[str, Data] | None:
    """Return the rule that says what is done where something holds; None where it is not known what holds."""
    if not isinstance(decision, str):
        return None
    if key in ("otherwise", "else", "default"):
        return {"otherwise": decision}
    cells = cells_asked(key, inputs)
    if cells is None and len(inputs) == 1 and re.match(r"below |from |.+ to ", key):
        cells = {next(iter(inputs)): key}
    return None if cells is None else {"when": {**cells}, "do": decision}


def _rule_text(rule: dict[str, Data], indent: str) -> str:
    if "otherwise" in rule:
        return f"- otherwise: {rule['otherwise']}"
    cells = rule["when"] if isinstance(rule["when"], dict) else {}
    when = ", ".join(f"{name}: {_cells_text(cell)}" for name, cell in cells.items())
    return f"- when: {{{when}}}\n{indent}  do: {rule['do']}"


def _cells_text(cells: Data) -> str:
    if isinstance(cells, list):
        return f"[{', '.join(map(_cells_text, cells))}]"
    return scalar_text(cells) or ""


def parts_of_rules(reading: Reading) -> None:
    """Read rules with `otherwise` beside `do`, cells without `when`, and `contact: halt` as rules."""
    for name in [*reading.mapping(("behaviors",))]:
        rules: Path = ("behaviors", name, "rules")
        value, inputs = reading.at(rules), inputs_of(reading, str(name))
        at = 0
        while isinstance(value, list) and at < len(value):
            item, path = value[at], (*rules, at)
            if isinstance(item, dict) and {*item} == {"when", "otherwise"}:
                message = "otherwise is a rule of its own; what a rule with when does stands under do"
                written = Rewriting("do", KEY)
                reading.tell((*path, "otherwise"), "BB020", message, "write do", written)
                reading.rename((*path, "otherwise"), "do")
            elif isinstance(item, dict) and "otherwise" in item and {"when", "do"} & set(item):
                _split(reading, rules, at, item)
                value = reading.at(rules)
            elif isinstance(item, dict) and not {"when", "otherwise"} & set(item):
                _with_when(reading, path, item, inputs)
            at += 1


def _split(reading: Reading, rules: Path, at: int, item: dict[str, Data]) -> None:
    path = (*rules, at)
    key, source = reading.key((*path, "otherwise")), reading.document(path).source
    edits: list[Edit] = []
    if key is not None and begins_line(source, key.start) and [*item][-1] == "otherwise":
        edits = [source.edit(key.start - STEP, key.start, "- ")]
    message = "otherwise is a rule of its own, and begins with a dash"
    written = correction(reading.document(path), edits)
    reading.tell((*path, "otherwise"), "BB022", message, f"write - otherwise: {item['otherwise']}", written)
    items = reading.at(rules)
    others = items if isinstance(items, list) else []
    first = {name: value for name, value in item.items() if name != "otherwise"}
    split = [*others[:at], first, {"otherwise": item["otherwise"]}, *others[at + 1 :]]
    # The last of parts are looked up first, and no place that one gives may be one that another looks for.
    parts: list[tuple[Path, Path]] = [((k + 1,), (k,)) for k in range(len(others) - 1, at, -1)]
    reading.replace(rules, split, [*parts, ((at + 1, "otherwise"), (at, "otherwise"))])


def _with_when(reading: Reading, path: Path, item: dict[str, Data], inputs: dict[str, Data]) -> None:
    cells = {key: value for key, value in item.items() if key != "do"}
    if not cells:
        return
    if "do" in item and all(key in inputs for key in cells):
        rule: dict[str, Data] = {"when": {**cells}, "do": item["do"]}
    elif "do" not in item and len(cells) == 1:
        ((key, decision),) = cells.items()
        found = _rule(key, decision, inputs)
        if found is None:
            return
        rule = found
    else:
        return
    source = reading.document(path).source
    edits: list[Edit] = []
    own = [(reading.key((*path, key)), reading.node((*path, key))) for key in cells]
    first, last = own[0][0], own[-1][1]
    if first is not None and last is not None and [*item][: len(cells)] == [*cells]:
        text = _rule_text(rule, " " * (column(source, first.start) - STEP)).removeprefix("- ")
        edits = [source.edit(first.start, last.end, text.split("\n")[0] if "do" in item else text)]
    message = "a rule says when, and what to do: the cells stand under when"
    shown = _rule_text(rule, "").split("\n")[0].removeprefix("- ")
    reading.tell(
        (*path, next(iter(cells))),
        "BB022",
        message,
        f"write {shown}",
        correction(reading.document(path), edits),
    )
    parts: list[tuple[Path, Path]] = [(("when", key), (key,)) for key in cells] if "do" in item else []
    reading.replace(path, rule, [*parts, *(((("do",), ("do",)),) if "do" in item else ())])


def decisions(reading: Reading) -> None:
    """Read a list of actions, and what an action sets, as the action that a rule does."""
    for name in [*reading.mapping(("behaviors",))]:
        rules = reading.at(("behaviors", name, "rules"))
        for at, item in enumerate(rules if isinstance(rules, list) else ()):
            for key in ("do", "otherwise"):
                value = item.get(key) if isinstance(item, dict) else None
                if isinstance(value, list | dict) and value:
                    _one_action(reading, ("behaviors", name, "rules", at, key), value)


def _one_action(reading: Reading, path: Path, value: list[Data] | dict[str, Data]) -> None:
    actions = reading.mapping(("behaviors", str(path[1]), "actions"))
    same = next((name for name, sets in actions.items() if sets == value), "")
    known = (
        [str(each) for each in value if isinstance(each, str) and each in actions]
        if isinstance(value, list)
        else []
    )
    new = same or next(iter(known), "") or next(iter(actions), "no action")
    if isinstance(value, dict):
        message = "a rule names an action; what is set stands below the name, under actions"
    else:
        message = "a behavior does one thing at a time: a rule names one action, not a list"
    advice = f"write {path[-1]}: {new}"
    if not same:
        advice += ", or an action of its own that sets all of this"
    reading.tell(path, "BB022", message, advice, Rewriting(new, WHOLE, is_certain=bool(same)), WHOLE)
    reading.set(path, new)
