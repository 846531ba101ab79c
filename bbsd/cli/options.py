"""Arguments and options that several commands share."""

from enum import StrEnum
from pathlib import Path
from typing import Annotated, Literal

import typer


def spec_files(incomplete: str) -> list[str]:
    """Return the specs and folders whose path starts with the typed text, for completion in a shell.

    If only one folder matches, its content is added: shells put a space after a single match.
    """
    folder = incomplete[: incomplete.rfind("/") + 1]
    try:
        paths = sorted(Path(folder or ".").iterdir())
    except OSError:
        return []
    names = (f"{path.name}/" if path.is_dir() else path.name for path in paths if _is_candidate(path))
    matches = [folder + name for name in names if (folder + name).startswith(incomplete)]
    is_one_folder = len(matches) == 1 and matches[0].endswith("/")
    return [*matches, *spec_files(matches[0])] if is_one_folder else matches


def _is_candidate(path: Path) -> bool:
    return not path.name.startswith(".") and (path.suffix in SUFFIXES or path.is_dir())


SUFFIXES = {".yaml", ".yml"}

SpecFile = Annotated[
    Path,
    typer.Argument(
        metavar="SPEC",
        help="The spec, a YAML file; the folder of a run stands for its design.",
        show_default=False,
        autocompletion=spec_files,
    ),
]

DesignFile = Annotated[
    Path,
    typer.Argument(
        metavar="DESIGN",
        help="The design: a spec without holes, as a YAML file, or the folder of a run.",
        show_default=False,
        autocompletion=spec_files,
    ),
]

Seed = Annotated[
    int,
    typer.Option(
        "--seed", metavar="N", min=0, help="Seed of all random numbers; the same seed gives the same result."
    ),
]

Overrides = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        metavar="PATH=VALUE",
        help="Override a value of the spec, such as design.coevolution.generations=10; may be repeated.",
        show_default=False,
    ),
]

Jobs = Annotated[int, typer.Option(metavar="N", min=1, help="Threads to use; affects only the speed.")]
Lanes = Annotated[
    int,
    typer.Option(
        "--lanes",
        metavar="N",
        min=1,
        help="Episodes that a kernel runs side by side; affects only the speed.",
    ),
]

AllowImport = Annotated[
    list[str] | None,
    typer.Option(
        metavar="MODULE",
        help="Allow the spec's environment to import a module, which runs its code; may be repeated.",
        show_default=False,
    ),
]

ImportFrom = Annotated[
    list[Path] | None,
    typer.Option(
        metavar="FOLDER",
        help="Look for allowed modules in this folder too; may be repeated.",
        show_default="the installed environment alone",
    ),
]

StepLimit = Annotated[
    float,
    typer.Option(
        "--step-limit",
        metavar="S",
        min=0.1,
        help="Seconds that a step of the spec's environment may take.",
    ),
]

InPython = Annotated[
    bool,
    typer.Option(
        "--step-in-python",
        help="Step the spec's environment in Python also where its table of transitions could be used.",
    ),
]

AsJson = Annotated[bool, typer.Option("--json", help="The same as --format json.")]


class ResultFormat(StrEnum):
    """How a result is printed."""

    TEXT = "text"
    JSON = "json"


AsFormat = Annotated[ResultFormat, typer.Option("--format", help="Format of the output.")]


def read_episode(text: str) -> int | Literal["worst", "median", "best"]:
    """Return an episode's number, or the rank that names it; raise BadParameter for anything else."""
    match text:
        case "worst" | "median" | "best":
            return text
    if text.isascii() and text.isdecimal():
        return int(text)
    raise typer.BadParameter(f"{text!r} is neither a number from 0 nor worst, median or best")


Episode = Annotated[
    str,
    typer.Option(
        "--episode",
        metavar="N|worst|median|best",
        help="An episode of bbsd evaluate: its number from 0, or by its return among all that are run.",
    ),
]
