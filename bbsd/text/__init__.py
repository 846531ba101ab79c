"""YAML in, with the place of everything in its file, and YAML out, in one style."""

from bbsd.text.document import Document
from bbsd.text.nodes import Data, DataPath
from bbsd.text.reading.reader import read
from bbsd.text.source import Source
from bbsd.text.writing.modeline import without_relative_modeline
from bbsd.text.writing.patch import (
    DELETE,
    Deletion,
    TooLargeError,
    as_read,
    differences,
    replace_blocks,
    with_change,
)
from bbsd.text.writing.writer import write

__all__ = [
    "DELETE",
    "Data",
    "DataPath",
    "Deletion",
    "Document",
    "Source",
    "TooLargeError",
    "as_read",
    "differences",
    "read",
    "replace_blocks",
    "with_change",
    "without_relative_modeline",
    "write",
]
