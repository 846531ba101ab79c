"""Specs as YAML texts: read with the place of every value, written in one style.

`reading` turns a text into a `Document` and reports mistakes; `writing` makes texts of data, changes parts of a text,
and puts a text in the house style. Both use the modules here: the source, the tree of nodes, the document.
"""

from bbsd.text.document import Document
from bbsd.text.nodes import Data, DataPath
from bbsd.text.reading.reader import read
from bbsd.text.source import Source

__all__ = [
    "Data",
    "DataPath",
    "Document",
    "Source",
    "read",
]
