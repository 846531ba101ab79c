"""Arguments and options that several commands have."""

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer


def spec_files(incomplete: str) -> list[str]:
    """Return the specs and folders whose path begins as what is typed, for a shell's completion."""
    folder = Path(incomplete).parent if not incomplete.endswith("/") else Path(incomplete)
    begun = incomplete[: incomplete.rfind("/") + 1]
    try:
        found = sorted(folder.iterdir())
    except OSError:
        return []
    names = [f"{path.name}/" if path.is_dir() else path.name for path in found if _may_be_meant(path)]
    return [begun + name for name in names if (begun + name).startswith(incomplete)]


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

Lanes = Annotated[
    int,
    typer.Option(
        "--lanes", metavar="N", min=1, help="Episodes side by side in a kernel; results do not depend on it."
    ),
]

AsJson = Annotated[bool, typer.Option("--json", help="Print JSON instead of tables.")]


class Format(StrEnum):
    """How a result is printed."""

    TEXT = "text"
    JSON = "json"


AsFormat = Annotated[Format, typer.Option("--format", help="How to print it.")]
