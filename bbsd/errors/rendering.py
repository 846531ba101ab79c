"""Diagnoses as text for people and as JSON for programs."""

from __future__ import annotations

import unicodedata
from typing import TYPE_CHECKING, Any

from bbsd.errors.kinds.kind import Severity

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from bbsd.errors.correction import CorrectedLine, Correction
    from bbsd.errors.diagnosis import Diagnosis, Place

TAB = "    "
UNREAD = "BB001"
"""The code of a file that cannot be read, in which there are no places."""
MOST_CORRECTED = 6
"""Corrected lines that are shown."""
BEFORE, SHOWN = 60, 160  # the characters of a long line that are shown before the place, and in all
BOLD, RED, GREEN, YELLOW, BLUE = "\x1b[1m", "\x1b[1;31m", "\x1b[1;32m", "\x1b[1;33m", "\x1b[1;34m"
PLAIN = "\x1b[0m"
STYLES = {Severity.MISTAKE: RED, Severity.WARNING: YELLOW}


def escape(text: str) -> str:
    """Return a text with what steers a terminal, hides or looks like a blank as visible escapes."""
    return "".join(_visible(character) for character in text)


def character_name(character: str) -> str:
    """Return what Unicode calls a character: `U+00A0 (no-break space)`."""
    name = unicodedata.name(character, "").lower()
    return f"U+{ord(character):04X}" + (f" ({name})" if name else "")


def _visible(character: str) -> str:
    if character.isprintable() or unicodedata.category(character) == "Co":
        return character
    return character.encode("unicode_escape").decode("ascii")


def _width(text: str) -> int:
    """Return how many columns a text takes: two for an East Asian wide character, none for a combining one."""
    wide = sum(unicodedata.east_asian_width(character) in {"W", "F"} for character in text)
    return len(text) + wide - sum(unicodedata.category(character) in {"Mn", "Me"} for character in text)


def _shown(text: str) -> str:
    return TAB.join(escape(part) for part in text.split("\t"))


def render_text(
    diagnosis: Diagnosis, source_line: str, color: bool = False, corrected: Sequence[CorrectedLine] = ()
) -> str:
    """Return a diagnosis as `file:line:column: error[code]: message`, source line, caret, corrected lines and advice.

    A warning has `warning[code]` instead. Without a source line (there is no file, say) only the message and the
    advice are shown. Corrected lines stand beside `write`, or beside `maybe` where there are other readings. The text
    ends without a line break.
    """
    place = diagnosis.place
    head = (
        f"{escape(place.file)}: "
        if diagnosis.code == UNREAD
        else f"{escape(place.file)}:{place.line}:{place.column}: "
    )
    severity = _colored(f"{diagnosis.severity}[{diagnosis.code}]", STYLES[diagnosis.severity], color)
    lines = [head + severity + ": " + _colored(escape(diagnosis.message), BOLD, color)]
    if source_line:
        lines += _excerpt(place, source_line, STYLES[diagnosis.severity], color)
    if diagnosis.correction:
        lines += _corrected(diagnosis.correction, corrected, color)
    if diagnosis.advice:
        lines.append(f"      {_colored('=', BLUE, color)} {escape(diagnosis.advice)}")
    return "\n".join(lines)


def _excerpt(place: Place, source_line: str, style: str, color: bool) -> list[str]:
    """Return the source line, cut where it is long, and the caret below the place."""
    start = place.column - 1
    first = max(0, start - BEFORE) if len(source_line) > SHOWN else 0
    last = first + SHOWN
    left = ("…" if first else "") + _shown(source_line[first:start])
    marked = _shown(source_line[start : min(start + place.length, last)])
    right = _shown(source_line[start + place.length : last]) + ("…" if last < len(source_line) else "")
    caret = " " * _width(left) + _colored("^" * max(1, _width(marked)), style, color)
    return [
        _colored(f"{place.line:>5} |", BLUE, color) + f" {left}{marked}{right}",
        _colored("      |", BLUE, color) + f" {caret}",
    ]


def _corrected(correction: Correction, lines: Sequence[CorrectedLine], color: bool) -> list[str]:
    """Return lines as they should be; of many, or of a long one, only the beginning.

    Lines that stand apart in the file have their numbers, so that they do not look like one block.
    """
    shown = [(line.text, line.number) for line in lines[:MOST_CORRECTED]]
    shown += [("…", 0)] if len(lines) > MOST_CORRECTED else []
    first = f"{'write' if correction.is_certain else 'maybe':>5} |"
    margins = [first, *(f"{f'at {number}' if number else '':>5} |" for _, number in shown[1:])]
    return [
        _colored(margin, GREEN, color) + " " + _shown(line[:SHOWN]) + ("…" if len(line) > SHOWN else "")
        for margin, (line, _) in zip(margins, shown, strict=False)
    ]


def _colored(text: str, style: str, color: bool) -> str:
    return f"{style}{text}{PLAIN}" if color else text


def render_json(diagnoses: Iterable[Diagnosis]) -> list[dict[str, Any]]:
    """Return objects for JSON: file, line, column, end_column (exclusive), code, severity, message, advice.

    Their severity is error or warning. Where there is a correction, it has its edits (line, column, end_line,
    end_column, exclusive, and text) and whether it is certain.
    """
    return [_json_object(diagnosis) for diagnosis in diagnoses]


def _json_object(diagnosis: Diagnosis) -> dict[str, Any]:
    place = diagnosis.place
    return {
        "file": place.file,
        "line": place.line,
        "column": place.column,
        "end_column": place.column + place.length,
        "code": diagnosis.code,
        "severity": diagnosis.severity.value,
        "message": diagnosis.message,
        "advice": diagnosis.advice,
        **({"correction": _correction(diagnosis.correction)} if diagnosis.correction else {}),
    }


def _correction(correction: Correction) -> dict[str, Any]:
    return {"certain": correction.is_certain, "edits": [edit._asdict() for edit in correction.edits]}
