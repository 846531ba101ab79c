"""Names that cannot be names, and keys of dynamics that say a derivative or one robot's value."""

from __future__ import annotations

import re
from keyword import kwlist
from typing import TYPE_CHECKING

from bbsd.expression.reserved import RESERVED, Use, another_name
from bbsd.expression.syntax.mistakes import KEY, Rewriting
from bbsd.expression.syntax.parsing import NAME
from bbsd.language.field_types import scalar_text
from bbsd.language.keys import fields_at
from bbsd.language.meant.edits.layout import correction
from bbsd.language.meant.edits.uses import uses
from bbsd.language.meant.forms import named_blocks
from bbsd.text.nodes import Scalar

if TYPE_CHECKING:
    from bbsd.expression.scope import Path
    from bbsd.language.meant.reading import Reading
    from bbsd.text import Data

TIME_STEPS = ("dt", "delta_t", "time_step", "tick")
RULE = "names are small letters, digits and _, a letter first"
DERIVATIVES = (
    r"d_?(?P<name>{0})/dt",
    r"d(?P<name>{0})_dt",
    r"(?P<name>{0})_dot",
    r"(?P<name>{0})'",
    r"d_(?P<name>{0})",
    r"dot_(?P<name>{0})",
)
NEXT = (
    r"next_(?P<name>{0})",
    r"(?P<name>{0})_next",
    r"(?P<name>{0})_new",
    r"new_(?P<name>{0})",
    r"(?P<name>{0})\(t ?\+ ?1\)",
    r"(?P<name>{0})\[t ?\+ ?1\]",
)


def keys_of_dynamics(reading: Reading) -> None:
    """Read `dheading/dt: turn`, `next_x: ...` and `x[0]: ...` in dynamics as the next value of that state."""
    stored = {**reading.mapping(("environment", "state")), **reading.mapping(("environment", "world"))}
    dynamics: Path = ("environment", "dynamics")
    for key in [*reading.mapping(dynamics)]:
        if key in stored or not stored:
            continue
        path, any_name = (*dynamics, key), "|".join(map(re.escape, stored))
        if name := _matched(key, DERIVATIVES, any_name):
            _derivative(reading, path, name)
        elif (match := ELEMENT.fullmatch(key)) and "list(" in str(stored.get(match["name"], "")):
            _element(reading, path, match["name"], str(stored[match["name"]]))
        elif name := _matched(key, (*NEXT, r"(?P<name>{0})\[\s*(?:\d+|r|i|robot)\s*\]"), any_name):
            message = f"the rule of {name} is the same for every robot: its key is {name}"
            if "[" not in key:
                message = f"dynamics say the next value of state: its key is {name}"
            if isinstance(stored[name], list) or "list(" in str(stored[name]):
                continue
            reading.tell(path, "BB024", message, "", Rewriting(name, KEY, is_certain="[" not in key))
            reading.rename(path, name) if name not in reading.mapping(dynamics) else reading.remove(path)


ELEMENT = re.compile(r"(?P<name>[a-z]\w*)(?P<indices>(?:\[[^\[\]]+\])+)")
LISTED = re.compile(r"list\((?P<inner>.*) for (?P<name>\w+) in range\((?P<length>.+?)\)\)")


def _element(reading: Reading, path: Path, name: str, start: str) -> None:
    """Read `waiting[floor]: 0` in dynamics as the list as a whole, with that element changed."""
    key = str(path[-1])
    indices = [index.strip() for index in re.findall(r"\[([^\[\]]+)\]", key)]
    lengths: list[str] = []
    while match := LISTED.fullmatch(start.strip()):
        lengths.append(match["length"])
        start = match["inner"]
    if len(indices) != len(lengths):
        return
    free = [letter for letter in "kjihg" if not re.search(rf"\b{letter}\b", key + str(reading.at(path)))]
    names = free[: len(indices)]
    which = " and ".join(f"{own} == {index}" for own, index in zip(names, indices, strict=False))
    text = f"{scalar_text(reading.at(path))} if {which} else {name}{''.join(f'[{own}]' for own in names)}"
    for own, length in zip(reversed(names), reversed(lengths), strict=False):
        text = f"list({text} for {own} in range({length}))"
    node, key_node, document = reading.node(path), reading.key(path), reading.document(path)
    edits = None
    if key_node is not None and isinstance(node, Scalar):
        edits = [document.source.edit(key_node.start, node.end, f"{name}: {text}")]
    message = f'"{key}" is an element of a list, and only actions set single elements'
    is_certain = name not in reading.mapping(path[:-1])
    written = correction(document, edits, is_certain=is_certain)
    reading.tell(path, "BB134", message, f"set the list as a whole, {name}: {text}", written)
    reading.remove(path)
    if is_certain:
        reading.set((*path[:-1], name), text)


LAMBDA = re.compile(r"lambda\s+(?P<parameters>[\w, ]*?)\s*:\s*(?P<value>.+)", re.DOTALL)
FUNCTION = re.compile(r"(?:def|function|fn|func)\s+(?P<key>\w+\s*\([\w, ]*\))")


