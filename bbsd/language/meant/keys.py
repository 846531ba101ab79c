"""Keys by other names, and keys in the wrong block."""

from __future__ import annotations

from difflib import get_close_matches
from typing import TYPE_CHECKING, get_args

from bbsd.errors.suggestion import MAX_WORD
from bbsd.expression.syntax.mistakes import KEY, WHOLE, Rewriting
from bbsd.language.base import FREE
from bbsd.language.field_types import scalar_text
from bbsd.language.goals import is_goal
from bbsd.language.keys import blocks_with, fields_at
from bbsd.language.meant.depth import blocks
from bbsd.language.meant.edits.layout import column, correction, moved, stretch
from bbsd.language.meant.words import BEHAVIOR, ENVIRONMENT, RULE, TOP
from bbsd.language.validation import named
from bbsd.text.nodes import Mapping, Scalar

if TYPE_CHECKING:
    from bbsd.errors import Correction, Edit
    from bbsd.expression.scope import Path
    from bbsd.language.meant.reading import Reading

NEAR = 0.75
"""How much two keys are alike, from 0 to 1, where one certainly misspells the other."""
ORDER = "the order in structure is the priority, from the highest layer down"
NOWHERE = {"priority": ORDER, "level": ORDER, "layer": ORDER, "rank": ORDER, "weight": ORDER, "order": ORDER}
"""Keys of behaviors that have no place in a spec, and what says instead what they should."""


def other_names(reading: Reading) -> None:
    """Rename keys of other tools, and misspelled ones, where the right key is not there."""
    for path in [*blocks(reading), *_rules(reading)]:
        fields = fields_at(path) or {}
        if path[2:3] == ("rules",) and _whole_rule(reading, path):
            continue
        for key in _unexpected(reading, path):
            free = [name for name in fields if name not in reading.mapping(path)]
            new = _synonyms(path).get(key)
            if new is not None and new in free:
                _rename(reading, (*path, key), new, is_certain=True)
            elif not blocks_with(key) and (near := _near(key, free)):
                _rename(reading, (*path, key), near[0], is_certain=near[1])


def _whole_rule(reading: Reading, path: Path) -> bool:
    """Rename both keys of `if: ..., then: ...` as one mistake; return whether a rule is written so."""
    keys = [*reading.mapping(path)]
    new = [RULE.get(key, "") for key in keys]
    own = [reading.key((*path, key)) for key in keys]
    if sorted(new) != ["do", "when"] or {*keys} & {*new} or None in own:
        return False
    source = reading.document(path).source
    edits = [
        source.edit(each.start, each.end, name)
        for each, name in zip(own, new, strict=True)
        if each is not None
    ]
    message = f'unexpected keys "{keys[0]}" and "{keys[1]}"; a rule has when and do'
    written = correction(reading.document(path), edits)
    reading.tell((*path, keys[0]), "BB020", message, f"write {new[0]} and {new[1]}", written)
    for key, name in zip(keys, new, strict=True):
        reading.rename((*path, key), name)
    return True


def _unexpected(reading: Reading, path: Path) -> list[str]:
    """Return keys of a block that it does not have, but for free ones and words for what is good or bad."""
    fields = fields_at(path)
    if fields is None:
        return []
    keys = (key for key in reading.mapping(path) if key not in fields and not key.startswith(FREE))
    return [key for key in keys if not is_goal((*path, key))]


def _rules(reading: Reading) -> list[Path]:
    return [
        ("behaviors", name, "rules", at)
        for name, behavior in reading.mapping(("behaviors",)).items()
        if isinstance(behavior, dict) and isinstance(rules := behavior.get("rules"), list)
        for at in range(len(rules))
    ]


def _synonyms(path: Path) -> dict[str, str]:
    match path:
        case ():
            return TOP
        case ("environment",):
            return ENVIRONMENT
        case ("behaviors", _):
            return BEHAVIOR
        case ("behaviors", _, "rules", _):
            return RULE
    return {}


def _near(key: str, names: list[str]) -> tuple[str, bool] | None:
    """Return the name that a key misspells, and whether that is certain."""
    if len(key) > MAX_WORD:
        return None
    if near := get_close_matches(key, names, n=1):
        return near[0], bool(get_close_matches(key, near, cutoff=NEAR))
    return None


def _rename(reading: Reading, path: Path, key: str, *, is_certain: bool) -> None:
    old = str(path[-1])
    message = f'unexpected key "{old}"; did you mean "{key}"?'
    reading.tell(path, "BB020", message, "", Rewriting(key, is_certain=is_certain, span=KEY))
    reading.rename(path, key)


def wrong_block(reading: Reading) -> None:
    """Move keys that have their place in one other block there."""
    for path in [*blocks(reading)]:
        for key in _unexpected(reading, path):
            targets = blocks_with(key)
            if len(targets) != 1:
                continue
            if targets[0] == "a behavior" and path == ():
                _into_behaviors(reading, key)
            elif not targets[0].startswith("a "):
                block = () if targets[0] == "the top level" else tuple(targets[0].split("."))
                _move(reading, (*path, key), block)


def _move(reading: Reading, old: Path, block: Path) -> None:
    key = str(old[-1])
    if key in reading.mapping(block) or not (block == () or isinstance(reading.at(block), dict | type(None))):
        return
    where = ".".join(map(str, block)) or "the top level"
    advice = f"it belongs into {where}"
    document = reading.document(old)
    written = correction(document, moved(reading, old, block)) or _wrapped(reading, old, block)
    reading.tell(old, "BB020", f'unexpected key "{key}" here', advice, written)
    reading.move(old, (*block, key))


