"""The text of a file, and the lines and columns of its characters."""

from __future__ import annotations

import re
from bisect import bisect_right
from dataclasses import dataclass
from functools import cached_property
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING

from bbsd.errors import Diagnosis, Edit, Place, SpecError, nearest

if TYPE_CHECKING:
    from collections.abc import Iterable

MAX_BYTES = 1_000_000  # the specs that people write have a few kilobytes
MOST_NAMED = 3
MOST_SEARCHED = 1000  # files
BYTE_ORDER_MARK = "\ufeff"
LINE_BREAK = re.compile(r"\r\n|\r|\n")


@dataclass(frozen=True)
class Source:
    """The text of a file, and the name of the file as diagnoses show it."""

    file: str
    text: str

    @classmethod
    def read(cls, path: str | Path) -> Source:
        """Read a file in UTF-8, with or without a byte order mark.

        Raises SpecError if there is no such file, or it is a directory, may not be opened, has more than 1 MB or is
        not UTF-8.
        """
        file = str(path)
        return _decoded(file, _content(file))

    @classmethod
    def given(cls, name: str, text: str) -> Source:
        """Return a text that is in no file, under the name by which diagnoses show it.

        Raises SpecError for what no file could hold: a text of more than 1 MB, or one that is not Unicode.
        """
        try:
            content = text.encode("utf-8")
        except UnicodeEncodeError as error:
            source = cls(name, text.encode("utf-8", "replace").decode("utf-8"))
            message = (
                f"the character U+{ord(text[error.start]):04X} is half of one, and not Unicode by itself"
            )
            raise SpecError([Diagnosis("BB003", message, source.place(error.start))], source) from None
        if len(content) > MAX_BYTES:
            raise _refused(name, "BB002", "the text has more than 1 MB, which no spec needs")
        return cls(name, text.removeprefix(BYTE_ORDER_MARK))

    @cached_property
    def _starts(self) -> list[int]:
        return [0, *(match.end() for match in LINE_BREAK.finditer(self.text))]

    def line(self, number: int) -> str:
        """Return the line of that number, counted from 1, without its break; '' if there is none."""
        if not 1 <= number <= len(self._starts):
            return ""
        start = self._starts[number - 1]
        return self.text[start : self.line_end(start)]

    def line_number(self, offset: int) -> int:
        """Return the number, counted from 1, of the line that an offset is on."""
        return bisect_right(self._starts, offset)

    def offset_of(self, number: int) -> int:
        """Return the offset of the first character of the line of that number, counted from 1."""
        return self._starts[number - 1]

    def line_start(self, offset: int) -> int:
        """Return the offset of the first character of the line that an offset is on."""
        return self._starts[self.line_number(offset) - 1]

    def line_end(self, offset: int) -> int:
        """Return the offset of the break that ends the line that an offset is on, or of the text's end."""
        number = self.line_number(offset)
        if number == len(self._starts):
            return len(self.text)
        end = self._starts[number] - 1
        return end - 1 if self.text[end - 1 : end + 1] == "\r\n" else end

    def place(self, start: int, end: int | None = None) -> Place:
        """Return the place of the characters from `start` up to `end` (one if None), as far as they are on one line."""
        last = start + 1 if end is None else min(end, self.line_end(start))
        column = start - self.line_start(start) + 1
        return Place(self.file, self.line_number(start), column, max(1, last - start))

    def edit(self, start: int, end: int, text: str) -> Edit:
        """Return the edit that writes a text for the characters from `start` up to `end`."""
        line, end_line = self.line_number(start), self.line_number(end)
        return Edit(line, start - self.line_start(start) + 1, end_line, end - self.line_start(end) + 1, text)

    def edited(self, edits: Iterable[Edit]) -> Source:
        """Return the text after edits, none of which overlap; lines that they add end as the text's first line does."""
        text = self.text
        first_break = LINE_BREAK.search(text)
        for edit in sorted(edits, reverse=True):
            start = self._starts[edit.line - 1] + edit.column - 1
            end = self._starts[edit.end_line - 1] + edit.end_column - 1
            new = edit.text.replace("\n", first_break[0]) if first_break else edit.text
            text = text[:start] + new + text[end:]
        return Source(self.file, text)


def _content(file: str) -> bytes:
    try:
        with Path(file).open("rb") as stream:
            content = stream.read(MAX_BYTES + 1)
    except FileNotFoundError:
        raise _refused(file, "BB001", _missing_text(Path(file))) from None
    except IsADirectoryError:
        raise _refused(file, "BB001", _folder_text(Path(file))) from None
    except (OSError, ValueError) as error:  # ValueError: a null character in the name
        raise _refused(file, "BB001", f"the file cannot be read: {_reason(error)}") from None
    if len(content) > MAX_BYTES:
        raise _refused(file, "BB002", "the file has more than 1 MB, which no spec needs")
    return content


def _missing_text(file: Path) -> str:
    """Return what is wrong with the name of a file that is not there, and which one may be meant."""
    message = "there is no such file"
    if not file.parent.is_dir():
        message += f", and no folder {file.parent}"
    near = _near_file(file)
    return f'{message}; did you mean "{near.as_posix()}"?' if near else message


def _near_file(file: Path) -> Path | None:
    """Return a spec with nearly that name in the same folder, or with that name in a folder beside or below."""
    try:
        folder = file.parent if file.parent.is_dir() else Path()
        here = {path.name: path for path in islice(folder.glob("*.y*ml"), MOST_SEARCHED)}
        below = {path.name: path for path in islice(folder.glob("*/*.y*ml"), MOST_SEARCHED)}
    except (OSError, ValueError):  # ValueError: a null character in the name
        return None
    name = file.name if file.suffix else f"{file.name}.yaml"
    for found in (here, below):
        if near := name if name in found else nearest(name, found):
            return found[near]
    return None


def _folder_text(folder: Path) -> str:
    """Return what is wrong with a folder in place of a file, and which files in it may be meant."""
    files = sorted(map(str, folder.glob("*.yaml")))
    more = f" and {len(files) - MOST_NAMED} more" if len(files) > MOST_NAMED else ""
    choice = f"; give a file in it: {', '.join(files[:MOST_NAMED])}{more}" if files else ""
    return f"this is a folder, not a file{choice}"


def _reason(error: OSError | ValueError) -> str:
    return (error.strerror if isinstance(error, OSError) else None) or str(error)


def _decoded(file: str, content: bytes) -> Source:
    try:
        return Source(file, content.decode("utf-8").removeprefix(BYTE_ORDER_MARK))
    except UnicodeDecodeError as error:
        source = Source(file, content.decode("utf-8", "replace").removeprefix(BYTE_ORDER_MARK))
        place = source.place(len(content[: error.start].decode("utf-8").removeprefix(BYTE_ORDER_MARK)))
        message = f"the byte 0x{content[error.start]:02x} is not UTF-8"
        raise SpecError([Diagnosis("BB003", message, place, "save the file as UTF-8")], source) from None


def _refused(file: str, code: str, message: str) -> SpecError:
    return SpecError([Diagnosis(code, message, Place(file, 1, 1))], Source(file, ""))
