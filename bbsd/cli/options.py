"""Arguments and options that several commands have."""

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

SpecFile = Annotated[Path, typer.Argument(metavar="SPEC", help="The spec, a YAML file.", show_default=False)]

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
