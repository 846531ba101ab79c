"""Names of a spec that extends another, which nothing uses: they are misspelled names of the base."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from bbsd.errors import nearest
from bbsd.expression.syntax.mistakes import KEY, Rewriting
from bbsd.language.validation import child

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from bbsd.expression.scope import Path as DataPath
    from bbsd.language.lineage import Lineage
    from bbsd.language.validation import LocatedMistake
    from bbsd.text import Data


def with_names_of_bases(found: Iterable[LocatedMistake], files: Lineage) -> Iterator[LocatedMistake]:
    """Yield warnings, with the name of a base where a name that nothing uses is nearly that one."""
    own, *bases = files.documents
    for path, warning in found:
        names = {
            name: base.source.file
            for base in reversed(bases)
            for name in _names(base.data, path[:-1])
            if warning.code == "BB201"
        }
        written = {*_names(own.data, path[:-1])} if names else set[str]()
        name = str(path[-1])
        near = nearest(name, names.keys() - written) if name in written and name not in names else ""
        if near:
            message = f'{warning.message}; did you mean "{near}" of {Path(names[near]).name}?'
            correction = Rewriting(near, KEY, is_certain=False)
            yield path, warning._replace(message=message, correction=correction)
        else:
            yield path, warning


def _names(data: Data, path: DataPath) -> list[str]:
    for segment in path:
        data = child(data, segment)
    return [*data] if isinstance(data, dict) else []
