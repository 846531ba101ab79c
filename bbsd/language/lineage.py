"""Specs that extend others: the files, the data that they give together, and the place of each value."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from bbsd.errors import Diagnosis, SpecError, did_you_mean
from bbsd.language.field_types import kind_of
from bbsd.language.validation import child, has
from bbsd.text import Source, read

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from bbsd.errors import Place
    from bbsd.expression.scope import Path as DataPath
    from bbsd.text import Data, Document

EXTENDS = "extends"
MAX_FILES = 10
"""Files that extend each other in a chain."""
MAX_CHARACTERS = 1_000_000
"""Characters of all files of a spec together."""
MAX_EXTENDED_NODES = 50_000
"""Keys and values of a spec together with what it extends."""
ADVICE = "a spec extends a file in its own folder or below it"


class _NoBaseError(Exception):
    """A file cannot be extended; the message says why."""


@dataclass(frozen=True)
class Lineage:
    """A spec's document and those that it extends, each before the one that it extends."""

    documents: tuple[Document, ...]
    mistakes: tuple[Diagnosis, ...]
    """Mistakes of the files themselves: in their YAML, or in what they extend."""

    @property
    def source(self) -> Source:
        """The text of the spec itself."""
        return self.documents[0].source

    @property
    def names(self) -> frozenset[str]:
        """The names of the files."""
        return frozenset(document.source.file for document in self.documents)

    @property
    def is_readable(self) -> bool:
        """Whether all the files could be read, at least in part."""
        is_whole = EXTENDS not in self.documents[-1].data or self.documents[-1].data[EXTENDS] is None
        return is_whole and all(document.root for document in self.documents)

    @property
    def characters(self) -> int:
        """The length of all the files' texts together."""
        return sum(len(document.source.text) for document in self.documents)

    @cached_property
    def data(self) -> dict[str, Data]:
        """The data that the files give together."""
        data: dict[str, Data] = {}
        for document in reversed(self.documents):
            data = overlay(data, _without_extends(document))
        return data

    @cached_property
    def flat(self) -> Document:
        """The files as one document: the last file's text with the changes that the others make."""
        from bbsd.text.writing.patch import differences, replace_blocks

        flat = self.documents[-1]
        for document in reversed(self.documents[:-1]):
            data = overlay(flat.data, _without_extends(document))
            text = replace_blocks(flat, dict(differences(flat.data, data)))
            flat = read(Source(self.source.file, text))
        return flat

    def place(
        self, path: DataPath, offset: int | None = None, on_key: bool = False, length: int = 1
    ) -> Place:
        """Return the place of a value in the first file that has it, as a document's `place`."""
        return self.document(path).place(path, offset, on_key, length)

    def document(self, path: DataPath) -> Document:
        """Return the first file that has a value, the spec's own where none has."""
        holding = (document for document in self.documents if _holds(document.data, path))
        return next(holding, self.documents[0])

    def error(self, diagnoses: Sequence[Diagnosis]) -> SpecError:
        """Return an error that shows diagnoses in the texts of the files."""
        others = {document.source.file: document.source for document in self.documents[1:]}
        return SpecError(diagnoses, self.source, others)


def read_lineage(source: Source) -> Lineage:
    """Read a spec and all that it extends; raise SpecError where one of those is no text."""
    documents = [read(source)]
    mistakes: list[Diagnosis] = []
    while documents[-1].data.get(EXTENDS) is not None and not mistakes:
        try:
            documents.append(read(_base(documents)))
        except _NoBaseError as error:
            mistakes.append(Diagnosis("BB029", str(error), documents[-1].place((EXTENDS,)), ADVICE))
    files = Lineage(tuple(documents), tuple(_sorted([*_diagnoses(documents), *mistakes])))
    if len(documents) > 1 and _size(files.data) > MAX_EXTENDED_NODES:
        message = f"with what it extends, a spec has more than {MAX_EXTENDED_NODES} keys and values"
        return Lineage(files.documents, (Diagnosis("BB011", message, documents[0].place((EXTENDS,))),))
    return files


def _diagnoses(documents: Sequence[Document]) -> Iterator[Diagnosis]:
    for document in documents:
        yield from document.diagnoses


def _sorted(diagnoses: Sequence[Diagnosis]) -> list[Diagnosis]:
    return sorted(diagnoses, key=lambda diagnosis: diagnosis.place)


def _base(documents: Sequence[Document]) -> Source:
    """Read the file that the last document extends; raise _NoBaseError or SpecError where that is not possible."""
    document = documents[-1]
    name = document.data[EXTENDS]
    if not isinstance(name, str) or not name:
        raise _NoBaseError(f"extends needs the name of a file, not {kind_of(name) if name else 'nothing'}")
    path = Path(document.source.file).parent / name
    try:
        _require_allowed(path, name, [Path(document.source.file) for document in documents])
    except (
        OSError,
        ValueError,
        RuntimeError,
    ) as error:  # a name too long, a null character, a circle of links
        raise _NoBaseError(f'the file "{name}" cannot be read: {error}') from None
    source = Source.read(path)
    if sum(len(document.source.text) for document in documents) + len(source.text) > MAX_CHARACTERS:
        raise _NoBaseError("with what it extends, the spec has more than 1 MB")
    return source


def _require_allowed(path: Path, name: str, files: Sequence[Path]) -> None:
    """Raise _NoBaseError for a path outside of the folder (links followed) or without a file, circles, long chains."""
    folder, target = files[-1].parent, path.resolve()
    if not target.is_relative_to(folder.resolve()):
        raise _NoBaseError(f'the file "{name}" lies outside of the spec\'s folder')
    if not target.exists():
        present = (file.relative_to(folder).as_posix() for file in folder.glob("*.y*ml"))
        raise _NoBaseError(f'there is no file "{name}"{did_you_mean(name, present)}')
    if not target.is_file():
        raise _NoBaseError(f'"{name}" is not a file')
    if target in [file.resolve() for file in files]:
        raise _NoBaseError(f'the file "{name}" extends itself' + " in a circle" * (len(files) > 1))
    if len(files) == MAX_FILES:
        raise _NoBaseError(f"more than {MAX_FILES} files extend each other")


def overlay(base: dict[str, Data], over: dict[str, Data]) -> dict[str, Data]:
    """Lay a mapping over another, level by level, the base's keys first; null takes a key of the base away."""
    merged = dict(base)
    for key, value in over.items():
        below = base.get(key)
        if value is None and key in base:
            del merged[key]
        elif isinstance(below, dict) and isinstance(value, dict):
            merged[key] = overlay(below, value)
        else:
            merged[key] = value
    return merged


def _without_extends(document: Document) -> dict[str, Data]:
    return {key: value for key, value in document.data.items() if key != EXTENDS}


def _holds(data: Data, path: DataPath) -> bool:
    for segment in path:
        if not has(data, segment):
            return False
        data = child(data, segment)
    return True


def _size(data: Data) -> int:
    """Count values and keys."""
    if isinstance(data, dict):
        return 1 + sum(1 + _size(value) for value in data.values())
    return 1 + sum(map(_size, data)) if isinstance(data, list) else 1
