"""What is shown is inert: texts of specs, files and errors neither steer a terminal nor a reader of logs or tables."""

from __future__ import annotations

import re

from bbsd.errors.rendering import escape

STYLE = r"\x1b\[(?:[0-4]|3[1-7]|9[0-7])?(?:;(?:[0-4]|3[1-7]|9[0-7]))*m"
"""Bold, dim, italic, underlined, colors of the text, and plain: none of them hides or moves anything."""
SUSPECT = re.compile(rf"(?P<style>{STYLE})|(?P<command>^(?=::|\#\#\[))|[^\n\t\x20-\x7e]", re.MULTILINE)
FORMULA = ("=", "+", "-", "@", "\t", "\r")
"""How a cell begins that a spreadsheet takes for a formula."""


def inert(text: str, *, commands: bool = False, begins_line: bool = True) -> str:
    """Return lines of output in which nothing steers a terminal, hides, or begins a command to what runs a job.

    Line breaks, tabs and plain styles stay.

    Args:
        text: One line or more, or a part of one.
        commands: Whether lines may be commands (`::error ...`), since they were asked for.
        begins_line: Whether the text begins a line.
    """

    def visible(match: re.Match[str]) -> str:
        if match["style"] is not None:
            return match["style"]
        if match["command"] is not None:
            is_command = not commands and (begins_line or match.start() > 0)
            return "\\" if is_command else ""
        return escape(match[0])

    return SUSPECT.sub(visible, text)


def inert_cell(text: str) -> str:
    """Return a cell of a table for spreadsheets: its text, behind an apostrophe where it would be a formula."""
    shown = escape(text)
    return f"'{shown}" if shown.startswith(FORMULA) and not _is_number(shown) else shown


def inert_json(text: str) -> str:
    """Return JSON in which every character that is no printable one is escaped as JSON does it."""
    return re.sub(r"[^\n\x20-\x7e]", _as_json, text)


def _as_json(match: re.Match[str]) -> str:
    if match[0].isprintable():
        return match[0]
    units = match[0].encode("utf-16-be", "surrogatepass")
    return "".join(f"\\u{units[at] << 8 | units[at + 1]:04x}" for at in range(0, len(units), 2))


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True
