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
    """Return one command per line; characters that would end a property or start another command are escaped."""
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
    listed = ",".join(f"{name}={value.translate(IN_PROPERTY)}" for name, value in properties.items())
    return f"::{diagnosis.severity} {listed}::{message_text(diagnosis).translate(IN_MESSAGE)}"


def message_text(diagnosis: Diagnosis) -> str:
    """Return the message and the advice of a diagnosis in one text."""
    return escape("; ".join(filter(None, (diagnosis.message, diagnosis.advice))))
