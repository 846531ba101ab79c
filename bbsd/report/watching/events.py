"""Metrics as event files of TensorBoard, written without it.

A file is a row of records (length, check of the length, data, check of the data); the data are `Event` messages of
protocol buffers. Times are those of the steps, so that the same run gives the same bytes.
"""

from __future__ import annotations

import os
import struct
from typing import TYPE_CHECKING

from bbsd.files import NO_FOLLOW, write_all, write_whole
from bbsd.runs.storage.lock import writer_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping, Sequence
    from pathlib import Path
    from typing import Any

    from bbsd.runs.storage.watching import Watched

FILE = "events.out.tfevents.0.bbsd"
"""TensorBoard reads files whose names have `tfevents`; the number is that of the first second."""
VERSION = b"brain.Event:2"
POLYNOMIAL, MASK = 0x82F63B78, 0xA282EAD8
"""CRC32C, Castagnoli's, reflected; and what TFRecord adds to it."""
WIRE_VARINT, WIRE_64, WIRE_BYTES, WIRE_32 = 0, 1, 2, 5
WALL_TIME, STEP, FILE_VERSION, SUMMARY = 1, 2, 3, 5
"""Fields of Event; Summary has its values in field 1, a value its tag in field 1 and its number in field 2."""


class EventFiles:
    """The event files of a design's runs, in a folder for each below one."""

    def __init__(self, folder: Path) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        self._folder = folder
        self._written: dict[Path, Sequence[Mapping[str, Any]]] = {}

    def update(self, now: Watched) -> None:
        """Write what is new; a file is begun anew where a run was taken back, as a run that is resumed is."""
        for run in now.runs:
            name = "-".join([*([run.rival] if run.rival else []), f"run-{run.run}"])
            self._write(self._folder / name / FILE, run.lines)

    def _write(self, path: Path, lines: Sequence[Mapping[str, Any]]) -> None:
        written = self._written.get(path)
        with writer_of(path):
            if written is not None and tuple(lines[: len(written)]) == tuple(written):
                _append(path, events(lines[len(written) :]))
            else:
                path.parent.mkdir(exist_ok=True)
                write_whole(path, event_file(lines))
        self._written[path] = lines


def event_file(lines: Iterable[Mapping[str, Any]]) -> bytes:
    """Return the content of an event file of a run's metrics."""
    return record(_event(0, _field(FILE_VERSION, VERSION))) + events(lines)


def events(lines: Iterable[Mapping[str, Any]]) -> bytes:
    """Return the records of lines of metrics, a step each."""
    return b"".join(map(_record_of, lines))


def record(data: bytes) -> bytes:
    """Return data as a TFRecord."""
    length = struct.pack("<Q", len(data))
    return length + _check(length) + data + _check(data)


def _record_of(line: Mapping[str, Any]) -> bytes:
    step = int(line.get("generation", line.get("episodes", 0)))
    values = b"".join(
        _field(1, _field(1, tag.encode()) + _key(2, WIRE_32) + struct.pack("<f", value))
        for tag, value in _numbers(line)
    )
    return record(_event(step, _field(SUMMARY, values)))


def _numbers(line: Mapping[str, Any], above: str = "") -> Iterator[tuple[str, float]]:
    """Yield the numbers of a line with their tags, those of a mapping below its name."""
    for key, value in line.items():
        if isinstance(value, dict):
            yield from _numbers(value, f"{above}{key}/")
        elif isinstance(value, int | float) and key not in ("run", "generation", "episodes"):
            yield f"{above}{key}", float(value)


def _event(step: int, what: bytes) -> bytes:
    time = _key(WALL_TIME, WIRE_64) + struct.pack("<d", float(step))
    return time + _key(STEP, WIRE_VARINT) + _varint(step) + what


def _field(number: int, content: bytes) -> bytes:
    return _key(number, WIRE_BYTES) + _varint(len(content)) + content


def _key(number: int, wire: int) -> bytes:
    return _varint(number << 3 | wire)


def _varint(value: int) -> bytes:
    groups = []
    while value > 0x7F:
        groups.append(value & 0x7F | 0x80)
        value >>= 7
    return bytes([*groups, value])


def _table() -> tuple[int, ...]:
    table = list(range(256))
    for _ in range(8):
        table = [each >> 1 ^ (POLYNOMIAL if each & 1 else 0) for each in table]
    return tuple(table)


TABLE = _table()


def _check(data: bytes) -> bytes:
    """Return the masked CRC32C of data."""
    crc = 0xFFFFFFFF
    for byte in data:
        crc = crc >> 8 ^ TABLE[(crc ^ byte) & 0xFF]
    crc ^= 0xFFFFFFFF
    return struct.pack("<I", ((crc >> 15 | crc << 17) + MASK) & 0xFFFFFFFF)


def _append(path: Path, content: bytes) -> None:
    """Write records behind those that are there: a viewer keeps the file open."""
    if content:
        descriptor = os.open(path, os.O_WRONLY | os.O_APPEND | NO_FOLLOW)
        try:
            write_all(descriptor, content)
        finally:
            os.close(descriptor)
