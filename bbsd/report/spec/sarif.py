"""Diagnoses as SARIF 2.1.0, the exchange format of tools that check code."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any
from urllib.parse import quote

from bbsd.errors.catalog import KINDS
from bbsd.report.spec.github import message_text
from bbsd.version import __version__

if TYPE_CHECKING:
    from collections.abc import Iterable

    from bbsd.errors import Correction, Diagnosis, DiagnosisKind, Place

SCHEMA = "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json"
RULES = tuple(KINDS)
"""The codes, in the order in which a log describes them."""


def sarif_log(diagnoses: Iterable[Diagnosis]) -> dict[str, Any]:
    """Return a log of one run as plain data."""
    driver = {"name": "bbsd", "version": __version__, "rules": [_rule(kind) for kind in KINDS.values()]}
    run = {
        "tool": {"driver": driver},
        "columnKind": "unicodeCodePoints",
        "results": [_result(diagnosis) for diagnosis in diagnoses],
    }
    return {"$schema": SCHEMA, "version": "2.1.0", "runs": [run]}


def _rule(kind: DiagnosisKind) -> dict[str, Any]:
    return {
        "id": kind.code,
        "shortDescription": {"text": kind.title},
        "fullDescription": {"text": kind.explanation},
        "defaultConfiguration": {"level": kind.severity.value},
        "help": {"text": f"Such as:\n\n{kind.example}\n\nInstead:\n\n{kind.mend}"},
    }


def _result(diagnosis: Diagnosis) -> dict[str, Any]:
    return {
        "ruleId": diagnosis.code,
        "ruleIndex": RULES.index(diagnosis.code),
        "level": diagnosis.severity.value,
        "message": {"text": message_text(diagnosis)},
        "locations": [{"physicalLocation": _location(diagnosis.place)}],
        **({"fixes": [_fix(diagnosis.place.file, diagnosis.correction)]} if diagnosis.correction else {}),
    }


def _fix(file: str, correction: Correction) -> dict[str, Any]:
    """Return what to change; that it is one of several readings is said in its description."""
    what = "What is meant" if correction.is_certain else "What may be meant"
    replacements = [
        {
            "deletedRegion": {
                "startLine": edit.line,
                "startColumn": edit.column,
                "endLine": edit.end_line,
                "endColumn": edit.end_column,
            },
            "insertedContent": {"text": edit.text},
        }
        for edit in correction.edits
    ]
    change = {"artifactLocation": {"uri": _uri(file)}, "replacements": replacements}
    return {"description": {"text": what}, "artifactChanges": [change]}


def _location(place: Place) -> dict[str, Any]:
    region = {
        "startLine": place.line,
        "startColumn": place.column,
        "endColumn": place.column + place.length,
    }
    return {"artifactLocation": {"uri": _uri(place.file)}, "region": region}


def _uri(file: str) -> str:
    """Return a file name as a URI reference; it is relative if the name is."""
    path = Path(file)
    return path.as_uri() if path.is_absolute() else quote(path.as_posix())
