"""Where a design is written: a folder that is named, a new one below another, or nowhere."""

from __future__ import annotations

import re
import shlex
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, NamedTuple

from bbsd.api.given.arguments import Assignments, BadArgument, assignments
from bbsd.api.given.sources import DICT, TEXT, is_path, path_of
from bbsd.api.results import Designed, NothingToDesign
from bbsd.runs.storage.choosing import RUNS, folder_to_resume, new_folder
from bbsd.runs.storage.finished import NoDesign, design_file, is_of_run, spec_inside, way_on
from bbsd.runs.storage.folder import Folder

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bbsd.api.given.sources import AnySpec
    from bbsd.language.loading import Loaded
    from bbsd.runs.storage.identity import Identity

NOT_IN_NAMES = re.compile(r"[^\w.+-]+")


class Wanted(NamedTuple):
    """Where a design is to be written."""

    out: Path | None
    """The folder, new or empty, or that which is resumed."""
    below: Path | None
    """The folder in which a new one is made, or in which the newest is looked for."""
    resume: bool
    has_start: bool = False
    """Whether it begins with known designs."""

    @property
    def is_kept(self) -> bool:
        """Whether anything is written that stays."""
        return self.resume or self.out is not None or self.below is not None


@contextmanager
def place_of(wanted: Wanted, loaded: Loaded, who: Identity) -> Iterator[Folder]:
    """Give the folder of a design: the one that is wanted, or a temporary one that is removed again.

    Raises FolderError where it cannot be written, or not be resumed.
    """
    name = _stem(loaded)
    if wanted.resume:
        yield folder_to_resume(wanted.out, name, who, wanted.below or RUNS, has_start=wanted.has_start)
    elif wanted.is_kept:
        yield new_folder(wanted.out, name, who.seed, wanted.below or RUNS)
    else:
        with TemporaryDirectory(prefix="bbsd-", ignore_cleanup_errors=True) as path:
            yield Folder(Path(path))


def _stem(loaded: Loaded) -> str:
    """Return the name of a spec's file, or of the spec itself where it is in none, as a part of a folder's name."""
    if loaded.source.file not in (TEXT, DICT):
        return Path(loaded.source.file).stem
    return NOT_IN_NAMES.sub("-", loaded.spec.name).strip("-.") or "spec"


def former_of(spec: AnySpec, *, goes_on: bool) -> Folder | None:
    """Return the folder of a design that is given in place of a spec, to go on with it; None for a spec.

    Raises:
        NothingToDesign: it is given without a word on what to do with it.
    """
    if isinstance(spec, Designed):
        path = spec.written
        if path is None and goes_on:
            raise BadArgument(
                "a design that was written into no folder cannot be continued",
                "name a folder: bbsd.design(..., out=FOLDER)",
            )
    else:
        path = path_of(spec) if is_path(spec) else None
        path = path if path is not None and path.is_dir() else None
    if path is None or goes_on:
        return None if path is None else Folder(path)
    if not is_of_run(path):
        advice = "give the file of a spec, or the folder that bbsd design wrote"
        if example := spec_inside(path):
            command = f"bbsd design {shlex.quote(str(example))}"
            advice = f"such as: {command}; --resume and --more take the folder of a run as well"
        raise NoDesign(f"{path} is a folder; design needs the file of one spec", advice)
    design_file(path)  # raises where it has no answer: with the way to go on
    raise NothingToDesign(f"{path} is the folder of a run that is finished", _ways_on(path))


def _ways_on(path: Path) -> str:
    former = way_on(path).removeprefix("continue it: ")
    return f"--more N goes on with it; --start {path} begins anew with its design; {former} shows its result again"


def require_former(
    folder: Folder, *, seed: int, runs: int, set: Assignments, out: object, below: object
) -> None:
    """Raise BadArgument where arguments are given that differ from what the design in a folder was begun with."""
    made = folder.design()
    given = {
        "seed": (seed, 0, made.seed),
        "runs": (runs, 1, made.runs),
        "set": (assignments(set), (), made.overrides),
        "out": (out, None, folder.path),
        "below": (below, None, None),
    }
    for name, (value, default, former) in given.items():
        if value not in (default, former):
            raise BadArgument(
                f"{folder.path} was begun with another {name}: {former!r:.60}, not {value!r:.60}",
                f"leave out {name}, or give the spec instead of the folder",
            )
