"""`bbsd version`."""

import typer

from bbsd.version import __version__


def version() -> None:
    """Show the version."""
    typer.echo(f"bbsd {__version__}")
