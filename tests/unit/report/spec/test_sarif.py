from __future__ import annotations

from bbsd.errors import Correction, Diagnosis, DiagnosisKind, Edit, Place, Severity
from bbsd.errors.catalog import KINDS
from bbsd.report.spec import sarif
from bbsd.report.spec.sarif import sarif_log

DIAGNOSIS = Diagnosis("BB020", "unexpected key", Place("my specs/a.yaml", 3, 5, 4))


def run(*diagnoses):
    log = sarif_log(diagnoses)
    assert log["version"] == "2.1.0"
    return log["runs"][0]


def test_a_result_refers_to_the_rule_that_describes_it():
    found = run(DIAGNOSIS)
    (result,) = found["results"]
    rule = found["tool"]["driver"]["rules"][result["ruleIndex"]]
    assert rule["id"] == result["ruleId"] == "BB020"
    assert rule["shortDescription"]["text"] == KINDS["BB020"].title


def test_a_place_counts_from_1_and_ends_behind_its_last_character():
    (result,) = run(DIAGNOSIS)["results"]
    (location,) = result["locations"]
    assert location["physicalLocation"]["region"] == {"startLine": 3, "startColumn": 5, "endColumn": 9}
    assert run()["columnKind"] == "unicodeCodePoints"


def test_a_file_is_a_uri(tmp_path):
    def uri(file):
        (result,) = run(Diagnosis("BB020", "", Place(file, 1, 1)))["results"]
        return result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"]

    assert uri("my specs/a.yaml") == "my%20specs/a.yaml"
    assert uri(str(tmp_path / "a.yaml")) == f"file://{tmp_path}/a.yaml"


def test_every_kind_of_mistake_is_a_rule():
    rules = run()["tool"]["driver"]["rules"]
    assert [rule["id"] for rule in rules] == list(KINDS)


def test_the_level_is_the_severity(monkeypatch):
    kind = DiagnosisKind("BB101", "odd", "why", "example", "mend", Severity.WARNING)
    monkeypatch.setitem(KINDS, kind.code, kind)
    monkeypatch.setattr(sarif, "RULES", tuple(KINDS))
    results = run(DIAGNOSIS, Diagnosis(kind.code, "this is odd", Place("a.yaml", 1, 1)))["results"]
    assert [result["level"] for result in results] == ["error", "warning"]


def test_a_correction_is_a_fix() -> None:
    correction = Correction((Edit(2, 6, 2, 8, "and"),))
    place = Place("spec.yaml", 2, 6, 2)
    (result,) = sarif_log([Diagnosis("BB050", "wrong", place, "", correction)])["runs"][0]["results"]
    ((change,),) = (fix["artifactChanges"] for fix in result["fixes"])
    assert change["replacements"] == [
        {
            "deletedRegion": {"startLine": 2, "startColumn": 6, "endLine": 2, "endColumn": 8},
            "insertedContent": {"text": "and"},
        }
    ]
