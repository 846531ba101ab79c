"""Whatever a spec or a design is given as: its text, the run that it is of, its name."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias, TypeGuard

from bbsd.api.given.arguments import BadArgument
from bbsd.language.loading import Loaded
from bbsd.text import Source, read

if TYPE_CHECKING:
    from bbsd.api.results import Designed

AnySpec: TypeAlias = "str | Path | Mapping[str, Any] | Loaded | Designed"
"""A spec or a design: the path of a file, the folder of a run, which stands for its design, the text itself (with line
breaks), its data as a dict, what `load` returned, or what `design` returned.
"""
TEXT, DICT = "<text>", "<dict>"
"""What stands in the place of a file's name where mistakes are shown."""


def source_of(spec: AnySpec) -> Source:
    """Return the text of a spec or a design; of a run's folder, that of what it designed.

    Raises:
        SpecError: its file cannot be read.
        NoDesign: a folder that is no run, or a run without an answer.
        BadArgument: it is none of what a spec can be given as.
    """
    if isinstance(spec, Loaded):
        return spec.source
    if isinstance(spec, Mapping):
        return Source.given(DICT, _text_of(spec))
    if isinstance(spec, str) and not is_path(spec):
        return Source.given(TEXT, spec)
    if _is_designed(spec):
        return Source(TEXT if spec.written is None else str(spec.architecture), spec.text)
    path = path_of(spec)
    if path.is_dir():
        from bbsd.runs.storage.finished import design_file

        path = design_file(path)
    return Source.read(path)


def path_of(spec: object) -> Path:
    """Return the path that a spec is given as. Raises BadArgument where it is no path."""
    if not isinstance(spec, str | os.PathLike) or not isinstance(os.fspath(spec), str):
        raise BadArgument(
            f"a spec cannot be given as {_kind(spec)}",
            "give the path of its file, the folder of a run, its text, a dict, or a result of bbsd.load or bbsd.design",
        )
    return Path(spec)


def run_of(spec: AnySpec) -> Path | None:
    """Return the folder of the run whose design is given, by itself or by the file of it; None where it is of none."""
    if _is_designed(spec):
        return spec.written
    if not is_path(spec):
        return None
    from bbsd.runs.storage.finished import ARCHITECTURE

    path = path_of(spec)
    return path if path.is_dir() else path.parent if path.name == ARCHITECTURE else None


def name_of(spec: AnySpec) -> str:
    """Return what a spec that is given as no path is called: its file's name, or its own."""
    if isinstance(spec, Loaded):
        return spec.spec.name if spec.source.file in (TEXT, DICT) else Path(spec.source.file).resolve().name
    if _is_designed(spec):
        return spec.name if spec.written is None else spec.folder.resolve().name
    source = source_of(spec)
    name = read(source).data.get("name")
    return name if isinstance(name, str) else source.file


def is_path(spec: object) -> bool:
    """Return whether a spec is given as a path."""
    is_text = isinstance(spec, str) and ("\n" in spec or "\r" in spec)
    return isinstance(spec, str | os.PathLike) and not is_text


def _is_designed(spec: object) -> TypeGuard[Designed]:
    """Return whether a spec is given as the result of a design; without importing what these are made of for a path."""
    if is_path(spec):
        return False
    from bbsd.api.results import Designed

    return isinstance(spec, Designed)


def _text_of(data: Mapping[str, Any]) -> str:
    from bbsd.text.writing.writer import write

    try:
        return write(_plain(data, ()))
    except RecursionError:
        raise BadArgument("a spec's dict contains itself, or is nested too deep") from None


def _plain(value: Any, at: tuple[str | int, ...]) -> Any:  # noqa: ANN401 - whatever a dict holds
    """Return a value as a YAML file could hold it. Raises BadArgument for what none can."""
    if isinstance(value, Mapping):
        for key in value:
            if not isinstance(key, str):
                raise BadArgument(f"a key of a spec is text, not {_kind(key)}{_where(at)}")
        return {key: _plain(item, (*at, key)) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(item, (*at, index)) for index, item in enumerate(value)]
    if isinstance(getattr(value, "shape", None), tuple) and hasattr(value, "tolist"):  # of NumPy
        return _plain(value.tolist(), at)
    if value is None or isinstance(value, str | bool | int | float):
        return value
    raise BadArgument(
        f"a value of a spec is text, a number, a truth, a list or a dict, not {_kind(value)}{_where(at)}"
    )


def _where(at: tuple[str | int, ...]) -> str:
    return f", at {'.'.join(map(str, at))}" if at else ""


def _kind(value: object) -> str:
    return f"{value!r:.60}" if isinstance(value, int | float | bytes) else f"a {type(value).__name__}"
