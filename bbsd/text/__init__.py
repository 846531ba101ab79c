"""YAML in, with the place of everything in its file, and YAML out, in one style."""

from bbsd.text.document import Document
from bbsd.text.modeline import without_relative_modeline
from bbsd.text.nodes import Data, DataPath
from bbsd.text.patch import DELETE, Deletion, TooLargeError, as_read, differences, replace_blocks, with_change
from bbsd.text.reader import read
from bbsd.text.source import Source
from bbsd.text.writer import write

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
