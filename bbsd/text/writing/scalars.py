"""Single values as YAML text: plain where every reader of YAML 1.1 and 1.2 understands them, else in quotes."""

from __future__ import annotations

import math
import re

from bbsd.text.reading.traps import GLUED

# No indicator, or a minus without a blank after it; see YAML 1.2, 7.3.3 Plain Style.
SAFE_START = re.compile(r"(?:[^\s\-?:,\[\]{}#&*!|>'\"%@`]|-[^\s\-,\[\]{}])")
UNSAFE = re.compile(r":(?:\s|$)|\s#|^\.\.\.|\s$")
UNSAFE_IN_FLOW = re.compile(r"[,\[\]{}:?]")
ESCAPES = {'"': '\\"', "\\": "\\\\", "\n": "\\n", "\t": "\\t", "\r": "\\r"}


def scalar_text(value: str | float | bool | None, flow: bool = False) -> str:
    """Return a single value as YAML on one line; `flow` says whether it stands inside {...} or [...].

    Raises TypeError for a value of any other type.
    """
    match value:
        case None:
            return "null"
        case bool():
            return "true" if value else "false"
        case int():
            return int.__repr__(value)
        case float():
            return _float_text(value)
        case str():
            return value if is_plain(value, flow) else _quoted(value)
        case _:
            raise TypeError(f"{type(value).__name__} is not a plain value")


def _float_text(value: float) -> str:
    if math.isnan(value):
        return ".nan"
    if math.isinf(value):
        return ".inf" if value > 0 else "-.inf"
    return float.__repr__(value)


def is_plain(text: str, flow: bool = False) -> bool:
    """Say whether a text needs no quotes; `flow` says whether it stands inside {...} or [...]."""
    from bbsd.text.core_schema import is_text_everywhere

    if not text.isprintable() or not SAFE_START.match(text) or UNSAFE.search(text) or GLUED.match(text):
        return False
    if flow and (UNSAFE_IN_FLOW.search(text) or text.count("(") != text.count(")")):
        return False
    return is_text_everywhere(text)


def _quoted(text: str) -> str:
    if text.isprintable():
        return "'" + text.replace("'", "''") + "'"
    return '"' + "".join(_escaped(character) for character in text) + '"'


def _escaped(character: str) -> str:
    if character in ESCAPES:
        return ESCAPES[character]
    if character.isprintable():
        return character
    code = ord(character)
    if code <= 0xFF:
        return f"\\x{code:02X}"
    return f"\\u{code:04X}" if code <= 0xFFFF else f"\\U{code:08X}"


def literal_lines(text: str) -> list[str] | None:
    """Return the header and the lines, not indented, of a literal block, or None if the text cannot be one.

    It can if it has more than one line, and each is printable, not empty, and neither begins nor ends with a blank.
    """
    lines = text.removesuffix("\n").split("\n")
    if "\n" not in text or not all(line.isprintable() and line == line.strip() != "" for line in lines):
        return None
    return ["|" if text.endswith("\n") else "|-", *lines]
