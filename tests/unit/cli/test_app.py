"""Options that mean the same in all commands."""

import typer

from bbsd.cli.app import app

COMMANDS = typer.main.get_command(app).commands
FORMATS = {
    name: {text: option for option in command.params for text in option.opts}
    for name, command in COMMANDS.items()
}


def test_each_command_that_prints_json_has_a_format_and_its_short_form() -> None:
    with_json = {name for name, options in FORMATS.items() if "--json" in options}
    with_format = {name for name, options in FORMATS.items() if "--format" in options}
    assert (
        with_json
        == with_format
        >= {"check", "design", "evaluate", "explain", "compare", "why", "runs", "spaces", "doctor"}
    )


def test_text_and_json_are_among_the_formats_of_each_and_text_is_the_default() -> None:
    for options in FORMATS.values():
        if "--format" in options:
            assert {"text", "json"} <= set(options["--format"].type_descriptor.annotation)
            assert options["--format"].default == "text"
