"""Diagnoses as people and programs read them."""

from __future__ import annotations

import unicodedata
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

    from bbsd.errors.diagnosis import Diagnosis, Place

TAB = "    "
BEFORE, SHOWN = 60, 160  # of a long line, characters shown before the place and in all
BOLD, RED, BLUE, PLAIN = "\x1b[1m", "\x1b[1;31m", "\x1b[1;34m", "\x1b[0m"


def escape(text: str) -> str:
    """Return the text with what steers a terminal or hides (control and format characters) written out."""
    return "".join(_visible(character) for character in text)


def _visible(character: str) -> str:
    if character.isprintable() or unicodedata.category(character) in {"Zs", "Co"}:
        return character
    return character.encode("unicode_escape").decode("ascii")


def _width(text: str) -> int:
    """Return the columns of a text, of which East Asian wide characters take two and combining ones none."""
    wide = sum(unicodedata.east_asian_width(character) in {"W", "F"} for character in text)
    return len(text) + wide - sum(unicodedata.category(character) in {"Mn", "Me"} for character in text)


def _shown(text: str) -> str:
    return TAB.join(escape(part) for part in text.split("\t"))


def render_text(diagnosis: Diagnosis, source_line: str, color: bool = False) -> str:
    """Return the diagnosis as `file:line:column: error[code]: message`, source line, caret and advice.

    Without a source line (there is no file, say) only the first line and the advice. It ends without a
    line break.
    """
    place = diagnosis.place
    head = f"{escape(place.file)}:{place.line}:{place.column}: "
    error = _colored(f"error[{diagnosis.code}]", RED, color)
    lines = [head + error + ": " + _colored(escape(diagnosis.message), BOLD, color)]
    if source_line:
        lines += _excerpt(place, source_line, color)
    if diagnosis.advice:
        lines.append(f"      {_colored('=', BLUE, color)} {escape(diagnosis.advice)}")
    return "\n".join(lines)


def _excerpt(place: Place, source_line: str, color: bool) -> list[str]:
    start = place.column - 1
    first = max(0, start - BEFORE) if len(source_line) > SHOWN else 0
    last = first + SHOWN
    left = ("…" if first else "") + _shown(source_line[first:start])
    marked = _shown(source_line[start : min(start + place.length, last)])
    right = _shown(source_line[start + place.length : last]) + ("…" if last < len(source_line) else "")
    caret = " " * _width(left) + _colored("^" * max(1, _width(marked)), RED, color)
    return [
        _colored(f"{place.line:>5} |", BLUE, color) + f" {left}{marked}{right}",
        _colored("      |", BLUE, color) + f" {caret}",
    ]


def _colored(text: str, style: str, color: bool) -> str:
    return f"{style}{text}{PLAIN}" if color else text


def render_json(diagnoses: Iterable[Diagnosis]) -> list[dict[str, str | int]]:
    """Return objects for JSON: file, line, column, end_column (exclusive), code, message, advice."""
    return [
        {
            "file": each.place.file,
            "line": each.place.line,
            "column": each.place.column,
            "end_column": each.place.column + each.place.length,
            "code": each.code,
            "message": each.message,
            "advice": each.advice,
        }
        for each in diagnoses
    ]
