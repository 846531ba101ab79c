from __future__ import annotations

from bbsd.errors import Diagnosis, DiagnosisKind, Place, Severity
from bbsd.errors.catalog import KINDS
from bbsd.report.spec.github import github_text


def test_a_diagnosis_is_one_command():
    found = github_text([Diagnosis("BB020", "unexpected key", Place("a.yaml", 3, 5, 4), "remove it")])
    assert found == "::error file=a.yaml,line=3,col=5,endColumn=9,title=BB020::unexpected key; remove it"


def test_a_file_or_message_cannot_add_a_property_or_a_command():
    place = Place("a,line=1:b%\n::error::x", 1, 1)
    found = github_text([Diagnosis("BB001", "100 %\r\n::error::y", place)])
    assert found == (
        "::error file=a%2Cline=1%3Ab%25%0A%3A%3Aerror%3A%3Ax,line=1,col=1,endColumn=2,title=BB001"
        "::100 %25\\r\\n::error::y"
    )


def test_no_mistakes_are_no_text():
    assert github_text([]) == ""


def test_a_warning_is_a_command_of_its_own(monkeypatch):
    kind = DiagnosisKind("BB101", "odd", "why", "example", "mend", Severity.WARNING)
    monkeypatch.setitem(KINDS, kind.code, kind)
    found = github_text([Diagnosis(kind.code, "this is odd", Place("a.yaml", 1, 1))])
    assert found.startswith("::warning file=a.yaml,line=1,")
