"""Keys by other names, and keys in the wrong block."""

from __future__ import annotations

from difflib import get_close_matches
from typing import TYPE_CHECKING

from bbsd.errors.suggestion import MAX_WORD
from bbsd.expression.syntax.mistakes import KEY, Rewriting
from bbsd.language.base import FREE
from bbsd.language.goals import is_goal
from bbsd.language.keys import blocks_with, fields_at
from bbsd.language.meant.depth import blocks
from bbsd.language.meant.layout import correction, moved
from bbsd.language.validation import named
from bbsd.text.nodes import Scalar

if TYPE_CHECKING:
    from bbsd.errors import Correction
    from bbsd.expression.scope import Path
    from bbsd.language.meant.reading import Reading

NEAR = 0.75
"""How much two keys are alike, from 0 to 1, where one certainly misspells the other."""
TOP = {
    "behaviour": "behaviors",
    "behaviours": "behaviors",
    "behavior": "behaviors",
    "modules": "behaviors",
    "skills": "behaviors",
    "rewards": "reward",
    "env": "environment",
    "params": "constants",
    "parameters": "constants",
    "const": "constants",
    "title": "name",
    "description": "summary",
    "layers": "structure",
    "order": "structure",
    "priorities": "structure",
    "priority": "structure",
    "hierarchy": "structure",
    "arbitration": "structure",
    "version": "bbsd",
    "language": "bbsd",
    "include": "extends",
    "import": "extends",
    "base": "extends",
    "inherits": "extends",
    "based_on": "extends",
    "parent": "extends",
    "training": "design",
    "optimizer": "design",
    "plot": "view",
    "render": "view",
    "visualization": "view",
}
ENVIRONMENT = {
    "states": "state",
    "variables": "state",
    "sensor": "sensors",
    "observations": "sensors",
    "transition": "dynamics",
    "transitions": "dynamics",
    "updates": "dynamics",
    "update": "dynamics",
    "timesteps": "steps",
    "time_steps": "steps",
    "max_steps": "steps",
    "horizon": "steps",
    "length": "steps",
    "num_robots": "robots",
    "n_robots": "robots",
    "agents": "robots",
    "n_agents": "robots",
    "done": "ends",
    "terminal": "ends",
    "terminates": "ends",
    "termination": "ends",
    "functions": "definitions",
    "macros": "definitions",
    "terminated": "ends",
    "is_done": "ends",
    "until": "ends",
    "end": "ends",
    "stop": "ends",
    "finished": "ends",
    "max_episode_steps": "steps",
    "episode_length": "steps",
    "episode_steps": "steps",
    "n_steps": "steps",
    "num_steps": "steps",
    "duration": "steps",
    "initial_state": "state",
    "init": "state",
    "initial": "state",
    "start": "state",
    "percepts": "sensors",
    "perception": "sensors",
    "sensing": "sensors",
    "gym": "gymnasium",
    "env_id": "gymnasium",
    "kwargs": "with",
    "arguments": "with",
    "args": "with",
    "options": "with",
}
BEHAVIOR = {
    "sensors": "inputs",
    "observations": "inputs",
    "observes": "inputs",
    "sees": "inputs",
    "senses": "inputs",
    "condition": "excited",
    "active": "excited",
    "activation": "excited",
    "trigger": "excited",
    "if": "excited",
    "when": "excited",
    "outputs": "actions",
    "effects": "actions",
    "policy": "rules",
    "guard": "excited",
    "enabled": "excited",
    "precondition": "excited",
    "preconditions": "excited",
    "activate": "excited",
    "postcondition": "expects",
    "ensures": "expects",
    "expect": "expects",
    "percepts": "inputs",
    "perceives": "inputs",
}
RULE = {
    "then": "do",
    "action": "do",
    "act": "do",
    "if": "when",
    "case": "when",
    "condition": "when",
    "else": "otherwise",
    "default": "otherwise",
    "where": "when",
    "given": "when",
    "cells": "when",
    "output": "do",
    "choose": "do",
    "select": "do",
}
ORDER = "the order in structure is the priority, from the highest layer down"
NOWHERE = {"priority": ORDER, "level": ORDER, "layer": ORDER, "rank": ORDER, "weight": ORDER, "order": ORDER}
"""Keys of behaviors that have no place in a spec, and what says instead what they should."""


def other_names(reading: Reading) -> None:
    """Rename keys of other tools, and misspelled ones, where the right key is not there."""
    for path in [*blocks(reading), *_rules(reading)]:
        fields = fields_at(path) or {}
        for key in _unexpected(reading, path):
            free = [name for name in fields if name not in reading.mapping(path)]
            new = _synonyms(path).get(key)
            if new is not None and new in free:
                _rename(reading, (*path, key), new, is_certain=True)
            elif not blocks_with(key) and (near := _near(key, free)):
                _rename(reading, (*path, key), near[0], is_certain=near[1])


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
    reading.tell((key,), "BB020", f'unexpected key "{key}" here: it belongs into a behavior', advice)
    for behavior in behaviors.values():
        if not isinstance(behavior, dict):
            continue
        own = behavior.get(key)
        if own is None or (isinstance(own, list) and isinstance(value, dict)):
            behavior[key] = value
    reading.remove((key,))


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
