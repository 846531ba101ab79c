"""Specs as YAML texts: read with the place of every value, written in one style.

`reading` turns a text into a `Document` and reports mistakes; `writing` makes texts of data, changes parts of a text,
and puts a text in the house style. Both use the modules here: the source, the tree of nodes, the document.
"""

from bbsd.text.document import Document
from bbsd.text.nodes import Data, DataPath
from bbsd.text.reading.reader import read
from bbsd.text.source import Source
from bbsd.text.writing.modeline import without_relative_modeline
from bbsd.text.writing.patch import (
    DELETE,
    Deletion,
    TooLargeError,
    differences,
    read_back,
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
    "differences",
    "read",
    "read_back",
    "replace_blocks",
    "with_change",
    "without_relative_modeline",
    "write",
]
