"""Diagnoses of a spec: where a mistake is, what it is, what to do about it, and how that is shown."""

from bbsd.errors.correction import Correction, Edit, Lines
from bbsd.errors.diagnosis import Diagnosis, Place, SpecError
from bbsd.errors.inert import inert, inert_cell, inert_json
from bbsd.errors.kinds.kind import DiagnosisKind, Severity
from bbsd.errors.rendering import character_name, escape, render_json, render_text
from bbsd.errors.suggestion import did_you_mean, nearest
from bbsd.errors.usage import UsageError

__all__ = [
    "Correction",
    "Diagnosis",
    "DiagnosisKind",
    "Edit",
    "Lines",
    "Place",
    "Severity",
    "SpecError",
    "UsageError",
    "character_name",
    "did_you_mean",
    "escape",
    "inert",
    "inert_cell",
    "inert_json",
    "nearest",
    "render_json",
    "render_text",
]
