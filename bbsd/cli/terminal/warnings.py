"""A word on the warnings about a spec, where something else than `bbsd check` uses it."""

import shlex
from typing import TYPE_CHECKING

from bbsd.cli.terminal.output import say
from bbsd.errors import escape

if TYPE_CHECKING:
    from bbsd.language.loading import Loaded


def say_warnings(loaded: "Loaded") -> None:
    """Say on standard error how many warnings there are about a spec, and which command shows them."""
    if loaded.warnings:
        from bbsd.report.spec.checked import count_text

        file = escape(shlex.quote(loaded.source.file))
        say(
            f"{count_text(loaded.warnings)}: bbsd check {file} shows {'it' if len(loaded.warnings) == 1 else 'them'}"
        )
