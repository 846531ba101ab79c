"""A run's state on disk: one file of plain arrays with a digest, and inside it the identity of its run."""

from __future__ import annotations

import errno
import json
import math
from hashlib import sha256
from io import BytesIO
from typing import TYPE_CHECKING, Any
from zipfile import ZIP_STORED, BadZipFile, ZipFile

import numpy as np
from numpy.lib import format as npy

from bbsd.files import read_regular, write_whole

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    from bbsd.runs.storage.identity import Identity

    Arrays = dict[str, NDArray[Any]]

DIGEST_BYTES = 32
IDENTITY = "identity"
DISK_FAILS = frozenset({errno.EIO, errno.EMFILE, errno.ENFILE, errno.ENOMEM, errno.ENOSPC})
"""Errors that tell nothing of a file itself."""


class CheckpointError(Exception):
    """A checkpoint that cannot be resumed; the message says why."""


def save(path: Path, who: Identity, arrays: Arrays) -> None:
    """Write a run's state and its digest into a file, completely or not at all."""
    write_whole(path, packed(who, arrays))


def packed(who: Identity, arrays: Arrays) -> bytes:
    """Return the content of a checkpoint file: a digest, then the arrays."""
    text = np.frombuffer(json.dumps(who.plain()).encode(), np.uint8)
    buffer = BytesIO()
    np.savez(buffer, **{IDENTITY: text, **arrays}, allow_pickle=False)
    content = buffer.getvalue()
    return sha256(content).digest() + content


def load(path: Path, who: Identity) -> Arrays:
    """Read the arrays of a run's state from a file.

    Raises:
        CheckpointError: the file is damaged, or of another run: the message names what differs.
        OSError: the disk fails, so that nothing is known of the file, and nothing may be cut back to an older one.
    """
    try:
        content = read_regular(path)
    except OSError as error:
        if error.errno in DISK_FAILS:
            raise
        raise CheckpointError(f"{path} cannot be read: {error.strerror}") from None
    return unpacked(content, who, str(path))


def unpacked(content: bytes, who: Identity, name: str) -> Arrays:
    """Return the arrays of a checkpoint file's content; the name is that of the file, for messages.

    Raises:
        CheckpointError: the content is damaged, or of another run: the message names what differs.
    """
    if not is_undamaged(content):
        raise CheckpointError(f"{name} is damaged: its digest does not match")
    try:
        arrays = _arrays(content[DIGEST_BYTES:])
        theirs = json.loads(arrays.pop(IDENTITY).astype(np.uint8).tobytes())
        different = who.differences(theirs)
    except (BadZipFile, EOFError, KeyError, MemoryError, TypeError, ValueError, AttributeError) as error:
        raise CheckpointError(f"{name} cannot be read: {error}") from None
    if different:
        raise CheckpointError(f"{name} is of another run: different are {' and '.join(different)}")
    return arrays


def is_undamaged(content: bytes) -> bool:
    """Return whether the digest of a checkpoint file's content matches; whose it is, is not looked at."""
    return sha256(content[DIGEST_BYTES:]).digest() == content[:DIGEST_BYTES]


def _arrays(content: bytes) -> Arrays:
    """Return the arrays of an archive; no more is allocated than the content has bytes."""
    arrays: Arrays = {}
    with ZipFile(BytesIO(content)) as archive:
        for member in archive.infolist():
            if member.compress_type != ZIP_STORED or member.file_size > len(content):
                raise ValueError(f"{member.filename} is compressed")
            with archive.open(member) as stream:
                data = stream.read()
            arrays[member.filename.removesuffix(".npy")] = _array(data, member.filename)
    return arrays


def _array(data: bytes, name: str) -> NDArray[Any]:
    stream = BytesIO(data)
    if npy.read_magic(stream) != (1, 0):
        raise ValueError(f"{name} is of another format")
    shape, _, dtype = npy.read_array_header_1_0(stream)
    if dtype.hasobject or math.prod(shape) * dtype.itemsize != len(data) - stream.tell():
        raise ValueError(f"{name} has another size than it says")
    stream.seek(0)
    return np.asarray(npy.read_array(stream, allow_pickle=False))