def _wrapped(reading: Reading, old: Path, block: Path) -> Correction | None:
    """Return the correction that writes a value on one line with the blocks around it that are not there."""
    document, node, key = reading.document(old), reading.node(old), reading.key(old)
    missing = block[len(old) - 1 :]
    if block[: len(old) - 1] != old[:-1] or not missing or reading.at((*old[:-1], missing[0])) is not None:
        return None
    if key is None or not isinstance(node, Scalar):
        return None
    source = document.source
    inner = source.text[key.start : node.end]
    for name in reversed(missing):
        inner = f"{name}: {{{inner}}}"
    return correction(document, [source.edit(key.start, node.end, inner)])


def _into_behaviors(reading: Reading, key: str) -> None:
    """Give what stands at the top, and belongs into a behavior, to all behaviors that have none of it."""
    value = reading.at((key,))
    behaviors = reading.mapping(("behaviors",))
    example = next(iter(behaviors), "a behavior")
    advice = f"each behavior has its own: write it below {example}"
    written = correction(reading.document((key,)), _copied(reading, key), is_certain=False)
    reading.tell((key,), "BB020", f'unexpected key "{key}" here: it belongs into a behavior', advice, written)
    for behavior in behaviors.values():
        if not isinstance(behavior, dict):
            continue
        own = behavior.get(key)
        if own is None or (isinstance(own, list) and isinstance(value, dict)):
            behavior[key] = value
    reading.remove((key,))


def _copied(reading: Reading, key: str) -> list[Edit] | None:
    """Return the edits that move a block from the top into each behavior that has none of it, or lists its names."""
    own, node = stretch(reading, (key,)), reading.node((key,))
    source = reading.document((key,)).source
    if own is None or not isinstance(node, Mapping) or node.flow:
        return None
    edits = [source.edit(own[0], min(own[1] + 1, len(source.text)), "")]
    for name in reading.mapping(("behaviors",)):
        path: Path = ("behaviors", name)
        behavior = reading.at(path)
        value = behavior.get(key) if isinstance(behavior, dict) else None
        inner = stretch(reading, path)
        first = next(iter(behavior), None) if isinstance(behavior, dict) else None
        below = reading.key((*path, first)) if first is not None else None
        if inner is None or below is None or not (value is None or isinstance(value, list)):
            continue
        indent = " " * column(source, below.start)
        entries = [
            source.text[source.line_start(entry.key.start) : entry.value.end]
            for inner_key, entry in node.entries.items()
            if value is None or inner_key in value
        ]
        text = "\n".join(f"{indent}{line}" for entry in entries for line in entry.split("\n"))
        if value is None:
            edits.append(source.edit(inner[1], inner[1], f"\n{indent}{key}:\n{text}"))
        elif (listed := stretch(reading, (*path, key))) is not None:
            edits.append(source.edit(*listed, f"{indent}{key}:\n{text}"))
    return edits if len(edits) > 1 else None


OPTIONS = {
    "seed": "--seed",
    "seeds": "--seeds",
    "random_seed": "--seed",
    "jobs": "--jobs",
    "workers": "--jobs",
    "out": "--out",
    "output": "--out",
    "output_dir": "--out",
    "time_limit": "--time-limit",
    "runs": "--runs",
}
"""What is no part of a spec, and by which option a design is told of it."""


def options_of_commands(reading: Reading) -> None:
    """Take away keys of what is said on the command line, such as the seed."""
    for path in ((), ("environment",), ("design",)):
        for key in [*reading.mapping(path)]:
            option = OPTIONS.get(key)
            if option is None or key in (fields_at(path) or {}):
                continue
            value = scalar_text(reading.at((*path, key))) or "..."
            message = f'unexpected key "{key}": a spec is the same with any; it is an option of the command'
            advice = f"remove this line, and write: bbsd design {reading.files.source.file} {option} {value}"
            reading.tell((*path, key), "BB020", message, advice)
            reading.remove((*path, key))


METHODS = {
    "genetic": "paper",
    "ga": "paper",
    "evolution": "paper",
    "evolutionary": "paper",
    "coevolution": "paper",
    "cem": "cross_entropy",
    "ce": "cross_entropy",
    "q_learning": "q",
    "qlearning": "q",
    "rl": "q",
    "hill_climbing": "hill",
    "default": "auto",
    "none": "auto",
}
"""What methods of design are called elsewhere."""


def methods(reading: Reading) -> None:
    """Read another name of a method as the method."""
    path: Path = ("design", "method")
    value = reading.at(path)
    new = METHODS.get(value.lower().replace("-", "_")) if isinstance(value, str) else None
    if new is not None:
        field = (fields_at(("design",)) or {})["method"]
        message = (
            f'there is no method "{value}": it is one of {", ".join(map(str, get_args(field.annotation)))}'
        )
        written = Rewriting(new, WHOLE, is_certain=False)
        reading.tell(path, "BB023", message, f"{new} is the nearest", written, WHOLE)
        reading.set(path, new)


def without_place(reading: Reading) -> None:
    """Take away keys that have no place, and of which something else says what they should."""
    for name in [*reading.mapping(("behaviors",))]:
        path = ("behaviors", name)
        for key in [*reading.mapping(path)]:
            if key in NOWHERE:
                advice = f"remove this line; list {named(path)} in structure where it belongs"
                if reading.data.get("structure") is None:
                    layers = ", ".join(reading.mapping(("behaviors",)))
                    advice = (
                        f"remove this line, and write at the end: structure: [{layers}], the highest priority first "
                        "(without structure, the order is designed)"
                    )
                reading.tell((*path, key), "BB020", f'unexpected key "{key}": {NOWHERE[key]}', advice)
                reading.remove((*path, key))
