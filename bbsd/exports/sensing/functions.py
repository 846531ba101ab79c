"""The elementary functions of the tool in C, and what calls them."""

from __future__ import annotations

import re
from functools import cache
from importlib.resources import files
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

PREFIX = "bbsd_"
"""Begins the names of the functions that this tool defines in C."""
IN_MATH_H = {"abs": "fabs", "ceil": "ceil", "floor": "floor", "sqrt": "sqrt"}
"""Operations that the functions of C's library carry out, as their results are exact or rounded once."""
NAME = re.compile(r"\bbbsd_\w+")
MACRO = "BBSD_SHIFT"


def function_of(operation: str) -> str:
    """Return the function of C that carries out an operation of graphs."""
    return IN_MATH_H.get(operation, PREFIX + operation)


@cache
def _blocks() -> Mapping[str, str]:
    """Return the text of each function and of the macro, by name, each after those that it uses."""
    text = files("bbsd.exports.sensing").joinpath("elementary.h").read_text(encoding="utf-8")
    blocks = [block.strip() for block in re.split(r"\n\n(?=/\*|static|#define)", text)]
    return {_name(block): block for block in blocks}


def _name(block: str) -> str:
    if block.startswith("#define"):
        return MACRO
    defined = re.search(r"^static inline \w+ (\w+)\(", block, re.MULTILINE)
    if defined is None:
        raise ValueError(f"no function is defined here: {block[:80]}")
    return defined[1]


def functions_text(used: Iterable[str]) -> list[str]:
    """Return the definitions of functions and of all that they use in turn, each guarded against a second one."""
    needed, waiting, blocks = set[str](), {name for name in used if name.startswith(PREFIX)}, _blocks()
    while waiting:
        name = waiting.pop()
        needed.add(name)
        uses = {*NAME.findall(blocks[name]), *([MACRO] if MACRO in blocks[name] else [])}
        waiting |= (uses & blocks.keys()) - needed
    return [_guarded(name, block) for name, block in blocks.items() if name in needed]


def _guarded(name: str, block: str) -> str:
    guard = f"{name.upper()}_DEFINED"
    return f"#ifndef {guard}\n#define {guard}\n{block}\n#endif"
