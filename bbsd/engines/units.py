"""Units of work as plain bytes, and their results: what a worker anywhere needs to know, and what it gives back.

A unit is worked on for a while, then what was done comes back as files; where it is not finished, the same unit goes
on from there, on any worker. So a lost worker costs what it did since, and nothing that a worker has on its disk is
needed.
"""

from __future__ import annotations

import json
from dataclasses import dataclass, field, replace
from hashlib import sha256
from importlib import import_module
from typing import TYPE_CHECKING, Any

from bbsd.errors import UsageError
from bbsd.version import REVISION, __version__

if TYPE_CHECKING:
    from collections.abc import Mapping
    from typing import Self

DIGEST_BYTES, LENGTH_BYTES = 32, 8
VERSION = f"bbsd {__version__}, revision {REVISION}"


class OtherVersion(UsageError):
    """A worker that has another version of bbsd than the one that sent the unit."""

    advice = "install the same version on all workers: another one may give other results"

    def __init__(self, sent: str, worker: str) -> None:
        super().__init__(f"a worker has {worker}, and this is {sent}")
        self.versions = sent, worker

    def __reduce__(self) -> tuple[type[Self], tuple[str, str]]:
        return type(self), self.versions


class DamagedBytes(Exception):
    """Bytes that are not what was sent: their digest does not match."""


@dataclass(frozen=True, slots=True)
class Unit:
    """Work that depends on nothing but what is here."""

    name: str
    """What people call it, such as `run 2`; no two units at the same time have the same one."""
    work: str
    """The function that does it, `module:function`; it takes a Unit and returns a Result."""
    order: Mapping[str, Any]
    """What is to be done, as JSON has it; it stays the same until the unit is finished."""
    files: Mapping[str, bytes] = field(default_factory=dict)
    """What it resumes from; empty at the beginning."""
    seconds: float | None = None
    """How long to work on it before what was done is given back; None: to its end."""
    version: str = VERSION
    """The version of bbsd that sent it; no other one does it."""

    def going_on_from(self, files: Mapping[str, bytes]) -> Unit:
        """Return the unit that goes on from here."""
        return replace(self, files=files)

    def to_bytes(self) -> bytes:
        """Return the unit as bytes."""
        head = {key: getattr(self, key) for key in ("version", "name", "work", "order", "seconds")}
        return _packed(head, self.files)

    @classmethod
    def from_bytes(cls, content: bytes) -> Unit:
        """Return the unit that was sent as bytes. Raises DamagedBytes, OtherVersion."""
        head, files = _unpacked(content)
        if head["version"] != VERSION:
            raise OtherVersion(head["version"], VERSION)
        return cls(files=files, **head)


@dataclass(frozen=True, slots=True)
class Result:
    """What came of a unit, so far where it is not finished."""

    files: Mapping[str, bytes]
    finished: bool = True

    def to_bytes(self) -> bytes:
        """Return the result as bytes, which begin with their digest."""
        return _packed({"finished": self.finished}, self.files)

    @classmethod
    def from_bytes(cls, content: bytes) -> Result:
        """Return the result that was sent as bytes. Raises DamagedBytes."""
        head, files = _unpacked(content)
        return cls(files, head["finished"])


def do(content: bytes) -> bytes:
    """Do a unit that was sent as bytes, and return its result as bytes; workers call this.

    Raises:
        OtherVersion: the unit is of another version of bbsd.
    """
    unit = Unit.from_bytes(content)
    module, _, function = unit.work.partition(":")
    result: Result = getattr(import_module(module), function)(unit)
    return result.to_bytes()


def _packed(head: Mapping[str, Any], files: Mapping[str, bytes]) -> bytes:
    """Return a digest of all that follows, the length of the head, the head as JSON, and the files one by one."""
    sizes = {name: len(content) for name, content in files.items()}
    text = json.dumps({**head, "files": sizes}).encode()
    content = b"".join([len(text).to_bytes(LENGTH_BYTES, "big"), text, *files.values()])
    return sha256(content).digest() + content


def _unpacked(content: bytes) -> tuple[dict[str, Any], dict[str, bytes]]:
    digest, content = content[:DIGEST_BYTES], content[DIGEST_BYTES:]
    if sha256(content).digest() != digest:
        raise DamagedBytes("the digest of what was sent does not match")
    begin = LENGTH_BYTES + int.from_bytes(content[:LENGTH_BYTES], "big")
    head = json.loads(content[LENGTH_BYTES:begin])
    files = {}
    for name, size in head.pop("files").items():
        files[name] = content[begin : begin + size]
        begin += size
    return head, files
