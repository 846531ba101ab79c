"""Arguments and options that several commands have."""

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer


def spec_files(incomplete: str) -> list[str]:
    """Return the specs and folders whose path begins as what is typed, for a shell's completion.

    What is in a folder is added where nothing else is meant: shells put a blank behind what is alone.
    """
    begun = incomplete[: incomplete.rfind("/") + 1]
    try:
        paths = sorted(Path(begun or ".").iterdir())
    except OSError:
        return []
    names = (f"{path.name}/" if path.is_dir() else path.name for path in paths if _may_be_meant(path))
    found = [begun + name for name in names if (begun + name).startswith(incomplete)]
    is_alone = len(found) == 1 and found[0].endswith("/")
    return [*found, *spec_files(found[0])] if is_alone else found


def _may_be_meant(path: Path) -> bool:
    return not path.name.startswith(".") and (path.suffix in SUFFIXES or path.is_dir())


SUFFIXES = {".yaml", ".yml"}

SpecFile = Annotated[
    Path,
    typer.Argument(
        metavar="SPEC", help="The spec, a YAML file.", show_default=False, autocompletion=spec_files
    ),
]

Seed = Annotated[int, typer.Option("--seed", metavar="N", min=0, help="Names all random streams.")]

Overrides = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        metavar="PATH=VALUE",
        help="Another value, such as design.coevolution.generations=10; may be repeated.",
        show_default=False,
    ),
]

Jobs = Annotated[
    int, typer.Option(metavar="N", min=1, help="Threads that share the work; the result is the same.")
]
Lanes = Annotated[
    int,
    typer.Option(
        "--lanes", metavar="N", min=1, help="Episodes side by side in a kernel; results do not depend on it."
    ),
]

AsJson = Annotated[bool, typer.Option("--json", help="Print JSON instead of tables.")]


class ResultFormat(StrEnum):
    """How a result is printed."""

    TEXT = "text"
    JSON = "json"


AsFormat = Annotated[ResultFormat, typer.Option("--format", help="How to print it.")]
