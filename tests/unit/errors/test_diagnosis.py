import pickle

import pytest

from bbsd.errors import Diagnosis, DiagnosisKind, Place, Severity, SpecError
from bbsd.errors.catalog import KINDS
from bbsd.text import Source

MISTAKES = (
    Diagnosis("BB006", "the key is given twice", Place("spec.yaml", 3, 1, 4)),
    Diagnosis("BB012", "nested too deeply", Place("spec.yaml", 7, 2)),
)


def test_an_error_lists_all_its_diagnoses() -> None:
    error = SpecError(MISTAKES, Source("spec.yaml", "text"))
    assert str(error) == (
        "spec.yaml:3:1: error[BB006]: the key is given twice\nspec.yaml:7:2: error[BB012]: nested too deeply"
    )


def test_an_error_can_be_sent_between_processes() -> None:
    error = pickle.loads(pickle.dumps(SpecError(MISTAKES, Source("spec.yaml", "text"))))
    assert error.diagnoses == MISTAKES
    assert error.source.line(1) == "text"


def test_the_severity_is_that_of_the_kind(monkeypatch: pytest.MonkeyPatch) -> None:
    found = Diagnosis("BB101", "this is odd", Place("spec.yaml", 1, 1))
    assert found.severity is Severity.MISTAKE
    made_up = DiagnosisKind("BB101", "odd", "why", "example", "mend", Severity.WARNING)
    monkeypatch.setitem(KINDS, "BB101", made_up)
    assert found.severity is Severity.WARNING
    assert str(SpecError([MISTAKES[0], found], Source("spec.yaml", "text"))).splitlines() == [
        "spec.yaml:3:1: error[BB006]: the key is given twice",
        "spec.yaml:1:1: warning[BB101]: this is odd",
    ]
