"""`bbsd new`."""

import shlex
from collections.abc import Iterator
from enum import StrEnum
from importlib.resources import files
from pathlib import Path
from typing import Annotated

import typer

from bbsd.cli.options import SUFFIXES
from bbsd.cli.terminal.output import say, show
from bbsd.errors import UsageError, escape
from bbsd.files import write_text_whole
from bbsd.runs.storage.lock import writer_of

MAX_NAME_LENGTH = 100
"""Characters of a spec's name, at most, as the language allows."""


class Template(StrEnum):
    """Specs to start from, the simplest first: files in `templates`."""

    MINIMAL = "minimal"
    TWO_ROBOTS = "two_robots"
    ANSWERS = "answers"


class AlreadyExists(UsageError):
    """A file that would have to be overwritten."""

    advice = "no file is overwritten: choose another name, or remove the file"


def new(
    name: Annotated[
        str | None,
        typer.Argument(
            metavar="NAME", help="Name of the new spec; its file is NAME.yaml.", show_default=False
        ),
    ] = None,
    template: Annotated[Template, typer.Option(help="The spec to start from.")] = Template.MINIMAL,
    listed: Annotated[bool, typer.Option("--list", help="List the templates and exit.")] = False,
) -> None:
    """Write a small spec that runs, as a start for your own.

    Also writes the JSON Schema of the language beside it, by which editors complete and check specs.
    """
    if listed:
        show("\n".join(_descriptions()))
    elif name:
        _write(Path(name if Path(name).suffix in SUFFIXES else f"{name}.yaml"), template)
    else:
        raise typer.BadParameter("give a NAME, or --list")


def _descriptions() -> Iterator[str]:
    from bbsd.text import Source, read

    width = max(map(len, Template))
    for template in Template:
        yield f"{template:<{width}}  {read(Source(template, template_text(template))).data['summary']}"


def template_text(template: Template) -> str:
    """Return the text of a template."""
    return files("bbsd.cli").joinpath("templates", f"{template}.yaml").read_text(encoding="utf-8")


def _write(path: Path, template: Template) -> None:
    from bbsd.report.reference.schema import SCHEMA_FILE
    from bbsd.text import Source, read
    from bbsd.text.writing.patch import replace_blocks

    document = read(Source(template, template_text(template)))
    _create(path, replace_blocks(document, {("name",): path.stem[:MAX_NAME_LENGTH]}))
    schema = path.with_name(SCHEMA_FILE)
    if not schema.exists():
        _create(schema, _schema_text())
    say(f"wrote {escape(str(path))}; next: {escape(shlex.join(['bbsd', 'design', str(path)]))}")


def _schema_text() -> str:
    from bbsd.report.plain import json_text
    from bbsd.report.reference.schema import language_schema

    return f"{json_text(language_schema())}\n"


def _create(path: Path, text: str) -> None:
    with writer_of(path):
        try:
            path.touch(exist_ok=False)
        except FileExistsError:
            raise AlreadyExists(f"{path} already exists") from None
        try:
            write_text_whole(path, text)
        except BaseException:
            path.unlink()
            raise
