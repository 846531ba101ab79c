"""`bbsd why`."""

from typing import TYPE_CHECKING, Annotated, cast

import typer

import bbsd
from bbsd.cli.options import (
    AllowImport,
    AsFormat,
    AsJson,
    DesignFile,
    Episode,
    ImportFrom,
    InPython,
    Overrides,
    ResultFormat,
    Seed,
    StepLimit,
    read_episode,
)
from bbsd.cli.terminal.access import stepping
from bbsd.cli.terminal.output import show
from bbsd.errors import SpecError
from bbsd.report.plain import json_text

if TYPE_CHECKING:
    from bbsd.explanation.why.described import Given


def why(
    spec: DesignFile,
    episode: Episode = "0",
    step: Annotated[
        int | None, typer.Option(metavar="N", min=1, help="The step that is asked about, from 1.")
    ] = None,
    robot: Annotated[
        int, typer.Option(metavar="N", min=0, help="The robot that is asked about, from 0.")
    ] = 0,
    at: Annotated[
        list[str] | None,
        typer.Option(
            "--at",
            metavar="NAME=VALUE",
            help="Instead of a step: a value of state, world or a sensor, for all robots or a list with one for each;"
            " may be repeated.",
            show_default=False,
        ),
    ] = None,
    unwanted: Annotated[
        list[str] | None,
        typer.Option(
            "--not",
            metavar="ACTION",
            help="An action or a behavior: what would have had to be different for it not to control?",
            show_default=False,
        ),
    ] = None,
    wanted: Annotated[
        list[str] | None,
        typer.Option(
            "--why-not",
            metavar="ACTION",
            help="An action or a behavior: what would have had to be different for it to control?",
            show_default=False,
        ),
    ] = None,
    seed: Seed = 0,
    overrides: Overrides = None,
    allow_import: AllowImport = None,
    import_from: ImportFrom = None,
    step_limit: StepLimit = 30.0,
    in_python: InPython = False,
    form: AsFormat = ResultFormat.TEXT,
    as_json: AsJson = False,
) -> None:
    """Say why a robot did what it did in a step.

    Tells for each layer whether it was excited, which cell it perceived, what it wanted and who controlled; and with
    --not and --why-not the smallest change of what was perceived, and of rules or order, that would have changed that.
    """
    from bbsd.explanation.why import answer_text

    answer = bbsd.why(
        spec,
        episode=read_episode(episode),
        step=step,
        robot=robot,
        at=dict(map(_read_value, at or ())),
        unwanted=unwanted or (),
        wanted=wanted or (),
        seed=seed,
        set=overrides or (),
        **stepping(allow_import, import_from, step_limit, in_python=in_python),
    )
    show(json_text(answer.to_plain()) if as_json or form is ResultFormat.JSON else answer_text(answer))


def _read_value(argument: str) -> tuple[str, "Given"]:
    """Return the name and the value of an argument NAME=VALUE, the value as YAML."""
    from bbsd.text import Source, read

    name, equals, text = argument.partition("=")
    if not equals or not name.strip():
        raise typer.BadParameter(f"{argument!r} is no NAME=VALUE")
    key = "_" * max(1, len(name) - 1)  # as long as the name, less the blank after its colon
    source = Source("--at", f"{key}: {text}")
    document = read(source)
    if document.diagnoses:
        raise SpecError(document.diagnoses, Source("--at", argument))
    value = document.data[key]
    if isinstance(value, dict) or value is None:
        raise typer.BadParameter(f"{argument!r} gives no value")
    return name.strip(), cast("Given", value)
