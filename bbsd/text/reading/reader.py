"""The entry to reading: from the text of a file to a document."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.text.document import Document

if TYPE_CHECKING:
    from bbsd.text.source import Source


def read(source: Source) -> Document:
    """Read a YAML 1.2 text (core schema) as a mapping, with all mistakes that can be found together.

    Never raises: the mistakes are in the document's diagnoses, in the order of the text. Bounds: 50 000 keys and values
    and 40 levels with aliases expanded, texts of 10 000 characters (but for tables), numbers of 100 characters. A text
    counts as one value more for each 1000 characters.
    """
    from bbsd.text.reading.composition import compose

    root, diagnoses = compose(source)
    return Document(source, root, tuple(sorted(diagnoses, key=lambda diagnosis: diagnosis.place)))
