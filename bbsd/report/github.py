"""Diagnoses as workflow commands, which GitHub shows beside the lines of a pull request."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.errors import escape

if TYPE_CHECKING:
    from collections.abc import Iterable

    from bbsd.errors import Diagnosis

IN_MESSAGE = str.maketrans({"%": "%25", "\r": "%0D", "\n": "%0A"})
IN_PROPERTY = IN_MESSAGE | str.maketrans({":": "%3A", ",": "%2C"})


def github_text(diagnoses: Iterable[Diagnosis]) -> str:
    """Return one command a line; what would end a property or begin another command is escaped."""
    return "\n".join(map(_command, diagnoses))


def _command(diagnosis: Diagnosis) -> str:
    place = diagnosis.place
    properties = {
        "file": place.file,
        "line": str(place.line),
        "col": str(place.column),
        "endColumn": str(place.column + place.length),
        "title": diagnosis.code,
    }
    written = ",".join(f"{name}={value.translate(IN_PROPERTY)}" for name, value in properties.items())
    return f"::{diagnosis.severity} {written}::{message_text(diagnosis).translate(IN_MESSAGE)}"


def message_text(diagnosis: Diagnosis) -> str:
    """Return what is wrong and what to do about it, in one text."""
    return escape("; ".join(filter(None, (diagnosis.message, diagnosis.advice))))
