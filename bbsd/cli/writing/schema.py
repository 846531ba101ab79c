"""`bbsd schema`."""

from bbsd.cli.terminal.output import show


def schema() -> None:
    """Print the JSON Schema of the language, for editors."""
    from bbsd.report.plain import json_text
    from bbsd.report.reference.schema import language_schema

    show(json_text(language_schema()))
