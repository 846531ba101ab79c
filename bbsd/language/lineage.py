"""Specs that extend others: which files those are, what they say together, and where each value stands."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from bbsd.errors import Diagnosis, SpecError, did_you_mean
from bbsd.language.field_types import kind_of
from bbsd.language.validation import child, has
from bbsd.text import Source, differences, read, replace_blocks

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from bbsd.errors import Place
    from bbsd.expression.scope import Path as DataPath
    from bbsd.text import Data, Document

EXTENDS = "extends"
MAX_FILES = 10
MAX_CHARACTERS = 1_000_000
MAX_NODES = 50_000
ADVICE = "a spec extends a file in its own folder or below it"


class _NoBaseError(Exception):
    """Why a file cannot be extended."""


@dataclass(frozen=True)
class Lineage:
    """A spec's document and those it extends, each before the one that it extends."""

    documents: tuple[Document, ...]
    mistakes: tuple[Diagnosis, ...]
    """All that is wrong with the files as files."""

    @property
    def source(self) -> Source:
        """The text of the spec itself."""
        return self.documents[0].source

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
        """What the files say together."""
        found: dict[str, Data] = {}
        for document in reversed(self.documents):
            found = overlaid(found, _own(document))
        return found

    @cached_property
    def flat(self) -> Document:
        """The same as one document: the last file's text with the changes that the others make."""
        found = self.documents[-1]
        for document in reversed(self.documents[:-1]):
            wanted = overlaid(found.data, _own(document))
            text = replace_blocks(found, dict(differences(found.data, wanted)))
            found = read(Source(self.source.file, text))
        return found

    def place(
        self, path: DataPath, offset: int | None = None, on_key: bool = False, length: int = 1
    ) -> Place:
        """The place of a value in the first file that has it, as a document's `place`."""
        holding = (document for document in self.documents if _holds(document.data, path))
        return next(holding, self.documents[0]).place(path, offset, on_key, length)

    def error(self, diagnoses: Sequence[Diagnosis]) -> SpecError:
        """What is wrong with the files, with their texts."""
        others = {document.source.file: document.source for document in self.documents[1:]}
        return SpecError(diagnoses, self.source, others)


def lineage(source: Source) -> Lineage:
    """Read a spec and all that it extends; raises SpecError where one of those is no text."""
    documents = [read(source)]
    mistakes: list[Diagnosis] = []
    while documents[-1].data.get(EXTENDS) is not None and not mistakes:
        try:
            documents.append(read(_base(documents)))
        except _NoBaseError as error:
            mistakes.append(Diagnosis("BB029", str(error), documents[-1].place((EXTENDS,)), ADVICE))
    found = Lineage(tuple(documents), tuple(_sorted([*_diagnoses(documents), *mistakes])))
    if len(documents) > 1 and _size(found.data) > MAX_NODES:
        message = f"with what it extends, a spec has more than {MAX_NODES} keys and values"
        return Lineage(found.documents, (Diagnosis("BB011", message, documents[0].place((EXTENDS,))),))
    return found


def _diagnoses(documents: Sequence[Document]) -> Iterator[Diagnosis]:
    for document in documents:
        yield from document.diagnoses


def _sorted(diagnoses: Sequence[Diagnosis]) -> list[Diagnosis]:
    return sorted(diagnoses, key=lambda each: each.place)


def _base(documents: Sequence[Document]) -> Source:
    """Read the file that the last document extends; raises _NoBaseError, SpecError."""
    document = documents[-1]
    written = document.data[EXTENDS]
    if not isinstance(written, str) or not written:
        raise _NoBaseError(
            f"extends needs the name of a file, not {kind_of(written) if written else 'nothing'}"
        )
    path = Path(document.source.file).parent / written
    try:
        _require_allowed(path, written, [Path(each.source.file) for each in documents])
    except (
        OSError,
        ValueError,
        RuntimeError,
    ) as error:  # a name too long, a null character, a circle of links
        raise _NoBaseError(f'the file "{written}" cannot be read: {error}') from None
    source = Source.read(path)
    if sum(len(each.source.text) for each in documents) + len(source.text) > MAX_CHARACTERS:
        raise _NoBaseError("with what it extends, the spec has more than 1 MB")
    return source


def _require_allowed(path: Path, written: str, files: Sequence[Path]) -> None:
    """Refuse what lies outside of the folder, links followed, what is no file, circles and long chains."""
    folder, target = files[-1].parent, path.resolve()
    if not target.is_relative_to(folder.resolve()):
        raise _NoBaseError(f'the file "{written}" lies outside of the spec\'s folder')
    if not target.exists():
        known = (each.relative_to(folder).as_posix() for each in folder.glob("*.y*ml"))
        raise _NoBaseError(f'there is no file "{written}"{did_you_mean(written, known)}')
    if not target.is_file():
        raise _NoBaseError(f'"{written}" is not a file')
    if target in [file.resolve() for file in files]:
        raise _NoBaseError(f'the file "{written}" extends itself' + " in a circle" * (len(files) > 1))
    if len(files) == MAX_FILES:
        raise _NoBaseError(f"more than {MAX_FILES} files extend each other")


def overlaid(base: dict[str, Data], over: dict[str, Data]) -> dict[str, Data]:
    """Lay a mapping over another, level by level, the base's keys first; null takes a key of the base away."""
    found = dict(base)
    for key, value in over.items():
        below = base.get(key)
        if value is None and key in base:
            del found[key]
        elif isinstance(below, dict) and isinstance(value, dict):
            found[key] = overlaid(below, value)
        else:
            found[key] = value
    return found


def _own(document: Document) -> dict[str, Data]:
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
        return 1 + sum(1 + _size(each) for each in data.values())
    return 1 + sum(map(_size, data)) if isinstance(data, list) else 1