def functions(reading: Reading) -> None:
    """Read `near: lambda a, b: ...`, and `def near(a, b): return ...`, as definitions with parameters."""
    block: Path = ("environment", "definitions")
    for key in [*reading.mapping(block)]:
        path, text = (*block, key), scalar_text(reading.at((*block, key))) or ""
        if match := LAMBDA.fullmatch(text.strip()):
            new, value = f"{key}({match['parameters']})", match["value"]
        elif match := FUNCTION.fullmatch(key.strip()):
            new, value = match["key"], text.strip().removeprefix("return ")
        else:
            continue
        node, key_node, document = reading.node(path), reading.key(path), reading.document(path)
        edits = None
        if key_node is not None and isinstance(node, Scalar):
            edits = [document.source.edit(key_node.start, node.end, f"{new}: {value}")]
        message = "a definition has its parameters in its key, and is its value"
        written = correction(document, edits)
        reading.tell(path, "BB051", message, f"write {new}: {value}", written)
        reading.rename(path, new)
        reading.set((*block, new), value)


def _matched(key: str, patterns: tuple[str, ...], names: str) -> str | None:
    return next(
        (match["name"] for each in patterns if (match := re.fullmatch(each.format(names), key.strip()))), None
    )


def _derivative(reading: Reading, path: Path, name: str) -> None:
    rate = scalar_text(reading.at(path)) or ""
    step = _time_step(reading)
    factor = rate if re.fullmatch(r"[\w.]+(?:\([^()]*\))?", rate) else f"({rate})"
    text = f"{name} + {step} * {factor}"
    key, node, document = reading.key(path), reading.node(path), reading.document(path)
    edits = None
    if key is not None and isinstance(node, Scalar):
        edits = [document.source.edit(key.start, node.end, f"{name}: {text}")]
    message = f"dynamics say the next value of {name}, not its derivative"
    advice = f"write {name}: {text}" + ("" if step in TIME_STEPS else ", where a step takes 0.1")
    reading.tell(path, "BB024", message, advice, correction(document, edits, is_certain=False))
    reading.remove(path)
    if name not in reading.mapping(path[:-1]):
        reading.set((*path[:-1], name), text)


def _time_step(reading: Reading) -> str:
    """Return the time of a step: the constant that a spec has for it, else a usual one."""
    constants = reading.mapping(("constants",))
    return next((name for name in TIME_STEPS if name in constants), "0.1")


def names(reading: Reading) -> None:
    """Read names with capitals, blanks and dashes as those with _ that they should be, where they are used too."""
    for path in named_blocks(reading):
        for old in [*reading.mapping(path)]:
            if old in WORDS_OF_PYTHON and path != ("behaviors",):
                _reserved(reading, path, old)
                continue
            new = _with_underscores(old)
            if NAME.match(old) or "(" in old or new is None or new in reading.mapping(path):
                continue
            block, _, inner = old.partition(".")
            if inner in (fields_at((*path, block)) or ()):
                advice = f"write {block}: and, in the line below, {inner}:"
                reading.tell(
                    (*path, old), "BB024", f'"{old}" cannot be a name, nor a path to {inner}', advice
                )
                reading.remove((*path, old))
                continue
            _rename(reading, path, old, new, is_certain="." not in old)


IN_SPECS = frozenset({"and", "or", "not", "if", "else", "for", "in", "is", "from"})
WORDS_OF_PYTHON = frozenset(kwlist) & RESERVED[Use.VALUE].keys() - IN_SPECS
"""Names that no value can have, and that nothing but a name can mean in a spec."""


def _reserved(reading: Reading, path: Path, old: str) -> None:
    new = another_name(old)
    if path[-1] in ("actions", "reward") or new in reading.mapping(path):
        return
    message = f'"{old}" cannot be {Use.VALUE.value}: {RESERVED[Use.VALUE][old]}'
    _rename(reading, path, old, new, message, f"write another one, such as {new}", is_certain=False)


def _with_underscores(name: str) -> str | None:
    new = re.sub(r"[\s\-.]+", "_", re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name.strip())).lower()
    return new if NAME.match(new) else None


def _rename(
    reading: Reading,
    path: Path,
    old: str,
    new: str,
    message: str = "",
    advice: str = "",
    *,
    is_certain: bool = True,
) -> None:
    key, document = reading.key((*path, old)), reading.document((*path, old))
    edits = []
    if key is not None:
        edits = [document.source.edit(key.start, key.end, new)]
        found = uses(document.root, old, _pattern(old)) if document.root else ()
        edits += [document.source.edit(start, end, new) for start, end in found if start != key.start]
    message = message or f'"{old}" cannot be a name; {RULE}'
    written = correction(document, edits, is_certain=is_certain)
    reading.tell((*path, old), "BB024", message, advice or f"write {new}", written)
    reading.rename((*path, old), new)
    _use_new(reading.data, old, new)


def _pattern(old: str) -> re.Pattern[str]:
    return re.compile(rf"(?<![\w.\-]){re.escape(old)}(?![\w\-]|\s*\()")


def _use_new(data: Data, old: str, new: str) -> Data:
    """Replace a name in all texts of data."""
    if isinstance(data, dict):
        for key in [*data]:
            data[key] = _use_new(data[key], old, new)
    elif isinstance(data, list):
        data[:] = [_use_new(item, old, new) for item in data]
    elif isinstance(data, str):
        return _pattern(old).sub(new, data)
    return data
